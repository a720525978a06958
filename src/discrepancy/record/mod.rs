//! A measured run as columns and signals, with the noise of its sensor.

pub mod angle;
pub(crate) mod channel_noise;
pub(crate) mod input_noise;
pub(crate) mod level_crossings;
pub mod local_polynomial;
pub(crate) mod quantisation;
pub(crate) mod rauch_tung_striebel;
pub mod row_weights;
pub mod run_record;
pub mod sensor_noise;

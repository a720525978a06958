//! A model as its user states it: vehicle, parameters and columns of the log, with the effects that may be named.

use crate::effects::{self, Effect};
use crate::error::{Error, Result};
use crate::files::{ModelFile, write_whole};
use crate::vehicles::Vehicle;
use crate::{dynamics, extensions, vehicles};
use std::fmt::Write;
use std::path::Path;

/// A vehicle with its parameters, the columns of its logs, and the effects that it may miss.
///
/// ```
/// let model = creepage::Model::read("examples/runs/cornering/model.toml")?;
/// assert_eq!(model.vehicle(), "unicycle");
/// # Ok::<(), creepage::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Model {
    pub(crate) file: ModelFile,
    pub(crate) library: Vec<Effect>,
    vehicles: Vec<Vehicle>,
}

impl Model {
    /// Reads a model file; vehicles of the user's own that it names are read with it.
    ///
    /// ```
    /// assert!(creepage::Model::read("no/such/model.toml").is_err());
    /// ```
    ///
    /// # Errors
    /// With file, line and column: no TOML, an unknown vehicle, key or effect, a value out of range.
    pub fn read(path: impl AsRef<Path>) -> Result<Self> {
        Self::read_with(path, None, None)
    }

    /// As [`Model::read`], with files of the user's own vehicles and effects beside the catalogues.
    ///
    /// ```
    /// let effects = Some("examples/effects/my_effects.toml".as_ref());
    /// assert!(creepage::Model::read_with("examples/runs/cornering/model.toml", None, effects).is_ok());
    /// ```
    ///
    /// # Errors
    /// As [`Model::read`]; when a vehicle or an effect of the user's own does not hold.
    pub fn read_with(path: impl AsRef<Path>, vehicles: Option<&Path>, effects: Option<&Path>) -> Result<Self> {
        let path = path.as_ref();
        let vehicles = extensions::vehicles_of(path, vehicles)?;
        let library = match effects {
            Some(effects) => extensions::with_own_on(effects, &vehicles)?,
            None => effects::all().to_vec(),
        };
        let file = ModelFile::read(path, &dynamics::known_on(&vehicles, &library))?;
        Ok(Self { file, library, vehicles })
    }

    /// The model that the text of a model file describes.
    ///
    /// ```
    /// let text = "vehicle = \"unicycle\"\n[parameters]\nwheel_radius = 0.1\n[columns]\ntime = \"t\"\n";
    /// assert_eq!(creepage::Model::parse(text)?.text(), text);
    /// # Ok::<(), creepage::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Model::read`].
    pub fn parse(text: &str) -> Result<Self> {
        Self::on(text, vehicles::all().to_vec(), effects::all().to_vec())
    }

    /// A vehicle of the catalogue with its parameters in SI units; columns of logs bear the names of their roles.
    ///
    /// ```
    /// let robot = creepage::Model::new("differential-drive", &[("wheel_radius", 0.1), ("track_width", 0.4)])?;
    /// assert_eq!(robot.vehicle(), "differential-drive");
    /// # Ok::<(), creepage::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the vehicle or a parameter is unknown, a parameter is missing, or its value is out of range.
    pub fn new(vehicle: &str, parameters: &[(&str, f64)]) -> Result<Self> {
        let mut text = format!("vehicle = {vehicle:?}\n\n[parameters]\n");
        for (name, value) in parameters {
            if !value.is_finite() {
                return Err(Error::input(format!("the parameter {name} is {value}")).help("give a finite number"));
            }
            let _ = writeln!(text, "{name:?} = {value:?}");
        }
        Self::parse(&text)
    }

    fn on(text: &str, vehicles: Vec<Vehicle>, library: Vec<Effect>) -> Result<Self> {
        let file = ModelFile::parse(text, "model.toml", &dynamics::known_on(&vehicles, &library))?;
        Ok(Self { file, library, vehicles })
    }

    /// The same model with another text, such as a patched one.
    pub(crate) fn rewritten(&self, text: &str) -> Result<Self> {
        let known = dynamics::known_on(&self.vehicles, &self.library);
        let file = ModelFile::parse(text, self.file.path.clone(), &known)?;
        Ok(Self { file, ..self.clone() })
    }

    /// The model with effects of the user's own, from a file, beside those of the catalogue.
    ///
    /// ```
    /// let model = creepage::Model::read("examples/runs/cornering/model.toml")?;
    /// assert!(model.with_effects("examples/effects/my_effects.toml").is_ok());
    /// # Ok::<(), creepage::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the file cannot be read, or an effect of it does not hold on a vehicle it applies to.
    pub fn with_effects(self, path: impl AsRef<Path>) -> Result<Self> {
        Ok(Self { library: extensions::with_own_on(path, &self.vehicles)?, ..self })
    }

    /// The file and the effects that may be named.
    #[doc(hidden)]
    pub fn into_parts(self) -> (ModelFile, Vec<Effect>) {
        (self.file, self.library)
    }

    /// The id of the vehicle.
    ///
    /// ```
    /// assert_eq!(creepage::Model::new("unicycle", &[("wheel_radius", 0.1)])?.vehicle(), "unicycle");
    /// # Ok::<(), creepage::Error>(())
    /// ```
    pub fn vehicle(&self) -> &str {
        &self.file.vehicle
    }

    /// The text of the model file.
    ///
    /// ```
    /// let model = creepage::Model::new("unicycle", &[("wheel_radius", 0.1)])?;
    /// assert!(model.text().contains("0.1"));
    /// # Ok::<(), creepage::Error>(())
    /// ```
    pub fn text(&self) -> &str {
        &self.file.text
    }

    /// Writes the model file, whole or not at all.
    ///
    /// ```no_run
    /// creepage::Model::new("unicycle", &[("wheel_radius", 0.1)])?.write("model.toml")?;
    /// # Ok::<(), creepage::Error>(())
    /// ```
    ///
    /// # Errors
    /// When the file cannot be written.
    pub fn write(&self, path: impl AsRef<Path>) -> Result<()> {
        write_whole(path.as_ref(), self.text().as_bytes())
    }
}

impl AsRef<ModelFile> for Model {
    fn as_ref(&self) -> &ModelFile {
        &self.file
    }
}

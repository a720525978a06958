//! The Radau IIA method of order five (Hairer and Wanner, Solving Ordinary Differential Equations II, table IV.5.6).

/// Stages of the method.
pub(super) const STAGES: usize = 3;

/// The nodes and the matrix of the method; its last row are the weights, for the last stage is the end.
pub(super) struct Tableau {
    pub c: [f64; STAGES],
    pub a: [[f64; STAGES]; STAGES],
}

/// The method of order five.
pub(super) fn tableau() -> Tableau {
    let r = 6.0_f64.sqrt();
    Tableau {
        c: [(4.0 - r) / 10.0, (4.0 + r) / 10.0, 1.0],
        a: [
            [(88.0 - 7.0 * r) / 360.0, (296.0 - 169.0 * r) / 1800.0, (-2.0 + 3.0 * r) / 225.0],
            [(296.0 + 169.0 * r) / 1800.0, (88.0 + 7.0 * r) / 360.0, (-2.0 - 3.0 * r) / 225.0],
            [(16.0 - r) / 36.0, (16.0 + r) / 36.0, 1.0 / 9.0],
        ],
    }
}

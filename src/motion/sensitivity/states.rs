//! States with their sensitivities, of one trajectory and of several side by side, and sums of them.

/// State and sensitivities at a time; S is stored row by row, with
/// [`Equations::visible`](crate::model::Equations::visible) + p columns.
#[derive(Clone, Debug, Default)]
pub struct StateSensitivity {
    /// State.
    pub z: Vec<f64>,
    /// Sensitivities, or empty when they are not wanted.
    pub s: Vec<f64>,
}

impl StateSensitivity {
    /// What is to be carried on: the hidden states, and all sensitivities.
    pub(crate) fn hidden(self, visible: usize) -> Self {
        Self { z: self.z[visible..].to_vec(), s: self.s }
    }
}

/// L states and their sensitivities; S is stored row by row, with [`Equations::visible`] + p columns, or empty when it is
/// not wanted.
#[derive(Clone, Debug, Default)]
pub(crate) struct LaneStates<const L: usize> {
    pub z: Vec<[f64; L]>,
    pub s: Vec<[f64; L]>,
}

impl<const L: usize> LaneStates<L> {
    /// As many values as are wanted.
    #[inline(always)]
    pub(crate) fn make_room(&mut self, z: usize, s: usize) {
        self.z.resize(z, [0.0; L]);
        self.s.resize(s, [0.0; L]);
    }

    /// States that begin at some values, their sensitivities not wanted.
    pub fn of(starts: [&[f64]; L]) -> Self {
        let n = starts.iter().map(|z| z.len()).min().unwrap_or(0);
        Self { z: (0..n).map(|i| starts.map(|z| z[i])).collect(), s: vec![] }
    }

    /// One of the arcs.
    pub fn one(&self, l: usize) -> StateSensitivity {
        let lane = |values: &[[f64; L]]| values.iter().map(|v| v[l]).collect();
        StateSensitivity { z: lane(&self.z), s: lane(&self.s) }
    }
}

/// out = y + h·k
#[inline(always)]
pub(crate) fn sum<const L: usize>(out: &mut [[f64; L]], y: &[[f64; L]], h: &[f64; L], k: &[[f64; L]]) {
    for ((out, y), k) in out.iter_mut().zip(y).zip(k) {
        for l in 0..L {
            out[l] = y[l] + h[l] * k[l];
        }
    }
}

/// out += h·k
#[inline(always)]
pub(crate) fn add<const L: usize>(out: &mut [[f64; L]], h: &[f64; L], k: &[[f64; L]]) {
    for (out, k) in out.iter_mut().zip(k) {
        for l in 0..L {
            out[l] += h[l] * k[l];
        }
    }
}

/// Takes the new values where they are wanted.
#[inline(always)]
pub(crate) fn take<const L: usize>(old: &mut [[f64; L]], new: &[[f64; L]], wanted: &[bool; L]) {
    for (old, new) in old.iter_mut().zip(new) {
        for l in 0..L {
            old[l] = if wanted[l] { new[l] } else { old[l] };
        }
    }
}

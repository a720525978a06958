//! Carriers of a comparison: normal forms prove an identity, floating-point numbers refute one.

use crate::formula::{Normal, Scalar, Symbol};

/// Values of which motions below this share of one another differ by rounding.
const ROUNDING: f64 = 1e-12;
/// Values of which motions above this share of one another differ for sure.
pub const SURE: f64 = 1e-6;

/// Values in which two families of motions can be compared.
pub trait Carrier: Scalar {
    /// A symbol that is left open; numbers come in several sets.
    fn open(name: &Symbol, set: u32) -> Self;

    /// Whether it is zero beside values of a given size; `None` where rounding leaves that open.
    fn vanishes_beside(&self, size: &[&Self]) -> Option<bool>;

    /// Whether it is zero exactly.
    fn is_exactly_zero(&self) -> bool;
}

impl Carrier for Normal {
    fn open(name: &Symbol, _: u32) -> Self {
        Normal::symbol(name.clone())
    }

    fn vanishes_beside(&self, _: &[&Self]) -> Option<bool> {
        Some(self.is_zero())
    }

    fn is_exactly_zero(&self) -> bool {
        self.is_zero()
    }
}

impl Carrier for f64 {
    fn open(name: &Symbol, set: u32) -> Self {
        between(0.2, 0.9, fraction(name.as_str(), set))
    }

    fn vanishes_beside(&self, size: &[&Self]) -> Option<bool> {
        let size = size.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        match self.abs() {
            v if v <= ROUNDING * size => Some(true),
            v if v > SURE * size => Some(false),
            _ => None,
        }
    }

    fn is_exactly_zero(&self) -> bool {
        *self == 0.0
    }
}

/// A number between two others, at a share of the way.
pub fn between(low: f64, high: f64, share: f64) -> f64 {
    low + (high - low) * share
}

/// A share of one that a name and a whole number stand for (FNV-1a, mixed as in SplitMix64).
pub fn fraction(name: &str, set: u32) -> f64 {
    let bytes = set.to_le_bytes().into_iter().chain(name.bytes());
    let hash = bytes.fold(0xcbf2_9ce4_8422_2325_u64, |h, b| (h ^ u64::from(b)).wrapping_mul(0x0100_0000_01b3));
    let mixed = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    ((mixed ^ (mixed >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
}

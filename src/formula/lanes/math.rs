//! Elementary functions over a block of lanes, the same bits on every processor.

use crate::formula::Fun;
use crate::formula::float::{finite, quotient};

/// Largest argument whose whole quarter turns are taken away exactly: 2²⁰·π/2 and some margin below.
const MAX_REDUCIBLE: f64 = 1.0e6;
/// Adding it rounds to a whole number, which then stands in the low bits.
const ROUNDING_SHIFT: f64 = 6_755_399_441_055_744.0;

/// π/2 in three parts; the first two have 33 bits, so that their products with whole numbers below 2²⁰ are exact.
const QUARTER_TURN: [f64; 3] = [
    f64::from_bits(0x3FF9_21FB_5440_0000),
    f64::from_bits(0x3DD0_B461_1A60_0000),
    f64::from_bits(0x3BA3_198A_2E03_7073),
];

/// Minimax coefficients of Sun's fdlibm for |r| ≤ π/4: sin r = r + r³·S(r²), cos r = 1 − r²/2 + r⁴·C(r²).
#[allow(clippy::excessive_precision)] // as published
const S: [f64; 6] = [
    -1.666_666_666_666_663_243_48e-1,
    8.333_333_333_322_489_461_24e-3,
    -1.984_126_982_985_794_931_34e-4,
    2.755_731_370_707_006_767_89e-6,
    -2.505_076_025_340_686_341_95e-8,
    1.589_690_995_211_550_102_21e-10,
];
#[allow(clippy::excessive_precision)] // as published
const C: [f64; 6] = [
    4.166_666_666_666_660_190_37e-2,
    -1.388_888_888_887_410_957_49e-3,
    2.480_158_728_947_672_941_78e-5,
    -2.755_731_435_139_066_330_35e-7,
    2.087_572_321_298_174_827_9e-9,
    -1.135_964_755_778_819_482_65e-11,
];

/// Horner's scheme.
#[inline(always)]
fn horner(z: f64, c: &[f64; 6]) -> f64 {
    c[0] + z * (c[1] + z * (c[2] + z * (c[3] + z * (c[4] + z * c[5]))))
}

/// sin x and cos x, each within 2 units in the last place.
///
/// Whole quarter turns are taken away in three parts (Cody and Waite); arguments beyond [`MAX_REDUCIBLE`] go to the crate `libm`. They
/// are written where they are to stay: copies of blocks cost as much as a tenth of a motion.
#[inline(always)]
pub(super) fn sin_cos<const L: usize>(x: &[f64; L], s: &mut [f64; L], c: &mut [f64; L]) {
    let mut near = true;
    for l in 0..L {
        near &= x[l].abs() <= MAX_REDUCIBLE;
        let shifted = x[l] * std::f64::consts::FRAC_2_PI + ROUNDING_SHIFT;
        let (turns, n) = (shifted.to_bits(), shifted - ROUNDING_SHIFT);
        let r = ((x[l] - n * QUARTER_TURN[0]) - n * QUARTER_TURN[1]) - n * QUARTER_TURN[2];
        let z = r * r;
        let sine = r + (r * z) * horner(z, &S);
        let half = 0.5 * z;
        let w = 1.0 - half;
        let cosine = w + (((1.0 - w) - half) + (z * z) * horner(z, &C));
        // Odd quarter turns swap the two; the second bit is the sign.
        let swap = 0u64.wrapping_sub(turns & 1);
        let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
        s[l] = f64::from_bits(((sine & !swap) | (cosine & swap)) ^ ((turns & 2) << 62));
        c[l] = f64::from_bits(((cosine & !swap) | (sine & swap)) ^ ((turns.wrapping_add(1) & 2) << 62));
    }
    if !near {
        far_sin_cos(x, s, c);
    }
}

/// Puts the sines and cosines of what is far in the place of what was found for them; both are NaN where x is no number or
/// infinite.
#[cold]
#[inline(never)]
fn far_sin_cos<const L: usize>(x: &[f64; L], s: &mut [f64; L], c: &mut [f64; L]) {
    for l in 0..L {
        if x[l].abs() > MAX_REDUCIBLE {
            (s[l], c[l]) = libm::sincos(x[l]);
        }
    }
}

/// A function other than sine and cosine.
#[inline(always)]
pub(super) fn call<const L: usize>(f: Fun, x: &[f64; L]) -> [f64; L] {
    let mut y = [0.0; L];
    match f {
        Fun::Sin => sin_cos(x, &mut y, &mut [0.0; L]),
        Fun::Cos => sin_cos(x, &mut [0.0; L], &mut y),
        Fun::Tan | Fun::Cot => {
            let (mut s, mut c) = ([0.0; L], [0.0; L]);
            sin_cos(x, &mut s, &mut c);
            for l in 0..L {
                y[l] = if matches!(f, Fun::Tan) { quotient(s[l], c[l]) } else { quotient(c[l], s[l]) };
            }
        }
        Fun::Sqrt => {
            for l in 0..L {
                y[l] = finite(x[l].sqrt());
            }
        }
        Fun::Abs => {
            for l in 0..L {
                y[l] = finite(x[l].abs());
            }
        }
        Fun::Sign => {
            for l in 0..L {
                y[l] = if x[l].is_finite() { f64::from(i8::from(x[l] > 0.0) - i8::from(x[l] < 0.0)) } else { f64::NAN };
            }
        }
        Fun::Step => {
            for l in 0..L {
                y[l] = if x[l].is_finite() { f64::from(u8::from(x[l] > 0.0)) } else { f64::NAN };
            }
        }
        _ => {
            for l in 0..L {
                y[l] = one_by_one(f, x[l]);
            }
        }
    }
    y
}

/// Functions that are rare in constraints, by the crate `libm`, which is the same on every processor.
#[inline(never)]
fn one_by_one(f: Fun, x: f64) -> f64 {
    if !x.is_finite() {
        return f64::NAN;
    }
    finite(match f {
        Fun::Asin => libm::asin(x),
        Fun::Acos => libm::acos(x),
        Fun::Atan => libm::atan(x),
        Fun::Tanh => libm::tanh(x),
        Fun::Exp => libm::exp(x),
        _ => libm::log(x),
    })
}

/// xⁿ by repeated squaring; undefined on overflow, and at zero for n < 0.
#[inline(always)]
pub(super) fn power<const L: usize>(x: &[f64; L], n: i32) -> [f64; L] {
    let mut y = [1.0; L];
    for l in 0..L {
        let (mut square, mut left, mut product) = (x[l], n.unsigned_abs(), 1.0);
        while left > 0 {
            if left & 1 == 1 {
                product *= square;
            }
            left >>= 1;
            if left > 0 {
                square *= square;
            }
        }
        let whole = if x[l].is_finite() { finite(product) } else { f64::NAN };
        y[l] = if n < 0 { quotient(1.0, whole) } else { whole };
    }
    y
}

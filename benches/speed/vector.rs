//! What code written by hand for this processor's vectors can do: products and sums in one rounding where it has them.

/// Lanes: two vectors of AVX-512, so that one waits while the other works.
pub const WIDTH: usize = 16;

/// Runs work with the widest instructions there are.
pub fn widest(work: impl FnOnce()) {
    #[cfg(target_arch = "x86_64")]
    {
        use std::is_x86_feature_detected as has;
        if has!("avx512f") && has!("avx512dq") && has!("avx512vl") && has!("fma") {
            // SAFETY: the processor was asked.
            return unsafe { with_avx512(work) };
        }
        if has!("avx2") && has!("fma") {
            // SAFETY: the processor was asked.
            return unsafe { with_avx2(work) };
        }
    }
    work();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,fma")]
fn with_avx512(work: impl FnOnce()) {
    work();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma")]
fn with_avx2(work: impl FnOnce()) {
    work();
}

const S: [f64; 6] = [
    -1.666_666_666_666_663_2e-1,
    8.333_333_333_322_489e-3,
    -1.984_126_982_985_795e-4,
    2.755_731_370_707_006_8e-6,
    -2.505_076_025_340_686_3e-8,
    1.589_690_995_211_55e-10,
];
const C: [f64; 6] = [
    4.166_666_666_666_66e-2,
    -1.388_888_888_887_411e-3,
    2.480_158_728_947_673e-5,
    -2.755_731_435_139_066_3e-7,
    2.087_572_321_298_175e-9,
    -1.135_964_755_778_819_5e-11,
];
const ROUND: f64 = 6_755_399_441_055_744.0;

#[inline(always)]
fn horner(z: f64, c: &[f64; 6]) -> f64 {
    c[5].mul_add(z, c[4]).mul_add(z, c[3]).mul_add(z, c[2]).mul_add(z, c[1]).mul_add(z, c[0])
}

/// sin x and cos x for modest x, in as few operations as will do.
#[inline(always)]
pub fn sin_cos(x: &[f64; WIDTH]) -> ([f64; WIDTH], [f64; WIDTH]) {
    let (mut s, mut c) = ([0.0; WIDTH], [0.0; WIDTH]);
    for l in 0..WIDTH {
        let shifted = x[l].mul_add(std::f64::consts::FRAC_2_PI, ROUND);
        let (turns, n) = (shifted.to_bits(), shifted - ROUND);
        let r = (-n).mul_add(6.123_233_995_736_766e-17, (-n).mul_add(std::f64::consts::FRAC_PI_2, x[l]));
        let z = r * r;
        let sine = (r * z).mul_add(horner(z, &S), r).to_bits();
        let cosine = (z * z).mul_add(horner(z, &C), (-0.5f64).mul_add(z, 1.0)).to_bits();
        let swap = 0u64.wrapping_sub(turns & 1);
        s[l] = f64::from_bits(((sine & !swap) | (cosine & swap)) ^ ((turns & 2) << 62));
        c[l] = f64::from_bits(((cosine & !swap) | (sine & swap)) ^ ((turns.wrapping_add(1) & 2) << 62));
    }
    (s, c)
}

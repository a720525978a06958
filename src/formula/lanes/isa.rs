//! The same code compiled for several sets of vector instructions, chosen at run time.

/// A set of vector instructions that this processor has.
///
/// Only [`Isa::best`] and [`Isa::available`] make one other than the baseline, which is the default, so that whoever
/// holds one may use it. No set contracts a product
/// and a sum into one rounding: the results are the same bits on every one of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Isa(Set);

#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Set {
    /// What every processor of the architecture has: SSE2 on x86-64, NEON on AArch64.
    #[default]
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2,
    #[cfg(target_arch = "x86_64")]
    Avx512,
}

/// Work that gains from wide vectors. `run` and all it calls have to be `#[inline(always)]`.
pub trait Kernel {
    /// Does the work.
    fn run(self);
}

impl Isa {
    /// The widest set.
    ///
    /// ```
    /// use creepage::formula::Isa;
    /// assert!(Isa::available().contains(&Isa::best()));
    /// ```
    pub fn best() -> Self {
        #[cfg(target_arch = "x86_64")]
        {
            if avx512_is_there() {
                return Self(Set::Avx512);
            }
            if std::is_x86_feature_detected!("avx2") {
                return Self(Set::Avx2);
            }
        }
        Self(Set::Baseline)
    }

    /// Every set, the narrowest first.
    pub fn available() -> Vec<Self> {
        let mut found = vec![Self(Set::Baseline)];
        #[cfg(target_arch = "x86_64")]
        {
            found.extend(std::is_x86_feature_detected!("avx2").then_some(Self(Set::Avx2)));
            found.extend(avx512_is_there().then_some(Self(Set::Avx512)));
        }
        found
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self.0 {
            Set::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => "AVX2",
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => "AVX-512",
        }
    }

    /// Does the work with these instructions.
    #[allow(unsafe_code)]
    pub fn dispatch(self, work: impl Kernel) {
        match self.0 {
            Set::Baseline => work.run(),
            // SAFETY: a value of this set exists only where the processor was asked and has it.
            #[cfg(target_arch = "x86_64")]
            Set::Avx2 => unsafe { with_avx2(work) },
            // SAFETY: as above.
            #[cfg(target_arch = "x86_64")]
            Set::Avx512 => unsafe { with_avx512(work) },
        }
    }
}

#[cfg(target_arch = "x86_64")]
fn avx512_is_there() -> bool {
    use std::is_x86_feature_detected as has;
    has!("avx512f") && has!("avx512dq") && has!("avx512vl") && has!("avx512bw")
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn with_avx2(work: impl Kernel) {
    work.run();
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx512f,avx512dq,avx512vl,avx512bw")]
fn with_avx512(work: impl Kernel) {
    work.run();
}

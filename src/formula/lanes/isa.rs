//! The same code compiled for several sets of vector instructions, chosen at run time.

/// A set of vector instructions that this processor has.
///
/// Only [`Isa::best`] and [`Isa::available`] make one other than the baseline, which is the default, so that whoever
/// holds one may use it. No set contracts a product
/// and a sum into one rounding: the results are the same bits on every one of them.
#[derive(Clone, Copy, Debug, Default)]
pub struct Isa(Set);

/// A set other than the baseline is a token of `pulp`, which gives it out only where the processor was asked and has it.
#[derive(Clone, Copy, Debug, Default)]
enum Set {
    /// What every processor of the architecture has: SSE2 on x86-64, NEON on AArch64.
    #[default]
    Baseline,
    #[cfg(target_arch = "x86_64")]
    Avx2(pulp::x86::V3),
    #[cfg(target_arch = "x86_64")]
    Avx512(pulp::x86::V4),
}

/// Work that gains from wide vectors. `run` and all it calls have to be `#[inline(always)]`, or kernels of their own: large work
/// that several kernels ask for is compiled once for each set, not once for each of them.
pub trait Kernel {
    /// Does the work.
    fn run(self);
}

/// Work as `pulp` takes it.
struct Call<K>(K);

impl<K: Kernel> pulp::NullaryFnOnce for Call<K> {
    type Output = ();

    #[inline(always)]
    fn call(self) {
        self.0.run();
    }
}

impl Isa {
    /// The widest set.
    ///
    /// ```
    /// use creepage::formula::Isa;
    /// assert!(Isa::available().contains(&Isa::best()));
    /// ```
    pub fn best() -> Self {
        Self::wide().next().unwrap_or_default()
    }

    /// The widest set for L lanes: one lane fills no vector.
    pub(crate) fn for_lanes(lanes: usize) -> Self {
        if lanes == 1 { Self::default() } else { Self::best() }
    }

    /// Every set, the narrowest first.
    pub fn available() -> Vec<Self> {
        let mut found: Vec<Self> = Self::wide().chain([Self::default()]).collect();
        found.reverse();
        found
    }

    /// The sets that not every processor has, the widest first.
    #[cfg(target_arch = "x86_64")]
    fn wide() -> impl Iterator<Item = Self> {
        use pulp::x86::{V3, V4};
        [V4::try_new().map(Set::Avx512), V3::try_new().map(Set::Avx2)].into_iter().flatten().map(Self)
    }

    #[cfg(not(target_arch = "x86_64"))]
    fn wide() -> impl Iterator<Item = Self> {
        std::iter::empty()
    }

    /// Its name.
    pub fn name(self) -> &'static str {
        match self.0 {
            Set::Baseline => "baseline",
            #[cfg(target_arch = "x86_64")]
            Set::Avx2(_) => "AVX2",
            #[cfg(target_arch = "x86_64")]
            Set::Avx512(_) => "AVX-512",
        }
    }

    /// Does the work with these instructions, in a function of its own.
    #[inline]
    pub fn dispatch(self, work: impl Kernel) {
        match self.0 {
            Set::Baseline => with_baseline(work),
            #[cfg(target_arch = "x86_64")]
            Set::Avx2(set) => set.vectorize(Call(work)),
            #[cfg(target_arch = "x86_64")]
            Set::Avx512(set) => set.vectorize(Call(work)),
        }
    }
}

/// Apart from its callers, as those of the other sets are.
#[inline(never)]
fn with_baseline(work: impl Kernel) {
    work.run();
}

/// There is one set of each name.
impl PartialEq for Isa {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl Eq for Isa {}

//! A shard of a sweep: the I-th of N parts.

use std::ops::Range;
use std::str::FromStr;

/// The I-th of N parts, counted from one; parts follow one another.
///
/// ```
/// use creepage::sweep::Shard;
/// let shards = ["1/3", "2/3", "3/3"].map(|s| s.parse::<Shard>().unwrap());
/// assert_eq!(shards.map(|s| s.of(10)), [0..3, 3..6, 6..10]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    index: usize,
    count: usize,
}

impl Shard {
    /// All of a sweep.
    pub const WHOLE: Shard = Shard { index: 1, count: 1 };

    /// Whether it is the first part, which has the header.
    pub fn is_first(self) -> bool {
        self.index == 1
    }

    /// Its cases among so many.
    pub fn of(self, cases: usize) -> Range<usize> {
        let end = |i: usize| (cases as u128 * i as u128 / self.count as u128) as usize;
        end(self.index - 1)..end(self.index)
    }
}

impl FromStr for Shard {
    type Err = String;
    fn from_str(text: &str) -> Result<Self, String> {
        let advice = || format!("{text:?} is no part of a sweep; write I/N with I from 1 to N, such as 2/8");
        let (index, count) = text.split_once('/').ok_or_else(advice)?;
        let (index, count) = (index.parse().map_err(|_| advice())?, count.parse().map_err(|_| advice())?);
        if index == 0 || index > count { Err(advice()) } else { Ok(Self { index, count }) }
    }
}

//! Exact linear algebra over the rationals: rank and null space by Gauss–Jordan elimination with whole numbers.

use crate::formula::{BigInt, BigRational};
use num_integer::Integer;
use num_traits::{One, Signed, Zero};

/// Rows reduced against each other: each has a column of its own in which all others are zero.
///
/// Rows are kept whole and without common factor, so that numbers stay as short as they can be.
#[derive(Clone)]
pub(crate) struct Echelon {
    width: usize,
    rows: Vec<(usize, Vec<BigInt>)>,
}

impl Echelon {
    /// No rows yet, of a number of columns.
    pub(crate) fn new(width: usize) -> Self {
        Self { width, rows: Vec::new() }
    }

    /// The rows of a matrix.
    pub(crate) fn of(width: usize, rows: &[Vec<BigRational>]) -> Self {
        let mut echelon = Self::new(width);
        rows.iter().for_each(|r| {
            echelon.insert(r);
        });
        echelon
    }

    /// How many rows are independent.
    pub(crate) fn rank(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are as many independent rows as columns.
    pub(crate) fn is_full(&self) -> bool {
        self.rank() == self.width
    }

    /// The columns that belong to one row each.
    pub(crate) fn pivots(&self) -> Vec<usize> {
        self.rows.iter().map(|(p, _)| *p).collect()
    }

    /// Adds a row; whether it was independent of those before.
    pub(crate) fn insert(&mut self, row: &[BigRational]) -> bool {
        self.insert_whole(whole(row))
    }

    /// Adds a row of whole numbers; whether it was independent of those before.
    pub(crate) fn insert_whole(&mut self, row: Vec<BigInt>) -> bool {
        let mut row = row;
        for (pivot, known) in &self.rows {
            clear(&mut row, known, *pivot);
        }
        let Some(pivot) = row.iter().position(|v| !v.is_zero()) else { return false };
        self.rows.iter_mut().for_each(|(_, known)| clear(known, &row, pivot));
        self.rows.push((pivot, row));
        true
    }

    /// A basis of the vectors on which every row vanishes, one for each column without pivot, which is 1 in it.
    pub(crate) fn null_space(&self) -> Vec<Vec<BigRational>> {
        let pivots = self.pivots();
        let free = (0..self.width).filter(|c| !pivots.contains(c));
        free.map(|c| self.null_vector(c)).collect()
    }

    fn null_vector(&self, column: usize) -> Vec<BigRational> {
        let mut vector = vec![BigRational::zero(); self.width];
        vector[column] = BigRational::one();
        for (pivot, row) in &self.rows {
            vector[*pivot] = -BigRational::from_parts_signed(row[column].clone(), row[*pivot].clone());
        }
        vector
    }
}

/// Makes a column of a row zero by a multiple of another row.
fn clear(row: &mut [BigInt], by: &[BigInt], column: usize) {
    if row[column].is_zero() {
        return;
    }
    let (keep, take) = (by[column].clone(), row[column].clone());
    row.iter_mut().zip(by).for_each(|(v, b)| *v = &*v * &keep - b * &take);
    primitive(row);
}

/// Divides whole numbers by their greatest common factor.
pub(crate) fn primitive(row: &mut [BigInt]) {
    let common = common_factor(row.iter());
    if common > BigInt::one() {
        row.iter_mut().for_each(|v| *v /= &common);
    }
}

/// The greatest common factor; zero for nothing but zeros.
pub(crate) fn common_factor<'a>(values: impl Iterator<Item = &'a BigInt>) -> BigInt {
    let mut common = BigInt::zero();
    for v in values.filter(|v| !v.is_zero()) {
        common = common.gcd(v);
        if common.is_one() {
            break;
        }
    }
    common
}

/// A positive multiple of rational numbers that is whole and without common factor.
pub(crate) fn whole(row: &[BigRational]) -> Vec<BigInt> {
    let denominator = row.iter().fold(BigInt::one(), |all, v| all.lcm(v.denominator().as_ibig()));
    let mut row: Vec<BigInt> = row.iter().map(|v| v.numerator() * (&denominator / v.denominator().as_ibig())).collect();
    primitive(&mut row);
    row
}

/// As [`whole`], with the first number that is not zero positive.
pub(crate) fn whole_and_positive(row: &[BigRational]) -> Vec<BigInt> {
    let row = whole(row);
    match row.iter().find(|v| !v.is_zero()).is_some_and(Signed::is_negative) {
        true => row.into_iter().map(|v| -v).collect(),
        false => row,
    }
}

/// Σ aᵢ·bᵢ
pub(crate) fn dot(a: &[BigRational], b: &[BigRational]) -> BigRational {
    let terms = a.iter().zip(b).filter(|(x, y)| !x.is_zero() && !y.is_zero());
    terms.fold(BigRational::zero(), |sum, (x, y)| sum + x * y)
}

//! Proof that a function is constant under the constraints, for all configurations: bordered minors vanish identically.

use super::Row;
use super::exact_linear_algebra::Echelon;
use super::integral_ansatz::Sample;
use super::zero_test::vanishes;
use crate::formula::{BigRational, Exact, Expr, Fun, Scalar, Symbol};
use num_traits::One;

/// The size of the largest determinant that is written out: one of size n has n! terms.
const MAX_DETERMINANT: usize = 6;

/// The fewest rows, by leaving out later ones first, of which gradients are combinations at every sample.
///
/// Each sample has the matrix of the rows and the gradient of the function.
pub(crate) fn needed_rows(count: usize, samples: &[(Vec<Vec<BigRational>>, Vec<BigRational>)]) -> Option<Vec<usize>> {
    let spans = |rows: &[usize]| {
        samples.iter().all(|(matrix, gradient)| {
            let chosen: Vec<_> = rows.iter().map(|r| matrix[*r].clone()).collect();
            !Echelon::of(gradient.len(), &chosen).insert(gradient)
        })
    };
    let mut rows: Vec<usize> = (0..count).collect();
    if !spans(&rows) {
        return None;
    }
    for r in (0..count).rev() {
        let fewer: Vec<usize> = rows.iter().copied().filter(|k| *k != r).collect();
        if spans(&fewer) {
            rows = fewer;
        }
    }
    Some(rows)
}

/// Whether dh is a combination of independent rows at all configurations where they are independent.
///
/// It is when every minor of the matrix (rows, dh) that borders a regular minor of the rows vanishes identically.
pub(crate) fn follows(h: &Expr, rows: &[Row], coordinates: &[Symbol], samples: &[Sample]) -> bool {
    let rates: Vec<Symbol> = coordinates.iter().map(Symbol::rate).collect();
    let pivots = samples.iter().find_map(|at| {
        let values: Option<Vec<_>> = rows.iter().map(|r| at.point.row(r, &rates)).collect();
        Some(Echelon::of(rates.len(), &values?).pivots()).filter(|p| p.len() == rows.len())
    });
    let Some(pivots) = pivots.filter(|p| p.len() < MAX_DETERMINANT) else { return false };
    let mut matrix: Vec<Vec<Expr>> = rows.iter().map(|r| rates.iter().map(|q| r.coefficient(q)).collect()).collect();
    matrix.push(coordinates.iter().map(|q| h.derivative(q)).collect());
    let others = (0..rates.len()).filter(|c| !pivots.contains(c));
    others.into_iter().all(|c| {
        let columns: Vec<usize> = pivots.iter().copied().chain([c]).collect();
        let minor: Vec<Vec<Expr>> = matrix.iter().map(|r| columns.iter().map(|c| r[*c].clone()).collect()).collect();
        vanishes(&determinant(&minor))
    })
}

/// The determinant, expanded along the first row.
pub(crate) fn determinant(matrix: &[Vec<Expr>]) -> Expr {
    let Some((first, rest)) = matrix.split_first() else { return Expr::int(1) };
    let mut sum = Expr::int(0);
    for (c, factor) in first.iter().enumerate().filter(|(_, f)| !f.is_zero()) {
        let minor: Vec<Vec<Expr>> = rest
            .iter()
            .map(|r| r.iter().enumerate().filter(|(i, _)| *i != c).map(|(_, v)| v.clone()).collect())
            .collect();
        let term = factor * &determinant(&minor);
        sum = if c % 2 == 0 { &sum + &term } else { &sum - &term };
    }
    sum
}

/// An exact value as a formula: a number, or an angle as twice an arc tangent; `None` for half a turn and for angles
/// without rational sine and cosine.
pub(crate) fn written(value: &Exact) -> Option<Expr> {
    if let Some(number) = value.as_rational() {
        return Some(Expr::number(number));
    }
    let part = |f: Fun| Exact::call(f, value).as_rational().cloned();
    let (sin, cos) = (part(Fun::Sin)?, part(Fun::Cos)?);
    let half = Exact::rational(sin).div(&Exact::rational(BigRational::one() + cos));
    Some(&Expr::int(2) * &Expr::call(Fun::Atan, &Expr::number(half.as_rational()?)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::Point;
    use crate::mechanism::random_points::Samples;

    /// x' = cos(phi)·v', y' = sin(phi)·v' and a fixed phi.
    fn straight() -> (Vec<Row>, Vec<Symbol>, Sample) {
        let row = |terms: &[(&str, &str)]| {
            let mut row = Row::default();
            terms.iter().for_each(|(rate, c)| row.add(*rate, &Expr::parse(c).unwrap()));
            row
        };
        let along = row(&[("x'", "cos(phi)"), ("y'", "sin(phi)"), ("v'", "-1")]);
        let rows = vec![along, row(&[("x'", "-sin(phi)"), ("y'", "cos(phi)")]), row(&[("phi'", "1")])];
        let coordinates: Vec<Symbol> = ["x", "y", "v", "phi"].map(Symbol::from).to_vec();
        let mut samples = Samples::of(rows.iter().flat_map(|r| r.terms()).map(|(_, c)| c));
        let point = samples.point(&coordinates, &Point::default());
        let sample = Sample::at(point, &coordinates, Vec::new(), &mut samples);
        (rows, coordinates, sample)
    }

    #[test]
    fn a_function_follows_from_the_rows_or_it_does_not() {
        let (rows, coordinates, sample) = straight();
        let samples = [sample];
        let follows = |h: &str, rows: &[Row]| follows(&Expr::parse(h).unwrap(), rows, &coordinates, &samples);
        for h in ["x - v*cos(phi)", "x*sin(phi) - y*cos(phi)", "x*cos(phi) + y*sin(phi) - v", "phi"] {
            assert!(follows(h, &rows), "{h}");
        }
        for h in ["x", "v", "x + v*cos(phi)", "x*sin(phi) + y*cos(phi)"] {
            assert!(!follows(h, &rows), "{h}");
        }
        assert!(!follows("x*sin(phi) - y*cos(phi)", &rows[..2]));
    }

    #[test]
    fn a_determinant_has_its_sign() {
        let matrix = |rows: [&str; 3]| -> Vec<Vec<Expr>> {
            rows.iter().map(|r| r.split(' ').map(|c| Expr::parse(c).unwrap()).collect()).collect()
        };
        assert_eq!(determinant(&matrix(["a 0 0", "0 b 0", "0 0 c"])).tidy().to_string(), "a*b*c");
        assert_eq!(determinant(&matrix(["0 a 0", "b 0 0", "0 0 c"])).tidy().to_string(), "-a*b*c");
        assert_eq!(determinant(&matrix(["1 2 3", "4 5 6", "7 8 10"])).tidy().as_number(), Some(BigRational::from(-3)));
    }

    /// Each further row makes a determinant longer by its size.
    #[test]
    fn six_rows_are_too_many_to_write_out() {
        let coordinates: Vec<Symbol> = (0..7).map(|i| Symbol::new(&format!("q_{i}"))).collect();
        let fixed = |q: &Symbol| {
            let mut row = Row::default();
            row.add(q.rate(), &Expr::int(1));
            row
        };
        let rows: Vec<Row> = coordinates.iter().map(fixed).collect();
        let sample = Sample::at(Point::default(), &coordinates, Vec::new(), &mut Samples::of(std::iter::empty()));
        let first = Expr::sym("q_0");
        let samples = [sample];
        assert!(follows(&first, &rows[..5], &coordinates, &samples));
        assert!(!follows(&first, &rows[..6], &coordinates, &samples));
    }

    #[test]
    fn an_angle_is_written_by_its_half() {
        let text = |value: &Exact| written(value).map(|e| e.to_string());
        assert_eq!(text(&Exact::ratio(3, 4)).as_deref(), Some("0.75"));
        assert_eq!(text(&Exact::direction(3.into(), 4.into())).as_deref(), Some("2*atan(0.5)"));
        assert_eq!(text(&Exact::half_tangent(1, 0)), None);
        assert_eq!(text(&Exact::direction(1.into(), 2.into())), None);
    }
}

//! Plans followed while a program changes (continuation; Allgower and Georg, *Numerical Continuation Methods*, 1990).

use super::sequential_quadratic_programming::{restored, solved};
use super::trailing::between;
use super::transcription::{Point, Program};

/// By how much the beginning of a guess moves at a time, m and rad.
const BEGUN: f64 = 0.1;

/// The best point of a program from a guess that begins in another state: the beginning moves to the start, and the guess follows.
pub fn continued(program: &mut Program, guess: Point, begins: &[f64]) -> Option<Point> {
    let start = program.start.clone();
    let off = begins.iter().zip(&start).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    let parts = (off / BEGUN).ceil() as usize;
    let mut point = guess;
    for part in 0..parts {
        let share = part as f64 / parts as f64;
        program.start = between(begins, &start, share);
        point = match part {
            0 => solved(program, point)?,
            _ => near_to(program, point)?,
        };
    }
    program.start = start;
    solved(program, point)
}

/// The point of a program near one that nearly is.
pub fn near_to(program: &Program, point: Point) -> Option<Point> {
    restored(program, point.clone()).or_else(|| solved(program, point))
}

//! Trailers drawn along the way of the body ahead of them: their headings integrated in the direction in which they follow
//! (Rouchon, Fliess, Lévine and Martin 1993: what is drawn is stable, what is pushed is not).

use crate::model::Equations;

/// By how much a trailer is bent at most, rad: a curve that is too tight for a train is none to begin with.
const BENT: f64 = 1.0;
/// Parts of a span in which trailers are drawn.
const DRAWN: usize = 10;

/// Lets trailers follow the body: ahead from where they are, backward as they would have been drawn the other way from straight
/// behind it, for only drawn they come to rest.
pub fn trail(equations: &Equations, states: &mut [Vec<f64>], inputs: &[Vec<f64>], ahead: &[bool], step: f64) {
    if equations.poses <= 3 {
        return;
    }
    for k in (0..ahead.len()).rev().filter(|k| !ahead[*k]) {
        states[k] = trailed(equations, [&states[k + 1], &states[k]], &inputs[k], -step);
    }
    for k in (0..ahead.len()).filter(|k| ahead[*k]) {
        states[k + 1] = trailed(equations, [&states[k], &states[k + 1]], &inputs[k], step);
    }
}

/// The second state with trailers drawn there from the first, whose body moves from one to the other in a step.
fn trailed(equations: &Equations, [from, to]: [&Vec<f64>; 2], inputs: &[f64], step: f64) -> Vec<f64> {
    let trailers = 3..equations.poses;
    let mut w = equations.workspace(&[]);
    let (mut rates, mut u) = (vec![0.0; equations.n()], inputs.to_vec());
    u.resize(equations.inputs.len(), 0.0);
    let mut drawn = from[trailers.clone()].to_vec();
    for part in 0..DRAWN {
        let mut z = between(from, to, part as f64 / DRAWN as f64);
        z[trailers.clone()].copy_from_slice(&drawn);
        equations.rates(&mut w, &z, &u, &mut rates);
        for (heading, rate) in drawn.iter_mut().zip(&rates[trailers.clone()]) {
            let by = step / DRAWN as f64 * rate;
            *heading += if by.is_finite() { by.clamp(-0.2, 0.2) } else { 0.0 };
        }
    }
    let mut there = to.clone();
    for (i, heading) in trailers.zip(drawn) {
        // Ahead of the first of them is the body.
        there[i] = heading.clamp(there[i - 1] - BENT, there[i - 1] + BENT);
    }
    there
}

/// The state a share of the way between two.
pub fn between(a: &[f64], b: &[f64], share: f64) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a + share * (b - a)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::formula::Symbol;
    use crate::model::{Model, Trailer};

    /// Behind a car on a circle a trailer comes to rest where the sine of the bend is its length over the radius: driven ahead at the
    /// end, driven backward at the beginning.
    #[test]
    fn trailers_come_to_rest_behind_a_body_on_a_circle() {
        let model = Model::new("car", &[("wheel_radius", 0.3), ("wheelbase", 2.0)]).unwrap();
        let model = model.with_trailers(&[Trailer { length: 1.5, hitch: 0.0 }]);
        let equations = model.equations(&[]).unwrap();
        let (radius, spans, speed) = (4.0, 60, 0.3);
        let turn = speed / radius;
        for direction in [1.0, -1.0] {
            let pose = |k: usize| {
                let heading = direction * turn * k as f64;
                vec![radius * heading.sin(), radius * (1.0 - heading.cos()), heading, heading]
            };
            let mut states: Vec<Vec<f64>> = (0..=spans).map(pose).collect();
            let steering = (2.0 / radius).atan();
            let value =
                |input: &Symbol| if input.as_str() == "steering_angle" { steering } else { direction * speed / 0.3 };
            let inputs = vec![equations.inputs.iter().map(value).collect(); spans];
            trail(&equations, &mut states, &inputs, &vec![direction > 0.0; spans], 1.0);
            let settled = if direction > 0.0 { &states[spans] } else { &states[0] };
            let bend = settled[2] - settled[3];
            assert!((bend.sin() - 1.5 / radius).abs() < 1e-3, "{direction}: {bend}");
        }
    }
}

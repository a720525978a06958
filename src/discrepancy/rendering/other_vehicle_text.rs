//! Another vehicle behind the same log, in words.

use super::effect_names::named;
use crate::discrepancy::selection::other_vehicle::{LogReading, OtherVehicle};
use crate::effects::Applied;
use crate::number_format::{significant, with_error};

/// The vehicle that explains the runs, the lines that say so, and the one that does not.
pub fn sentence(other: &OtherVehicle) -> String {
    let is = match &other.reading {
        LogReading::Vehicle { id, title } => format!("another vehicle, {id} ({title})"),
        LogReading::Wheel { applied, std } => format!("another reading, {}", wheel(applied, std)),
    };
    let beside =
        if other.misses.is_empty() { String::new() } else { format!(" together with {}", named(&other.misses)) };
    let mend = mend(other).replace('\n', "  ");
    format!(
        "These runs are explained to their noise by {is}{beside}; paste into the model file: {mend}. The {} that it has now \
         does not explain them.",
        other.given
    )
}

/// The wheel that stands for the middle of its axle, and where it is.
fn wheel(applied: &Applied, std: &[Option<f64>]) -> String {
    let left = applied.values.first().copied().unwrap_or(f64::NAN);
    let side = if left < 0.0 { "right" } else { "left" };
    let far = with_error(left.abs(), std.first().copied().flatten());
    format!("{far} m to the {side}: {}", applied.effect.says)
}

/// The lines of a model file that say so.
pub fn mend(other: &OtherVehicle) -> String {
    match &other.reading {
        LogReading::Vehicle { id, .. } => format!("vehicle = \"{id}\""),
        LogReading::Wheel { applied, .. } => format!("[[effects]]\nid = \"{}\"\n{}", applied.effect.id, lines(applied)),
    }
}

fn lines(applied: &Applied) -> String {
    let each = applied.effect.parameters.keys().zip(&applied.values);
    each.map(|(name, v)| format!("{name} = {}", significant(*v, 5).replace('−', "-"))).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::discrepancy::fixtures::applied;
    use crate::effects;

    #[test]
    fn the_other_vehicle_is_named_with_its_line() {
        let reading = LogReading::Vehicle { id: "tricycle".into(), title: "front wheel driven and steered".into() };
        let said = sentence(&OtherVehicle { given: "car".into(), reading, misses: vec![applied("lever-arm")] });
        assert_eq!(
            said,
            "These runs are explained to their noise by another vehicle, tricycle (front wheel driven and steered) together \
             with lever-arm; paste into the model file: vehicle = \"tricycle\". The car that it has now does not explain them."
        );
    }

    #[test]
    fn a_wheel_is_named_with_its_place_and_its_entry() {
        let effect = effects::named("steering-of-one-wheel").unwrap();
        let applied = Applied::new(effect, None, vec![-0.31]);
        let other = OtherVehicle {
            given: "car".into(),
            reading: LogReading::Wheel { applied: Box::new(applied), std: vec![Some(0.02)] },
            misses: vec![],
        };
        assert!(sentence(&other).contains("0.310 ± 0.020 m to the right"), "{}", sentence(&other));
        assert_eq!(mend(&other), "[[effects]]\nid = \"steering-of-one-wheel\"\nleft = -0.31000");
    }
}

//! Repairs of logged data in words, with the lines to paste into the model file.

use crate::discrepancy::preprocessing::repairs::{Change, InputRepair, PoseRepair, Repair, Repaired, Unit};
use crate::discrepancy::preprocessing::signed_ratios::Ratio;
use crate::number_format::significant;
use crate::wording::listed;
use std::f64::consts::TAU;

/// What a repaired run is told, without its name.
pub fn says(of: &Repaired) -> String {
    let causes: Vec<String> = of.repairs.iter().map(because).collect();
    format!("{}: {}", symptom(of), causes.join(", or "))
}

/// How measured and reckoned motion differ.
fn symptom(of: &Repaired) -> String {
    let number = |x: f64| significant(x, 3);
    let [way, turn] = [of.ratios.way, of.ratios.turn];
    let shown = |r: Ratio| match r.slope < 0.0 {
        true => -r.size,
        false => r.size,
    };
    let is_right = |r: Ratio| r.unexplained < 0.15;
    match (way.filter(|r| !is_right(*r)), turn.filter(|r| !is_right(*r))) {
        (Some(way), _) if way.slope < 0.0 && way.unexplained > 1.5 => {
            "the vehicle drives backwards where the log says forwards".into()
        }
        (Some(way), None) if way.unexplained > 0.8 && (0.5..2.0).contains(&way.size) => {
            "the vehicle does not move where its heading points".into()
        }
        (Some(way), None) => format!("the measured way is {} times what the model drives", number(shown(way))),
        (None, Some(turn)) => format!("the measured turning is {} times the model's", number(shown(turn))),
        (Some(_), Some(_)) | (None, None) => "neither the measured way nor the measured turning is the model's".into(),
    }
}

/// What a repair says of the data.
fn because(repair: &Repair) -> String {
    match repair {
        Repair::Inputs(inputs) => of_inputs(inputs),
        Repair::Pose(pose) => of_pose(*pose),
    }
}

fn of_inputs(inputs: &[InputRepair]) -> String {
    let names = listed(inputs.iter().map(|r| r.role.clone()));
    let (verb, noun) = if inputs.len() > 1 { ("have", "are") } else { ("has", "is") };
    let first = &inputs[0];
    let is_exchanged = inputs.iter().any(|r| r.source != r.role);
    let is_reversed = |r: &InputRepair| matches!(r.change, Change::Scale(f, _) if f < 0.0);
    if is_exchanged {
        let signs: Vec<String> = inputs.iter().filter(|r| is_reversed(r)).map(|r| r.role.clone()).collect();
        let sides =
            inputs.iter().any(|r| r.role.ends_with("_left")) && inputs.iter().any(|r| r.role.ends_with("_right"));
        let moved = inputs.iter().filter(|r| r.source != r.role).map(|r| r.role.clone());
        let what = match sides {
            true => "left and right are swapped".to_string(),
            false => format!("the columns of {} are exchanged", listed(moved)),
        };
        return match signs.len() {
            0 => what,
            n if n == inputs.len() && n > 1 => format!("{what}, and both have the wrong sign"),
            _ => format!("{what}, and the sign of {} is wrong", listed(signs.into_iter())),
        };
    }
    let both = if inputs.len() == 2 { "both " } else { "" };
    match first.change {
        Change::Scale(_, Unit::Sign) => format!("{both}{names} {verb} the wrong sign"),
        Change::Scale(factor, unit) => {
            let sign = if factor < 0.0 { ", and the sign is wrong" } else { "" };
            let size = factor.abs();
            match unit {
                Unit::Named(name) => format!("{names} {noun} in {}{sign}", spelt(name)),
                Unit::Counts => format!(
                    "{names} {noun} {} times the right one: counts per turn, or a diameter in the place of wheel_radius{sign}",
                    significant(1.0 / size, 2)
                ),
                _ if size > 1.0 => format!("{names} {noun} a speed in m/s, not a rate in rad/s{sign}"),
                _ => format!("{names} {noun} a wheel's rate in rad/s, not a speed in m/s{sign}"),
            }
        }
        Change::Odometer(_) => format!("{names} {noun} the way driven (an odometer), not a speed: its differences fit"),
        Change::Difference(factor) if (factor.abs() - 1.0).abs() < 0.2 => {
            format!("{names} {noun} an angle (the position of the joint), not a rate: its differences fit")
        }
        Change::Difference(_) => format!("{names} {noun} cumulative counts, not a rate: their differences fit"),
        Change::PerRow(factor, _) if (factor.abs() - 1.0).abs() < 0.2 => {
            format!(
                "{names} {noun} what happened since the row before, not a rate: divided by the time between rows they fit"
            )
        }
        Change::PerRow(..) => format!("{names} {noun} counts since the row before, not a rate"),
        Change::Line([scale, offset]) => format!(
            "{names} {noun} the command of a servo, a straight line of the angle: angle = {}·{names} + {} rad",
            significant(scale, 4),
            significant(offset, 4)
        ),
    }
}

fn spelt(unit: &str) -> &str {
    match unit {
        "deg/s" => "degrees per second",
        "turns/s" => "turns per second",
        "rpm" => "turns per minute (rpm)",
        "deg" => "degrees",
        "mm/s" => "millimetres per second",
        "cm/s" => "centimetres per second",
        "mm" => "millimetres",
        "cm" => "centimetres",
        "km" => "kilometres",
        "ft" => "feet",
        other => other,
    }
}

fn of_pose(pose: PoseRepair) -> String {
    match pose {
        PoseRepair::HeadingTurned(by) => format!("the heading is turned by {:.0}°", by.to_degrees()),
        PoseRepair::HeadingClockwise(from) => match zero(from) {
            Some(zero) => format!("the heading counts clockwise from {zero}"),
            None => "the heading counts clockwise".into(),
        },
        PoseRepair::AxesExchanged => "x and y are swapped".into(),
        PoseRepair::AxesExchangedReversed => "x and y are swapped, and both have the wrong sign".into(),
        PoseRepair::AxisReversed(axis) => format!("{} has the wrong sign", ["x", "y"][axis.min(1)]),
        PoseRepair::FromBelow => "y counts to the right and the heading clockwise".into(),
        PoseRepair::PositionUnit(unit, _) => format!("the position is in {}", spelt(unit)),
        PoseRepair::HeadingInDegrees => "the heading is in degrees".into(),
    }
}

/// The name of a direction of zero.
fn zero(from: f64) -> Option<&'static str> {
    let near = |x: f64| (from - x).abs() < 1e-6;
    if near(std::f64::consts::FRAC_PI_2) { Some("north") } else { None }
}

/// The lines to paste into the model file, the section first.
pub fn mend(of: &Repaired) -> String {
    of.repairs.iter().map(|r| lines(r, &of.pose)).collect::<Vec<_>>().join("\n# or\n")
}

/// The same in one line.
pub fn mend_in_line(of: &Repaired) -> String {
    of.repairs.iter().map(|r| lines(r, &of.pose).replace('\n', "  ")).collect::<Vec<_>>().join("  or  ")
}

fn lines(repair: &Repair, pose: &[String; 3]) -> String {
    match repair {
        Repair::Inputs(inputs) => {
            let each: Vec<String> = inputs.iter().map(line).collect();
            format!("[columns]\n{}", each.join("\n"))
        }
        Repair::Pose(repair) => of_columns(*repair, pose),
    }
}

fn line(of: &InputRepair) -> String {
    let (role, column) = (&of.role, quoted(&of.column));
    match of.change {
        Change::Scale(1.0, _) => format!("{role} = {column}"),
        Change::Scale(factor, Unit::Named(unit)) if factor > 0.0 => {
            format!("{role} = {{ column = {column}, unit = \"{unit}\" }}")
        }
        Change::Scale(factor, Unit::Named(unit)) => {
            let _ = factor;
            format!("{role} = {{ column = {column}, unit = \"{unit}\", scale = -1.0 }}")
        }
        Change::Scale(factor, _) => format!("{role} = {{ column = {column}, scale = {} }}", number(factor)),
        // Differences are read of wheels alone.
        Change::Odometer(radius) => format!("wheel_rate = {{ angle = {column}, scale = {} }}", number(1.0 / radius)),
        Change::Difference(factor) if (factor + 1.0).abs() < 0.2 => {
            format!("{role} = {{ angle = {column}, scale = -1.0 }}")
        }
        Change::Difference(factor) if (factor - 1.0).abs() < 0.2 => format!("{role} = {{ angle = {column} }}"),
        Change::Difference(factor) => {
            format!("{role} = {{ ticks = {column}, ticks_per_turn = {} }}", number((TAU / factor).round()))
        }
        Change::PerRow(factor, rate) => {
            let unit = if (factor.abs() - 1.0).abs() < 0.2 { factor.signum() } else { factor };
            format!("{role} = {{ column = {column}, scale = {} }}", number(unit * rate))
        }
        Change::Line([scale, offset]) => {
            format!("{role} = {{ column = {column}, scale = {}, offset = {} }}", number(scale), number(offset))
        }
    }
}

fn of_columns(repair: PoseRepair, columns: &[String; 3]) -> String {
    let [x, y, heading] = columns.each_ref().map(|name| quoted(name));
    let reversed = |column: &str| format!("{{ column = {column}, scale = -1.0 }}");
    let clockwise = format!("heading = {{ column = {heading}, turn = \"clockwise\" }}");
    match repair {
        PoseRepair::HeadingTurned(by) => format!("[sensor]\nheading_offset = {}", number(by)),
        PoseRepair::HeadingClockwise(from) => match zero(from) {
            Some(zero) => {
                format!("[columns]\nheading = {{ column = {heading}, zero = \"{zero}\", turn = \"clockwise\" }}")
            }
            None if from == 0.0 => format!("[columns]\n{clockwise}"),
            None => format!("[columns]\nheading = {{ column = {heading}, scale = -1.0, offset = {} }}", number(from)),
        },
        PoseRepair::AxesExchanged => format!("[columns]\nx = {y}\ny = {x}"),
        PoseRepair::AxesExchangedReversed => format!("[columns]\nx = {}\ny = {}", reversed(&y), reversed(&x)),
        PoseRepair::AxisReversed(0) => format!("[columns]\nx = {}", reversed(&x)),
        PoseRepair::AxisReversed(_) => format!("[columns]\ny = {}", reversed(&y)),
        PoseRepair::FromBelow => format!("[columns]\ny = {}\n{clockwise}", reversed(&y)),
        PoseRepair::PositionUnit(unit, _) => {
            format!("[columns]\nx = {{ column = {x}, unit = \"{unit}\" }}\ny = {{ column = {y}, unit = \"{unit}\" }}")
        }
        PoseRepair::HeadingInDegrees => format!("[columns]\nheading = {{ column = {heading}, unit = \"deg\" }}"),
    }
}

/// A name as TOML quotes it.
fn quoted(name: &str) -> String {
    format!("\"{}\"", name.replace('\\', "\\\\").replace('"', "\\\""))
}

/// A number as TOML has it, with a point.
fn number(x: f64) -> String {
    let rounded: f64 = format!("{x:.6e}").parse().unwrap_or(x);
    format!("{rounded:?}")
}

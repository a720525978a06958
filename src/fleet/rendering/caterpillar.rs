//! A caterpillar plot: the value of each robot with its interval, sorted, beside the mean and the spread of the fleet.

use crate::fleet::report::{FleetParameter, FleetReport, RobotReport, ValueOfRobot};
use crate::number_format::{prefixed, significant};
use crate::picture::axis::{Axis, extent, widened};
use crate::picture::plot::{Marker, Size, frame_svg, mark};
use crate::picture::svg::{Element, cut, label, line, rect};

/// Half of a 95 % interval of a normal value, in deviations.
pub(super) const NORMAL_95: f64 = 1.96;
/// Robots up to which every one has its name beside it.
const NAMED: usize = 60;
/// Pixels left of the values, above the first robot, and below the last.
const MARGINS: [f64; 4] = [124.0, 20.0, 54.0, 48.0];
const WIDTH: f64 = 520.0;

/// The plot of a parameter; none where no robot tells it.
pub fn caterpillar(report: &FleetReport, effect: &str, name: &str, p: &FleetParameter) -> Option<Element> {
    let key = format!("{effect} {name}");
    let mut robots: Vec<(&RobotReport, &ValueOfRobot)> =
        report.per_robot.iter().filter_map(|r| Some((r, r.values.get(&key)?))).collect();
    robots.sort_by(|a, b| a.1.value.total_cmp(&b.1.value).then(a.0.robot.cmp(&b.0.robot)));
    let ends = |v: &ValueOfRobot| [v.value - NORMAL_95 * v.std, v.value + NORMAL_95 * v.std];
    let [low, high] = widened(extent(robots.iter().flat_map(|(_, v)| ends(v)))?, 0.04);
    let pitch = if robots.len() <= NAMED { 15.0 } else { (900.0 / robots.len() as f64).max(0.6) };
    let height = MARGINS[2] + pitch * robots.len() as f64 + MARGINS[3];
    let size = Size { width: WIDTH, height, margins: MARGINS };
    let (factor, unit) = scaled(low.abs().max(high.abs()), &p.unit);
    let axis = Axis::linear(name, &unit, [low * factor, high * factor]).along(size.columns());
    let at = |v: f64| axis.at(v * factor);
    let (top, bottom) = (MARGINS[2], MARGINS[2] + pitch * robots.len() as f64);
    let mut drawn = vec![label("heading", [2.0, 16.0], "start", format!("{effect}, {name}"))];
    drawn.extend(band(p, &at, [top, bottom], size.columns()));
    drawn.extend(grid(&axis, [top, bottom], size));
    for (i, (robot, v)) in robots.iter().enumerate() {
        let y = top + pitch * (i as f64 + 0.5);
        let class = if v.is_odd { "before" } else { "after" };
        let [a, b] = ends(v).map(at);
        drawn.push(line(&format!("line thin {class}"), [a, y], [b, y]));
        if robots.len() <= NAMED || v.is_odd {
            drawn.push(mark(class, if v.is_odd { Marker::Square } else { Marker::Circle }, [at(v.value), y]));
            let weight = if v.is_odd { "strong" } else { "tick" };
            drawn.push(label(weight, [MARGINS[0] - 10.0, y + 4.0], "end", cut(&robot.robot, 16)));
        }
    }
    let title = format!("{effect}, {name}: {} robots", robots.len());
    let odd: Vec<&str> = robots.iter().filter(|(_, v)| v.is_odd).map(|(r, _)| r.robot.as_str()).collect();
    let others = if odd.is_empty() { "none differs".to_string() } else { format!("{} differs", odd.join(", ")) };
    let mean = p.mean.map_or("–".into(), |m| significant(m.value * factor, 3));
    let description = format!("The value of each robot with its 95 % interval, sorted; mean {mean} {unit}; {others}.");
    let id = format!("caterpillar-{}-{name}", effect.replace('@', "-"));
    Some(frame_svg(size, &id, &title, &description).children(drawn))
}

/// Pure numbers in per cent, others with a prefix.
pub(super) fn scaled(largest: f64, unit: &str) -> (f64, String) {
    if unit == "1" { (100.0, "%".into()) } else { prefixed(largest, unit) }
}

/// The mean as a line, the spread of robots as a band.
fn band(
    p: &FleetParameter,
    at: &impl Fn(f64) -> f64,
    [top, bottom]: [f64; 2],
    [left, right]: [f64; 2],
) -> Vec<Element> {
    let (Some(mean), Some(between)) = (&p.mean, &p.between_robots) else { return vec![] };
    let [a, b] = [-NORMAL_95, NORMAL_95].map(|s| at(mean.value + s * between.value).clamp(left, right));
    let middle = at(mean.value);
    vec![
        rect("band", [a, top], b - a, bottom - top),
        line("line floor", [middle, top], [middle, bottom]),
        label("strong", [middle, top - 8.0], "middle", "mean"),
    ]
}

fn grid(axis: &Axis, [top, bottom]: [f64; 2], size: Size) -> Vec<Element> {
    let ticks = axis.ticks(58.0).into_iter().flat_map(|tick| {
        let number = label("tick", [tick.at, bottom + 18.0], "middle", tick.label);
        [line("grid", [tick.at, top], [tick.at, bottom]), number]
    });
    let caption = label("caption", [size.columns()[1], bottom + 38.0], "end", axis.caption());
    ticks.chain([caption]).collect()
}

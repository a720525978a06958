//! Small multiples: what each run says of a value over its date, a panel a robot, all on one scale (Tufte, 1990).

use super::caterpillar::{NORMAL_95, scaled};
use crate::discrepancy::rendering::html::part;
use crate::fleet::days;
use crate::fleet::report::{FleetParameter, FleetReport, RobotReport, RunValue};
use crate::number_format::significant;
use crate::picture::axis::{Axis, extent, widened};
use crate::picture::plot::{Marker, Panel, Size};
use crate::picture::svg::{Element, cut, line};
use crate::wording::counted;

/// Robots that get a panel.
const MOST: usize = 36;
const SIZE: Size = Size { width: 300.0, height: 140.0, margins: [52.0, 12.0, 30.0, 26.0] };

/// The panels of a parameter, robots that differ before the others; none where no robot has several dated runs.
pub fn over_time(report: &FleetReport, effect: &str, name: &str, p: &FleetParameter) -> Option<Element> {
    let key = format!("{effect} {name}");
    let mut robots: Vec<(&RobotReport, &Vec<RunValue>)> =
        report.per_robot.iter().filter_map(|r| Some((r, r.over_time.get(&key)?))).collect();
    let z = |r: &RobotReport| {
        r.values.get(&key).map_or(0.0, |v| if v.is_odd { f64::MAX } else { v.z.unwrap_or(0.0).abs() })
    };
    robots.sort_by(|a, b| z(b.0).total_cmp(&z(a.0)).then(a.0.robot.cmp(&b.0.robot)));
    let all = || robots.iter().flat_map(|(_, of)| of.iter());
    let [first, last] = extent(all().filter_map(|r| days(&r.date)))?;
    let [low, high] = extent(all().flat_map(ends))?;
    let (factor, unit) = scaled(low.abs().max(high.abs()), &p.unit);
    let x = Axis::linear("", "", widened([0.0, last - first], 0.03)).along(SIZE.columns());
    let y = Axis::linear("", &unit, widened([low * factor, high * factor], 0.06)).along(SIZE.rows());
    let scale = Scale { x, y, first, factor };
    let id = |i: usize| format!("over-time-{}-{name}-{i}", effect.replace('@', "-"));
    let shown = robots.iter().take(MOST).enumerate();
    let panels = shown.map(|(i, (robot, runs))| scale.panel(robot, runs, p, &id(i), &key)).collect();
    let more = robots.len().saturating_sub(MOST);
    let rest = if more > 0 { format!(" Not drawn: {}.", counted(more, "further robot")) } else { String::new() };
    let begin = all().map(|r| r.date.as_str()).min().unwrap_or_default();
    let how = format!(
        "Each run with its 95 % interval over the days since {begin}; the dotted line is the mean of the fleet. Robots that \
         differ most stand first, a square is a run that differs.{rest}"
    );
    Some(part::small_figure(panels, &format!("{effect}, {name}, {unit}, run by run."), &how))
}

/// The ends of the interval of what a run says.
fn ends(of: &RunValue) -> [f64; 2] {
    [of.value - NORMAL_95 * of.std, of.value + NORMAL_95 * of.std]
}

/// What all panels share.
struct Scale {
    x: Axis,
    y: Axis,
    /// The first day.
    first: f64,
    factor: f64,
}

impl Scale {
    fn panel(&self, robot: &RobotReport, runs: &[RunValue], p: &FleetParameter, id: &str, key: &str) -> Element {
        let mut panel = Panel::new(SIZE, self.x.clone(), self.y.clone());
        let day = |r: &RunValue| days(&r.date).unwrap_or(self.first) - self.first;
        if let Some(mean) = p.mean {
            let [left, right] = SIZE.columns();
            let at = self.y.at(mean.value * self.factor);
            panel.note(line("line floor", [left, at], [right, at]));
        }
        for run in runs {
            let class = if run.is_odd { "before" } else { "after" };
            let [low, high] = ends(run).map(|v| panel.place([day(run), v * self.factor]));
            panel.note(line(&format!("line thin {class}"), low, high));
            let marker = if run.is_odd { Marker::Square } else { Marker::Circle };
            panel.markers(class, marker, &[[day(run), run.value * self.factor]]);
        }
        let odd = robot.values.get(key).is_some_and(|v| v.is_odd);
        panel.heading(&cut(&robot.robot, 24), if odd { "differs" } else { "" });
        let of = |v: f64| significant(v * self.factor, 3);
        let [from, to] = extent(runs.iter().map(|r| r.value)).unwrap_or([f64::NAN; 2]);
        let said = format!("{} between {} and {}.", counted(runs.len(), "run"), of(from), of(to));
        panel.finish(id, &format!("{key} of {}", robot.robot), &said)
    }
}

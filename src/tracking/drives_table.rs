//! The first drive of every way as a table.

use super::job::Tracked;
use std::fmt::Write;

/// Rows of the first drives: way, time, plan and pose, commands.
pub fn drives_table(found: &Tracked) -> String {
    let inputs = found.ways.first().map_or(0, |w| w.reference.commands.first().map_or(0, Vec::len));
    let mut out = "way,t,plan_x,plan_y,plan_heading,x,y,heading".to_string();
    out.extend((1..=inputs).map(|i| format!(",command_{i}")));
    out.push('\n');
    for way in &found.ways {
        let Some(driven) = way.drives.first() else { continue };
        for (k, (pose, command)) in driven.poses.iter().zip(&driven.commands).enumerate() {
            let plan = way.reference.pose(k);
            let t = k as f64 * found.report.sample_s;
            let _ = write!(out, "{},{t:.4}", way.id);
            for v in plan[..3].iter().chain(&pose[..3]).chain(command) {
                let _ = write!(out, ",{v:.6}");
            }
            out.push('\n');
        }
    }
    out
}

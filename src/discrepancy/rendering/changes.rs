//! The changes that a finding asks for: lines of the model file, of the robot's controller, of its description.

use crate::discrepancy::report::{Change, Finding, Report, Verdict};
use crate::export::{Exported, Target, description_lines};
use crate::files::{EffectEntry, ModelFile, lines_of};

/// What to change, each thing in its own words; none where nothing was found.
pub(crate) fn changes(report: &Report, file: &ModelFile, added: &[EffectEntry]) -> Vec<Change> {
    let mut found: Vec<Change> = mends(&report.data.findings).into_iter().collect();
    if report.verdict == Verdict::UnusableData || added.is_empty() {
        return found;
    }
    found.push(change("model.toml", lines_of(added)));
    let patched = file.with_effects(added);
    // A controller is shown where a number of it changes.
    let says_something = |e: &Exported| e.unsaid.len() < patched.effects.len();
    found.extend(Target::of_ros2(&patched).ok().filter(says_something).map(|e| change("ROS 2", e.text)));
    found.extend(description_lines(&patched).map(|e| change("URDF", e.text)));
    let code = "creepage export model.patched.toml --as c      > step.c\n\
                creepage export model.patched.toml --as python > step.py\n\
                # a step of the patched model with its Jacobian; also cpp and rust\n";
    found.push(change("code", code.into()));
    found
}

/// The lines of the model file that mend the data; none where nothing is to be mended.
pub(crate) fn mends(findings: &[Finding]) -> Option<Change> {
    let lines: Vec<&str> = findings.iter().filter_map(|f| f.mend.as_deref()).collect();
    (!lines.is_empty()).then(|| change("model.toml, for the data", lines.join("\n\n")))
}

fn change(of: &str, text: String) -> Change {
    Change { of: of.into(), text }
}

//! The stages of the crate in their order, and the stage of a file.

/// The stages in their order, folders and files below `src`. Stages of one line are level: none of them imports another.
const STAGES: [&[&str]; 53] = [
    &["error"],
    &["provenance", "wording", "number_format", "progress", "numerics"],
    &["formula"],
    &["mechanism"],
    &["vehicles"],
    &["effects"],
    &["files"],
    &["model"],
    &["motion"],
    &["planning"],
    &["energy_rule"],
    &["equivalence"],
    &["describe"],
    &["extensions"],
    &["export"],
    &["connection"],
    &["dynamics"],
    &["scaffold"],
    &["sweep"],
    &["picture"],
    &["tracking"],
    &["claims"],
    &["discrepancy/report"],
    &["discrepancy/calibration_report"],
    &["discrepancy/request"],
    &["discrepancy/record"],
    &["discrepancy/initial_state"],
    &["discrepancy/shooting"],
    &["discrepancy/preprocessing"],
    &["discrepancy/estimation"],
    &["discrepancy/evidence"],
    &["discrepancy/localisation"],
    &["discrepancy/selection"],
    &["discrepancy/diagnosis"],
    &["discrepancy/experiment"],
    &["discrepancy/clock_alignment"],
    &["discrepancy/identifiability"],
    &["discrepancy/rendering"],
    &["discrepancy/discovery"],
    &["discrepancy/pipeline"],
    &["discrepancy/pose_filter"],
    &["discrepancy/kinematic_comparison"],
    &["discrepancy/check", "discrepancy/discover", "discrepancy/calibration"],
    &["discrepancy/fixtures"],
    &["discrepancy"],
    &["figures"],
    &["theory"],
    &["report"],
    &["front_door"],
    &["fleet"],
    &["lib"],
    &["command"],
    &["main"],
];

/// The place of a file's stage in the order, and its place within the line: the longest prefix that is one counts.
pub fn stage(file: &str) -> Option<(usize, usize)> {
    let places =
        STAGES.iter().enumerate().flat_map(|(i, line)| line.iter().enumerate().map(move |(k, s)| ((i, k), *s)));
    let inside = |s: &str| file == s || file.strip_prefix(s).is_some_and(|rest| rest.starts_with('/'));
    // `discrepancy` itself is its mod.rs alone: what stands below it stands in a stage of its own.
    let own = |s: &str| s != "discrepancy" || file == "discrepancy/mod";
    places.filter(|(_, s)| inside(s) && own(s)).max_by_key(|(_, s)| s.len()).map(|(place, _)| place)
}

//! A robot's description that does not say what is asked of it.

use creepage::scaffold::{Measures, Starter, Wanted};

/// A wheel without a radius is not passed over in silence.
#[test]
fn a_radius_of_zero_is_told() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("robot.urdf");
    let wheel = |side: &str, radius: f64| {
        format!(
            "<link name='{side}_wheel'><visual><geometry><sphere radius='{radius}'/></geometry></visual></link>\
             <joint name='{side}' type='continuous'><parent link='base'/><child link='{side}_wheel'/></joint>"
        )
    };
    for (radii, line) in [
        ([0.0, 0.0], "wheel_radius = 0.1"),
        ([0.0, 0.25], "wheel_radius = 0.25"),
        ([0.25, 0.25], "wheel_radius = 0.25"),
    ] {
        let [left, right] = radii;
        let robot = format!("<robot><link name='base'/>{}{}</robot>", wheel("left", left), wheel("right", right));
        std::fs::write(&path, robot).unwrap();
        let measures = Some(Measures::read(&path).unwrap());
        let wanted = Wanted { vehicle: "differential-drive".into(), measures, ..Wanted::default() };
        let text = Starter::new(&wanted).unwrap().text;
        let found = text.lines().find(|l| l.starts_with(line)).unwrap_or_else(|| panic!("{text}"));
        let flat = radii.iter().filter(|r| **r == 0.0).count();
        let says =
            ["", "not taken: a radius not above zero of 1 wheel", "not taken: a radius not above zero of 2 wheels"];
        assert!(found.ends_with(says[flat]) && found.contains("not taken") == (flat > 0), "{found}");
    }
}

//! What `describe` says of the coefficients of a model as it stands.

use crate::models::{effect, machines, still, vehicle};
use creepage::describe::{CreepLimits, Description};
use creepage::effects::{Applied, Effect};

fn limits() -> CreepLimits {
    CreepLimits { rotation: "-0.2,0.3".parse().ok(), traverse: "-0.1,0.15".parse().ok() }
}

/// Creep, value, regime and whether the row holds, of every coefficient that is told of.
fn told(d: &Description) -> Vec<(String, Option<f64>, &'static str, bool)> {
    let all = d.constraints.iter().map(|c| &c.coefficient).filter(|c| c.is_told());
    all.map(|c| (c.creep.to_string(), c.value, c.regime(), c.row_holds)).collect()
}

#[test]
fn an_ideal_model_says_nothing_without_limits_and_ideal_with_them() {
    for model in machines().into_iter().chain(still()) {
        let d = Description::of(&model).unwrap();
        assert!(told(&d).is_empty(), "{}", model.vehicle.id);
        let all = told(&d.with_limits(limits()));
        // A momentum has no limits between creep and slip.
        let limited = model.constraints().iter().filter(|c| c.letter() != 'S').count();
        assert_eq!(all.len(), limited);
        let ideal = |c: &(String, Option<f64>, &str, bool)| c.1 == Some(0.0) && c.2 == "ideal" && c.3;
        assert!(all.iter().all(ideal), "{}: {all:?}", model.vehicle.id);
    }
}

#[test]
fn limits_belong_to_their_form() {
    let model = vehicle("differential-drive", &[0.4, 0.1])
        .with_effect(effect("unequal-rotation-creep", None, &[0.3, -0.1]))
        .with_effect(effect("traverse-creep", None, &[0.2]));
    let d = Description::of(&model).unwrap();
    let regimes = |d: &Description| told(d).into_iter().map(|t| t.2).collect::<Vec<_>>();
    assert_eq!(regimes(&d), ["forward-creep", "backward-creep", "left-creep"]);
    assert_eq!(regimes(&d.clone().with_limits(limits())), ["forward-creep", "slipping", "side-slip"]);
    let rotation = CreepLimits { traverse: None, ..limits() };
    assert_eq!(regimes(&d.with_limits(rotation)), ["forward-creep", "slipping", "left-creep"]);
}

#[test]
fn a_coefficient_that_is_given_as_zero_is_told() {
    let model = vehicle("unicycle", &[0.4]).with_effect(effect("rotation-creep", None, &[0.0]));
    let expected = [("e_rc".to_string(), Some(0.0), "ideal", true)];
    assert_eq!(told(&Description::of(&model).unwrap()), expected);
    // A radius is no coefficient.
    let model = vehicle("unicycle", &[0.4]).with_effect(effect("wheel-radius", None, &[0.1]));
    assert!(told(&Description::of(&model).unwrap()).is_empty());
}

#[test]
fn a_row_that_the_motion_leaves_is_not_called_ideal() {
    let slides = vehicle("unicycle", &[0.4]).with_effect(effect("cornering-creep", None, &[0.1]));
    let d = Description::of(&slides).unwrap();
    assert!(told(&d).is_empty());
    let d = d.with_limits(limits());
    let expected = [("e_rc".to_string(), Some(0.0), "ideal", true), ("e_tc".into(), Some(0.0), "undefined", false)];
    assert_eq!(told(&d), expected);
    assert!(d.constraints[1].coefficient.words().contains("effects beside the rows"));
    // A lagging speed leaves the rolling row and keeps the direction.
    let lags = vehicle("unicycle", &[0.4]).with_effect(effect("traction-creep", None, &[0.1]));
    let d = Description::of(&lags).unwrap().with_limits(limits());
    assert_eq!(told(&d).iter().map(|t| t.3).collect::<Vec<_>>(), [false, true]);
}

#[test]
fn a_coefficient_that_varies_has_no_regime() {
    let text = "id = 'mine'\nwhere = 'wheel'\nsays = 'creeps more the faster it turns'\nsource = 'a test'\n\
                [parameters.k]\nunit = 's'\nrange = [-1.0, 1.0]\nsize = 0.1\n[changes]\ne_tc = 'it + k*yaw_rate'\n";
    let mine: Effect = toml::from_str(text).unwrap();
    let model = vehicle("unicycle", &[0.4]).with_effect(Applied::new(&mine, None, vec![0.1]));
    let d = Description::of(&model).unwrap();
    assert_eq!(told(&d), [("e_tc".to_string(), None, "undefined", true)]);
    assert!(d.constraints[1].coefficient.words().starts_with("not constant"));
}

#[test]
fn a_blade_is_judged_though_it_has_no_motion() {
    let sleigh = vehicle("sleigh", &[1.0]).with_effect(effect("traverse-creep", None, &[-0.1]));
    let d = Description::of(&sleigh).unwrap();
    assert_eq!(told(&d), [("e_tc".to_string(), Some(-0.1), "right-creep", true)]);
    assert_eq!(told(&d.with_limits(limits()))[0].2, "side-slip");
}

use creepage::formula::Expr;
use creepage::vehicles::{self, Quantity, Section, Vehicle, Wheel};

/// A bus of two sections: a car in front, and behind a joint a section whose wheels drive.
pub fn bus() -> Vehicle {
    let car = vehicles::named("car").unwrap().clone();
    let metres = |meaning: &str| Quantity { unit: "m".into(), meaning: meaning.into(), optional: false };
    let mut parameters = car.parameters.clone();
    parameters.insert("joint_offset".into(), metres("the joint behind the middle axle"));
    parameters.insert("rear_length".into(), metres("from the joint back to the rear axle"));
    let [middle, front] = <[Wheel; 2]>::try_from(car.wheels.clone()).unwrap();
    let rear =
        Wheel { name: "rear wheels".into(), on: Some("rear section".into()), traverse_creep: None, ..middle.clone() };
    let middle = Wheel { radius: None, rate: None, rotation_creep: None, ..middle };
    Vehicle {
        id: "pushed-bus".into(),
        title: "steered in front, driven behind the joint".into(),
        parameters,
        wheels: vec![middle, front, rear],
        trailers: vec![Section {
            name: "rear section".into(),
            length: Expr::sym("rear_length"),
            hitch: Expr::sym("joint_offset"),
        }],
        ..car
    }
}

use creepage::claims::{Claim, DerivedFormulas, Status, proving};
use creepage::vehicles::Vehicle;

/// How fast the front of a pushed bus goes: the driven wheels push through the joint.
pub fn push(bus: &Vehicle) -> Claim {
    let creeps = ["e_rc", "e_tc", "e_f", "e_tc_1"];
    let ideal = creeps.iter().fold(DerivedFormulas::of_vehicle(bus, 0), |machine, e| machine.with_text(e, "0"));
    let pushed = [("v_d", "r*theta'/(cos(phi - phi_1) + c_1/L*sin(phi - phi_1)*tan(delta))")];
    Claim::new("bus-push", Status::Proved, "the speed of a bus that its rear section pushes")
        .at("CONTRIBUTING, a new claim")
        .under("no creep; the wheel rate of the rear section is measured")
        .proof("the derived motion gives it", &pushed, proving(ideal))
}

//! The holonomic and the nonholonomic part: growth vectors, integrals, degrees of nonholonomy, in exact arithmetic.

use super::growth_examples::Found;
use crate::claims::{Claim, Correction, DerivedFormulas, Status, proving};
use crate::formula::{Expr, Symbol};

const CHAPTER: &str = "05a-holonomy";
const GROWTH: &str = "src/mechanism/growth_vector.rs";
const INTEGRALS: &str = "src/mechanism/integrals.rs";

pub(crate) fn claims() -> Vec<Claim> {
    let found = Found::default();
    vec![counts(&found), integral(&found), skid_steer(&found), table(&found)]
}

pub(super) fn base(id: &str, status: Status, says: &str) -> Claim {
    Claim::new(id, status, says)
        .chapter(CHAPTER)
        .code(&[GROWTH, INTEGRALS, "src/formula/jet.rs", "src/claims/paper/descriptions.toml"])
        .tests(&["tests/mechanism/growth.rs", "tests/mechanism/growth_laws.rs"])
}

fn counts(found: &Found) -> Claim {
    base("E19", Status::Corrected, "three-wheeled cars have three holonomic constraints, four-wheeled ones four")
        .at("section 4, first theorem; errata E19")
        .corrects(Correction::FalseAsPrinted)
        .part_of("theorem-single-body")
        .under("ideal constraints; 7 and 8 coordinates as the paper has them; one general configuration each")
        .remark(
            "Of the constraints of castor, front-steered and Ackermann vehicles one is holonomic, r·(θ₁ − θ₂) = a·φ. \
             The paper's counts are those of synchro drives.",
        )
        .refutation(
            "the paper's counts",
            &[("differential_drive_castor.holonomic", "3")],
            &[("differential_drive_castor.holonomic", "1")],
            found.checking(),
        )
        .proof(
            "brackets bound the count from above, integrals from below",
            &[
                ("differential_drive_castor.coordinates", "7"),
                ("differential_drive_castor.holonomic", "1"),
                ("differential_drive_castor.nonholonomic", "4"),
                ("tricycle_with_rear_wheels.coordinates", "7"),
                ("tricycle_with_rear_wheels.holonomic", "1"),
                ("tricycle_with_rear_wheels.nonholonomic", "4"),
                ("ackermann.coordinates", "8"),
                ("ackermann.holonomic", "1"),
                ("ackermann.nonholonomic", "5"),
                ("synchro_drive.holonomic", "3"),
                ("synchro_drive_4.holonomic", "4"),
            ],
            found.checking(),
        )
}

/// The integral that the search finds for the two-wheeler.
fn integral(found: &Found) -> Claim {
    let integral = found.of("differential-drive").and_then(|c| Some(c.found.integrals.first()?.formula.clone()));
    let integral = integral.unwrap_or_default();
    let one_radius = |s: &Symbol| matches!(s.as_str(), "r_1" | "r_2").then(|| Expr::sym("r"));
    base("integral-28", Status::Proved, "the machine finds the integral r·(θ₁ − θ₂) − a·φ of the two-wheeler")
        .at("section 4, (28)")
        .about(&[28])
        .under("no creep; the integral is proved for all configurations and lengths")
        .proof(
            "what the search returns, radii equal",
            &[("integral", "r*(theta_1 - theta_2) - a*phi")],
            proving(DerivedFormulas::default().with("integral", integral.substitute(&one_radius))),
        )
}

fn skid_steer(found: &Found) -> Claim {
    base("E20", Status::Corrected, "all wheeled cars have two nonholonomic constraints")
        .at("section 4, first theorem, \"all wheeled cars\"; errata E20")
        .corrects(Correction::FalseAsPrinted)
        .part_of("theorem-single-body")
        .under("four fixed wheels, each with its rolling and its direction")
        .remark(
            "Skid steering has rank 6 in 7 coordinates: the ideal vehicle drives straight and nothing else, all six \
             constraints are holonomic, and every turn is creep. It is to be left out, or given R·T_front·T_rear.",
        )
        .refutation(
            "two nonholonomic constraints",
            &[("skid_steer.nonholonomic", "2")],
            &[("skid_steer.nonholonomic", "0")],
            found.checking(),
        )
        .proof(
            "no freedom is left but straight driving",
            &[
                ("skid_steer.coordinates", "7"),
                ("skid_steer.rank", "6"),
                ("skid_steer.growth", "1"),
                ("skid_steer.holonomic", "6"),
                ("skid_steer.nonholonomic", "0"),
            ],
            found.checking(),
        )
        .proof(
            "steered wheels kept parallel allow no motion at all but steering",
            &[
                ("parallel_steering.coordinates", "4"),
                ("parallel_steering.rank", "3"),
                ("parallel_steering.holonomic", "3"),
            ],
            found.checking(),
        )
}

fn table(found: &Found) -> Claim {
    base("growth-table", Status::Proved, "growth vectors of the vehicles of the paper")
        .at("corrected theorem (b), table")
        .about(&[26, 27, 28])
        .under("one general configuration each")
        .proof(
            "iterated brackets of exact power series; a vector (2, 3, 5, 7) is written 2357",
            &[
                ("unicycle.growth", "234"),
                ("unicycle.nonholonomic", "2"),
                ("differential_drive.growth", "234"),
                ("differential_drive.holonomic", "1"),
                ("differential_drive.nonholonomic", "2"),
                ("differential_drive_castor.growth", "2356"),
                ("tricycle_with_rear_wheels.growth", "2356"),
                ("ackermann.growth", "2357"),
                ("synchro_drive.growth", "234"),
                ("synchro_drive.nonholonomic", "2"),
                ("synchro_drive_4.growth", "234"),
                ("kinematic_car.growth", "234"),
                ("kinematic_car.holonomic", "0"),
                ("car.growth", "2345"),
                ("car.nonholonomic", "3"),
            ],
            found.checking(),
        )
}

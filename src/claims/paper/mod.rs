//! The claims of the paper, section by section.

mod blade;
mod compiled_derivatives;
mod creep_dynamics;
mod direction;
mod domain;
mod dual_numbers;
mod editorial;
mod falling_cat;
mod figure_words;
mod finite;
mod growth_examples;
mod growth_of_trains;
mod hinge_chain;
mod ideal_limit;
mod introduction;
mod laws;
mod limits_of_creep;
mod planned_vehicles;
mod planning;
mod platforms;
mod power;
mod realisation;
mod regimes;
mod rotation;
mod sentences;
mod simulation;
mod single_body;
mod structure;
mod symmetry;
mod symmetry_creep;
mod theorems;
mod towing;
mod tracked_vehicles;
mod trailers;
mod traverse;
mod viscous;
mod viscous_limit;
mod wheel;

use super::Claim;

/// Every claim, in the order of the paper.
///
/// ```
/// assert!(creepage::claims::all().iter().any(|c| c.id == "eq-24"));
/// ```
pub fn all() -> Vec<Claim> {
    [
        introduction::claims(),
        rotation::claims(),
        traverse::claims(),
        direction::claims(),
        dual_numbers::claims(),
        compiled_derivatives::claims(),
        regimes::claims(),
        wheel::claims(),
        simulation::claims(),
        figure_words::claims(),
        single_body::claims(),
        structure::claims(),
        growth_of_trains::claims(),
        platforms::claims(),
        theorems::claims(),
        realisation::claims(),
        trailers::claims(),
        towing::claims(),
        ideal_limit::claims(),
        planning::claims(),
        planned_vehicles::claims(),
        tracked_vehicles::claims(),
        symmetry::claims(),
        hinge_chain::claims(),
        falling_cat::claims(),
        symmetry_creep::claims(),
        laws::claims(),
        power::claims(),
        creep_dynamics::claims(),
        limits_of_creep::claims(),
        viscous::claims(),
        viscous_limit::claims(),
        sentences::claims(),
        editorial::claims(),
    ]
    .concat()
}

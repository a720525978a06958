//! What is listed and not yet shown: dynamics do not exist yet, and a misprint without mathematics.

use crate::claims::{Claim, Status};

/// Rows of the errata that need equations of motion with forces.
const OPEN: [(&str, &str, &str, &[u8]); 4] = [
    (
        "E13",
        "the growth parameter k_g > 0 of (1) is a decay; 1/k_g is a relaxation length",
        "section 1, (1); errata E13",
        &[1],
    ),
    (
        "E14",
        "(1) with (2) is an elastic law, f = k_r·k_g·x_c, in which no speed is left, and no viscous creep",
        "section 1, (1)–(2); errata E14",
        &[1, 2],
    ),
    (
        "E15",
        "Rocard's law (2) and the viscous law (18) agree only for b_T = k_r/v_l, which is no constant",
        "(2) and (18); errata E15",
        &[2, 18],
    ),
    (
        "E22",
        "with the friction of (11) and (18) the energy falls by b_R·v_A² + b_T·v_t²; the rule is a normalisation",
        "section 4, simulation; errata E22",
        &[],
    ),
];

pub(super) fn claims() -> Vec<Claim> {
    let open = |(id, says, place, about): &(&str, &str, &str, &[u8])| {
        Claim::new(id, Status::Open, says)
            .at(place)
            .about(about)
            .remark("Open until dynamics exist.")
            .chapter("10-open")
    };
    let mut all: Vec<Claim> = OPEN.iter().map(open).collect();
    all.push(
        Claim::new("E26", Status::Editorial, "\"the sleigh in Fig. 3\" means Fig. 4")
            .at("section 3; errata E26")
            .remark("Fig. 3 shows the disk; the sleigh is drawn in Fig. 4.")
            .chapter("03-traverse-creep"),
    );
    all
}

//! What is listed and not yet shown, and a misprint without mathematics.

use crate::claims::{Claim, Status};

/// Rows of the errata that need equations of motion with forces.
const OPEN: [(&str, &str, &str, &[u8]); 1] = [(
    "E25",
    "for symmetry constraints the limit is vanishing drag, and the violation a memory integral",
    "section 4, last paragraph; errata E25",
    &[],
)];

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

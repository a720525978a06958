//! A misprint without mathematics.

use crate::claims::{Claim, Status};

pub(crate) fn claims() -> Vec<Claim> {
    let misprint = Claim::new("E26", Status::Editorial, "\"the sleigh in Fig. 3\" means Fig. 4")
        .at("section 3; errata E26")
        .remark("Fig. 3 shows the disk; the sleigh is drawn in Fig. 4.")
        .chapter("03-traverse-creep");
    vec![misprint]
}

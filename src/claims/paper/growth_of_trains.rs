//! Growth vectors of trains: regular, perpendicular, and the states between them.

use super::growth_examples::Found;
use super::structure::base;
use crate::claims::{Claim, Status};

pub(crate) fn claims() -> Vec<Claim> {
    let found = Found::default();
    vec![trains(&found), degrees(&found), states(&found)]
}

fn trains(found: &Found) -> Claim {
    base("growth-trailers", Status::Proved, "growth vectors of trains of up to three trailers, with and without the angle of a wheel, in the configurations named")
        .at("corrected theorem (c), growth")
        .under("hitches on the axles; one general configuration each, bars of length 1")
        .proof(
            "regular, perpendicular, and with the last angle alone at right angles, which does not matter",
            &[
                ("regular_0.growth", "23"),
                ("regular_1.growth", "234"),
                ("regular_2.growth", "2345"),
                ("regular_3.growth", "23456"),
                ("perpendicular_1.growth", "234"),
                ("perpendicular_2.growth", "23445"),
                ("perpendicular_3.growth", "23445556"),
                ("first_perpendicular.growth", "23445"),
                ("last_perpendicular.growth", "2345"),
                ("with_wheel_0.growth", "234"),
                ("with_wheel_1.growth", "235"),
                ("with_wheel_2.growth", "2356"),
                ("steered_0.growth", "2345"),
                ("steered_1.growth", "23456"),
                ("steered_2.growth", "23457"),
            ],
            found.checking(),
        )
}

fn degrees(found: &Found) -> Claim {
    base("jean-degree", Status::Proved, "the degree of nonholonomy of the trains looked at is N + 2 for N ≤ 5 where no hitch is perpendicular, and Fibonacci's F(N + 3) for N ≤ 3 where all are")
        .at("corrected theorem (c); both bounds were known before Jean 1996")
        .under("hitches on the axles, bars of length 1; one configuration of each kind, so a computation and no theorem for all")
        .proof(
            "exact brackets",
            &[
                ("regular_0.degree", "0 + 2"),
                ("regular_1.degree", "1 + 2"),
                ("regular_2.degree", "2 + 2"),
                ("regular_3.degree", "3 + 2"),
                ("regular_4.degree", "4 + 2"),
                ("regular_5.degree", "5 + 2"),
                ("perpendicular_0.degree", "2"),
                ("perpendicular_1.degree", "3"),
                ("perpendicular_2.degree", "5"),
                ("perpendicular_3.degree", "8"),
            ],
            found.checking(),
        )
}

fn states(found: &Found) -> Claim {
    base("jean-states", Status::Proved, "between the two extremes the degree of three trailers depends on which hitches are perpendicular and on whether the next stands at arctan(sin(π/2)·d_1/d_2)")
        .at("corrected theorem (c); Jean 1996, the degree in every state by induction")
        .under("three trailers, hitches on the axles, d_1 = 3/4, d_2 = d_3 = 1; one configuration of each state; the angle at the last hitch does not matter")
        .remark("With bars of equal length Jean's second angle is π/4, whose sine is irrational; exact brackets need a rational one, so the bars here make its tangent 3/4.")
        .proof(
            "exact brackets; a degree a state: no hitch at a right angle, the first, the second, the second with the first at Jean's angle to the same side, to the other side, both",
            &[
                ("state_regular.degree", "5"),
                ("state_first.degree", "7"),
                ("state_next.degree", "6"),
                ("state_second.degree", "7"),
                ("state_mirrored.degree", "6"),
                ("state_both.degree", "8"),
            ],
            found.checking(),
        )
}

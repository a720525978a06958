//! The sentences of the paper about Fig. 7 under each reading of the word "conservative".

use super::{Data, fixed};
use crate::energy_rule::{EndPoint, FIG7_DURATION, Instantaneous, Reading, fig7_case, fig7_instants, fig7_path};
use crate::error::Result;
use std::fmt::Write;

/// The cases of Fig. 7: name, e_rc, e_tc.
pub const CASES: [(&str, f64, f64); 4] =
    [("i", -0.01, -0.02), ("ii", -0.1, -0.2), ("iii", -0.1, -0.002), ("iv", -0.001, -0.2)];

/// The cases in which type R and type T dominate, by their place in [`CASES`].
const MOSTLY_R: usize = 2;
const MOSTLY_T: usize = 3;
/// The time that stands for "at the beginning", s, and the equal coefficients of the fair comparison.
const BEGINNING: f64 = 0.5;
const EQUAL_CREEP: f64 = -0.05;
/// Values that differ by no more than this are the same, in SI units.
const SAME_WITHIN: f64 = 1e-9;
/// Instants at which energies are compared.
const INSTANTS: usize = 9;

/// What was computed of one reading.
struct Facts {
    ideal: EndPoint,
    ends: Vec<EndPoint>,
    /// Distance from the ideal wheel early on, m, in each case.
    early: Vec<f64>,
    /// The same at equal coefficients: type T over type R.
    ratio: f64,
    start: Instantaneous,
    starts: Vec<Instantaneous>,
    /// Energies in case (ii) and of the ideal wheel.
    energies: [Vec<f64>; 2],
}

/// A sentence of the paper as a predicate.
struct Sentence {
    id: &'static str,
    says: &'static str,
    holds: fn(&Facts) -> bool,
}

const SENTENCES: [Sentence; 9] = [
    Sentence {
        id: "S1",
        says: "early on (iv), mostly T, is farther off than (iii), mostly R",
        holds: |f| f.early[MOSTLY_T] > f.early[MOSTLY_R] + SAME_WITHIN,
    },
    Sentence { id: "S1'", says: "so it is at equal coefficients", holds: |f| f.ratio > 1.0 + SAME_WITHIN },
    Sentence {
        id: "S2a",
        says: "in (iii) the wheel has turned less than the ideal one",
        holds: |f| f.ends[MOSTLY_R].phi < f.ideal.phi - SAME_WITHIN,
    },
    Sentence {
        id: "S2b",
        says: "in (iii) it has rolled by less than the ideal one",
        holds: |f| f.ends[MOSTLY_R].theta < f.ideal.theta - SAME_WITHIN,
    },
    Sentence {
        id: "S2c",
        says: "in (iii) it has travelled farther",
        holds: |f| f.ends[MOSTLY_R].distance > f.ideal.distance + SAME_WITHIN,
    },
    Sentence {
        id: "S2",
        says: "in every case it has turned less",
        holds: |f| f.ends.iter().all(|e| e.phi < f.ideal.phi - SAME_WITHIN),
    },
    Sentence {
        id: "S3",
        says: "both initial rates differ from the ideal ones",
        holds: |f| {
            let differ = |s: &Instantaneous| {
                (s.yaw_rate - f.start.yaw_rate).abs() > SAME_WITHIN
                    && (s.wheel_rate - f.start.wheel_rate).abs() > SAME_WITHIN
            };
            f.starts.iter().all(differ)
        },
    },
    Sentence {
        id: "S4",
        says: "the energy is that of the ideal wheel at every instant",
        holds: |f| f.energies[0].iter().zip(&f.energies[1]).all(|(a, b)| (a - b).abs() < SAME_WITHIN),
    },
    Sentence {
        id: "S4b",
        says: "the energy is constant in time",
        holds: |f| f.energies[0].iter().all(|e| (e - f.energies[0][0]).abs() < SAME_WITHIN),
    },
];

/// The sentences and whether each holds under each reading, computed.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Id, words, and whether it holds, in the order of [`Reading::ALL`].
    pub sentences: Vec<(&'static str, &'static str, Vec<bool>)>,
    /// Type T over type R, early on at equal coefficients, in the same order.
    pub ratios: Vec<f64>,
}

/// Computes the table; S1 and S1' compare the distance from the ideal wheel after half a second, S1' at −0.05.
///
/// Source: paper, *Simulation*; theory/08-simulation, errata E22–E24.
///
/// ```
/// let judged = creepage::figures::readings::table().unwrap();
/// let energy = judged.sentences.iter().find(|s| s.0 == "S4").unwrap();
/// assert!(energy.2[1] && !energy.2[0]); // reading A keeps the energy rule, no reading does not
/// ```
///
/// # Errors
/// When a case of the paper cannot be integrated.
pub fn table() -> Result<Judged> {
    let facts = Reading::ALL.iter().map(|r| facts(*r)).collect::<Result<Vec<_>>>()?;
    let judge = |s: &Sentence| (s.id, s.says, facts.iter().map(s.holds).collect());
    Ok(Judged { sentences: SENTENCES.iter().map(judge).collect(), ratios: facts.iter().map(|f| f.ratio).collect() })
}

fn facts(reading: Reading) -> Result<Facts> {
    let each =
        |of: &dyn Fn(f64, f64) -> Result<f64>| CASES.iter().map(|(_, r, t)| of(*r, *t)).collect::<Result<Vec<_>>>();
    let ideal_early = fig7_path(0.0, 0.0, Reading::NonConservative, &[BEGINNING])?[0];
    let off = |e_rc: f64, e_tc: f64| -> Result<f64> {
        let p = fig7_path(e_rc, e_tc, reading, &[BEGINNING])?[0];
        Ok((p.x - ideal_early.x).hypot(p.y - ideal_early.y))
    };
    let times: Vec<f64> = (0..INSTANTS).map(|i| FIG7_DURATION * i as f64 / (INSTANTS - 1) as f64).collect();
    let energies = |e_rc, e_tc, reading| -> Result<Vec<f64>> {
        Ok(fig7_instants(e_rc, e_tc, reading, &times)?.iter().map(|i| i.energy).collect())
    };
    let start = |e_rc: f64, e_tc: f64, reading| Ok(fig7_instants(e_rc, e_tc, reading, &[0.0])?[0]);
    Ok(Facts {
        ideal: fig7_case(0.0, 0.0, Reading::NonConservative)?,
        ends: CASES.iter().map(|(_, r, t)| fig7_case(*r, *t, reading)).collect::<Result<_>>()?,
        early: each(&off)?,
        ratio: off(0.0, EQUAL_CREEP)? / off(EQUAL_CREEP, 0.0)?,
        start: start(0.0, 0.0, Reading::NonConservative)?,
        starts: CASES.iter().map(|(_, r, t)| start(*r, *t, reading)).collect::<Result<_>>()?,
        energies: [energies(CASES[1].1, CASES[1].2, reading)?, energies(0.0, 0.0, Reading::NonConservative)?],
    })
}

impl Judged {
    /// The table for a terminal.
    pub fn text(&self) -> String {
        let mut out =
            String::from("What each reading of \"conservative\" makes of the paper's sentences on Fig. 7\n\n");
        let head: String = Reading::ALL.iter().map(|r| format!("{:>8}", short(*r))).collect();
        let _ = writeln!(out, "  {:<62}{head}", "");
        for (id, says, holds) in &self.sentences {
            let cells: String = holds.iter().map(|h| format!("{:>8}", mark(*h))).collect();
            let _ = writeln!(out, "  {:<62}{cells}", format!("{id:<4} {says}"));
        }
        let ratios: String = self.ratios.iter().map(|r| format!("{:>8}", fixed(*r, 4))).collect();
        let _ = writeln!(out, "  {:<62}{ratios}", "     distance at equal coefficients, type T over type R");
        out
    }

    /// The table as Markdown.
    pub fn markdown(&self) -> String {
        let row = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
        let names = Reading::ALL.iter().map(|r| short(*r).replace('_', "\\_"));
        let mut out = row(["".into(), "sentence".into()].into_iter().chain(names).collect());
        out.push_str(&row(vec!["---".into(); 2 + Reading::ALL.len()]));
        for (id, says, holds) in &self.sentences {
            let marks = holds.iter().map(|h| mark(*h).to_string());
            out.push_str(&row([(*id).into(), (*says).into()].into_iter().chain(marks).collect()));
        }
        let ratios = self.ratios.iter().map(|r| fixed(*r, 5));
        let says = "distance at equal coefficients, type T over type R".to_string();
        out.push_str(&row(["".into(), says].into_iter().chain(ratios).collect()));
        out
    }

    /// The table as data.
    pub fn data(&self) -> Data {
        let names: Vec<&str> = ["id", "sentence"].into_iter().chain(Reading::ALL.iter().map(|r| r.name())).collect();
        let mut data = Data::new("readings", &names);
        for (id, says, holds) in &self.sentences {
            let marks = holds.iter().map(|h| if *h { "yes" } else { "no" }.to_string());
            data.row([(*id).into(), (*says).into()].into_iter().chain(marks));
        }
        let says = "distance at equal coefficients: type T over type R".to_string();
        data.row(["ratio".into(), says].into_iter().chain(self.ratios.iter().map(|r| fixed(*r, 6))));
        data
    }
}

fn mark(holds: bool) -> &'static str {
    if holds { "yes" } else { "-" }
}

/// The name of a reading in a narrow column.
fn short(reading: Reading) -> &'static str {
    if reading == Reading::NonConservative { "none" } else { reading.name() }
}

//! The cases and their parameters as CSV, one row each.

use crate::simulator::{Hidden, Timing};
use crate::suite::case::Case;
use crate::suite::make::Target;
use crate::suite::secret;
use crate::workers::Outcome;
use std::fmt::Write as _;

/// `id` or `id:trailer`.
pub fn target_text((id, trailer): Target) -> String {
    trailer.map_or(id.into(), |i| format!("{id}:{i}"))
}

/// A hidden effect with its values.
pub fn hidden_text(hidden: &Hidden) -> String {
    let values = secret::parameters(hidden).into_iter().map(|(name, v)| format!("{name}={v:.4}"));
    format!("{} {}", target_text(secret::target(hidden)), values.collect::<Vec<_>>().join(" "))
}

fn joined(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(" + ")
}

/// How well the data of a case show what it hides, and the nearest rival.
fn power_text(case: &Case) -> [String; 2] {
    let visible = joined(case.powers.iter().map(|p| format!("{:.0}", p.visible)));
    let nearest = case.powers.iter().filter_map(|p| p.rivals.first());
    [visible, joined(nearest.map(|(t, apart)| format!("{} {apart:.0}", target_text(*t))))]
}

/// Every case.
pub fn cases(outcomes: &[Outcome]) -> String {
    let mut text = String::from(
        "seed,kind,vehicle,drive,duration_s,rate_hz,rows,position_m,heading_rad,interval_mean,jitter,dropouts,gaps,\
         outliers,noise_told,hidden,from_s,until_s,determined,visible_chi2,nearest_rival,verdict,named,scopes,right,\
         excused,unnamed,gap_1s_over_floor,gap_5s_over_floor,gap_5s_before_over_floor\n",
    );
    outcomes.iter().for_each(|o| text += &case_row(o));
    text
}

fn case_row(o: &Outcome) -> String {
    let (s, j) = (&o.case.scenario, &o.judgement);
    let [visible, nearest] = power_text(&o.case);
    let ratio = |r: Option<f64>| r.map_or(String::new(), |r| format!("{r:.3}"));
    let end = |t: Option<f64>| t.filter(|t| t.is_finite()).map_or(String::new(), |t| format!("{t:.1}"));
    let cells = [
        o.case.seed.to_string(),
        o.case.kind.name().into(),
        o.case.make.name.into(),
        o.case.drive.name().into(),
        format!("{:.1}", s.duration),
        format!("{:.1}", s.rate),
        o.trial.rows.to_string(),
        format!("{:.2e}", s.noise.position),
        format!("{:.2e}", s.noise.heading),
        u8::from(s.timing == Timing::IntervalMean).to_string(),
        format!("{:.2}", s.jitter),
        format!("{:.3}", s.dropouts),
        s.gaps.len().to_string(),
        format!("{:.4}", s.outliers.share),
        u8::from(o.case.tells_noise).to_string(),
        joined(s.hidden.iter().map(hidden_text)),
        end(s.span.map(|[from, _]| from)),
        end(s.span.map(|[_, until]| until)),
        u8::from(o.case.determined()).to_string(),
        visible,
        nearest,
        format!("\"{}\"", j.verdict.replace('"', "'")),
        joined(j.named.iter().map(|t| target_text(*t))),
        joined(j.scopes.iter().cloned()).replace(',', ";"),
        u8::from(j.right).to_string(),
        u8::from(j.excused).to_string(),
        u8::from(j.unnamed).to_string(),
        ratio(j.gap_over_floor[0]),
        ratio(j.gap_over_floor[1]),
        ratio(j.gap_before[1]),
    ];
    cells.join(",") + "\n"
}

/// Every parameter of every rightly named effect.
pub fn parameters(outcomes: &[Outcome]) -> String {
    let mut text = String::from("seed,kind,vehicle,determined,right,effect,parameter,truth,value,std,z,covered\n");
    for o in outcomes {
        let case = &o.case;
        let flags = format!("{},{}", u8::from(case.determined()), u8::from(o.judgement.right));
        for p in &o.judgement.parameters {
            let head = format!("{},{},{},{flags}", case.seed, case.kind.name(), case.make.name);
            let (z, covered) = (p.z(), u8::from(p.covered()));
            writeln!(
                text,
                "{head},{},{},{:.6e},{:.6e},{:.3e},{z:.3},{covered}",
                p.effect, p.name, p.truth, p.value, p.std
            )
            .expect("a String takes all");
        }
    }
    text
}

/// How long every case took; the only table that differs from call to call.
pub fn times(outcomes: &[Outcome]) -> String {
    let rows = outcomes.iter().map(|o| {
        let kind = o.case.kind.name();
        format!("{},{kind},{},{},{:.3}\n", o.case.seed, o.case.make.name, o.trial.rows, o.trial.seconds)
    });
    std::iter::once("seed,kind,vehicle,rows,seconds\n".to_string()).chain(rows).collect()
}

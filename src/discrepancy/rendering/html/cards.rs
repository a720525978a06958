//! Three cards under the sentence: the error against the noise, how sure the finding is, what remains.

use super::part::holding;
use crate::discrepancy::rendering::summary::why;
use crate::discrepancy::report::{Named, Pictures, Report, Verdict, judged, middle};
use crate::number_format::{plain, prefixed, significant};
use crate::picture::svg::Element;
use crate::wording::{counted, listed};

/// Evidence above which an effect is beyond doubt (Kass and Raftery 1995: very strong).
const BEYOND_DOUBT: f64 = 10.0;
/// A constraint that is violated by this many times what noise makes stands out.
const OUT_OF_NOISE: f64 = 1.5;

/// The cards that have something to say; none where nothing was fitted.
/// A card: its heading, what stands out, and the rest.
pub(super) fn cards(report: &Report, pictures: &Pictures) -> Option<Element> {
    let all: Vec<Element> = [error(report), sure(report, pictures), rest(report)].into_iter().flatten().collect();
    (!all.is_empty()).then(|| Element::new("div").with("class", "cards").children(all))
}

pub(crate) fn card(heading: &str, big: Option<String>, body: Vec<Element>) -> Element {
    let big = big.map(|b| holding("p", b).with("class", "big"));
    Element::new("section").with("class", "card").child(holding("h2", heading)).children(big).children(body)
}

/// Small print.
pub(crate) fn small(text: String) -> Element {
    holding("p", text).with("class", "small")
}

/// Bars of the error before and after against the noise floor, at the middle horizon.
fn error(report: &Report) -> Option<Element> {
    let gap = middle(&report.gap)?;
    let (name, v) = judged(gap)?;
    let values = [v.position_rms_before, v.position_rms_after, gap.noise_floor.position_rms];
    let most = values.into_iter().filter(|v| v.is_finite()).fold(0.0, f64::max);
    let (factor, unit) = prefixed(most, "m");
    let bar = |(label, class, value): (&str, &str, f64)| {
        let share = if most > 0.0 && value.is_finite() { (100.0 * value / most).max(0.6) } else { 0.0 };
        let fill = Element::new("i").with("class", class).with("style", format!("width:{}%", plain(share.round())));
        Element::new("div")
            .with("class", "bar")
            .child(holding("span", label))
            .child(Element::new("span").with("class", "track").child(fill))
            .child(holding("b", format!("{} {unit}", significant(value * factor, 2))))
    };
    let named = [("as given", "before"), ("patched", "after"), ("noise alone", "floor")];
    // A model that nothing was added to is the one as given.
    let is_patched = values[0] != values[1];
    let bars = named.into_iter().zip(values).filter(|((_, class), _)| is_patched || *class != "after");
    let bars = bars.map(|((label, class), v)| bar((label, class, v))).collect();
    let runs = if name == "held-out" { "runs held out" } else { "fitted runs" };
    Some(card(&format!("Position error {} s ahead, {runs}, RMS", plain(gap.horizon_s)), None, bars))
}

/// How strongly the data speak for what was found.
fn sure(report: &Report, pictures: &Pictures) -> Option<Element> {
    let heading = "How sure";
    if report.verdict == Verdict::UnusableData {
        return None;
    }
    if report.effects.is_empty() && !report.odd_runs.is_empty() {
        let says = report.odd_runs.iter().map(|o| small(format!("{}.", o.says))).collect();
        return Some(card(heading, Some(format!("{} unlike the others", counted(report.odd_runs.len(), "run"))), says));
    }
    if report.effects.is_empty() {
        let best = pictures.candidates.iter().map(|c| c.delta_bic).filter(|b| b.is_finite()).reduce(f64::max)?;
        let weighed = format!("{} weighed", counted(pictures.candidates.len(), "effect"));
        let (big, asked) = match best > BEYOND_DOUBT {
            true => ("nothing with a name", format!("{weighed}, and none is kept.")),
            false => (
                "no effect has evidence",
                format!("{weighed}; ΔBIC of the best is {}, and above 10 is very strong.", significant(best, 2)),
            ),
        };
        return Some(card(heading, Some(big.into()), vec![small(asked)]));
    }
    let certain = report.effects.iter().filter(|e| e.evidence.delta_bic > BEYOND_DOUBT).count();
    let big = format!("{certain} of {} beyond doubt", report.effects.len());
    let bic = listed(report.effects.iter().map(|e| significant(e.evidence.delta_bic, 3)));
    let mut body = vec![small(format!("ΔBIC {bic}; above 10 is very strong."))];
    body.extend(report.effects.iter().filter_map(other_names).map(small));
    Some(card(heading, Some(big), body))
}

/// The other names of an effect, with the reason.
fn other_names(effect: &Named) -> Option<String> {
    let rivals: Vec<String> = effect.indistinguishable_from.iter().map(|r| format!("{} ({})", r.id, why(r))).collect();
    (!rivals.is_empty()).then(|| format!("{} is not told from {}.", effect.id, listed(rivals)))
}

/// What the patched model leaves, constraint by constraint, in multiples of the noise.
fn rest(report: &Report) -> Option<Element> {
    let left = report.remaining.as_ref()?;
    let heading = "What remains";
    let ratios: Vec<(&str, f64)> = left.constraints.iter().map(|c| (c.place.as_str(), c.rms / c.noise)).collect();
    let listed: Vec<String> = ratios
        .iter()
        .filter(|(_, r)| r.is_finite())
        .map(|(place, r)| format!("{place} {}", significant(*r, 2)))
        .collect();
    let small_print = small(format!("{}: times what noise alone makes.", listed.join(" · ")));
    let body = if listed.is_empty() { vec![] } else { vec![small_print] };
    let big = match &report.remains {
        Some(remains) if remains.ratio > 1.05 => format!("{} × the noise", significant(remains.ratio, 2)),
        Some(_) => "more than noise".into(),
        None if report.verdict == Verdict::NotIdentifiable => "not to be told".into(),
        None if ratios.iter().any(|(_, r)| *r > OUT_OF_NOISE) => "little beside the noise".into(),
        None => "noise only".into(),
    };
    let says = report.remains.as_ref().map(|r| small(format!("{}.", r.says)));
    Some(card(heading, Some(big), says.into_iter().chain(body).collect()))
}

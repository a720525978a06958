//! Laws of growth vectors over generated vehicles.

use crate::support::described::*;
use crate::support::{Outcome, check};
use creepage::formula::{Exact, Scalar, Symbol};
use creepage::mechanism::{Nonholonomy, Point};
use proptest::prelude::*;

/// What a wheel is mounted like.
#[derive(Clone, Debug)]
enum Mount {
    Along,
    Askew(Exact),
    Steered(Exact),
    Castor(Exact),
}

#[derive(Clone, Debug)]
struct Wheel {
    place: (i64, i64),
    mount: Mount,
    rolls: bool,
    holds: bool,
}

/// A vehicle with trailers and a configuration.
#[derive(Clone, Debug)]
struct Drawn {
    wheels: Vec<Wheel>,
    heading: Exact,
    betas: Vec<Exact>,
}

fn angles() -> impl Strategy<Value = Exact> + Clone {
    (1i64..6, 1i64..6, any::<bool>()).prop_filter_map("right angle", |(p, q, minus)| {
        (p != q).then(|| Exact::half_tangent(if minus { -p } else { p }, q))
    })
}

fn wheels() -> impl Strategy<Value = Wheel> {
    let mount = prop_oneof![
        6 => Just(Mount::Along),
        1 => angles().prop_map(Mount::Askew),
        2 => angles().prop_map(Mount::Steered),
        2 => angles().prop_map(Mount::Castor),
    ];
    (-2i64..3, -2i64..3, mount, any::<bool>(), 0..4).prop_map(|(f, l, mount, rolls, holds)| Wheel {
        place: (f, l),
        mount,
        rolls,
        holds: holds > 0 || !rolls,
    })
}

fn vehicles() -> impl Strategy<Value = Drawn> {
    let betas = prop::collection::vec(angles(), 0..3);
    (prop::collection::vec(wheels(), 1..4), angles(), betas).prop_map(|(mut wheels, heading, betas)| {
        // One wheel holds the reference point, as the axle does that trailers are hung on.
        wheels[0] = Wheel { place: (0, 0), mount: Mount::Along, holds: true, ..wheels[0].clone() };
        Drawn { wheels, heading, betas }
    })
}

impl Drawn {
    /// The description with wheels in the order given, each keeping its names.
    fn text(&self, order: &[usize]) -> String {
        let wheels: String = order.iter().map(|k| self.wheels[*k].text(*k)).collect();
        let angles = |k: usize| match self.wheels[k].mount {
            Mount::Askew(_) => format!("[define.mount_{k}]\nformula = \"angle_{k}\"\nunit = \"rad\"\nmeaning = \"\"\n"),
            _ => String::new(),
        };
        let steered = |k: &usize| matches!(self.wheels[*k].mount, Mount::Steered(_));
        let names: Vec<String> = (0..self.wheels.len()).filter(steered).map(|k| format!("mount_{k}")).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        format!("{wheels}{}{}", (0..self.wheels.len()).map(angles).collect::<String>(), measured(&names))
    }

    /// The configuration, turned by an angle.
    fn point(&self, turned: &Exact) -> Point {
        let heading = self.heading.add(turned);
        let at = trailers(lengths().with("phi", heading.clone()), &headings(&heading, &self.betas));
        self.wheels.iter().enumerate().fold(at, |at, (k, wheel)| match &wheel.mount {
            Mount::Along => at,
            Mount::Askew(a) | Mount::Steered(a) | Mount::Castor(a) => {
                at.with(Symbol::new(&format!("mount_{k}")), a.clone())
            }
        })
    }

    fn found(&self, order: &[usize], at: &Point) -> Option<Nonholonomy> {
        of(&self.text(order), self.betas.len()).nonholonomy(at, 6).ok()
    }

    fn order(&self) -> Vec<usize> {
        (0..self.wheels.len()).collect()
    }
}

impl Wheel {
    fn text(&self, k: usize) -> String {
        let (forward, left) = self.place;
        let mut text = format!("[[wheels]]\nname = \"wheel {k}\"\nforward = \"{forward}\"\nleft = \"{left}\"\n");
        if !matches!(self.mount, Mount::Along) {
            text += &format!("steering = \"mount_{k}\"\n");
        }
        if matches!(self.mount, Mount::Castor(_)) {
            text += "trail = \"c\"\n";
        }
        if self.rolls {
            text += &format!("radius = \"r\"\nrate = \"theta_{k}'\"\nrotation_creep = \"e_rc_{k}\"\n");
        }
        if self.holds {
            text += &format!("traverse_creep = \"e_tc_w{k}\"\n");
        }
        text
    }
}

/// What must not depend on names, order or place.
fn summary(found: &Nonholonomy) -> (Vec<usize>, usize, usize, usize, usize) {
    (found.growth.dimensions.clone(), found.growth.rank, found.holonomic, found.nonholonomic, found.integrals.len())
}

/// How many vehicles had a growth vector, and of how many both counts agreed.
type Met = (std::cell::Cell<usize>, std::cell::Cell<usize>);

fn counts_fit(drawn: &Drawn, met: &Met) -> Outcome {
    let at = drawn.point(&Exact::ratio(0, 1));
    let mechanism = of(&drawn.text(&drawn.order()), drawn.betas.len());
    let Some(found) = drawn.found(&drawn.order(), &at) else { return Ok(()) };
    met.0.set(met.0.get() + 1);
    let (n, growth) = (mechanism.coordinates.len(), &found.growth);
    prop_assert_eq!(growth.rank + growth.dimensions[0], n);
    prop_assert_eq!(growth.rank, mechanism.rank(&at).unwrap());
    prop_assert!(growth.dimensions.windows(2).all(|w| w[0] <= w[1]), "{:?}", growth);
    prop_assert!(growth.dimensions.len() == growth.degree_of_nonholonomy);
    prop_assert_eq!(found.holonomic + found.nonholonomic, growth.rank);
    prop_assert!(found.integrals.len() <= found.holonomic, "{:?}", found);
    // What a body drags behind may have integrals that are none of those looked for: of a trailer of a body that can
    // only roll straight, tan(β/2)·exp(s/d). Then one count is short, and says so.
    let drags = !drawn.betas.is_empty() || drawn.wheels.iter().any(|w| matches!(w.mount, Mount::Castor(_)));
    let agree = found.counts_agree();
    prop_assert!(agree || drags, "{} {:?}", drawn.text(&drawn.order()), found);
    prop_assert_eq!(growth.is_final, agree || growth.dimensions[0] < 2);
    met.1.set(met.1.get() + usize::from(agree));
    Ok(())
}

#[test]
fn the_counts_of_generated_vehicles_fit_together() {
    let met = Met::default();
    check(150, vehicles(), |drawn| counts_fit(&drawn, &met));
    let (met, agreed) = (met.0.get(), met.1.get());
    assert!(met > 130 && agreed > 100, "{met} {agreed}");
}

#[test]
fn nothing_depends_on_the_order_of_wheels() {
    check(60, vehicles(), |drawn| {
        let at = drawn.point(&Exact::ratio(0, 1));
        let mut order = drawn.order();
        let before = drawn.found(&order, &at).map(|f| summary(&f));
        order.reverse();
        prop_assert_eq!(before, drawn.found(&order, &at).map(|f| summary(&f)));
        Ok(())
    });
}

#[test]
fn nothing_depends_on_where_the_vehicle_stands() {
    check(60, (vehicles(), angles(), -9i64..9, -9i64..9), |(drawn, turned, x, y)| {
        let here = drawn.found(&drawn.order(), &drawn.point(&Exact::ratio(0, 1))).map(|f| summary(&f));
        let there = drawn.point(&turned).with("x", Exact::ratio(x, 2)).with("y", Exact::ratio(y, 3));
        prop_assert_eq!(here, drawn.found(&drawn.order(), &there).map(|f| summary(&f)));
        Ok(())
    });
}

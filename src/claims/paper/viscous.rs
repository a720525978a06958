//! Sections 2 and 3 with forces: disk and sleigh under viscous friction, and their ideal motions.

use crate::claims::with_forces::{ideal, lettered, machine_of, residuals, vanishing, viscous};
use crate::claims::{Claim, DerivedFormulas, Sampling, Statement, Status, proving};
use crate::dynamics::{Dynamics, Formulas};
use crate::error::{Error, Result};
use crate::formula::{Expr, Normal, Symbol};

pub(crate) const CHAPTER: &str = "10-viscous";
const CODE: &[&str] = &["src/dynamics/derive.rs", "src/model/forces/bodies.rs", "src/model/forces/contact.rs"];

pub(crate) fn claims() -> Vec<Claim> {
    vec![disk(), disk_ideal(), sleigh(), caplygin(), slow_creep(), constant_creep()]
}

fn base(id: &str, says: &str) -> Claim {
    Claim::new(id, Status::Proved, says)
        .chapter(CHAPTER)
        .code(CODE)
        .tests(&["tests/dynamics/sleigh.rs", "tests/dynamics/derived.rs"])
}

const DISK: [(&str, &str); 6] = [
    ("body.mass", "m"),
    ("theta.inertia", "J"),
    ("contact_1.coefficient", "b"),
    ("contact_1.force", "f"),
    ("force", "F"),
    ("wheel_torque", "tau"),
];

/// Accelerations of the disk: its coordinates do not feel each other's inertia.
fn disk_accelerations(dynamics: &Dynamics) -> Result<[Expr; 2]> {
    let f = dynamics.formulas()?;
    if f.mass.len() != 2 || !f.mass[0][1].is_zero() || !f.mass[1][0].is_zero() {
        return Err(Error::run("the disk is not what it was"));
    }
    let zero = |r: &Expr, q: &Symbol| {
        let still = r.substitute(&|s| (*s == q.rate().rate()).then(|| Expr::int(0)));
        &-&still / &r.derivative(&q.rate().rate())
    };
    let residuals = residuals(&f);
    Ok([0, 1].map(|i| lettered(&zero(&residuals[i], &f.coordinates[i]), &DISK)))
}

/// v, ω, v_A = v − r·ω and their rates under friction.
pub(super) fn disk_machine() -> Result<DerivedFormulas> {
    let [v, w] = disk_accelerations(&viscous("disk", 0, &["force", "wheel_torque"])?)?;
    let letters = |e: Expr| lettered(&e, &[("s'", "v"), ("theta'", "omega")]);
    let derived = DerivedFormulas::default().with("v'", letters(v)).with("omega'", letters(w));
    // v and v_A are the free symbols.
    Ok(derived.with_text("omega", "(v - v_A)/r").with_text("v_A'", "v' - r*omega'"))
}

fn disk() -> Claim {
    let derived = machine_of(disk_machine);
    let solution = derived.clone().with_text("decay'", "-lambda*decay");
    let defects = ["v_A_by_decay*decay' - rest", "at_start"].map(|t| Expr::parse(t).unwrap_or_default());
    base("viscous-disk", "under constant force and torque the disk's slip is v_A = v_A*·(1 − exp(−λt)) with λ = b·(1/m + r²/J) and v_A* = (F/m − r·τ/J)/λ")
        .at("section 2, (11)–(12); corrected theorem (e)")
        .about(&[11, 12])
        .under("constant F and τ, from rest without slip")
        .proof(
            "the slip by itself obeys a linear equation",
            &[("v_A'", "F/m - r*tau/J - b*(1/m + r^2/J)*v_A")],
            proving(derived),
        )
        .proof(
            "the solution, with decay = exp(−λt)",
            &[
                ("lambda", "b*(1/m + r^2/J)"),
                ("v_A", "(F/m - r*tau/J)/lambda*(1 - decay)"),
            ],
            move |s: &Statement, sampling: &Sampling| {
                let Some(said) = s.said_of("v_A") else { return crate::claims::Outcome::failure("no slip is said") };
                let starts = said.substitute(&|n: &Symbol| (n.as_str() == "decay").then(|| Expr::int(1)));
                let with = solution
                    .clone()
                    .with("v_A_by_decay", said.derivative(&"decay".into()))
                    .with_text("rest", "v_A'")
                    .with("at_start", starts);
                vanishing(with, defects.to_vec())(s, sampling)
            },
        )
}

fn disk_ideal() -> Claim {
    let derived = machine_of(|| {
        let [v, w] = disk_accelerations(&ideal("disk", 0, &["force", "wheel_torque"])?)?;
        let rolls = Expr::parse("v' - r*omega'")?;
        let slip = rolls.substitute(&|s: &Symbol| match s.as_str() {
            "v'" => Some(v.clone()),
            "omega'" => Some(w.clone()),
            _ => None,
        });
        // Linear in f: what f is must not speak of f.
        let no_force = |e: &Expr| e.substitute(&|s: &Symbol| (s.as_str() == "f").then(|| Expr::int(0)));
        let force = &-&no_force(&slip) / &no_force(&slip.derivative(&"f".into()));
        Ok(disk_machine()?.with("f", force).with("v_i'", v))
    });
    base("viscous-disk-limit", "the ideal disk has v' = (F + τ/r)/(m + J/r²), and the viscous one is ahead of it by J/(m·r² + J)·v_A, for all time at most J/(m·r² + J)·G/λ with λ = b·(1/m + r²/J) and G ≥ |F/m − r·τ/J|")
        .at("section 2, (3), (11); introduction, reference [6]; corrected theorem (e)")
        .about(&[3, 11])
        .under("both from rest; F and τ may depend on time, and are bounded")
        .remark("v_A starts at 0, inside of ±G/λ, and cannot cross an end at which it moves inwards or stands; λ grows as b. With m = 1, r = 0.5, J = 1, F = 0, τ = 0.3 the largest gap within 3 s is 0.096/b.")
        .proof("the multiplier solved for", &[("v_i'", "(F + tau/r)/(m + J/r^2)")], proving(derived.clone()))
        .proof(
            "the rate of the gap, and what drives it",
            &[("v' - v_i'", "J/(m*r^2 + J)*v_A'"), ("v_A' + b*(1/m + r^2/J)*v_A", "F/m - r*tau/J")],
            proving(derived.clone()),
        )
        .proof(
            "at v_A = +G/λ, with any G = F/m − r·τ/J + s²: the slip moves inwards or stands",
            &[("v_A'", "-s^2")],
            proving(derived.clone().with_text("v_A", "(F/m - r*tau/J + s^2)/(b*(1/m + r^2/J))")),
        )
        .proof(
            "at v_A = −G/λ, with any G = −(F/m − r·τ/J) + s²",
            &[("v_A'", "s^2")],
            proving(derived.with_text("v_A", "(F/m - r*tau/J - s^2)/(b*(1/m + r^2/J))")),
        )
}

const SLEIGH: [(&str, &str); 5] = [
    ("body.mass", "m"),
    ("body.inertia", "I"),
    ("body.mass_offset", "a"),
    ("contact_1.coefficient", "b"),
    ("contact_1.force", "f"),
];

/// The residuals of the sleigh with its velocity u forward, w to the left and its yaw rate.
fn sleigh_residuals(f: &Formulas) -> (DerivedFormulas, Vec<Expr>) {
    let motion = [
        ("x'", "u*cos(phi) - w*sin(phi)"),
        ("y'", "u*sin(phi) + w*cos(phi)"),
        ("phi'", "omega"),
        ("x''", "(u' - w*omega)*cos(phi) - (w' + u*omega)*sin(phi)"),
        ("y''", "(u' - w*omega)*sin(phi) + (w' + u*omega)*cos(phi)"),
        ("phi''", "omega'"),
    ];
    let derived = motion.iter().fold(DerivedFormulas::default(), |m, (name, formula)| m.with_text(name, formula));
    (derived, residuals(f).iter().map(|r| lettered(r, &SLEIGH)).collect())
}

/// The check that accelerations u′, w′, ω′ solve the derived equations.
fn solves(dynamics: Result<Dynamics>) -> impl Fn(&Statement, &Sampling) -> crate::claims::Outcome + Send + Sync {
    let built = dynamics.and_then(|d| d.formulas()).map(|f| sleigh_residuals(&f));
    let (derived, zero) = built.unwrap_or_else(|_| (DerivedFormulas::default(), vec![Expr::int(1)]));
    vanishing(derived, zero)
}

const SLEIGH_MOTION: [(&str, &str); 3] =
    [("u'", "omega*(w + a*omega)"), ("w'", "-b*(1/m + a^2/I)*w - omega*u"), ("omega'", "a*b*w/I")];

fn sleigh() -> Claim {
    base("viscous-sleigh", "the sleigh with friction moves by u' = ω(w + aω), w' = −b(1/m + a²/I)w − ωu, ω' = a·b·w/I")
        .at("section 3, (18); corrected theorem (e)")
        .about(&[18])
        .under("centre of mass a ahead of the blade, moment I about it; u = v_l and w = v_t of the blade")
        .proof("put into the derived equations", &SLEIGH_MOTION, solves(viscous("sleigh", 0, &[])))
}

fn caplygin() -> Claim {
    // T = tanh τ, W = ω².
    let closed = DerivedFormulas::default().with_text("E", "m*C^2/2");
    let zero = ["u_by_T*T' - a*W", "W_by_T*T' + 2*m*a*u*W/(I + m*a^2)"].map(|t| Expr::parse(t).unwrap_or_default());
    base("caplygin-sleigh", "the ideal sleigh: u' = aω², (I + ma²)ω' = −m·a·u·ω, so u = C·tanh τ, ω = √(2E/(I + ma²))/cosh τ with τ' = a·m·C/(I + ma²)")
        .at("section 3, (14); corrected theorem (e)")
        .about(&[14])
        .under("C = √(2E/m); E the kinetic energy, which stays")
        .tests(&["tests/dynamics/sleigh.rs"])
        .proof(
            "put into the derived equations, with the force that the blade needs",
            &[
                ("u'", "a*omega^2"),
                ("omega'", "-m*a*u*omega/(I + m*a^2)"),
                ("f", "m*(omega*u + a*(-m*a*u*omega/(I + m*a^2)))"),
            ],
            {
                let check = solves(ideal("sleigh", 0, &[]));
                move |s: &Statement, sampling: &Sampling| {
                    let rest = ["w", "w'"].map(|name| (Expr::sym(name), Expr::int(0)));
                    let said = s.equations().iter().map(|e| (e.left.clone(), e.right.clone()));
                    check(&Statement::of(rest.into_iter().chain(said)), sampling)
                }
            },
        )
        .proof(
            "the closed form solves them: T = tanh τ, W = ω²",
            &[("u", "C*T"), ("W", "2*E/(I + m*a^2)*(1 - T^2)"), ("T'", "a*m*C/(I + m*a^2)*(1 - T^2)")],
            move |s: &Statement, sampling: &Sampling| {
                let by = |name: &str| s.said_of(name).map(|e| e.derivative(&"T".into())).unwrap_or_default();
                let with = closed.clone().with("u_by_T", by("u")).with("W_by_T", by("W"));
                vanishing(with, zero.to_vec())(s, sampling)
            },
        )
}

fn slow_creep() -> Claim {
    let derived =
        SLEIGH_MOTION.iter().fold(DerivedFormulas::default(), |m, (name, formula)| m.with_text(name, formula));
    let derived = derived.with_text("w", "e_tc*u").with_text("force_balance", "w'/u");
    let zero = Expr::parse("force_balance").unwrap_or_default();
    base("creep-coefficient-emerges", "the side force of the sleigh balances, w' = 0, at the creep e_tc = −m·I/((I + m·a²)·b)·φ̇, with the mass centre on the axle −(m/b)·φ̇")
        .at("section 3, (18)–(19); corrected theorem (e)")
        .about(&[18, 19])
        .under("u ≠ 0; that a sleigh gets there within a time of order 1/b is measured: `creep-coefficient-measured`")
        .remark("A left turn creeps to the right. The coefficient is no constant: it is proportional to the yaw rate.")
        .proof("w' = 0 in the equations of the sleigh", &[("e_tc", "-m*I/((I + m*a^2)*b)*omega")], vanishing(derived, vec![zero]))
}

fn constant_creep() -> Claim {
    let on_axle =
        |text: &str| Expr::parse(text).unwrap_or_default().substitute(&|s| (s.as_str() == "a").then(|| Expr::int(0)));
    let derived =
        SLEIGH_MOTION.iter().fold(DerivedFormulas::default(), |m, (name, formula)| m.with(name, on_axle(formula)));
    // e = w/u; what is left of its rate with w = e·u is a quadratic in e.
    let derived = derived.with_text("w", "e*u").with_text("e'", "(w'*u - w*u')/u^2");
    let rate = derived.written_out("e'");
    let at = |value: i64| rate.substitute(&|s| (s.as_str() == "e").then(|| Expr::int(value)));
    let half = |e: &Expr| e / &Expr::int(2);
    let (zero, plus, minus) = (at(0), at(1), at(-1));
    let square = half(&(&(&plus + &minus) - &(&zero + &zero)));
    let linear = half(&(&plus - &minus));
    let discriminant = &linear.pow(2) - &(&Expr::int(4) * &(&square * &zero));
    let derived = derived.with("discriminant", discriminant).with_text("e_star'", "e'");
    // z = 1/e and its rate; at z = 0 the creep is infinite and the sleigh stops along its blade.
    let inverse = derived.clone().with_text("e", "1/z").with_text("z'", "-e'*z^2");
    // Written as one quotient its rate has no e left, and z may be zero in it.
    let rate = Normal::of(&inverse.written_out("z'"));
    let at_zero = |e: Expr| e.substitute(&|s| (s.as_str() == "z").then(|| Expr::int(0)));
    let inverse = inverse.with("z_at_zero'", &at_zero(rate.numerator()) / &at_zero(rate.denominator()));
    // b for which e stays, and the distance between its two places.
    let staying = derived.clone().with_text("b", "-m*omega*(1 + e^2)/e").with_text("root", "-omega*(1 - e^2)/e");
    base("constant-creep", "with the mass centre on the axle e' = −ω − βe − ωe², β = b/m: constant creep e* = (−β + √(β² − 4ω²))/(2ω) exists only for b ≥ 2m|ω|, and |e*| ≤ 1")
        .at("section 3, (17)–(19); corrected theorem (e)")
        .about(&[17, 18, 19])
        .under("a = 0, so that ω is constant; u ≠ 0")
        .remark("Below 2m|ω| the creep passes through infinity: the sleigh stops along its blade and turns back. At ω = 1, m = 1: e_tc = −0.02 for b = 50.02, −0.2 for b = 5.2.")
        .proof("the rate of the creep, and when it can be zero", &[("e'", "-omega - b/m*e - omega*e^2"), ("discriminant", "(b/m)^2 - 4*omega^2")], proving(derived))
        .proof(
            "the friction that keeps a creep: at |e| = 1 it is 2m|ω|, everywhere else more",
            &[("e'", "0"), ("(b/m)^2 - 4*omega^2", "omega^2*(1 - e^2)^2/e^2"), ("b", "-m*omega*(1 + e^2)/e")],
            proving(staying.clone()),
        )
        .proof(
            "at that friction e is the one with + before the root, which is positive for b > 0 where |e| < 1; the other is 1/e",
            &[
                ("root^2", "(b/m)^2 - 4*omega^2"),
                ("root", "b/m*(1 - e^2)/(1 + e^2)"),
                ("(-b/m + root)/(2*omega)", "e"),
                ("(-b/m - root)/(2*omega)", "1/e"),
            ],
            proving(staying),
        )
        .proof(
            "1/e passes through zero with the rate ω; a whole square and 4ω² − β² > 0 keep it from resting",
            &[("z'", "omega + b/m*z + omega*z^2"), ("4*omega*z'", "(2*omega*z + b/m)^2 + 4*omega^2 - (b/m)^2"), ("z_at_zero'", "omega")],
            proving(inverse),
        )
}

//! Theory, Jacobians at work: the compiled derivatives that fits run on against dual numbers, over vehicles and effects.

use crate::claims::{Claim, Fault, Statement, Status, Verdict, near, value_said};
use crate::effects::{self, Applied, Effect};
use crate::formula::{Dual, Symbol};
use crate::model::Model;
use crate::vehicles;
use num_dual::Dual64;
use proptest::prelude::*;
use std::sync::LazyLock;

pub(crate) fn claims() -> Vec<Claim> {
    vec![compiled()]
}

fn compiled() -> Claim {
    Claim::new(
        "jacobian-compiled",
        Status::Sampled,
        "the rates of the states and their derivatives by states, inputs and parameters, as they are compiled for fits, are \
         those of dual numbers pushed through the rates",
    )
    .at("theory, Jacobians of types R and T")
    .about(&[13, 21])
    .under("every vehicle of the catalogue that moves, with each effect that applies to it, at any state, away from kinks")
    .remark(
        "The dual numbers run through the program of the rates alone, which no rule of differentiation has touched; the \
         compiled derivatives come from rules on the graph of formulas.",
    )
    .chapter("03b-singularity-free")
    .code(&["src/model/compilation.rs", "src/formula/graph.rs", "src/formula/dual.rs"])
    .tests(&["tests/formula/derivatives.rs"])
    .sample(
        "vehicles of the catalogue, each with an effect",
        &[("compiled.rate", "dual.rate"), ("compiled.slope", "dual.slope")],
        |s, sampling| sampling.cases(drawn(), shown, |of| agree(s, of)),
    )
}

/// A vehicle with an effect, at a state.
type Drawn = (usize, Vec<f64>);

/// Vehicles with each effect that applies, which is free.
static MODELS: LazyLock<Vec<Model>> = LazyLock::new(|| {
    // A vehicle whose constraints leave no motion has no rates.
    let samples = vehicles::all().iter().filter_map(|v| Model::sample(v).ok().filter(|m| m.equations(&[]).is_ok()));
    samples.flat_map(|model| with_effects(&model)).collect()
});

fn with_effects(model: &Model) -> Vec<Model> {
    let library: Vec<Effect> = effects::all().iter().flat_map(|e| model.on_each_input(e)).collect();
    let one = |(e, trailer): (&Effect, Option<usize>)| {
        let usual = e.parameters.values().map(|p| p.size.clamp(p.range[0], p.range[1])).collect();
        model.clone().with_effect(Applied::new(e, trailer, usual).freed())
    };
    model.applicable(&library).into_iter().map(one).collect()
}

/// More numbers than any model has states, inputs and parameters.
const NUMBERS: usize = 24;

fn drawn() -> impl Strategy<Value = Drawn> {
    (0..MODELS.len().max(1), prop::collection::vec(0.2..1.2_f64, NUMBERS))
}

fn shown((which, values): &Drawn) -> Vec<(String, String)> {
    let Some(model) = MODELS.get(*which) else { return vec![] };
    let effects: Vec<String> = model.free_effects().map(Applied::label).collect();
    let values: Vec<String> = values.iter().map(|v| format!("{v:?}")).collect();
    [("vehicle", model.vehicle.id.clone()), ("effect", effects.join(", ")), ("values", values.join(" "))]
        .map(|(name, value)| (name.to_string(), value))
        .to_vec()
}

fn agree(s: &Statement, (which, values): &Drawn) -> Verdict {
    let undefined = |why: &str| Fault::Undefined(why.into());
    let model = MODELS.get(*which).ok_or_else(|| undefined("the catalogue is empty"))?;
    let free: Vec<Symbol> = model.free_parameters();
    let failed = |e: crate::Error| Fault::Undefined(e.to_string());
    let equations = model.equations(&free).map_err(failed)?;
    let (program, constants) = model.rates_of_any_carrier(&free).map_err(failed)?;
    let (n, inputs) = (equations.n(), equations.inputs.len());
    let p = model.free_values();
    let moving = values.get(..n + inputs).ok_or_else(|| undefined("too few numbers are drawn"))?;
    let all: Vec<f64> = moving.iter().chain(&p).chain(&constants).copied().collect();
    let width = n + inputs + p.len();
    let mut workspace = equations.workspace(&p);
    let compiled = equations.rates_and_jacobian(&mut workspace, &moving[..n], &moving[n..]).to_vec();
    for j in 0..width {
        let seeded = |(k, v): (usize, &f64)| Dual(Dual64::new(*v, if k == j { 1.0 } else { 0.0 }));
        let duals: Vec<Dual<Dual64>> = program.run_in(&all.iter().enumerate().map(seeded).collect::<Vec<_>>());
        for (i, Dual(dual)) in duals.iter().enumerate().take(n) {
            let at = |name: &str| {
                [("dual.rate", dual.re), ("dual.slope", dual.eps)].iter().find(|d| d.0 == name).map(|d| d.1)
            };
            near("compiled.rate", compiled[i], value_said(s, "compiled.rate", &at)?, 1e-11)?;
            near("compiled.slope", compiled[n + i * width + j], value_said(s, "compiled.slope", &at)?, 1e-9)?;
        }
    }
    Ok(())
}

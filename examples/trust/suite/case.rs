//! A case: everything about one hidden run, drawn from one number.

use super::drive::Drive;
use super::logging;
use super::make::{MAKES, Make, PAIRINGS, TARGETS, Target, WITHOUT_STATE};
use super::power::{Power, powers};
use super::secret;
use crate::simulator::{Hidden, Scenario};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What a case asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Whether nothing is named where nothing is hidden.
    Nothing,
    /// Whether one hidden effect is named.
    Single,
    /// Whether two at once are named.
    Pair,
    /// How long it takes: 60 s at 50 Hz.
    Timed,
    /// Whether one effect that begins, or holds for a time, is named with its time.
    InPart,
    /// Whether nothing is named where nothing is hidden and the inputs come in steps or with noise.
    Coarse,
}

impl Kind {
    /// All kinds; the place of one is the digit that stands for it in a seed.
    pub const ALL: [Kind; 6] = [Kind::Nothing, Kind::Single, Kind::Pair, Kind::Timed, Kind::InPart, Kind::Coarse];

    /// The name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Nothing => "nothing",
            Kind::Single => "single",
            Kind::Pair => "pair",
            Kind::Timed => "timed",
            Kind::InPart => "in part",
            Kind::Coarse => "coarse",
        }
    }
}

/// The most cases of a kind in one suite: seeds of kinds lie so far apart.
const MAX_CASES: u64 = 100_000;
/// How often a case is drawn anew when its data cannot tell what it hides.
const ATTEMPTS: u64 = 3;

/// The seed of the `index`-th case of a kind in a suite.
pub fn seed(suite: u64, kind: Kind, index: u64) -> u64 {
    (suite * 10 + kind as u64) * MAX_CASES + index % MAX_CASES
}

/// One hidden run.
#[derive(Clone, Debug)]
pub struct Case {
    /// The number it is drawn from.
    pub seed: u64,
    /// What it asks.
    pub kind: Kind,
    /// The vehicle.
    pub make: Make,
    /// How it is driven.
    pub drive: Drive,
    /// The run; what is hidden stands there.
    pub scenario: Scenario,
    /// Whether the model file tells the noise.
    pub tells_noise: bool,
    /// For each hidden effect, how well the data show it.
    pub powers: Vec<Power>,
    /// Whether an input was rounded to one value in all rows: what that is off by is a constant that is hidden, though not by
    /// an effect of the library.
    pub hides_rounding: bool,
}

impl Case {
    /// What the case of a seed is about, before anything is drawn: the make and the effects it hides.
    pub fn topic(seed: u64) -> (Kind, usize, Vec<Target>) {
        let kind = Kind::ALL[(seed / MAX_CASES % 10) as usize % Kind::ALL.len()];
        let index = (seed % MAX_CASES) as usize;
        // The step is prime to the number of pairings: every one has its turn before any has a second.
        let (make, target) = PAIRINGS[index * 89 % PAIRINGS.len()];
        match kind {
            Kind::Nothing | Kind::Coarse => (kind, index % MAKES.len(), vec![]),
            Kind::Timed if index.is_multiple_of(3) => (kind, index / 3 % MAKES.len(), vec![]),
            Kind::Single | Kind::Timed => (kind, make, vec![target]),
            Kind::InPart => {
                let some = &*WITHOUT_STATE;
                let (make, target) = some[index * 89 % some.len()];
                (kind, make, vec![target])
            }
            Kind::Pair => {
                let targets = &TARGETS[make];
                let mut random = stream(seed, 1);
                let free: Vec<Target> = targets.iter().copied().filter(|t| differ(*t, target)).collect();
                (kind, make, vec![target, free[random.random_range(0..free.len())]])
            }
        }
    }

    /// The case of a seed. Where something is hidden it is drawn up to three times until the data can tell it.
    pub fn drawn(seed: u64) -> Self {
        let mut case = Self::attempt(seed, 0);
        for attempt in 1..ATTEMPTS {
            if case.determined() {
                break;
            }
            case = Self::attempt(seed, attempt);
        }
        case
    }

    /// The case as it is drawn first, without what its data can tell.
    pub fn sketched(seed: u64) -> Self {
        Self::sketch(seed, 0).0
    }

    fn attempt(seed: u64, attempt: u64) -> Self {
        let (mut case, targets) = Self::sketch(seed, attempt);
        if !case.scenario.hidden.is_empty() {
            case.powers = powers(&case.scenario, targets);
        }
        case.hides_rounding = has_steps(&case) && has_one_value(&case.scenario);
        case
    }

    /// A case whose powers are not known, and what its vehicle might hide.
    fn sketch(seed: u64, attempt: u64) -> (Self, &'static [Target]) {
        let (kind, index, targets) = Self::topic(seed);
        let make = MAKES[index];
        let mut random = stream(seed, 100 + attempt);
        let (vehicle, parameters) = make.drawn(&mut random);
        // After a first failure the vehicle is driven so that it tells more.
        let drive = if attempt == 0 { Drive::drawn(&mut random) } else { Drive::rich(&mut random) };
        let hidden: Vec<Hidden> = targets.iter().map(|t| secret::drawn(*t, make.tractor, &mut random)).collect();
        let mut scenario = Scenario {
            parameters,
            hidden,
            profile: drive.profile(make.tractor, make.trailers > 0, &mut random),
            logs_speed: make.by_speed,
            logs_heading: make.heading,
            lead_in: 6.0,
            ..Scenario::new(vehicle, seed)
        };
        logging::draw(&mut scenario, kind == Kind::Timed, &mut random);
        let tells_noise = random.random_bool(0.2);
        match kind {
            Kind::Coarse => logging::draw_inputs(&mut scenario, &make, &mut random),
            Kind::InPart => {
                scenario.duration = scenario.duration.max(logging::LONG);
                scenario.span = Some(logging::span(&scenario, &mut random));
            }
            _ => {}
        }
        let case = Case { seed, kind, make, drive, scenario, tells_noise, powers: vec![], hides_rounding: false };
        (case, &TARGETS[index])
    }

    /// Whether the data show all that is hidden and tell it from everything else of the library.
    pub fn determined(&self) -> bool {
        self.powers.iter().all(Power::determined) && !self.hides_rounding
    }

    /// The model file of its user.
    pub fn model_toml(&self) -> String {
        let mut text = self.scenario.model_toml();
        if self.tells_noise {
            let noise = self.scenario.noise;
            text +=
                &format!("\n[noise]\nposition = {:?}   # m\nheading = {:?}   # rad\n", noise.position, noise.heading);
        }
        text
    }
}

/// Whether an input of a case comes in steps.
fn has_steps(case: &Case) -> bool {
    case.kind == Kind::Coarse && case.scenario.inputs.step > 0.0
}

/// Whether an input has one value in all rows of a log.
fn has_one_value(scenario: &Scenario) -> bool {
    let log = scenario.run();
    // The inputs are the last columns.
    let first = log.columns.len() - 2;
    (first..first + 2).any(|k| log.rows.windows(2).all(|w| w[0][k] == w[1][k]))
}

/// Whether two effects can be hidden at once and are not two names of one place.
fn differ(a: Target, b: Target) -> bool {
    use super::class::{contains, same};
    !same(a, b) && !contains(a.0, b.0) && !contains(b.0, a.0)
}

/// Independent random numbers for each purpose.
fn stream(seed: u64, purpose: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(purpose);
    random
}

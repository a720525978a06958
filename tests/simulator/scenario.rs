//! A scenario: a vehicle, what it hides, how it is driven and how it is logged.

use super::body::{Body, HEADING, TRAILERS};
use super::contact::Facing;
use super::gauss::advance;
use super::hidden::Hidden;
use super::input_log::{InputLog, InputLogger};
use super::lately::Lately;
use super::laws::Laws;
use super::log::{Log, Truth};
use super::profile::Profile;
use super::sensor::{Mounting, Noise, Outliers, disturb, wrapped};
use super::trailer::Trailer;
use super::vehicle::{Channel, Parameters, Vehicle, channels};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

/// What a row of the log holds in its input columns.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Timing {
    /// The value at the row's time.
    Sample,
    /// The mean since the row before, as encoder counts do.
    IntervalMean,
}

/// Everything that defines a run; start from [`Scenario::new`] and change what matters.
#[derive(Debug, Clone, PartialEq)]
pub struct Scenario {
    /// The vehicle.
    pub vehicle: Vehicle,
    /// The dimensions its user believes in.
    pub parameters: Parameters,
    /// What it really does beyond the ideal.
    pub hidden: Vec<Hidden>,
    /// When what is hidden holds, [from, to) in s; always where there is none. For laws without a state of their own.
    pub span: Option<[f64; 2]>,
    /// Speed and turn over time.
    pub profile: Profile,
    /// Whether inputs are samples or means.
    pub timing: Timing,
    /// Whether a unicycle logs `speed` (m/s) instead of `wheel_rate` (rad/s).
    pub logs_speed: bool,
    /// Whether there is a heading column; a GPS has none.
    pub logs_heading: bool,
    /// Length of the run, s.
    pub duration: f64,
    /// Rows per second, Hz.
    pub rate: f64,
    /// Pose of the reference point at t = 0: x, y (m), heading (rad).
    pub start: [f64; 3],
    /// Where the sensor sits, known to the user.
    pub mounting: Mounting,
    /// Scatter of the measured pose.
    pub noise: Noise,
    /// Gross errors of the measured position.
    pub outliers: Outliers,
    /// Steps and noise of the inputs.
    pub inputs: InputLog,
    /// Spans [from, to) in s without rows.
    pub gaps: Vec<(f64, f64)>,
    /// Share of single rows lost, 0 to 1.
    pub dropouts: f64,
    /// Width of the uniform scatter of row times, as a share of the row interval, 0 to below 1.
    pub jitter: f64,
    /// Whether measured headings are wrapped to (−π, π].
    pub wrap_heading: bool,
    /// How long before t = 0 the drive began, s; slips settle and trailers swing in meanwhile.
    pub lead_in: f64,
    /// The longest integration step, s: what a driver does takes seconds.
    pub step: f64,
    /// Articulation of each trailer when the drive began: heading ahead minus its own, rad.
    pub articulation: Vec<f64>,
    /// Of jitter, lost rows and noise; the profile is already drawn.
    pub seed: u64,
}

impl Scenario {
    /// An ideal vehicle on a random smooth drive of 60 s at 25 Hz, exact sensors, drawn from `seed`.
    pub fn new(vehicle: impl Into<Vehicle>, seed: u64) -> Self {
        let vehicle = vehicle.into();
        let mut random = stream(seed, 0);
        let profile = Profile::random(&vehicle, &mut random);
        let start = std::array::from_fn(|_| random.random_range(-3.0..3.0));
        Scenario {
            parameters: Parameters::usual(vehicle.tractor()),
            hidden: vec![],
            span: None,
            profile,
            timing: Timing::Sample,
            logs_speed: false,
            logs_heading: true,
            duration: 60.0,
            rate: 25.0,
            start,
            mounting: Mounting::default(),
            noise: Noise::default(),
            outliers: Outliers::default(),
            inputs: InputLog::default(),
            gaps: vec![],
            dropouts: 0.0,
            jitter: 0.0,
            wrap_heading: false,
            lead_in: 20.0,
            step: 0.02,
            articulation: vec![0.0; vehicle.trailers()],
            vehicle,
            seed,
        }
    }

    /// The same drive logged as logs come: rows lost and shifted, an interruption, wrapped headings, gross errors, means of
    /// intervals.
    pub fn roughly_logged(self) -> Self {
        Scenario {
            timing: Timing::IntervalMean,
            outliers: Outliers { share: 0.02, size: 0.5 },
            gaps: vec![(12.0, 14.5)],
            dropouts: 0.05,
            jitter: 0.3,
            wrap_heading: true,
            ..self
        }
    }

    /// Drives and logs.
    pub fn run(&self) -> Log {
        let body = self.body(&self.hidden);
        let times = self.times();
        let truth = self.drive(&body, &times);
        let channels = self.channels();
        let mut random = stream(self.seed, 2);
        let mut of_inputs = stream(self.seed, 3);
        let mut logger = InputLogger::new(&channels, self.inputs, &mut of_inputs);
        let mut before = -1.0 / self.rate;
        let mut rows = Vec::with_capacity(truth.len());
        for truth in &truth {
            let mut row = self.measured(&body, truth, &mut random);
            row.extend(logger.row([before, truth.t], self.timing == Timing::IntervalMean, &mut of_inputs));
            before = truth.t;
            rows.push(row);
        }
        Log { columns: self.columns(), rows, truth }
    }

    /// The vehicle with its true dimensions and some laws.
    fn body(&self, hidden: &[Hidden]) -> Body {
        let laws = Laws::new(hidden, self.vehicle.trailers());
        let trailers = match &self.vehicle {
            Vehicle::Alone(_) => vec![],
            Vehicle::NTrailer { lengths, hitch_offsets, .. } => (0..lengths.len())
                .map(|i| {
                    let (e_tc, factor, longer) = laws.trailers[i];
                    Trailer {
                        length: lengths[i] * factor,
                        hitch_offset: hitch_offsets.get(i).unwrap_or(&0.0) + longer,
                        e_tc,
                    }
                })
                .collect(),
        };
        Body {
            tractor: self.vehicle.tractor(),
            nominal: self.parameters,
            laws,
            trailers,
            profile: self.profile.clone(),
            asked: Lately::default(),
            speeding: Lately::default(),
        }
    }

    /// The times of the rows that reach the log, s.
    fn times(&self) -> Vec<f64> {
        let mut random = stream(self.seed, 1);
        let rows = (self.duration * self.rate).round() as usize;
        let mut times = Vec::with_capacity(rows + 1);
        for row in 0..=rows {
            let scatter = self.jitter * (random.random::<f64>() - 0.5);
            let lost = random.random::<f64>() < self.dropouts;
            let t = (row as f64 + if row == 0 { 0.0 } else { scatter }) / self.rate;
            if !lost && !self.gaps.iter().any(|&(from, to)| (from..to).contains(&t)) {
                times.push(t);
            }
        }
        times
    }

    /// The true motion at the given times: a lead-in, a move to the start, then the run.
    fn drive(&self, body: &Body, times: &[f64]) -> Vec<Truth> {
        let plain = self.body(&[]);
        let [from, to] = self.span.unwrap_or([f64::NEG_INFINITY, f64::INFINITY]);
        let acting = |t: f64| if (from..to).contains(&t) { body } else { &plain };
        // From one edge to the next one law holds, and the scheme keeps its order.
        let advanced = |mut state: Vec<f64>, since: f64, until: f64, step: f64| {
            let mut now = since;
            for end in [from, to, until] {
                if end > now && end <= until {
                    let of = acting(0.5 * (now + end));
                    state = advance(&|t, state: &[f64]| of.rates(t, state), state, now, end, step);
                    now = end;
                }
            }
            state
        };
        let mut behind = self.start[2];
        let headings: Vec<f64> = self
            .articulation
            .iter()
            .map(|bend| {
                behind -= bend;
                behind
            })
            .collect();
        let step = body.laws.longest_step(self.step);
        let began = acting(-self.lead_in).at_rest_in(-self.lead_in, self.start, &headings);
        let arrived = advanced(began, -self.lead_in, 0.0, step);
        let mut state = body.moved_to(&arrived, self.start);
        let mut now = 0.0;
        let mut truth = Vec::with_capacity(times.len());
        for &t in times {
            state = advanced(state, now, t, step);
            now = t;
            let pace = acting(t).pace(t, &state);
            truth.push(Truth {
                t,
                x: state[0],
                y: state[1],
                heading: state[HEADING],
                trailers: state[TRAILERS..].to_vec(),
                v_l: pace.v_l,
                v_t: pace.v_t,
                yaw: pace.yaw,
            });
        }
        truth
    }

    /// The time and pose columns of one row.
    fn measured(&self, body: &Body, truth: &Truth, random: &mut ChaCha8Rng) -> Vec<f64> {
        let Facing { forward, side, .. } = Facing::new(truth.heading);
        let (a, b) = body.laws.lever;
        let [known_a, known_b] = self.mounting.lever_arm;
        let arm = forward * (a + known_a) + side * (b + known_b);
        let mut position = [truth.x + arm.x, truth.y + arm.y];
        let offset = body.laws.misalignment + self.mounting.heading_offset;
        let mut headings = vec![truth.heading + offset];
        headings.extend(&truth.trailers);
        disturb(&mut position, &mut headings, self.noise, self.outliers, random);
        if self.wrap_heading {
            headings.iter_mut().for_each(|angle| *angle = wrapped(*angle));
        }
        let shown = &headings[usize::from(!self.logs_heading)..];
        [&[truth.t], &position[..], shown].concat()
    }

    fn channels(&self) -> [Channel; 2] {
        channels(self.vehicle.tractor(), &self.parameters, &self.profile, self.logs_speed)
    }

    /// The columns' names, in the order of the rows.
    fn columns(&self) -> Vec<String> {
        let mut names: Vec<String> = ["t", "x", "y"].map(String::from).to_vec();
        names.extend(self.logs_heading.then(|| "phi".to_string()));
        names.extend(self.trailer_columns());
        names.extend(self.channels().map(|channel| channel.column.to_string()));
        names
    }

    /// The columns of the trailers' headings, `phi_1` nearest the tractor.
    pub fn trailer_columns(&self) -> Vec<String> {
        let numbers = 1..=self.vehicle.trailers();
        numbers.map(|i| format!("phi_{i}")).collect()
    }

    /// Roles and columns of the model file's `[columns]`, trailers left out.
    pub fn roles(&self) -> Vec<(&'static str, &'static str)> {
        let mut roles = vec![("time", "t"), ("x", "x"), ("y", "y")];
        roles.extend(self.logs_heading.then_some(("heading", "phi")));
        roles.extend(self.channels().map(|channel| (channel.role, channel.column)));
        roles
    }
}

/// Independent random numbers for each purpose, so that changing one leaves the others alone.
fn stream(seed: u64, purpose: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(purpose);
    random
}

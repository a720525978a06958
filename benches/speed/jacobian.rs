//! The Jacobian of ten trailers: 12 constraint rows by 14 coordinates and their 14 rates.

use super::vector;
use creepage::formula::{Changes, Expr, Graph, Isa, Lanes, Memory, NodeId, Op, Program, Symbol};
use creepage::mechanism::Mechanism;
use creepage::{model, vehicles};

pub const TRAILERS: usize = 10;
/// Lanes of a block of the library.
pub const LANES: usize = 32;
const R: f64 = 0.5;

/// Rows, coordinates and compiled non-zero entries.
pub struct Compiled {
    pub rows: usize,
    pub coordinates: usize,
    /// Row and column of every entry that is not always zero; columns are coordinates, then rates.
    pub places: Vec<(usize, usize)>,
    pub lanes: Lanes,
    pub memory: Memory<LANES>,
}

pub fn mechanism(trailers: usize) -> Mechanism {
    model::mechanism(vehicles::named("unicycle").unwrap(), trailers)
}

/// A graph with radius, hitches and all lengths but the first; without creep.
pub fn defined(mechanism: &Mechanism, trailers: usize) -> Graph {
    let mut graph = Graph::default();
    for c in &mechanism.constraints {
        let zero = graph.insert(&Expr::int(0));
        graph.define(c.creep.clone(), zero);
    }
    let number = |text: &str| Expr::parse(text).unwrap();
    let radius = graph.insert(&number("0.5"));
    graph.define("r", radius);
    for i in 1..=trailers {
        let (length, hitch) = (graph.insert(&number("1")), graph.insert(&number("0")));
        if i > 1 {
            graph.define(Symbol::new(&format!("d_{i}")), length);
        }
        graph.define(Symbol::new(&format!("c_{i}")), hitch);
    }
    graph
}

pub fn compiled(trailers: usize) -> Compiled {
    let mechanism = mechanism(trailers);
    let q = &mechanism.coordinates;
    let mut graph = defined(&mechanism, trailers);
    let length = graph.insert(&Expr::int(1));
    graph.define("d_1", length);
    let rows: Vec<NodeId> = mechanism.constraints.iter().map(|c| graph.insert(&c.generic())).collect();
    let slots: Vec<Symbol> = q.iter().cloned().chain(q.iter().map(Symbol::rate)).collect();
    let (mut places, mut nodes) = (vec![], vec![]);
    for (column, symbol) in slots.iter().enumerate() {
        for (row, node) in graph.derivatives(&rows, symbol).into_iter().enumerate() {
            if !matches!(graph.op(node), Op::Num(v) if *v == creepage::formula::BigRational::default()) {
                places.push((row, column));
                nodes.push(node);
            }
        }
    }
    let program = Program::compile(&graph, &slots, &nodes).unwrap();
    let lanes = Lanes::new(&program, &vec![Changes::Lane; slots.len()]);
    let mut memory = lanes.memory();
    for (slot, _) in slots.iter().enumerate() {
        *memory.input(slot) = std::array::from_fn(|l| point(slot, l));
    }
    lanes.begin(&mut memory, Isa::best());
    Compiled { rows: rows.len(), coordinates: q.len(), places, lanes, memory }
}

/// A value of a coordinate or rate in a lane.
pub fn point(slot: usize, lane: usize) -> f64 {
    0.1 + 0.07 * slot as f64 + 0.013 * ((lane * 7) % 32) as f64
}

const N: usize = TRAILERS + 1;
const W: usize = vector::WIDTH;
type Lane = [f64; W];

/// Coordinates by hand: headings and their rates, x′ and y′; the Jacobian's entries that are not constant.
pub struct ByHand {
    pub phi: [Lane; N],
    pub rate: [Lane; N],
    pub x: Lane,
    pub y: Lane,
    /// ∂row/∂φ_j and ∂row/∂φ_j′ of row i, for j ≤ i.
    pub by_phi: [[Lane; N]; N],
    pub by_rate: [[Lane; N]; N],
    pub sine: [Lane; N],
    pub cosine: [Lane; N],
    /// ∂(rolling)/∂φ
    pub rolling: Lane,
}

impl ByHand {
    pub fn new(order: &[usize]) -> Self {
        let zero = [0.0; W];
        let at = |slot: usize| std::array::from_fn(|l| point(slot, l));
        let n = TRAILERS + 4;
        Self {
            phi: std::array::from_fn(|i| at(order[i])),
            rate: std::array::from_fn(|i| at(n + order[i])),
            x: at(n),
            y: at(n + 1),
            by_phi: [[zero; N]; N],
            by_rate: [[zero; N]; N],
            sine: [zero; N],
            cosine: [zero; N],
            rolling: zero,
        }
    }

    /// row_i = sin φ_i·X_i − cos φ_i·Y_i with X_i = x′ + Σ sin φ_j·φ_j′, Y_i = y′ − Σ cos φ_j·φ_j′ over trailers j ≤ i.
    #[inline(always)]
    pub fn run(&mut self) {
        let (mut x, mut y) = (self.x, self.y);
        for i in 0..N {
            let (s, c) = vector::sin_cos(&self.phi[i]);
            (self.sine[i], self.cosine[i]) = (s, c);
            if i == 0 {
                for l in 0..W {
                    self.rolling[l] = c[l].mul_add(self.y[l], -s[l] * self.x[l]);
                }
            } else {
                for l in 0..W {
                    x[l] = s[l].mul_add(self.rate[i][l], x[l]);
                    y[l] = (-c[l]).mul_add(self.rate[i][l], y[l]);
                }
            }
            for l in 0..W {
                self.by_phi[i][i][l] = c[l].mul_add(x[l], s[l] * y[l]);
            }
            for j in 1..=i {
                for l in 0..W {
                    let (sj, cj) = (self.sine[j][l], self.cosine[j][l]);
                    let both = s[l].mul_add(sj, c[l] * cj);
                    let cross = s[l].mul_add(cj, -c[l] * sj) * self.rate[j][l];
                    self.by_rate[i][j][l] = both;
                    self.by_phi[i][j][l] = if j == i { self.by_phi[i][i][l] } else { cross };
                }
            }
        }
    }
}

/// The radius of the wheel, for the entries that are constant.
pub const RADIUS: f64 = R;

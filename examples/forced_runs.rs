//! Writes runs of a sleigh and a car driven by forces, their friction hidden, each with the kinematic model of a user who
//! knows nothing of it: `cargo run --release --example forced_runs -- DIR`, then `creepage discover`.

#[path = "../tests/forced/mod.rs"]
mod forced;

use forced::{Body, Forced};
use std::path::PathBuf;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let out = PathBuf::from(std::env::args().nth(1).unwrap_or_else(|| "forced_runs".into()));
    let cases: [(&str, Body, &str, &[f64]); 6] = [
        // m/b = 0.11 s
        ("sleigh-viscous", Body::Sleigh, "viscous", &[181.8]),
        // m/k = 0.1 s²/m
        ("sleigh-rocard", Body::Sleigh, "rocard", &[200.0]),
        ("sleigh-elastic", Body::Sleigh, "elastic", &[200.0, 0.15]),
        ("car-viscous", Body::Car, "viscous", &[1.2e4]),
        ("car-rocard", Body::Car, "rocard", &[6e4]),
        ("car-elastic", Body::Car, "elastic", &[6e4, 0.5]),
    ];
    for (name, body, law, values) in cases {
        let dir = out.join(name);
        std::fs::create_dir_all(&dir)?;
        for seed in 0..2 {
            let run = Forced::new(body, law, values, seed);
            std::fs::write(dir.join(format!("run_{seed}.csv")), run.csv()?)?;
            std::fs::write(dir.join("model.toml"), run.model())?;
        }
    }
    Ok(())
}

//! Writes the corpus that fuzzing begins with, made from the examples and the texts of the tests.

#[allow(dead_code)]
#[path = "../../tests/support/targets.rs"]
mod targets;

fn main() -> std::io::Result<()> {
    for target in targets::TARGETS {
        let dir = format!("{}/corpus/{}", env!("CARGO_MANIFEST_DIR"), target.name);
        std::fs::create_dir_all(&dir)?;
        for (i, seed) in (target.seeds)().iter().enumerate() {
            std::fs::write(format!("{dir}/seed-{i}"), seed)?;
        }
    }
    Ok(())
}

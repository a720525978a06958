#!/usr/bin/env python3
"""Takes one part of the method away at a time and counts what it was worth: writes paper/data/ablations.json.

    python3 paper/ablations.py [--null 100] [--effects 120] [--coarse 60]

Each ablation is a change of a few characters in a clone of this repository, built and put to the benchmark of trust with the same seeds;
a change that is not found as it is written here is an error. It takes about half an hour.
"""

import argparse
import json
import os
import pathlib
import subprocess
import tempfile

here = pathlib.Path(__file__).resolve().parent
VARIANCES = "src/discrepancy/estimation/variance_components.rs"
NOISE = "src/discrepancy/estimation/noise_model.rs"
FOLDS = "src/discrepancy/evidence/cross_validation.rs"
# Name, file, what stands there, what takes its place.
ABLATIONS = [
    ("whole", []),
    ("no-jumps", [
        (NOISE, "variance: starts[jump.scale].variance,", "variance: 1e-9 * starts[jump.scale].variance,"),
        (NOISE, "is_estimated: jump.is_shown_by_path || starts[jump.scale].is_measured,", "is_estimated: false,"),
        (NOISE, "                self.components[k].variance = noise;", "                self.components[k].variance = 1e-9 * noise;"),
    ]),
    ("no-restriction", [(VARIANCES, "let d = deviance(segments, v, &e) + determinant;", "let d = deviance(segments, v, &e) + 0.0 * determinant;")]),
    ("no-cross-validation", [
        (FOLDS, "        let runs = self.records.len();\n        let part = if runs", "        if !fit.deviance.is_nan() {\n            return Ok(true);\n        }\n        let runs = self.records.len();\n        let part = if runs"),
        (FOLDS, "        let part = if self.records.len() >= FEWEST_RUNS { Part::Run } else { Part::Blocks };\n        let [new, old]", "        if !fit.deviance.is_nan() {\n            return Ok(false);\n        }\n        let part = if self.records.len() >= FEWEST_RUNS { Part::Run } else { Part::Blocks };\n        let [new, old]"),
    ]),
    ("no-price", [("src/discrepancy/selection/search.rs", "2.0 * self.size.ln()", "0.0 * self.size.ln()")]),
]

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--null", default=100)
arguments.add_argument("--effects", default=120)
arguments.add_argument("--coarse", default=60)
arguments = arguments.parse_args()

temporary = tempfile.TemporaryDirectory()
clone = pathlib.Path(temporary.name) / "creepage"
subprocess.run(["git", "clone", "--quiet", here.parent, clone], check=True)
environment = os.environ | {"CARGO_TARGET_DIR": str(here.parent / "target" / "ablations")}
made = []
for name, changes in ABLATIONS:
    subprocess.run(["git", "checkout", "--quiet", "."], cwd=clone, check=True)
    for file, old, new in changes:
        text = (clone / file).read_text()
        assert text.count(old) == 1, f"{name}: {file} does not hold {old!r} once"
        (clone / file).write_text(text.replace(old, new))
    out = clone / "trust" / name
    run = ["cargo", "run", "--quiet", "--profile", "work", "--example", "trust", "--", "--null", str(arguments.null), "--effects",
           str(arguments.effects), "--coarse", str(arguments.coarse), "--in-part", "0", "--timed", "0", "--threads", "2", "--out", str(out)]
    subprocess.run(run, cwd=clone, env=environment, check=True)
    counts = json.loads((out / "trust.json").read_text())
    wanted = ("false_alarms", "false_alarms_coarse", "singles", "pairs", "coverage", "rms_z")
    made.append({"ablation": name} | {k: counts[k] for k in wanted})
    print(json.dumps(made[-1]), flush=True)
    (here / "data" / "ablations.json").write_text(json.dumps(made, indent=1) + "\n")

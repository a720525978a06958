#!/usr/bin/env python3
"""Runs the program on public logs of real robots and writes paper/data/real.json: what it names, and how far models are off on runs
that were never fitted, beside a plain least-squares calibration of the same logs.

    python3 paper/real.py --bin target/release/creepage --data FOLDER

FOLDER holds `optiodom` and `dart`, each with its runs and a model.toml; the logs are public (see paper.typ) and not part of the project.
The errors are computed here and not by the program's own count: every HORIZON seconds a model starts from the measured pose, and the
distance of its end from the measured position is squared and averaged.

The calibration by least squares is the usual one: parameters of a robot that minimise the squared distance between measured positions
and one trajectory a run from the run's first pose. It is told which parameters to fit, and chooses none.
"""

import argparse
import csv
import json
import math
import pathlib
import subprocess
import tempfile

ROBOTS = [
    {
        "name": "optiodom", "vehicle": "differential drive, indoors",
        "fit": ["circular_231220200121_run01", "circular_231220200134_run01", "square_231220200029_run01"],
        "calibrated": [("track-width", "scale"), ("rotation-creep", "e_rc"), ("wheel-radius-mismatch", "scale")],
        "horizons": [5.0, 30.0],
    },
    {
        "name": "dart", "vehicle": "1:10 car, four-wheel drive",
        "fit": ["ramp_left_020", "ramp_left_015"],
        "calibrated": [("rotation-creep", "e_rc"), ("yaw-rate-scale", "scale"), ("heading-misalignment", "offset")],
        "horizons": [1.0, 5.0],
    },
]

arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
arguments.add_argument("--bin", required=True)
arguments.add_argument("--data", required=True, type=pathlib.Path)
arguments = arguments.parse_args()
folder_of_trials = tempfile.TemporaryDirectory()
scratch = pathlib.Path(folder_of_trials.name)


def rows_of(path):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return [row for row in rows if all(row[c] not in ("", "nan") for c in ("t", "x", "y", "phi"))]


def simulated(model, rows):
    """Where a model's sensor is at each of some rows, from the measured pose at the first."""
    inputs, out = scratch / "in.csv", scratch / "out.csv"
    with open(inputs, "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    subprocess.run([arguments.bin, "simulate", model, "--inputs", inputs, "--out", out, "--quiet"], check=True)
    with open(out, newline="") as file:
        return [(float(row["x"]), float(row["y"])) for row in csv.DictReader(file)]


def squared_errors(model, rows, horizon):
    """Squared distances at the end of consecutive stretches of a run."""
    squares, first = [], 0
    while True:
        start = float(rows[first]["t"])
        last = next((i for i in range(first, len(rows)) if float(rows[i]["t"]) >= start + horizon), None)
        if last is None:
            return squares
        x, y = simulated(model, rows[first : last + 1])[-1]
        squares.append((x - float(rows[last]["x"])) ** 2 + (y - float(rows[last]["y"])) ** 2)
        first = last


def with_effects(text, effects, name):
    path = scratch / name
    entries = "".join(f'\n[[effects]]\nid = "{e}"\n{p} = {v!r}\n' for (e, p), v in effects)
    path.write_text(text + entries)
    return path


def solved(matrix, right):
    """Gaussian elimination with pivots."""
    n = len(right)
    rows = [list(matrix[i]) + [right[i]] for i in range(n)]
    for c in range(n):
        pivot = max(range(c, n), key=lambda r: abs(rows[r][c]))
        rows[c], rows[pivot] = rows[pivot], rows[c]
        for r in range(c + 1, n):
            factor = rows[r][c] / rows[c][c]
            rows[r] = [a - factor * b for a, b in zip(rows[r], rows[c])]
    for c in reversed(range(n)):
        rows[c][n] = (rows[c][n] - sum(rows[c][k] * rows[k][n] for k in range(c + 1, n))) / rows[c][c]
    return [row[n] for row in rows]


def least_squares(text, names, runs):
    """Gauss and Newton's iteration with differences, one trajectory a run."""
    def residuals(values):
        model = with_effects(text, list(zip(names, values)), "trial.toml")
        found = []
        for rows in runs:
            for (x, y), row in zip(simulated(model, rows), rows):
                found += [x - float(row["x"]), y - float(row["y"])]
        return found

    values, step = [0.0] * len(names), 1e-4
    for _ in range(8):
        here = residuals(values)
        columns = []
        for i in range(len(names)):
            moved = [v + (step if k == i else 0.0) for k, v in enumerate(values)]
            columns.append([(a - b) / step for a, b in zip(residuals(moved), here)])
        gram = [[sum(a * b for a, b in zip(p, q)) for q in columns] for p in columns]
        change = solved(gram, [-sum(a * b for a, b in zip(p, here)) for p in columns])
        values = [v + d for v, d in zip(values, change)]
        if max(abs(d) for d in change) < 1e-7:
            break
    return values


made = []
for robot in ROBOTS:
    folder = arguments.data / robot["name"]
    all_runs = sorted(p for p in folder.glob("*.csv") if not p.stem.startswith("unaligned"))
    fit = [folder / (stem + ".csv") for stem in robot["fit"]]
    held = [p for p in all_runs if p not in fit]
    out = scratch / robot["name"]
    command = [arguments.bin, "discover", *fit, "--model", folder / "model.toml", "--held-out", *held, "--out", out, "--quiet"]
    subprocess.run(command, check=True)
    report = json.loads((out / "report.json").read_text())
    text = (folder / "model.toml").read_text()
    fitted = least_squares(text, robot["calibrated"], [rows_of(p) for p in fit])
    models = {
        "given": folder / "model.toml",
        "calibrated": with_effects(text, list(zip(robot["calibrated"], fitted)), "calibrated.toml"),
        "named": out / "model.patched.toml",
    }
    errors = {}
    for key, model in models.items():
        errors[key] = []
        for horizon in robot["horizons"]:
            squares = [s for p in held for s in squared_errors(model, rows_of(p), horizon)]
            errors[key].append(math.sqrt(sum(squares) / len(squares)))
    floors = {g["horizon_s"]: g["noise_floor"]["position_rms"] for g in report["gap"]}
    effects = [{"id": e["id"], "parameters": e["parameters"]} for e in report["effects"]]
    made.append({
        "robot": robot["name"], "vehicle": robot["vehicle"], "fitted_runs": len(fit), "held_out_runs": len(held),
        "verdict": report["verdict"], "effects": effects, "remains": report["remains"]["ratio"],
        "calibrated": [{"id": e, "parameter": p, "value": v} for (e, p), v in zip(robot["calibrated"], fitted)],
        "horizons_s": robot["horizons"], "errors_m": errors, "floor_m": [floors.get(h) for h in robot["horizons"]],
    })
    print(json.dumps(made[-1], indent=1))
target = pathlib.Path(__file__).resolve().parent / "data" / "real.json"
target.write_text(json.dumps(made, indent=1) + "\n")

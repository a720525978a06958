#!/usr/bin/env python3
"""Other ways to find what a kinematic model lacks, beside `creepage discover`, on runs whose truth is known.

    python3 book/comparison/compare.py --binary target/release/creepage [--data ../shared/data/open] [--out DIR]

Writes `results.md`. Which runs: every folder of examples/runs and every run of the open data with a unicycle or a
differential drive, the two vehicles that all methods can treat here; and three sets of UMBmark's squares. The rule was
written down before the first result was seen, and nothing is left out.
"""
import argparse
import json
import subprocess
from pathlib import Path

import calibration
import network
import sparse
import umbmark
from logs import HORIZON, gap, nominal, read

ROOT = Path(__file__).resolve().parents[2]
# What the truth is in PySINDy's library; None where its functions of the present inputs cannot say it.
TERMS = {
    "rotation-creep": ["ahead:v"], "traverse-creep": ["left:v"], "cornering-creep": ["left:v w"],
    "yaw-rate-bias": ["yaw:1"], "yaw-rate-scale": ["yaw:w"], "lever-arm": ["ahead:w", "left:w"],
    "track-width": ["yaw:w"], "wheel-radius-mismatch": ["ahead:v", "ahead:w", "yaw:v", "yaw:w"],
    "unnamed": ["left:w|w|"], "traction-creep": None, "input-delay": None, "drift": None,
}
ALSO = {"wheel-radius": "rotation-creep", "heading-misalignment": "traverse-creep",
        "unequal-rotation-creep": "wheel-radius-mismatch"}
CALIBRATED = {"rotation-creep", "yaw-rate-bias", "yaw-rate-scale", "track-width", "wheel-radius-mismatch"}


class Run:
    def __init__(self, name, model, fitted, held_out, hidden, parameters):
        self.name, self.model, self.files, self.held_out_files = name, model, fitted, held_out
        logs = [read(f, model) for f in fitted]
        # As `creepage discover` does: the last quarter is held out where no run is.
        self.fitted = logs if held_out else [log.part(0, 0.75) for log in logs]
        self.held_out = [read(f, model) for f in held_out] if held_out else [log.part(0.75, 1) for log in logs]
        self.hidden, self.parameters = hidden, parameters

    def terms(self):
        each = [TERMS[h] for h in self.hidden]
        return None if None in each else {t for terms in each for t in terms}


def bundled():
    for name in ["cornering", "track", "nothing", "pair"]:
        folder = ROOT / "examples/runs" / name
        answer = json.loads((folder / "answer.json").read_text())
        files = sorted(folder.glob("*.csv"))
        held_out = [f for f in files if "held_out" in f.name]
        effects = answer["effects"]
        yield Run(name, folder / "model.toml", [f for f in files if f not in held_out], held_out,
                  [e["id"] for e in effects], [e["parameters"] for e in effects])


def opened(folder):
    for answer in json.loads((folder / "answers.json").read_text()):
        if answer["vehicle"] not in ("unicycle", "differential-drive"):
            continue
        effects = answer["answer"]["effects"]
        names = [e["accept"][0] if e["accept"] else "unnamed" for e in effects]
        run = folder / answer["run"]
        yield Run(answer["run"], Path(f"{run}.toml"), [Path(f"{run}.csv")], [], names, [e["parameters"] for e in effects])


def discovered(run, binary, out):
    held_out = ["--held-out", *run.held_out_files] if run.held_out_files else []
    subprocess.run([binary, "discover", *run.files, *held_out, "--model", run.model, "--out", out / run.name,
                    "--horizon", str(HORIZON), "--quiet"], check=True, capture_output=True)
    return json.loads((out / run.name / "report.json").read_text())


def named(report):
    """What the report names, under the first id of its class."""
    found = {ALSO.get(e["id"], e["id"]) for e in report["effects"]}
    return found | ({"unnamed"} if report["unnamed"] else set())


def score(kept, true):
    """How many of the true terms were kept, and how many others."""
    if true is None:
        return f"– + {len(kept)}"
    return f"{len(true & kept)} of {len(true)} + {len(kept - true)}"


def numbers(parameters):
    return ", ".join(f"{k} = {v:.4g}" if isinstance(v, float) else f"{k} = {v}" for p in parameters for k, v in p.items())


def values(report):
    found = [f"{k} = {p['value']:.4g} ± {p['std'] or 0:.1g}" for e in report["effects"] for k, p in e["parameters"].items()]
    return ", ".join(found + [u["equation"] for u in report["unnamed"]])


def row(run, binary, out):
    report = discovered(run, binary, out)
    users = [sparse.fit(run.fitted, user) for user in (sparse.PREDICTION, sparse.SPARSITY)]
    kept, true = [set(u.terms()) for u in users], run.terms()
    p, std = calibration.fit(run.fitted)
    significant = [f"{n} {v:+.4f} ± {s:.4f}" for n, v, s in zip(calibration.NAMES[calibration.kind(run.fitted[0])], p, std)
                   if abs(v) > 1.96 * s]
    learnt = network.fit(run.fitted)
    held = report["gap"][0]["held_out"]
    name = named(report)
    return {
        "run": run.name, "hidden": " + ".join(run.hidden) or "nothing", "truth": numbers(run.parameters),
        "named": " + ".join(sorted(name)) or "nothing", "values": values(report), "right": name == set(run.hidden),
        "terms": [u.terms() for u in users], "true_terms": None if true is None else sorted(true),
        "sindy": [score(k, true) for k in kept], "sindy_right": [k == true for k in kept],
        "calibrated": significant, "sayable": set(run.hidden) <= CALIBRATED,
        "gap": [1e3 * g for g in (held["position_rms_before"], gap(run.held_out, nominal), held["position_rms_after"],
                *(gap(run.held_out, u.corrected) for u in users), gap(run.held_out, lambda log: calibration.corrected(log, p)), gap(run.held_out, learnt),
                report["gap"][0]["noise_floor"]["position_rms"])],
    }


def middle_and_worst(rows, k):
    ratios = sorted(r["gap"][k] / r["gap"][-1] for r in rows)
    return f"{ratios[len(ratios) // 2]:.2f} ({ratios[-1]:.3g})"


def summary(rows):
    null, said = [r for r in rows if r["hidden"] == "nothing"], [r for r in rows if r["true_terms"]]
    yield "| | `creepage` | PySINDy, for prediction | PySINDy, for sparsity | least squares | network on derivatives |"
    yield "|---|---|---|---|---|---|"
    right = lambda some: [sum(r["right"] for r in some)] + [sum(r["sindy_right"][k] for r in some) for k in (0, 1)]
    cells = lambda numbers: " | ".join(str(n) for n in numbers)
    yield f"| exactly what is hidden, of {len(rows)} runs | {cells(right(rows))} | – | – |"
    yield f"| the same, of the {len(said)} whose law PySINDy's library has | {cells(right(said))} | – | – |"
    names = sum(len(r["named"].split(" + ")) for r in null if r["named"] != "nothing")
    terms = [sum(len(r["terms"][k]) for r in null) for k in (0, 1)]
    yield (f"| named, or terms, or significant parameters in the {len(null)} runs with nothing hidden | {names} | "
           f"{cells(terms)} | {sum(len(r['calibrated']) for r in null)} | – |")
    yield ("| gap over noise floor: median (worst) | "
           + " | ".join(middle_and_worst(rows, k) for k in (2, 3, 4, 5, 6)) + " |")
    yield f"\nThe gap of the uncorrected model over the floor is {middle_and_worst(rows, 0)}."


def returned(rows):
    yield "| run | hidden | `creepage` names | PySINDy, for prediction | for sparsity | least squares, significant |"
    yield "|---|---|---|---|---|---|"
    for r in rows:
        found = f"{r['named']}{'' if r['right'] else ' **(wrong)**'}{': ' + r['values'] if r['values'] else ''}"
        hidden = r["hidden"] + (": " + r["truth"] if r["truth"] else "")
        cells = [r["run"], hidden, found, *r["sindy"], ", ".join(r["calibrated"]) or "none"]
        # A bar would end the cell.
        yield "| " + " | ".join(c.replace("|", "\\|") for c in cells) + " |"


def gaps(rows):
    yield ("| run | before | `creepage` | PySINDy, for prediction | for sparsity | least squares | network on derivatives "
           "| floor |\n"
           "|---|---|---|---|---|---|---|---|")
    for r in rows:
        yield f"| {r['run']} | " + " | ".join(f"{g:.3g}" for k, g in enumerate(r["gap"]) if k != 1) + " |"


def markdown(rows, squares):
    yield "### In short\n"
    yield from summary(rows)
    yield "\n### UMBmark's squares\n"
    yield "| hidden | UMBmark: E_d | E_b | `creepage discover` |\n|---|---|---|---|"
    yield from squares
    yield "\n### What each returns\n"
    yield from returned(rows)
    yield "\n### The gap after 5 s on held-out data, mm\n"
    yield from gaps(rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--binary", type=Path, default=ROOT / "target/release/creepage")
    parser.add_argument("--data", type=Path, help="folder of the open data, which are not part of the project")
    parser.add_argument("--out", type=Path, default=ROOT / "target/comparison")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    runs = list(bundled()) + (list(opened(arguments.data)) if arguments.data else [])
    rows = []
    for run in runs:
        rows.append(row(run, arguments.binary, arguments.out))
        print(run.name, rows[-1]["named"], rows[-1]["sindy"], [f"{g:.3g}" for g in rows[-1]["gap"]], flush=True)
    (arguments.out / "results.json").write_text(json.dumps(rows, indent=1))
    squares = list(umbmark.compare(arguments.binary, arguments.out / "squares"))
    (arguments.out / "results.md").write_text("\n".join(markdown(rows, squares)) + "\n")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""What PySINDy's column owes to the horizon its threshold is validated at: the one first chosen, and the one taken.

    python3 book/comparison/horizon.py [--data ../shared/data/open]

The gap is judged after 5 s in either case. Needs no binary of `creepage`.
"""
import argparse
from pathlib import Path

import numpy as np

import sparse
from compare import bundled, opened, score
from logs import gap, nominal

HORIZONS = [1.0, 5.0]
USERS = [("for prediction", sparse.PREDICTION), ("for sparsity", sparse.SPARSITY)]


def outcome(run, user, horizon):
    """The terms that are kept, and the share of the uncorrected gap that is left."""
    fitted = sparse.fit(run.fitted, user, horizon)
    return set(fitted.terms()), gap(run.held_out, fitted.corrected) / gap(run.held_out, nominal)


def summary(runs, outcomes):
    said = [(run.terms(), kept) for run, (kept, _) in zip(runs, outcomes) if run.terms()]
    nulls = sum(len(kept) for run, (kept, _) in zip(runs, outcomes) if not run.hidden)
    left = [share for run, (_, share) in zip(runs, outcomes) if run.hidden]
    exact, all_true = sum(t == k for t, k in said), sum(t <= k for t, k in said)
    return f"{exact} of {len(said)} | {all_true} of {len(said)} | {nulls} | {np.median(left):.3f}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--data", type=Path, help="folder of the open data, which are not part of the project")
    data = parser.parse_args().data
    runs = list(bundled()) + (list(opened(data)) if data else [])
    lines, differ = [], []
    for name, user in USERS:
        found = {h: [outcome(run, user, h) for run in runs] for h in HORIZONS}
        lines += [f"| {name} | {h:g} s | {summary(runs, found[h])} |" for h in HORIZONS]
        for run, (first, a), (taken, b) in zip(runs, *found.values()):
            if first != taken:
                differ.append(f"{run.name}, {name}: {score(first, run.terms())} at 1 s, {score(taken, run.terms())} at 5 s; "
                              f"gap left {a:.3f}, {b:.3f}")
    print("| PySINDy | validated over | exactly the true terms | all true terms kept | terms where nothing is hidden | "
          "gap left, median |\n|---|---|---|---|---|---|")
    print("\n".join(lines + [""] + differ))


if __name__ == "__main__":
    main()

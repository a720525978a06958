"""What the tests share: the examples of the repository."""

from pathlib import Path

import pytest

import creepage as cp

ROOT = Path(__file__).resolve().parents[2]
RUNS = ROOT / "examples" / "runs" / "cornering"


@pytest.fixture(scope="session")
def model() -> cp.Model:
    return cp.Model.load(RUNS / "model.toml")


@pytest.fixture(scope="session")
def found(model: cp.Model) -> cp.Discovery:
    runs = [cp.Run.read(RUNS / name, model) for name in ("eights.csv", "rosette.csv")]
    return cp.discover(model, runs, held_out=cp.Run.read(RUNS / "bay_held_out.csv", model))

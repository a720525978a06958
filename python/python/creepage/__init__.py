"""Creep kinematics of nonholonomic vehicles: where a model and measured runs disagree, and which effect is missing.

    import creepage as cp
    model = cp.Model.load("model.toml")
    runs = [cp.Run.read(path, model) for path in ("eights.csv", "rosette.csv")]
    found = cp.discover(model, runs, held_out=[cp.Run.read("bay_held_out.csv", model)])
    print(found.summary)                     # In turns the robot slides outwards: …
    found.model.save("model.patched.toml")

Units are SI: m, rad, s, kg. Signs: x forward, y to the left, angles counter-clockwise.
"""

from ._creepage import InputError, RunError
from .fleet import fleet
from .jobs import check, describe, discover, effects, fit, simulate, simulate_many, sweep, verify
from .model import Model
from .results import Check, Description, Discovery, Effect, Estimate, Fit, Gap, Ledger
from .run import Run

__all__ = [
    "Check",
    "Description",
    "Discovery",
    "Effect",
    "Estimate",
    "Fit",
    "Gap",
    "InputError",
    "Ledger",
    "Model",
    "Run",
    "RunError",
    "check",
    "describe",
    "discover",
    "effects",
    "fit",
    "fleet",
    "simulate",
    "simulate_many",
    "sweep",
    "verify",
]

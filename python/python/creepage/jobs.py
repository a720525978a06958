"""The jobs of the program, each a call. Work runs without the interpreter's lock, and Ctrl-C stops it."""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from os import PathLike
from typing import Any

from . import _creepage as native
from .frames import frame_of
from .model import Model
from .progress import Progress, listener
from .results import Check, Description, Discovery, Fit, Ledger
from .run import Run, _natives


def _all(runs: Run | Iterable[Run]) -> tuple[Run, ...]:
    return (runs,) if isinstance(runs, Run) else tuple(runs)


def discover(
    model: Model,
    runs: Run | Iterable[Run],
    *,
    held_out: Run | Iterable[Run] = (),
    horizons: Sequence[float] = (),
    effects: Sequence[str] | None = None,
    clock_offset: float | None = None,
    seed: int = 0,
    threads: int | None = None,
    progress: Progress = None,
) -> Discovery:
    """Finds where a model and measured runs disagree, names the missing effect, and adds it to the model.

    held_out      runs that are only judged; without any, the last quarter of every run
    horizons      s, of the gap; 1, 5 and 30 where there are none
    effects       ids of the effects that may be named; all where there is no list
    clock_offset  s, about where the clock of the poses reads against that of the inputs, for runs in two files
    threads       all cores where there is no number; the answer is the same for every number
    progress      None, True for a bar, or a function of (stage, done, of)

    Raises `InputError` when runs log different inputs, or the model's constraints do not determine its motion.
    Source: chapter 5 of `theory/`.
    """
    fitted, judged = _all(runs), _all(held_out)
    with listener(progress) as tell:
        found = native.discover(
            model._native,
            _natives(fitted),
            _natives(judged),
            [float(h) for h in horizons],
            seed,
            clock_offset,
            None if effects is None else list(effects),
            threads,
            tell,
        )
    report, page, text, patched = found
    return Discovery(report, page, text, model._rewritten(patched), model, fitted, judged)


def check(
    model: Model,
    runs: Run | Iterable[Run],
    *,
    effects: Sequence[str] | None = None,
    clock_offset: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Check:
    """Says before any fit what runs can tell of a model: which effects would be seen, and which not told apart."""
    named = None if effects is None else list(effects)
    with listener(progress) as tell:
        return Check(
            native.check(model._native, _natives(_all(runs)), clock_offset, named, threads, tell)
        )


def fit(model: Model, runs: Run | Iterable[Run], effects: Sequence[str], *, threads: int | None = None) -> Fit:
    """Fits just these effects: values, deviations and covariance, and no selection.

    An effect on one of several inputs or trailers is named `ID@INPUT` or `ID@TRAILER`.
    """
    return Fit(native.fit(model._native, _natives(_all(runs)), list(effects), threads))


def simulate(model: Model, run: Run) -> Any:
    """The motion of a model over the inputs of a run, from its first pose, as a data frame.

    Columns: time (s), x and y (m), heading (rad, not wrapped), then headings of trailers and what the model adds.
    """
    return frame_of(dict(native.simulate(model._native, run._native)))


def sweep(
    spec: str | PathLike[str], out: str | PathLike[str], *, threads: int | None = None, progress: Progress = None
) -> dict[str, int]:
    """Simulates all cases of a sweep's file into a table, CSV or Parquet by its name; goes on where a run was stopped."""
    with listener(progress) as tell:
        cases, undefined = native.sweep(spec, out, threads, tell)
    return {"cases": cases, "undefined": undefined}


def describe(model: Model) -> Description:
    """The constraints of a model with equations, Jacobians, growth vector and signature."""
    text, latex, found = native.describe(model._native)
    return Description(found, text, latex)


def verify(
    *ids: str, seed: int = 0, threads: int | None = None, progress: Progress = None
) -> Ledger:
    """Runs the claims of the paper that have these ids, all where none is named."""
    with listener(progress) as tell:
        return Ledger(native.verify(list(ids), seed, threads, tell))


def effects(vehicle: str | None = None) -> Any:
    """The effects that can be named, of one vehicle where one is given: the JSON of `creepage effects`, as Python values."""
    return json.loads(native.effects(vehicle))

"""The jobs of the program, each a call. Work runs without the interpreter's lock, and Ctrl-C stops it."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterable, Mapping, Sequence
from functools import partial
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any

from . import _creepage as native
from .engines import mapped, parts_of
from .frames import frame_of
from .model import Model
from .progress import Progress, listener
from .results import Check, Description, Discovery, Fit, Ledger
from .run import Run, _natives

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


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


def simulate_many(
    model: Model, run: Run, values: Mapping[str, Sequence[float]], *, threads: int | None = None
) -> NDArray[np.float64]:
    """The motions of a model over the inputs of a run, once for each of n sets of values: an array of shape (n, t, 3 + N).

    values   n numbers each of parameters ("track_width"), of values of the model's effects ("rotation-creep.e_rc"), or of
             components of the first pose ("initial.heading")

    Along the last axis: x and y (m), heading (rad, not wrapped), headings of the N trailers; t are the rows of the run. Each
    motion is integrated twice and checked to 1e-9; where one is undefined it is NaN, and a warning says how many are.

    Raises `InputError` where a name is unknown, a value is out of range or the lists differ in length, and for effects that
    hold in part or act on one input, which the engine of sweeps does not take.
    """
    given = [(name, [float(v) for v in of]) for name, of in values.items()]
    motions, undefined, rough = native.simulate_many(model._native, run._native, given, threads)
    for count, what in ((undefined, "is undefined: NaN"), (rough, "did not reach an error of 1e-9")):
        if count:
            warnings.warn(f"the motion of {count} of {len(motions)} cases {what}", RuntimeWarning, stacklevel=2)
    return motions


def sweep(
    spec: str | PathLike[str],
    out: str | PathLike[str],
    *,
    executor: Any = None,
    shards: int | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> dict[str, int]:
    """Simulates all cases of a sweep's file into a table, CSV or Parquet by its name; goes on where a run was stopped.

    executor  anything with `.submit` (concurrent.futures, a Dask client) or `.map` (a pool of multiprocessing or of Ray), whose
              workers see the same files and have a thread for each shard; this process, with its threads, where there is none
    shards    parts of the cases; four for each core where there is no number

    The table has the same bytes for every engine, sharding and number of threads.
    """
    if executor is None:
        with listener(progress) as tell:
            cases, undefined = native.sweep(spec, out, None, threads, tell)
        return {"cases": cases, "undefined": undefined}
    table = Path(out).resolve()
    folder = table.with_name(f"{table.name}.parts")
    folder.mkdir(parents=True, exist_ok=True)
    parts = parts_of(shards)
    counts = mapped(executor, partial(_sweep_shard, Path(spec).resolve(), folder, table.suffix), parts)
    files = [_part_file(folder, table.suffix, part) for part in parts]
    native.join_sweep(spec, [fspath(file) for file in files], out)
    for file in files:
        file.unlink()
    folder.rmdir()
    return {"cases": sum(c for c, _ in counts), "undefined": sum(u for _, u in counts)}


def _part_file(folder: Path, suffix: str, part: str) -> Path:
    return folder / f"{part.replace('/', '-of-')}{suffix}"


def _sweep_shard(spec: Path, folder: Path, suffix: str, part: str) -> tuple[int, int]:
    """The cases of one shard, such as "3/64", into a file of its own."""
    return native.sweep(spec, _part_file(folder, suffix, part), part, 1, None)


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

"""A fleet on any engine: `concurrent.futures`, Dask, pools of `multiprocessing` and of Ray.

The engine maps shards of the manifest; each is the command `creepage fleet map` in a process of its own, with one thread. On
an engine that has `submit` a shard that dies with its worker is asked again; the rows it had written are kept, so nothing is
done twice. The result has the same bytes for every engine, sharding and number of workers.
"""

from __future__ import annotations

import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from os import PathLike, cpu_count, fspath
from pathlib import Path
from typing import Any

from ._creepage import InputError, RunError
from .engines import mapped, parts_of


def _command(*arguments: str) -> None:
    done = subprocess.run([sys.executable, "-m", "creepage", *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise (InputError if done.returncode == 2 else RunError)(done.stderr.strip().removeprefix("creepage: "))


def shard(manifest: str, rows: str, part: str) -> str:
    """Asks `discover` of the robots of a shard, such as "3/64"."""
    _command("fleet", "map", manifest, "--out", rows, "--shard", part, "--threads", "1", "--quiet")
    return part


def fleet(
    manifest: str | PathLike[str],
    out: str | PathLike[str],
    *,
    rows: str | PathLike[str] | None = None,
    executor: Any = None,
    shards: int | None = None,
) -> dict[str, Any]:
    """Asks `discover` of every run of a fleet, fits the effects that the fleet needs, and puts them together.

    manifest  CSV with the columns robot, run, date, log, truth, model, and tags of one's own
    out       a folder for `fleet.json`, `fleet.html`, `fleet.csv`, `fleet.parquet`, and a model and parameters for each robot
    rows      a folder for what each shard found, kept for the next call; `rows` in `out` where there is none
    executor  anything with `.submit` (concurrent.futures, a Dask client) or `.map` (a pool of multiprocessing or of Ray); threads of this
              process where there is none
    shards    parts of the manifest; four for each core where there is no number

    The answer is the content of `fleet.json`.
    """
    found = Path(rows) if rows is not None else Path(out) / "rows"
    parts = parts_of(shards)
    one = partial(shard, fspath(Path(manifest).resolve()), fspath(found.resolve()))
    if executor is None:
        with ThreadPoolExecutor(cpu_count()) as pool:
            mapped(pool, one, parts)
    else:
        mapped(executor, one, parts)
    _command("fleet", "join", fspath(found), "--out", fspath(out), "--quiet")
    answer = json.loads((Path(out) / "fleet.json").read_text(encoding="utf-8"))
    assert isinstance(answer, dict)
    return answer

"""A fleet on any engine: `concurrent.futures`, Dask, joblib, Ray.

The engine maps shards of the manifest; each is the command `creepage fleet map` in a process of its own, with one thread. On
an engine that has `submit` a shard that dies with its worker is asked again; the rows it had written are kept, so nothing is
done twice. The result has the same bytes for every engine, sharding and number of workers.
"""

from __future__ import annotations

import json
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from os import PathLike, cpu_count, fspath
from pathlib import Path
from typing import Any

from ._creepage import InputError, RunError

#: Times a shard is asked that dies with its worker.
ATTEMPTS = 3


def _command(*arguments: str) -> None:
    done = subprocess.run([sys.executable, "-m", "creepage", *arguments], capture_output=True, text=True, check=False)
    if done.returncode:
        raise (InputError if done.returncode == 2 else RunError)(done.stderr.strip().removeprefix("creepage: "))


def shard(manifest: str, rows: str, part: str) -> str:
    """Asks `discover` of the robots of a shard, such as "3/64"."""
    _command("fleet", "map", manifest, "--out", rows, "--shard", part, "--threads", "1", "--quiet")
    return part


def _lost(executor: Any, manifest: str, rows: str, parts: list[str]) -> dict[str, Exception]:
    """The shards whose workers died, and of what."""
    futures = {part: executor.submit(shard, manifest, rows, part) for part in parts}
    lost: dict[str, Exception] = {}
    for part, future in futures.items():
        try:
            future.result()
        except (InputError, RunError):
            raise
        except Exception as error:  # the engine's own: a worker that was killed
            lost[part] = error
    return lost


def _mapped(executor: Any, manifest: str, rows: str, parts: list[str]) -> None:
    """Every shard on an engine that has `submit`, asked again where a worker died, or `map`."""
    if not hasattr(executor, "submit"):
        list(executor.map(shard, [manifest] * len(parts), [rows] * len(parts), parts))
        return
    lost: dict[str, Exception] = {}
    for _ in range(ATTEMPTS):
        lost = _lost(executor, manifest, rows, list(lost) or parts)
        if not lost:
            return
    raise next(iter(lost.values()))


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
    executor  anything with `.submit` (concurrent.futures, a Dask client) or `.map` (joblib, a pool of Ray); threads of this
              process where there is none
    shards    parts of the manifest; four for each core where there is no number

    The answer is the content of `fleet.json`.
    """
    found = Path(rows) if rows is not None else Path(out) / "rows"
    cores = cpu_count() or 1
    of = shards or 4 * cores
    parts = [f"{i}/{of}" for i in range(1, of + 1)]
    work = (fspath(Path(manifest).resolve()), fspath(found.resolve()), parts)
    if executor is None:
        with ThreadPoolExecutor(cores) as pool:
            _mapped(pool, *work)
    else:
        _mapped(executor, *work)
    _command("fleet", "join", fspath(found), "--out", fspath(out), "--quiet")
    answer = json.loads((Path(out) / "fleet.json").read_text(encoding="utf-8"))
    assert isinstance(answer, dict)
    return answer

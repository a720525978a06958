"""Work in parts on any engine: `concurrent.futures`, Dask, pools of `multiprocessing` and of Ray."""

from __future__ import annotations

from collections.abc import Callable
from os import cpu_count
from typing import Any, TypeVar

from ._creepage import InputError, RunError

Found = TypeVar("Found")

#: Times a part is asked that dies with its worker.
ATTEMPTS = 3


def parts_of(shards: int | None) -> list[str]:
    """The names of all shards, "1/8" and so on; four for each core where there is no number."""
    of = shards or 4 * (cpu_count() or 1)
    return [f"{i}/{of}" for i in range(1, of + 1)]


def _asked(executor: Any, one: Callable[[str], Found], parts: list[str]) -> tuple[dict[str, Found], Exception | None]:
    """What each part gives, without those whose workers died, and of what one of these died."""
    futures = {part: executor.submit(one, part) for part in parts}
    found: dict[str, Found] = {}
    lost: Exception | None = None
    for part, future in futures.items():
        try:
            found[part] = future.result()
        except (InputError, RunError):
            raise
        except Exception as error:  # the engine's own: a worker that was killed
            lost = error
    return found, lost


def mapped(executor: Any, one: Callable[[str], Found], parts: list[str]) -> list[Found]:
    """What a function gives for every part, asked again where a worker died on an engine that has `submit`.

    A function of one argument: pools of multiprocessing and of Ray map no other.
    """
    if not hasattr(executor, "submit"):
        return list(executor.map(one, parts))
    found: dict[str, Found] = {}
    lost: Exception | None = None
    for _ in range(ATTEMPTS):
        more, lost = _asked(executor, one, [part for part in parts if part not in found])
        found |= more
        if lost is None:
            return [found[part] for part in parts]
    assert lost is not None
    raise lost

"""Work in parts on any engine: `concurrent.futures`, Dask, pools of `multiprocessing` and of Ray."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

from ._creepage import InputError, RunError

Found = TypeVar("Found")

#: Times a part is asked that dies with its worker.
ATTEMPTS = 3


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

"""Progress of long work: none, a bar, or a function of one's own."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

#: None for silence, True for a bar of tqdm, or a function of (stage, done, of), where `of` is 0 if parts cannot be counted.
Progress = bool | Callable[[str, int, int], Any] | None


@contextmanager
def listener(progress: Progress) -> Iterator[Callable[[str, int, int], Any] | None]:
    """The function that the work tells."""
    if callable(progress):
        yield progress
        return
    if not progress:
        yield None
        return
    from tqdm.auto import tqdm

    with tqdm(total=None, leave=False) as bar:

        def tell(stage: str, done: int, of: int) -> None:
            if bar.desc != f"{stage}: ":
                bar.reset(total=of or None)
                bar.set_description(stage)
            bar.n = done
            bar.refresh()

        yield tell

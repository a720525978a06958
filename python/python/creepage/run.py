"""A measured run: times, poses and inputs, row by row."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

from . import _creepage as native
from .frames import csv_of, frame_of
from .model import Model

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


_Poses = tuple[str, str | None] | None


class Run:
    """A run that was read by the columns of a model: `Run.read` from a file, `Run.from_frame` from a table at hand."""

    def __init__(self) -> None:
        raise TypeError("a run is read: Run.read(path, model) or Run.from_frame(table, model)")

    @classmethod
    def _made(cls, run: native.Run, how: tuple[str, str | None, Model, _Poses]) -> Run:
        made = cls.__new__(cls)
        made._native = run
        made._how = how
        return made

    _native: native.Run
    _how: tuple[str, str | None, Model, _Poses]

    @classmethod
    def read(cls, path: str | PathLike[str], model: Model, *, truth: str | PathLike[str] | None = None) -> Run:
        """Reads a log (CSV, a folder of CSVs, a bag, Parquet); with `truth` the poses are those of a file of their own.

        Raises `InputError` with file, line and column where the log cannot be read.
        """
        poses = None if truth is None else (fspath(truth), None)
        return _rebuilt(fspath(path), None, model, poses)

    @classmethod
    def from_frame(cls, table: Any, model: Model, *, truth: Any = None, name: str = "run") -> Run:
        """A run from a table at hand: pandas, polars, pyarrow, or a mapping of names to arrays of shape (n,).

        With `truth` the table has inputs alone, and the poses are those of another table, or of the file of that path.

        Columns are read as those of a CSV: by the model's `[columns]`, units, quaternions and counts included. A value that
        is not a number is a blank cell; a row without a pose still has its inputs.
        """
        return _rebuilt(name, csv_of(table), model, None if truth is None else _poses(truth, "truth"))

    def with_truth(self, truth: Any, *, name: str = "truth") -> Run:
        """The same inputs with poses that were logged apart: a file's path, or a table as `Run.from_frame` takes it.

        The columns of the poses are those of the model; both clocks are aligned where the run is put to a model.
        """
        inputs, text, model, _ = self._how
        return _rebuilt(inputs, text, model, _poses(truth, name))

    def __reduce__(self) -> tuple[object, ...]:
        return _rebuilt, self._how

    @property
    def name(self) -> str:
        """Name of the file, without its folder."""
        return self._native.name

    @property
    def time(self) -> NDArray[np.float64]:
        """Strictly increasing times of the poses, s; shape (n,)."""
        return self._native.time

    @property
    def x(self) -> NDArray[np.float64]:
        """Measured positions along x, m; shape (n,)."""
        return self._native.x

    @property
    def y(self) -> NDArray[np.float64]:
        """Measured positions along y, m; shape (n,)."""
        return self._native.y

    @property
    def heading(self) -> NDArray[np.float64] | None:
        """Measured headings, rad, without jumps, shape (n,); None where no sensor measures one."""
        return self._native.heading

    @property
    def trailer_headings(self) -> list[NDArray[np.float64]]:
        """Measured absolute headings of the trailers, rad, nearest first; each of shape (n,)."""
        return self._native.trailer_headings

    @property
    def inputs(self) -> dict[str, NDArray[np.float64]]:
        """The inputs by their roles, at `input_time`; each of shape (m,)."""
        return dict(self._native.inputs)

    @property
    def input_time(self) -> NDArray[np.float64]:
        """The times of the inputs, s; those of the poses where both were logged together."""
        return self._native.input_time

    @property
    def warnings(self) -> list[str]:
        """What is to know of the file."""
        return self._native.warnings

    @property
    def dropped(self) -> dict[str, int]:
        """How many rows were left out for each reason."""
        return self._native.why_dropped

    def frame(self) -> Any:
        """Times and poses as a data frame, of pandas or polars, whichever is there."""
        columns = {"time": self.time, "x": self.x, "y": self.y}
        if self.heading is not None:
            columns["heading"] = self.heading
        columns |= {f"trailer_heading_{i}": h for i, h in enumerate(self.trailer_headings, 1)}
        return frame_of(columns)

    def __len__(self) -> int:
        return len(self.time)

    def __repr__(self) -> str:
        return f"<Run {self.name!r}: {len(self)} rows, {self.time[-1] - self.time[0]:.4g} s>"


def _natives(runs: Iterable[Run]) -> list[native.Run]:
    """What the jobs take of runs."""
    return [run._native for run in runs]


def _poses(truth: Any, name: str) -> tuple[str, str | None]:
    return (fspath(truth), None) if isinstance(truth, (str, PathLike)) else (name, csv_of(truth))


def _rebuilt(name: str, text: str | None, model: Model, truth: _Poses) -> Run:
    """A run as it was made: from a file or a text, with its poses from another file or text where they were logged apart."""
    how = (name, text, model, truth)
    if truth is not None and (text, truth[1]) != (None, None):
        return Run._made(native.Run.apart((name, text), truth, model._native), how)
    if text is None:
        return Run._made(native.Run.read(name, model._native, truth and truth[0]), how)
    return Run._made(native.Run.parse(name, text, model._native), how)

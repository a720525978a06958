"""The native half of the package: arguments in, strings and arrays out. Use the names of `creepage` itself."""

from collections.abc import Callable
from os import PathLike
from typing import Any, final

import numpy as np
from numpy.typing import NDArray

__all__ = [
    "InputError",
    "Model",
    "Run",
    "RunError",
    "check",
    "describe",
    "discover",
    "effects",
    "export",
    "fit",
    "join_sweep",
    "main",
    "simulate",
    "simulate_many",
    "sweep",
    "verify",
]

class InputError(ValueError):
    """Wrong usage or unusable input."""

    file: str | None
    line: int | None
    column: int | None
    help: str | None

class RunError(RuntimeError):
    """Work that failed although its input was good."""

    file: str | None
    line: int | None
    column: int | None
    help: str | None

@final
class Model:
    @staticmethod
    def read(
        path: str | PathLike[str],
        vehicles: str | PathLike[str] | None = None,
        effects: str | PathLike[str] | None = None,
    ) -> Model: ...
    @staticmethod
    def parse(text: str) -> Model: ...
    @staticmethod
    def of_vehicle(vehicle: str, parameters: list[tuple[str, float]]) -> Model: ...
    @property
    def vehicle(self) -> str: ...
    @property
    def text(self) -> str: ...
    def write(self, path: str | PathLike[str]) -> None: ...

@final
class Run:
    @staticmethod
    def read(path: str | PathLike[str], model: Model, truth: str | PathLike[str] | None = None) -> Run: ...
    @staticmethod
    def parse(name: str, text: str, model: Model) -> Run: ...
    @staticmethod
    def apart(inputs: tuple[str, str | None], truth: tuple[str, str | None], model: Model) -> Run: ...
    @property
    def name(self) -> str: ...
    @property
    def time(self) -> NDArray[np.float64]: ...
    @property
    def x(self) -> NDArray[np.float64]: ...
    @property
    def y(self) -> NDArray[np.float64]: ...
    @property
    def heading(self) -> NDArray[np.float64] | None: ...
    @property
    def trailer_headings(self) -> list[NDArray[np.float64]]: ...
    @property
    def inputs(self) -> list[tuple[str, NDArray[np.float64]]]: ...
    @property
    def input_time(self) -> NDArray[np.float64]: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def why_dropped(self) -> dict[str, int]: ...

def discover(
    model: Model,
    runs: list[Run],
    held_out: list[Run],
    horizons: list[float],
    seed: int,
    clock_offset: float | None,
    effects: list[str] | None,
    threads: int | None,
    progress: Callable[[str, int, int], Any] | None,
) -> tuple[str, str, str, str]: ...
def check(
    model: Model,
    runs: list[Run],
    clock_offset: float | None,
    effects: list[str] | None,
    threads: int | None,
    progress: Callable[[str, int, int], Any] | None,
) -> str: ...
def fit(model: Model, runs: list[Run], effects: list[str], threads: int | None) -> str: ...
def simulate(model: Model, run: Run) -> list[tuple[str, NDArray[np.float64]]]: ...
def simulate_many(
    model: Model, run: Run, values: list[tuple[str, list[float]]], threads: int | None
) -> tuple[NDArray[np.float64], int, int]: ...
def sweep(
    spec: str | PathLike[str],
    out: str | PathLike[str],
    shard: str | None,
    threads: int | None,
    progress: Callable[[str, int, int], Any] | None,
) -> tuple[int, int]: ...
def join_sweep(
    spec: str | PathLike[str], parts: list[str], out: str | PathLike[str]
) -> None: ...
def describe(model: Model) -> tuple[str, str, str]: ...
def verify(
    ids: list[str], seed: int, threads: int | None, progress: Callable[[str, int, int], Any] | None
) -> str: ...
def effects(vehicle: str | None) -> str: ...
def export(model: Model, target: str) -> tuple[str, list[str]]: ...
def main(arguments: list[str]) -> int: ...

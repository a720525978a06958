"""A vehicle with its parameters, the columns of its logs, and the effects that it may miss."""

from __future__ import annotations

import html
import re
import tempfile
import warnings
from os import PathLike, fspath
from pathlib import Path

from . import _creepage as native


class Model:
    """A model file at hand.

    `Model("differential-drive", wheel_radius=0.1, track_width=0.4)` is a vehicle of the catalogue (SI units), whose logs have
    columns of the names of their roles; `Model.load` reads a file, `Model.parse` takes its text.

    Raises `InputError` with file, line and column where something is unknown, missing or out of range.
    """

    def __init__(self, vehicle: str, **parameters: float) -> None:
        self._of(native.Model.of_vehicle(vehicle, [(name, float(value)) for name, value in parameters.items()]))

    def _of(self, model: native.Model, vehicles: str | None = None, effects: str | None = None) -> None:
        self._native = model
        self._own = (vehicles, effects)

    @classmethod
    def _made(cls, model: native.Model, vehicles: str | None = None, effects: str | None = None) -> Model:
        made = cls.__new__(cls)
        made._of(model, vehicles, effects)
        return made

    @classmethod
    def load(
        cls,
        path: str | PathLike[str],
        *,
        vehicles: str | PathLike[str] | None = None,
        effects: str | PathLike[str] | None = None,
    ) -> Model:
        """Reads a model file, with files of one's own vehicles and effects beside the catalogues."""
        own = [None if given is None else fspath(given) for given in (vehicles, effects)]
        return cls._made(native.Model.read(path, *own), *own)

    @classmethod
    def parse(cls, text: str) -> Model:
        """The model that the text of a model file describes."""
        return cls._made(native.Model.parse(text))

    def _rewritten(self, text: str) -> Model:
        """The same catalogues with another text, such as a patched one."""
        return _rebuilt(text, *self._own)

    @property
    def vehicle(self) -> str:
        """Id of the vehicle."""
        return self._native.vehicle

    @property
    def text(self) -> str:
        """The text of the model file."""
        return self._native.text

    def save(self, path: str | PathLike[str]) -> None:
        """Writes the model file, whole or not at all."""
        self._native.write(path)

    def export(self, target: str) -> str:
        """The findings of the model as what a robot reads.

        target   "ros2", "ros2-diff-drive", "ros2-steering", "wpilib", "vesc" or "json": parameters of a controller;
                 "c", "cpp", "python" or "rust": a step of the model with its Jacobian, which needs no library

        What the target has no place for stands in a comment of the text, and a warning says it. Raises `InputError` where the
        vehicle is none that the target drives.
        """
        text, unsaid = native.export(self._native, target)
        if unsaid:
            warnings.warn(f"{target} has no place for {'; '.join(unsaid)}", UserWarning, stacklevel=2)
        return text

    def to_ros2_yaml(self, controller: str | None = None) -> str:
        """The parameters of the ROS 2 controller that drives such a vehicle: as `export`, under the node's name.

        controller   name of the node; ROS 2's own, such as "diff_drive_controller", where there is none
        """
        text = self.export("ros2")
        return text if controller is None else re.sub(r"(?m)^\w+:$", f"{controller}:", text, count=1)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Model) and (self.text, self._own) == (other.text, other._own)

    def __hash__(self) -> int:
        return hash((self.text, self._own))

    def __repr__(self) -> str:
        return f"Model({self.vehicle!r})"

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"

    def __reduce__(self) -> tuple[object, ...]:
        return _rebuilt, (self.text, *self._own)


def _rebuilt(text: str, vehicles: str | None, effects: str | None) -> Model:
    if vehicles is None and effects is None:
        return Model.parse(text)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "model.toml"
        path.write_text(text, encoding="utf-8")
        return Model.load(path, vehicles=vehicles, effects=effects)

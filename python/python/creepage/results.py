"""What the jobs answer: frozen, picklable, and readable by people and by programs."""

from __future__ import annotations

import html
import json
from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .frames import frame_of_rows
from .model import Model
from .run import Run

if TYPE_CHECKING:
    from .plot import Plots

#: The colour of a verdict's bar: of the patched model, not of the news.
_GOOD, _FAIR, _BAD = "#2e7d4f", "#b7791f", "#b3392f"


@dataclass(frozen=True)
class Estimate:
    """A value with its standard deviation and unit; no deviation where the data do not tell one."""

    value: float
    std: float | None
    unit: str


@dataclass(frozen=True)
class Effect:
    """An effect that was found or fitted: id, values by name, ΔBIC, and the effects that these runs do not tell from it."""

    id: str
    where: str
    parameters: dict[str, Estimate]
    delta_bic: float | None
    indistinguishable_from: tuple[str, ...]
    scope: str | None
    on: str | None
    equation: str
    plain: str = ""


@dataclass(frozen=True)
class Gap:
    """The prediction error after a restart, at a horizon: m and rad, root mean square; None where no window is so long."""

    horizon_s: float
    held_out: bool
    position_before: float
    position_after: float
    position_floor: float
    heading_before: float | None
    heading_after: float | None
    heading_floor: float | None


def _estimates(parameters: dict[str, Any]) -> dict[str, Estimate]:
    return {name: Estimate(p["value"], p.get("std"), p["unit"]) for name, p in parameters.items()}


def _effect(found: dict[str, Any]) -> Effect:
    return Effect(
        id=found["id"],
        where=found.get("where", ""),
        parameters=_estimates(found["parameters"]),
        delta_bic=(found.get("evidence") or {}).get("delta_bic"),
        indistinguishable_from=tuple(other["id"] for other in found.get("indistinguishable_from", [])),
        scope=(found.get("scope") or {}).get("says"),
        on=found.get("on"),
        equation=found.get("equation", ""),
        plain=found.get("plain", ""),
    )


def _effect_rows(effects: tuple[Effect, ...]) -> list[dict[str, Any]]:
    return [
        {
            "effect": effect.id,
            "parameter": name,
            "value": p.value,
            "std": p.std,
            "unit": p.unit,
            "delta_bic": effect.delta_bic,
            "scope": effect.scope,
        }
        for effect in effects
        for name, p in effect.parameters.items()
    ]


@dataclass(frozen=True)
class _Answer:
    """An answer with its JSON."""

    json: str

    @cached_property
    def report(self) -> dict[str, Any]:
        """All of the JSON, as Python values."""
        found = json.loads(self.json)
        assert isinstance(found, dict)
        return found


@dataclass(frozen=True)
class Discovery(_Answer):
    """The answer of `discover`.

    `json` has the bytes of the command's `report.json`, `html` those of `report.html`, `text` its screen; `model` is the
    model with what was found added to it.
    """

    html: str = field(repr=False)
    text: str = field(repr=False)
    model: Model
    given: Model = field(repr=False)
    runs: tuple[Run, ...] = field(repr=False)
    held_out: tuple[Run, ...] = field(repr=False)

    @property
    def verdict(self) -> str:
        """`missing-effect`, `no-missing-effect`, `unnamed-effect`, `unexplained`, `not-identifiable` or `unusable-data`."""
        return str(self.report["verdict"])

    @property
    def summary(self) -> str:
        """The answer in one sentence."""
        return str(self.report["summary"])

    @cached_property
    def effects(self) -> tuple[Effect, ...]:
        """The effects that are missing, the strongest first."""
        return tuple(_effect(found) for found in self.report["effects"])

    @property
    def unnamed(self) -> tuple[str, ...]:
        """Equations of laws without a name."""
        return tuple(found["equation"] for found in self.report["unnamed"])

    @property
    def remains(self) -> str | None:
        """What remains above the noise floor, in words; None at the floor."""
        rest = self.report.get("remains")
        return str(rest["says"]) if rest else None

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to know of the data."""
        return tuple(self.report["data"]["warnings"])

    @cached_property
    def gap(self) -> tuple[Gap, ...]:
        """The prediction errors at every horizon, of fitted and of held-out runs."""
        found = []
        for gap in self.report["gap"]:
            floor = gap["noise_floor"]
            for part in ("fit", "held_out"):
                if (of := gap.get(part)) is None:
                    continue
                found.append(
                    Gap(
                        horizon_s=gap["horizon_s"],
                        held_out=part == "held_out",
                        position_before=of["position_rms_before"],
                        position_after=of["position_rms_after"],
                        position_floor=floor["position_rms"],
                        heading_before=of.get("heading_rms_before"),
                        heading_after=of.get("heading_rms_after"),
                        heading_floor=floor.get("heading_rms"),
                    )
                )
        return tuple(found)

    def frame(self) -> Any:
        """The values of the effects as a data frame: effect, parameter, value, std, unit, delta_bic, scope."""
        return frame_of_rows(_effect_rows(self.effects))

    def gap_frame(self) -> Any:
        """The gaps as a data frame, a row for each horizon of fitted and of held-out runs; m and rad."""
        return frame_of_rows([dict(gap.__dict__) for gap in self.gap])

    @property
    def plot(self) -> Plots:
        """Pictures on matplotlib's axes: `path()`, `gap()`, `residuals()`."""
        from .plot import Plots

        return Plots(self)

    def save(self, folder: str | PathLike[str]) -> None:
        """Writes `report.json`, `report.html` and, where the data could be used, `model.patched.toml`."""
        to = Path(folder)
        to.mkdir(parents=True, exist_ok=True)
        (to / "report.json").write_bytes(self.json.encode())
        (to / "report.html").write_bytes(self.html.encode())
        if self.verdict != "unusable-data":
            self.model.save(to / "model.patched.toml")

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        bad = self.verdict in ("unusable-data", "not-identifiable")
        colour = _BAD if bad else _FAIR if self.remains or self.verdict.startswith("un") else _GOOD
        card = (
            f'<div style="border-left:6px solid {colour};padding:.4em 1em;margin:.5em 0;font-size:1.1em">'
            f"<b>{html.escape(self.verdict)}</b><br>{html.escape(self.summary)}</div>"
        )
        # The page stands in a frame of its own: it can neither read the notebook nor be styled by it.
        page = html.escape(self.html, quote=True)
        return f'{card}<iframe sandbox="allow-scripts" srcdoc="{page}" style="width:100%;height:600px;border:0"></iframe>'


@dataclass(frozen=True)
class Check(_Answer):
    """The answer of `check`: before any fit, which effects the runs would show, and how small."""

    @property
    def effects(self) -> list[dict[str, Any]]:
        """Each effect with what the runs would tell of it."""
        return list(self.report["effects"])

    def frame(self) -> Any:
        """The effects as a data frame."""
        plain = (str, int, float, bool, type(None))
        return frame_of_rows([{k: v for k, v in e.items() if isinstance(v, plain)} for e in self.effects])


@dataclass(frozen=True)
class Fit(_Answer):
    """The answer of `fit`: values, deviations and covariance of just the effects that were named."""

    @cached_property
    def effects(self) -> tuple[Effect, ...]:
        """The effects with their values."""
        return tuple(_effect(found) for found in self.report["effects"])

    @property
    def covariance(self) -> tuple[list[str], list[list[float]]] | None:
        """Names of the values, and their covariance, in the units of the values; None where the data tell none."""
        found = self.report.get("covariance")
        return (list(found["names"]), [list(row) for row in found["matrix"]]) if found else None

    def frame(self) -> Any:
        """The values as a data frame: effect, parameter, value, std, unit."""
        return frame_of_rows(_effect_rows(self.effects))


@dataclass(frozen=True)
class Description(_Answer):
    """The constraints of a model with equations, Jacobians, growth vector and signature."""

    text: str = field(repr=False)
    _latex: str = field(repr=False)

    def latex(self) -> str:
        """The same as LaTeX."""
        return self._latex

    def __str__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return f"<pre>{html.escape(self.text)}</pre>"


@dataclass(frozen=True)
class Ledger(_Answer):
    """Claims of the paper with the status that the evidence earned."""

    @property
    def claims(self) -> list[dict[str, Any]]:
        """The claims, each with `id` and `status`."""
        return list(self.report["claims"])

    def frame(self) -> Any:
        """Ids and statuses as a data frame."""
        return frame_of_rows([{"id": c["id"], "status": c["status"]} for c in self.claims])

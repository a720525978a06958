"""Pictures of a discovery on matplotlib's axes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import _creepage as native

if TYPE_CHECKING:
    from .results import Discovery
    from .run import Run

#: Measured, given, patched: told apart by dash as well as by colour.
_MEASURED = {"color": "#4d5761", "linewidth": 2.5, "label": "measured"}
_GIVEN = {"color": "#b3392f", "linestyle": "--", "label": "model as given"}
_PATCHED = {"color": "#1f6fb2", "linestyle": "-.", "label": "patched model"}


class Plots:
    """Pictures of a discovery; each takes `ax=` and returns the axes that it drew on."""

    def __init__(self, found: Discovery) -> None:
        self._found = found

    def _run(self, run: str | None) -> Run:
        runs = (*self._found.held_out, *self._found.runs)
        for one in runs:
            if run is None or one.name == run:
                return one
        names = ", ".join(one.name for one in runs)
        raise ValueError(f"no run is called {run!r}; the runs are {names}")

    def _motions(self, run: Run) -> list[tuple[dict[str, Any], dict[str, np.ndarray]]]:
        models = ((_GIVEN, self._found.given), (_PATCHED, self._found.model))
        return [(style, dict(native.simulate(model._native, run._native))) for style, model in models]

    def path(self, run: str | None = None, ax: Any = None) -> Any:
        """The measured path, and those of both models from its first pose; the first held-out run where none is named."""
        of, ax = self._run(run), _axes(ax)
        ax.plot(of.x, of.y, **_MEASURED)
        for style, motion in self._motions(of):
            ax.plot(motion["x"], motion["y"], **style)
        ax.set(xlabel="x, m", ylabel="y, m", title=of.name)
        ax.set_aspect("equal", adjustable="datalim")
        ax.legend()
        return ax

    def residuals(self, run: str | None = None, ax: Any = None) -> Any:
        """The distance of both models from the measured path over time, driven from its first pose; m."""
        of, ax = self._run(run), _axes(ax)
        for style, motion in self._motions(of):
            ax.plot(of.time, np.hypot(motion["x"] - of.x, motion["y"] - of.y), **style)
        ax.set(xlabel="time, s", ylabel="distance from the measured path, m", title=of.name)
        ax.set_ylim(bottom=0)
        ax.legend()
        return ax

    def gap(self, ax: Any = None) -> Any:
        """The prediction errors at every horizon, before and after, beside the noise floor; mm, on a scale of powers."""
        ax = _axes(ax)
        held_out = any(gap.held_out for gap in self._found.gap)
        gaps = [gap for gap in self._found.gap if gap.held_out == held_out]
        at = np.arange(len(gaps))
        bars = (
            (-0.27, "position_before", "model as given", "#b3392f", "//"),
            (0.0, "position_after", "patched model", "#1f6fb2", ""),
            (0.27, "position_floor", "noise floor", "#9aa3ab", ".."),
        )
        for shift, name, label, colour, hatch in bars:
            values = [1e3 * getattr(gap, name) for gap in gaps]
            ax.bar(at + shift, values, 0.25, label=label, color=colour, hatch=hatch, edgecolor="white")
        ax.set_xticks(at, [f"{gap.horizon_s:g} s" for gap in gaps])
        ax.set(yscale="log", xlabel="after", ylabel="position error, mm", title="held-out runs" if held_out else "fitted runs")
        ax.legend()
        return ax


def _axes(ax: Any) -> Any:
    if ax is not None:
        return ax
    import matplotlib.pyplot as plt

    return plt.subplots()[1]

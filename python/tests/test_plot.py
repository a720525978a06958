"""Pictures on matplotlib's axes."""

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt
import pytest

import creepage as cp


def test_pictures_show_both_models(found: cp.Discovery) -> None:
    path = found.plot.path(run="eights.csv")
    assert [line.get_label() for line in path.get_lines()] == ["measured", "model as given", "patched model"]
    assert path.get_title() == "eights.csv" and path.get_xlabel() == "x, m"
    _, ax = plt.subplots()
    assert found.plot.residuals(ax=ax) is ax
    given, patched = (max(line.get_ydata()) for line in ax.get_lines())
    assert patched < 0.2 * given
    assert len(found.plot.gap().patches) == 3 * sum(gap.held_out for gap in found.gap)
    with pytest.raises(ValueError, match="eights.csv"):
        found.plot.path(run="nowhere.csv")
    plt.close("all")

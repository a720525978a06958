"""Runs from tables at hand: the same numbers to the last bit, whatever library holds them."""

import numpy as np
import pandas as pd
import polars as pl
import pyarrow as pa
import pytest
from conftest import RUNS

import creepage as cp


@pytest.fixture(scope="module")
def columns() -> dict[str, np.ndarray]:
    frame = pd.read_csv(RUNS / "eights.csv", comment="#")
    return {name: frame[name].to_numpy() for name in frame.columns}


@pytest.mark.parametrize("of", [dict, pd.DataFrame, pl.DataFrame, pa.table])
def test_every_table_is_the_file(of, columns: dict[str, np.ndarray], model: cp.Model) -> None:
    run = cp.Run.from_frame(of(columns), model, name="eights.csv")
    file = cp.Run.read(RUNS / "eights.csv", model)
    assert run.name == file.name
    assert np.array_equal(run.time, file.time) and np.array_equal(run.x, file.x)
    assert np.array_equal(run.heading, file.heading)
    assert run.inputs.keys() == file.inputs.keys()
    for role, values in run.inputs.items():
        assert np.array_equal(values, file.inputs[role])


def test_units_and_counts_are_the_models() -> None:
    text = (
        'vehicle = "unicycle"\n[parameters]\nwheel_radius = 0.5\n[columns]\ntime = { column = "ms", unit = "ms" }\n'
        'heading = { column = "deg", unit = "deg" }\n'
    )
    model = cp.Model.parse(text)
    n = 50
    table = {"ms": 20 * np.arange(n), "x": np.arange(n) / 3, "y": np.zeros(n), "deg": np.full(n, 90.0)}
    table |= {"wheel_rate": np.ones(n), "yaw_rate": np.zeros(n)}
    run = cp.Run.from_frame(table, model)
    assert np.array_equal(run.x, table["x"])
    assert np.allclose(np.diff(run.time), 0.02) and np.allclose(run.heading, np.pi / 2)
    assert len(run.frame()) == n and list(run.frame().columns) == ["time", "x", "y", "heading"]


def test_a_row_without_a_pose_keeps_its_inputs(model: cp.Model, columns: dict[str, np.ndarray]) -> None:
    sparse = {name: column.astype(float).copy() for name, column in columns.items()}
    sparse["x"][100:110] = np.nan
    run = cp.Run.from_frame(sparse, model)
    assert len(run) == len(columns["x"]) - 10 and len(run.input_time) == len(columns["x"])
    assert sum(run.dropped.values()) == 10


@pytest.mark.parametrize(
    ("table", "says"),
    [
        ({}, "without columns"),
        ({"t": np.zeros(3), "x": np.zeros(4)}, "one length"),
        ({"t": np.zeros((3, 2))}, "one length"),
        (7, "no table"),
        ({"t": np.zeros(3)}, "column"),
    ],
)
def test_what_is_no_run_is_refused(table: object, says: str, model: cp.Model) -> None:
    with pytest.raises(cp.InputError, match=says) as raised:
        cp.Run.from_frame(table, model)
    assert raised.value.line is None or raised.value.file == "run"
    with pytest.raises(TypeError):
        cp.Run()

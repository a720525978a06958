"""Tables of other libraries: in as CSV, out as a data frame of whichever library is there."""

from __future__ import annotations

import csv
import io
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np

from ._creepage import InputError


def _columns(table: Any) -> dict[str, np.ndarray]:
    """The columns of a table by name, as arrays."""
    if isinstance(table, Mapping):
        names = list(table)
    elif hasattr(table, "column_names"):  # pyarrow
        names = list(table.column_names)
    elif hasattr(table, "columns"):  # pandas, polars
        names = list(table.columns)
    else:
        raise InputError(f"a {type(table).__name__} is no table: give pandas, polars, pyarrow or a dict of arrays")
    columns = {str(name): np.asarray(table[name]) for name in names}
    lengths = {name: column.shape for name, column in columns.items()}
    if any(len(shape) != 1 for shape in lengths.values()) or len(set(lengths.values())) > 1:
        told = ", ".join(f"{name} {shape}" for name, shape in lengths.items())
        raise InputError(f"the columns of a table are arrays of one length, not {told}")
    if not columns:
        raise InputError("a table without columns is no run")
    return columns


def _cells(column: np.ndarray) -> list[str]:
    """The values of a column as a file has them: numbers to their last bit, what is not a number blank."""
    if column.dtype.kind == "f":
        return ["" if np.isnan(value) else repr(value) for value in column.astype(float).tolist()]
    if column.dtype.kind == "M":
        return ["" if np.isnat(value) else str(value) for value in column]
    return ["" if value is None or value != value else str(value) for value in column.tolist()]


def csv_of(table: Any) -> str:
    """A table as the text of a CSV."""
    columns = _columns(table)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*map(_cells, columns.values()), strict=True))
    return text.getvalue()


def frame_of(columns: Mapping[str, Any]) -> Any:
    """Columns as a data frame: of the library that the caller uses, else of the one that is installed."""
    libraries = ("pandas", "polars")
    for library in sorted(libraries, key=lambda name: name not in sys.modules):
        try:
            module = __import__(library)
        except ImportError:
            continue
        return module.DataFrame(dict(columns))
    raise ImportError("a frame needs pandas or polars: pip install pandas")


def frame_of_rows(rows: list[dict[str, Any]]) -> Any:
    """Rows as a data frame; what a row lacks is None."""
    names: dict[str, None] = {}
    for row in rows:
        names |= dict.fromkeys(row)
    return frame_of({name: [row.get(name) for row in rows] for name in names})

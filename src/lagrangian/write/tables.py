"""Writes columns of numbers with names and units as CSV, NetCDF, Parquet, NPZ, and xarray and pandas objects."""

from __future__ import annotations

import csv
import importlib
import io
import json
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.errors import MissingExtra, ModelError
from lagrangian.records import dataclass
from lagrangian.write.files import check_free, write_file, write_with

if TYPE_CHECKING:
    import pandas
    import xarray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Column:
    """A sequence of numbers with a name, an SI unit (empty if there is none) and a description."""

    name: str
    values: Array
    unit: str = ""
    words: str = ""

    @property
    def attributes(self) -> dict[str, str]:
        """``units`` and ``long_name``, as in the CF conventions."""
        return {"units": self.unit or "1", "long_name": self.words or self.name}


@dataclass(frozen=True, eq=False)
class ColumnTable:
    """Columns of equal length with one index column, and attributes of the whole table."""

    index: Column
    columns: tuple[Column, ...]
    attributes: Mapping[str, Any]

    @property
    def plain_attributes(self) -> dict[str, str | float | int]:
        """The attributes as stored in files: numbers and text, anything else as JSON."""
        return {key: _plain(value) for key, value in self.attributes.items()}


def _plain(value: Any) -> str | float | int:
    if isinstance(value, str):
        return str(value)  # also for subclasses of text, because HDF5 accepts only plain text
    return value if isinstance(value, (float, int)) and not isinstance(value, bool) else _json(value)


def _json(value: Any) -> str:
    return json.dumps(value, ensure_ascii=False)


def needed(module: str) -> Any:
    """Import an optional package, or raise `MissingExtra` with the command that installs it."""
    try:
        return importlib.import_module(module)
    except ImportError:
        raise MissingExtra(
            f"this needs the package '{module}'", fix="pip install 'lagrangian[data]'", code="E801"
        ) from None


def to_xarray(table: ColumnTable) -> xarray.Dataset:
    """Return an `xarray.Dataset` with a variable per column; units and descriptions are attributes."""
    xr = needed("xarray")
    at = table.index.name
    return xr.Dataset(
        {c.name: (at, c.values, c.attributes) for c in table.columns},
        coords={at: (at, table.index.values, table.index.attributes)},
        attrs=table.plain_attributes,
    )


def to_pandas(table: ColumnTable) -> pandas.DataFrame:
    """Return a `pandas.DataFrame` with the index column as index; units and descriptions are in ``frame.attrs``."""
    pd = needed("pandas")
    index = pd.Index(table.index.values, name=table.index.name)
    frame = pd.DataFrame({c.name: c.values for c in table.columns}, index=index)
    frame.attrs.update(table.plain_attributes)
    frame.attrs["units"] = {c.name: c.unit for c in (table.index, *table.columns)}
    return frame


def to_csv(table: ColumnTable) -> str:
    """Return text with a line of names and a line per row; numbers have all their digits."""
    out = io.StringIO()
    listed = (table.index, *table.columns)
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([c.name for c in listed])
    writer.writerows(zip(*[map(repr, c.values.tolist()) for c in listed], strict=True))
    return out.getvalue()


def _csv(path: Path, table: ColumnTable) -> None:
    write_file(path, to_csv(table))


def _netcdf(path: Path, table: ColumnTable) -> None:
    """Write NetCDF 4 through h5netcdf, in memory first, because HDF5 does not handle a full disk well."""
    netcdf = needed("h5netcdf")
    needed("h5py")
    memory, at = io.BytesIO(), table.index.name
    with netcdf.File(memory, "w") as file:
        file.dimensions = {at: len(table.index.values)}
        for c in (table.index, *table.columns):
            file.create_variable(c.name, (at,), data=c.values).attrs.update(c.attributes)
        file.attrs.update(table.plain_attributes)
    _bytes(path, memory)


def _bytes(path: Path, memory: io.BytesIO) -> None:
    write_with(path, lambda beside: beside.write_bytes(memory.getbuffer()))


def _parquet(path: Path, table: ColumnTable) -> None:
    pa, pq = needed("pyarrow"), needed("pyarrow.parquet")
    listed = (table.index, *table.columns)
    fields = [pa.field(c.name, pa.float64(), metadata=c.attributes) for c in listed]
    schema = pa.schema(fields, metadata={k: str(v) for k, v in table.plain_attributes.items()})
    made = pa.Table.from_arrays([pa.array(c.values) for c in listed], schema=schema)
    memory = io.BytesIO()
    pq.write_table(made, memory)
    _bytes(path, memory)


def _npz(path: Path, table: ColumnTable) -> None:
    arrays: dict[str, Any] = {c.name: c.values for c in (table.index, *table.columns)}
    arrays["attributes"] = _json(dict(table.plain_attributes))
    arrays["units"] = _json({c.name: c.unit for c in (table.index, *table.columns)})
    memory = io.BytesIO()
    np.savez(memory, **arrays)
    _bytes(path, memory)


ENDINGS: Mapping[str, Callable[[Path, ColumnTable], None]] = {
    ".csv": _csv,
    ".nc": _netcdf,
    ".parquet": _parquet,
    ".npz": _npz,
}
"""The function that writes a file, for each ending of its name."""


def check_target(path: Path, endings: Sequence[str], *, overwrite: bool) -> None:
    """Raise an error for an unknown ending, and for an existing file unless it may be replaced."""
    if path.suffix.lower() not in endings:
        fix = f"use one of {', '.join(endings)}"
        raise ModelError(f"the ending of '{path.name}' is not supported", fix=fix, code="E402")
    check_free(path, overwrite=overwrite)


def save(table: ColumnTable, path: str | Path, *, overwrite: bool = False) -> Path:
    """Write a table to a file whose ending determines the format, completely or not at all; return the path.

    Raises `Error` if the file exists (unless ``overwrite``) or cannot be written.
    """
    target = Path(path)
    check_target(target, list(ENDINGS), overwrite=overwrite)
    ENDINGS[target.suffix.lower()](target, table)
    return target

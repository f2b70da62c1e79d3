"""The quantities that vary from run to run: initial states, parameters and inputs, as arrays, ranges or draws."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics, read
from lagrangian.advice import Advice, Argument
from lagrangian.codegen.arguments import numbers
from lagrangian.errors import RunError, did_you_mean
from lagrangian.integrate.checksums import DONE
from lagrangian.integrate.design import GROUPS, Design, DesignColumn, RandomColumn
from lagrangian.integrate.store import Variable
from lagrangian.model import Model
from lagrangian.quantities.quantity import Quantity
from lagrangian.read.sweep_values import Spread, parse_spread, parse_values
from lagrangian.records import dataclass, field
from lagrangian.simulate.integrating import remembered
from lagrangian.simulate.plot import Units
from lagrangian.values.dimensions import Dim
from lagrangian.values.values import Given, Group, key_name, number

Array: TypeAlias = NDArray[np.float64]

SAMPLE, RUN, TIME, EVENT = "sample", "run", "time", "event"
TAKEN = {SAMPLE, RUN, TIME, EVENT, DONE, "chunk", "status", "reached"}
"""Names of axes and results that a varied entry must not have."""

PORTION = 1 << 20
MAX_LISTED = 10_000_000
"""The largest number of values in one array of a grid."""


@dataclass(frozen=True, eq=False)
class ListedEntries:
    """All entries of a model that determine a run, by group, with their values if they do not vary."""

    model: Model
    given: Given
    base: dict[str, dict[str, float | None]]

    @classmethod
    def of(cls, model: Model) -> ListedEntries:
        """The default entries: coordinates at their initial values, at rest, inputs 0, declared parameters, and
        [simulate]."""
        given = Given.of(model, remembered(model, "states", lambda: dynamics.rhs(dynamics.slips(model))))
        x: dict[str, float | None] = dict.fromkeys(given.states.names, 0.0)
        x.update({c.name: c.start for c in model.coordinates})
        x.update(given.states.values(model.settings.get("initial", {})))
        u: dict[str, float | None] = dict.fromkeys(given.inputs.names, 0.0)
        return cls(model, given, {"x": x, "u": u, "p": {p.name: p.value for p in model.parameters}})

    def group(self, group: str) -> Group:
        """The names and dimensions of a group."""
        return {"x": self.given.states, "u": self.given.inputs, "p": self.given.parameters}[group]

    def found(self, written: str) -> tuple[str, str]:
        """The group and the name of an entry in any spelling: ``theta1'``, ``θ₁'``, ``L_a``."""
        for group in GROUPS:
            if written in self.base[group]:
                return group, written
        plain = {name: group for group in GROUPS for name in self.base[group] if not name.endswith("'")}
        names, dots = read.Scope(self.model.symbols).meanings(written)
        if len(names) == 1 and names[0] + "'" * dots in self.base["x"]:
            return "x", names[0] + "'" * dots
        if len(names) == 1 and not dots and names[0] in plain:
            return plain[names[0]], names[0]
        known = [name for group in ("p", "x", "u") for name in self.base[group]]
        shown = ", ".join(known[:16]) + (", …" if len(known) > 16 else "")
        raise RunError(
            f"there is no parameter, coordinate, rate or input '{written[:64]}' to vary",
            fix=did_you_mean(written, known) or f"known: {shown}",
            code="E402",
        )

    def complete(self, varied: Iterable[tuple[str, str]]) -> dict[str, Array]:
        """The constants of all runs; entries that vary need no value."""
        free = set(varied)
        missing = [n for n, value in self.base["p"].items() if value is None and ("p", n) not in free]
        if missing:
            raise RunError(
                f"parameter '{missing[0]}' has no value. Missing: {', '.join(missing)}",
                fix=Advice("give ", Argument("params", "…", missing[0]), ", or vary it"),
                code="E401",
            )
        return {g: np.array([0.0 if v is None else v for v in self.base[g].values()]) for g in GROUPS}


@dataclass(eq=False)
class Varying:
    """The axes of an ensemble, and the entries that vary along them.

    ``axes``: name → length. ``columns``: (group, name) → values that broadcast to the axes, or draws.
    """

    entries: ListedEntries
    axes: dict[str, int]
    columns: dict[tuple[str, str], Array | RandomColumn] = field(default_factory=dict)

    def design(self) -> Design:
        """The runs of the ensemble."""
        columns = [
            DesignColumn(group, list(self.entries.base[group]).index(name), name, source)
            for (group, name), source in self.columns.items()
        ]
        shape = tuple(self.axes.values())
        return Design(tuple(self.axes), shape, self.entries.complete(self.columns), columns)

    def coordinates(self, names: Iterable[str], units: Units) -> dict[str, tuple[Variable, Iterator[Array]]]:
        """The varied entries as coordinates of results that are called ``names``."""
        found: dict[str, tuple[Variable, Iterator[Array]]] = {}
        taken = {*TAKEN, *names}
        for (group, name), source in self.columns.items():
            title = _title(group, name, taken)
            words = {
                **self._words(group, name, units),
                "varied": "drawn" if isinstance(source, RandomColumn) else "given",
            }
            if isinstance(source, RandomColumn):
                count = self.axes[SAMPLE]
                portions = (source.sample(np.arange(k, min(count, k + PORTION))) for k in range(0, count, PORTION))
                words["distribution"] = f"{source.law}({source.a:g}, {source.b:g})"
                found[title] = Variable("float64", (SAMPLE,), (count,), words), portions
                continue
            sizes = list(self.axes.items())[len(self.axes) - source.ndim :]
            along = [k for k, n in enumerate(source.shape) if n > 1 or (sizes[k][1] == 1 and source.ndim == 1)]
            kept = source.reshape([source.shape[k] for k in along])
            dims = tuple(title if sizes[k][0] == name else sizes[k][0] for k in along)
            found[title] = Variable("float64", dims, kept.shape, words), iter([kept])
        return found

    def dims(self, names: Iterable[str]) -> tuple[str, ...]:
        """The names of the axes for results that are called ``names``."""
        taken = {*TAKEN, *names}
        groups = {name: group for group, name in self.columns}
        return tuple(_title(groups[d], d, taken) if d in groups else d for d in self.axes)

    def _words(self, group: str, name: str, units: Units) -> dict[str, str]:
        model = self.entries.model
        named = {"x": (*model.coordinates, *model.velocities), "p": model.parameters, "u": model.inputs}[group]
        unit = next(units.of(entry.symbol) for entry in named if entry.name == name)
        noun = {"x": "initial value of", "p": "parameter", "u": "input"}[group]
        return {"long_name": f"{noun} {name}", **({"units": unit} if unit else {})}

    def task(self) -> dict[str, Any]:
        """The varied and the constant values as plain data by which tasks can be distinguished."""
        varied = {name: _said(source) for (_, name), source in self.columns.items()}
        fixed = {
            word: {n: v for n, v in self.entries.base[g].items() if (g, n) not in self.columns}
            for g, word in (("x", "initial"), ("p", "parameter"))
        }
        return {"axes": dict(self.axes), "varied": varied, **fixed}


def _title(group: str, name: str, taken: set[str]) -> str:
    """The name of the coordinate for an entry: its own or, if a result has that name, one such as θ(0)."""
    if name not in taken:
        return name
    return f"{name}(0)" if group == "x" else f"{'parameter' if group == 'p' else 'input'} {name}"


def _said(source: Array | RandomColumn) -> str:
    if isinstance(source, RandomColumn):
        return f"{source.law}({source.a!r}, {source.b!r}) seed {source.seed}"
    ends = f"{source.flat[0]:.17g} … {source.flat[-1]:.17g}" if source.size else "nothing"
    digest = hashlib.blake2b(np.ascontiguousarray(source).tobytes(), digest_size=8).hexdigest()
    return f"{'×'.join(map(str, source.shape))} values {ends} #{digest}"


# -- arrays -----------------------------------------------------------------------------------------------------


def from_arrays(model: Model, given: Mapping[str, Mapping[Any, Any] | None], dims: Sequence[str] | None) -> Varying:
    """An ensemble from arrays that broadcast together; ``given`` contains numbers and arrays by group and name.

    Raises `RunError` for unknown names, and for shapes that do not fit together.
    """
    entries = ListedEntries.of(model)
    columns: dict[tuple[str, str], Array | RandomColumn] = {}
    for group, mapping in given.items():
        for key, value in _items(mapping, group):
            where = _entry(entries, group, key_name(key))
            _take(entries, columns, where, value)
    shapes = {name: source.shape for (_, name), source in columns.items() if not isinstance(source, RandomColumn)}
    try:
        shape = np.broadcast_shapes(*shapes.values())
    except ValueError:
        listed = ", ".join(f"'{name}' {shape}" for name, shape in shapes.items())
        raise RunError(
            f"the arrays do not fit together: {listed}", fix="make their shapes equal, or 1 along an axis", code="E501"
        ) from None
    names = _dims(dims, shape)
    for name, own in shapes.items():
        along = [d for d, n in zip(names[len(names) - len(own) :], own, strict=True) if n > 1]
        if name in names and along not in ([], [name]):
            raise RunError(
                f"an axis is called '{name}', and '{name}' varies along {' and '.join(along)}",
                fix="give each axis the name of the only quantity that varies along it",
                code="E404",
            )
    return Varying(entries, dict(zip(names, shape, strict=True)), columns)


def _items(given: Mapping[Any, Any] | None, group: str) -> list[tuple[Any, Any]]:
    word = {"x": "initial", "p": "params", "u": "inputs"}[group]
    if given is None:
        return []
    if not isinstance(given, Mapping):
        raise RunError(
            f"{word} must be a mapping from names to numbers or arrays (got {type(given).__name__})",
            fix=f"{word}={{'name': [1.0, 2.0]}}",
            code="E501",
        )
    return list(given.items())


def _entry(entries: ListedEntries, group: str, name: str) -> tuple[str, str]:
    """The entry of ``group`` that ``name`` means."""
    names = entries.group(group).names
    if name in names:
        return group, name
    noun = {"x": "coordinate or rate", "p": "parameter", "u": "input"}[group]
    try:
        found = entries.found(name)
    except RunError:
        found = ("", "")
    if found[0] == group:
        return found
    hint = did_you_mean(name, names) or f"known: {', '.join(names[:12]) or 'none'}"
    raise RunError(f"there is no {noun} '{name[:64]}'", fix=hint, code="E402")


def _take(entries: ListedEntries, columns: dict[Any, Any], where: tuple[str, str], value: Any) -> None:
    """Record a number as the value for all runs, or an array as a column."""
    group, name = where
    what = f"'{name}'"
    if where in columns:
        raise RunError(f"{what} is given twice, by name and by symbol", code="E404")
    listed = isinstance(value, Sequence) and not isinstance(value, (str, bytes))  # ragged arrays have no number of axes
    if not listed and np.ndim(value) == 0:
        dims = entries.group(group)
        entries.base[group][name] = number(value, what, dims.dims[dims.names.index(name)])
        return
    if listed and any(isinstance(v, str) for v in value):
        dims = entries.group(group)
        dim = dims.dims[dims.names.index(name)]
        columns[where] = np.array([number(v, what, dim) for v in value])
    else:
        columns[where] = numbers(value, what)


def _dims(dims: Sequence[str] | None, shape: tuple[int, ...]) -> tuple[str, ...]:
    if dims is None:
        return (RUN,) if len(shape) == 1 else tuple(f"{RUN}_{k}" for k in range(len(shape)))
    listed = (dims,) if isinstance(dims, str) else tuple(dims)
    if len(listed) != len(shape) or len(set(listed)) != len(listed):
        raise RunError(f"{len(shape)} axes need as many different names (got {listed})", code="E501")
    if taken := [d for d in listed if d in TAKEN - {RUN, SAMPLE}]:
        raise RunError(f"an axis cannot be called '{taken[0]}'", fix="use another name, such as case", code="E403")
    return listed


# -- grids ------------------------------------------------------------------------------------------------------


def from_grid(
    model: Model,
    grid: Mapping[Any, Any] | Iterable[str] | str,
    fixed: Mapping[str, Mapping[Any, Any] | None],
    draws: int | None,
    seed: int,
) -> Varying:
    """An ensemble of every combination of the values in ``grid``, each for every random draw.

    ``grid``: name → values (an array, or text such as "10:100:50" and "normal(1, 0.1)"), or texts "k=10:100:50".
    """
    entries = ListedEntries.of(model)
    spare: dict[tuple[str, str], Array | RandomColumn] = {}
    for group, mapping in fixed.items():
        for key, value in _items(mapping, group):
            _take(entries, spare, _entry(entries, group, key_name(key)), value)
    if spare:
        name = next(iter(spare))[1]
        raise RunError(
            f"'{name}' is an array, but values that vary belong in the grid",
            fix=Advice(Argument("grid", "…", name)),
            code="E501",
        )
    axes: dict[str, Array] = {}
    drawn: dict[tuple[str, str], RandomColumn] = {}
    groups: dict[str, str] = {}
    for written, values in _grid_items(grid):
        group, name = entries.found(written)
        if name in groups:
            raise RunError(f"'{name}' is varied twice", fix="give it one range, list or distribution", code="E404")
        groups[name] = group
        dim = entries.group(group).dims[list(entries.base[group]).index(name)]
        if isinstance(values, Spread) and values.drawn:
            a, b = (_checked(values, q, dim) for q in values.numbers)
            drawn[group, name] = RandomColumn(name, values.kind, a, b, _seed(seed))
        else:
            axes[name] = _listed(values, dim) if isinstance(values, Spread) else _axis(values, name)
    if not groups:
        fix = Advice("give at least one with its values: ", Argument("grid", "np.linspace(10, 100, 50)", "k"))
        raise RunError("no varied quantity is given", fix=fix, code="E401")
    sizes = {name: len(values) for name, values in axes.items()}
    if drawn:
        sizes[SAMPLE] = _draws(draws)
    elif draws is not None:
        raise RunError(
            "draws is given, but no quantity is drawn at random",
            fix="draw a quantity, such as b~normal(1, 0.1), or leave draws out",
            code="E501",
        )
    columns: dict[tuple[str, str], Array | RandomColumn] = {}
    for k, (name, values) in enumerate(axes.items()):
        columns[groups[name], name] = values.reshape([-1 if i == k else 1 for i in range(len(sizes))])
    return Varying(entries, sizes, {**columns, **drawn})


def _grid_items(grid: Mapping[Any, Any] | Iterable[str] | str) -> Iterator[tuple[str, Any]]:
    if isinstance(grid, Mapping):
        for key, values in grid.items():
            name = key_name(key)
            yield name, parse_values(name, values) if isinstance(values, str) else values
        return
    listed = [grid] if isinstance(grid, str) else grid
    if not isinstance(listed, Iterable):
        raise RunError(
            f"a grid is a mapping from names to values (got {type(grid).__name__})",
            fix=Advice(Argument("grid", "np.linspace(10, 100, 50)", "k")),
            code="E501",
        )
    for text in listed:
        spread = parse_spread(text)
        yield spread.name, spread


def _listed(spread: Spread, dim: Dim | None) -> Array:
    """The values of a range or a list."""
    ends = [_checked(spread, q, dim) for q in spread.numbers]
    if spread.kind == "list":
        return np.array(ends)
    if spread.log:
        return np.geomspace(ends[0], ends[1], spread.count)
    return np.linspace(ends[0], ends[1], spread.count)


def _checked(spread: Spread, quantity: Quantity, dim: Dim | None) -> float:
    found = Dim(quantity.dimension.exponents)
    logarithm = spread.kind == "lognormal"
    if dim is not None and not dim.unknown and not quantity.is_bare and not logarithm and found.known != dim.known:
        raise spread.source.error(
            f"'{spread.name}' is given in {quantity.unit}",
            0,
            fix=f"a unit of {dim}" if str(dim) not in ("", "1") else "give no unit, or rad or deg for an angle",
            code="E408",
        )
    return quantity.value


def _axis(values: Any, name: str) -> Array:
    array = numbers(values, f"'{name}'")
    if array.ndim == 0:
        array = array.reshape(1)
    if array.ndim != 1:
        raise RunError(
            f"the values of '{name}' have shape {array.shape}",
            fix="give one row: np.linspace(10, 100, 50)",
            code="E501",
        )
    if array.size > MAX_LISTED:
        raise RunError(f"'{name}' has {array.size} values", fix=f"at most {MAX_LISTED}", code="E501")
    return array


def _draws(draws: int | None) -> int:
    if draws is None:
        raise RunError("the number of draws is not given", fix=Advice(Argument("draws", "1000")), code="E401")
    if isinstance(draws, bool) or not isinstance(draws, (int, np.integer)) or draws < 1:
        raise RunError(f"draws must be a whole number, at least 1 (got {draws!r:.30})", code="E501")
    return int(draws)


def _seed(seed: int) -> int:
    if isinstance(seed, bool) or not isinstance(seed, (int, np.integer)) or not 0 <= seed < 2**64:
        raise RunError(f"a seed is a whole number from 0 to 2^64 − 1 (got {seed!r:.30})", code="E501")
    return int(seed)

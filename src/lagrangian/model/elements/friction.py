"""Dry friction that sticks: Coulomb's law with a viscous part, between points or on a deflection."""

# SymPy has no type stubs:
# pyright: reportMissingTypeStubs=false, reportUnknownMemberType=false

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any, ClassVar, Literal

import sympy as sp
from sympy.core.function import AppliedUndef

from lagrangian import bounded
from lagrangian.model.elements.answers import ENERGY, ActsOn, Entry, FieldKind, Measure, deflected
from lagrangian.model.elements.base import (
    DEFLECTION,
    XI,
    Action,
    Condition,
    Element,
    Level,
    Surroundings,
    Use,
    check_ends,
    difference,
    norm,
    pair_ends,
)
from lagrangian.model.elements.conditions import Unmoved
from lagrangian.model.elements.constraint import Restriction
from lagrangian.model.geometry import Point, as_expr, is_listed
from lagrangian.model.names import is_text, multiplier_symbol, time
from lagrangian.records import dataclass

MOST_ROWS = 3
"""The largest number of rows that press together: the directions of space."""


@dataclass(frozen=True, eq=False, kw_only=True)
class Friction(Element):
    """Dry friction along a deflection δ: it slips with the effort −F sign(δ̇) − b δ̇, or it sticks, δ̇ = 0.

    F [N or N m] is ``limit``, or ``mu`` times ``normal``. Of a ``limit`` or ``normal`` that changes, only the magnitude
    counts; constant ones must not be negative. Instead of ``normal``, ``pressed_by`` names a row of a constraint, whose
    multiplier λ_N is the normal force: F = μ |λ_N|; or two or three rows along perpendicular directions, which press
    with F = μ √(λ₁² + λ₂² + …). That force depends on the friction in its turn.
    While it sticks, its effort is the multiplier λ of the row δ̇ = 0, as long as |λ| ≤ F_s. F_s is F unless ``static``
    is given: the limit at rest if ``limit`` is given, the coefficient at rest if ``mu`` is; it is not below F.
    ``viscous`` is b. With ``sense``, ±1, it is known to slip in that sense, and nothing jumps: then ``side`` is the
    sign of λ_N. δ is the distance of two points (``between``) or an expression in coordinates and t
    (``deflection``; an angle makes F a torque).
    """

    mu: Any = None
    normal: Any = None
    pressed_by: Any = None
    limit: Any = None
    static: Any = None
    viscous: Any = None
    between: Any = None
    deflection: Any = None
    sense: Any = None
    side: Any = None

    kind: ClassVar[str] = "friction"
    plural = "Dry friction."
    about = "Dry friction that slips or sticks, with the limit F or the coefficient mu and a normal force."
    entries: ClassVar[Mapping[str, Entry]] = {
        "mu": Entry(FieldKind.EXPRESSION, "Its coefficient while it slips; needs normal or pressed_by."),
        "normal": Entry(FieldKind.EXPRESSION, "The normal force, whose magnitude counts."),
        "pressed_by": Entry(
            FieldKind.ROWS, "The constraint, or its row, whose multiplier is the normal force; or a list of rows."
        ),
        "limit": Entry(FieldKind.EXPRESSION, "The friction force or torque F while it slips, instead of mu."),
        "static": Entry(FieldKind.EXPRESSION, "The coefficient at rest (with mu), or the limit at rest (with limit)."),
        "viscous": Entry(FieldKind.EXPRESSION, "The coefficient b of a viscous part b δ̇."),
        "between": Entry(FieldKind.TWO_POINTS, "The two points that slide along the line through both."),
        "deflection": Entry(FieldKind.EXPRESSION, "Its deflection δ, instead of two points."),
        "sense": Entry(FieldKind.EXPRESSION, "1 or -1 if it is known to slip in that sense: it never sticks then."),
        "side": Entry(FieldKind.EXPRESSION, "With sense and pressed_by, the sign of that multiplier, 1 or -1."),
    }
    ledger: ClassVar[Literal["T*", "V", "Ξ"]] = "Ξ"
    because = ("it takes energy out while it slips and does no work while it sticks: no potential, so it is in ", XI)
    resists = True
    normal_multipliers: ClassVar[tuple[sp.Expr, ...]] = ()
    """λ_N of the rows that press, by other symbols than those of runs."""

    def __post_init__(self) -> None:
        given = [key for key in ("mu", "normal", "pressed_by", "limit") if getattr(self, key) is not None]
        if given not in (["mu", "normal"], ["mu", "pressed_by"], ["limit"]):
            raise self._error(
                f"give mu with normal or pressed_by, or else limit (got {', '.join(given) or 'none'})",
                fix="mu='mu', normal='m*g' for a coefficient and a normal force; limit='F' for a force or torque",
                code="E412",
            )
        if isinstance(self.normal, str):
            raise self._error(
                f"the normal force '{self.normal[:64]}' is text",
                fix=f"pressed_by='{self.normal[:64]}' if the multiplier of that constraint is the normal force; else "
                "an expression in coordinates, rates, t, parameters and inputs",
                code="E406",
            )
        if self.pressed_by is not None:
            self._set(pressed_by=self._rows(self.pressed_by))
        self._set(between=check_ends(self, self.between, self.deflection))
        for key in ("sense", "side"):
            value = getattr(self, key)
            if value is not None and (isinstance(value, bool) or value not in (1, -1)):
                raise self._error(f"{key} is {value!r:.40}", fix=f"{key}=1 or {key}=-1", code="E406")
        if (self.side is None) != (self.sense is None or len(self.pressing) != 1):
            raise self._error(
                "side, the sign of the one multiplier that presses, is given with sense and pressed_by",
                fix="sense=1, side=1",
                code="E412",
            )
        for key in ("mu", "normal", "limit", "static", "viscous", "deflection", "sense", "side"):
            value = getattr(self, key)
            if value is not None:
                self._set(**{key: as_expr(value, f"the {key} of {self.title}", place=self.place)})

    def _rows(self, given: Any) -> str | tuple[str, ...]:
        """The name of the row that presses, or the names of several."""
        listed = given if is_listed(given) else (given,)
        found = [x.name if isinstance(x, Restriction) else x for x in listed]
        names = [name for name in found if is_text(name) and name]
        if not names or len(names) < len(found):
            raise self._error(
                "pressed_by must be a constraint or the name of one of its rows, or a list of rows",
                fix="pressed_by='floor', or pressed_by=['collar.across1', 'collar.across2']",
                code="E406",
            )
        if len(names) > MOST_ROWS or len(set(names)) < len(names):
            raise self._error(
                f"pressed_by lists {len(names)} rows, and two or three different ones press along perpendicular "
                "directions",
                fix="pressed_by=['collar.across1', 'collar.across2']",
                code="E412",
            )
        return names[0] if len(names) == 1 else tuple(names)

    @property
    def pressing(self) -> tuple[str, ...]:
        """The rows whose multipliers press on it."""
        if self.pressed_by is None:
            return ()
        return (self.pressed_by,) if isinstance(self.pressed_by, str) else self.pressed_by

    def suggested_name(self) -> str:
        """The symbol of its coefficient or limit."""
        main = self.mu if self.mu is not None else self.limit
        return getattr(main, "name", "") if main.is_Symbol or main.is_Function else ""

    def uses(self) -> Iterator[Use]:
        """Coefficients of parameters; the limit and the normal force may contain all that moves, t and inputs."""
        for key, what in (("mu", "coefficient"), ("static", "value at rest"), ("viscous", "viscous coefficient")):
            if getattr(self, key) is not None:
                yield Use(key, what, getattr(self, key), Level.CONSTANT)
        for key, what in (("normal", "normal force"), ("limit", "limit")):
            if getattr(self, key) is not None:
                yield Use(key, what, getattr(self, key), Level.VELOCITY, inputs=True)
        if self.deflection is not None:
            yield Use("deflection", "deflection", self.deflection, Level.POSITION)

    def measures(self, model: Surroundings) -> Iterator[Measure]:
        """With the unit [δ]: limit and normal force J/[δ], viscous coefficient J s/[δ]²; mu is a number.

        Pressed by a row, mu λ is in J/[δ]: where the unit of λ is known, that of mu is.
        """
        along = None if self.between else self.deflection
        if self.mu is None:
            yield Measure("limit", self.limit, ENERGY, along, -1)
            if self.static is not None:
                yield Measure("limit at rest", self.static, ENERGY, along, -1)
        elif self.pressed_by is None:
            yield Measure("coefficient", self.mu, (0, 0, 0))
            yield Measure("normal force", self.normal, ENERGY, along, -1)
            if self.static is not None:
                yield Measure("coefficient at rest", self.static, (0, 0, 0))
        if self.viscous is not None:
            yield Measure("viscous coefficient", self.viscous, (1, 2, -1), along, -2)

    def acts_on(self) -> ActsOn:
        """Its ends or its deflection."""
        return deflected(self.between, self.deflection)

    def points(self) -> Iterator[tuple[str, Point]]:
        """Its two ends, if it has them."""
        for point in self.between or ():
            yield "between", point

    # -- the law ------------------------------------------------------------------------------------------------

    @property
    def slipping_limit(self) -> sp.Expr:
        """F [N or N m]: the friction while it slips."""
        return _magnitude(self.limit) if self.mu is None else self.mu * self.normal_force

    @property
    def sticking_limit(self) -> sp.Expr:
        """F_s [N or N m]: the greatest |λ| at which it sticks."""
        if self.static is None:
            return self.slipping_limit
        return self.static if self.mu is None else self.static * self.normal_force

    @property
    def normal_force(self) -> sp.Expr:
        """The magnitude of the normal force: |N|, or |λ_N|, which is ± λ_N on a known side, or √(λ₁² + λ₂²)."""
        if self.pressed_by is None:
            return _magnitude(self.normal)
        first, *others = self.normal_multipliers or tuple(map(multiplier_symbol, self.pressing))
        if others:
            return sp.sqrt(sp.Add(*(x**2 for x in (first, *others))))
        return sp.Abs(first) if self.side is None else self.side * first

    def displacement(self, model: Surroundings) -> sp.Expr:
        """δ [m or rad]; along one fixed line it is the signed separation."""
        if not self.between:
            return model.expand(self.deflection)
        delta = difference(model, *self.between)
        line = self._line(delta)
        return norm(delta) if line is None else delta[line]

    def rate(self, model: Surroundings) -> sp.Expr:
        """δ̇ [m/s or rad/s]."""
        return bounded.diff(self.displacement(model), time)

    def effort(self, model: Surroundings, rate: sp.Expr) -> sp.Expr:
        """What acts on δ while it slips: −F sign(δ̇) − b δ̇; in one ``sense`` of slipping, −F · sense − b δ̇."""
        sense = sp.sign(rate) if self.sense is None else self.sense
        dry = -self.slipping_limit * sense
        return dry if self.viscous is None else dry - self.viscous * rate

    def works(self, model: Surroundings) -> tuple[Action, ...]:
        """One action on the deflection."""
        rate = self.rate(model)
        return (Action(self.effort(model, rate), rate, DEFLECTION, self.displacement(model)),)

    def ends(self, model: Surroundings) -> tuple[Action, ...]:
        """The friction on each end."""
        if not self.between:
            return self.works(model)
        start, end = self.between
        line = self._line(difference(model, start, end))
        effort = self.effort(model, self.rate(model))
        if line is None:
            return pair_ends(model, start, end, effort)
        return tuple(
            Action(sign * effort, model.velocity(point)[line], model.point_words(point), target=point)
            for sign, point in ((1, end), (-1, start))
        )

    @staticmethod
    def _line(delta: tuple[sp.Expr, ...]) -> int | None:
        """The axis along which alone the two points are apart, if there is one."""
        moving = [i for i, d in enumerate(delta) if d != 0]
        return moving[0] if len(moving) == 1 else None

    # -- its two regimes ----------------------------------------------------------------------------------------

    def slipping(self, sense: int) -> Friction:
        """The same friction while it slips in one sense, ±1: its effort has no jump."""
        made = self.named(self.name)
        made._set(sense=sp.Integer(sense))
        return made

    def pressed(self, rows: str | tuple[str, ...] | None) -> Friction:
        """The same friction with the name of the row that presses on it, or the names of several."""
        made = self.named(self.name)
        made._set(pressed_by=rows)
        return made

    def on_side(self, side: int) -> Friction:
        """The same friction while λ_N has one sign, ±1."""
        made = self.named(self.name)
        made._set(side=sp.Integer(side))
        return made

    def with_multipliers(self, symbols: Sequence[sp.Expr]) -> Friction:
        """The same friction with other symbols for the multipliers that press."""
        made = self.named(self.name)
        made._set(normal_multipliers=tuple(symbols))
        return made

    def sticking(self) -> Stuck:
        """The row δ̇ = 0 that replaces it while it sticks."""
        return Stuck(friction=self, name=self.name, place=self.place)


def _magnitude(force: sp.Expr) -> sp.Expr:
    """|force|; one of parameters alone stays as it is, because a run checks that it is not negative."""
    return sp.Abs(force) if force.has(AppliedUndef, time) else force


@dataclass(frozen=True, eq=False, kw_only=True)
class Stuck(Restriction):
    """A friction that sticks: the row δ̇ = 0, whose multiplier λ is the friction force on δ."""

    friction: Friction

    def acts_on(self) -> ActsOn:
        """What the friction acts on."""
        return self.friction.acts_on()

    def points(self) -> Iterator[tuple[str, Point]]:
        """The ends of the friction."""
        return self.friction.points()

    def conditions(self, model: Surroundings) -> tuple[Condition, ...]:
        """δ̇ = 0."""
        return (Unmoved(value=self.friction.rate(model), velocity=True, between=self.friction.between),)

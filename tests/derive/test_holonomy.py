"""Step 0: verdicts on constraints against what is published or follows by hand, and integrals against the rows."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import pytest
import sympy as sp

from lagrangian.derive.constraints import Holonomy, closed, judge
from lagrangian.errors import ModelError
from lagrangian.model import time as t
from size import rest_slow


@dataclass(frozen=True)
class Given:
    """A row as the model gives it."""

    name: str
    rate: sp.Expr
    position: sp.Expr | None = None


def functions(names: str) -> list[Any]:
    return [sp.Function(name, real=True)(t) for name in names.split()]


def dot(q: Any) -> Any:
    return sp.Derivative(q, t)


x, y, z, theta, phi, psi, left, right = functions("x y z theta phi psi left right")
dx, dy, dz, dtheta, dphi, dpsi, dleft, dright = map(dot, (x, y, z, theta, phi, psi, left, right))
r, w, a, b, c, ell = sp.symbols("r w a b c ell", positive=True)
sin, cos, exp = sp.sin, sp.cos, sp.exp
SPACE = [x, y, z]


def rates(*expressions: Any) -> list[Given]:
    return [Given(f"row {k + 1}", e) for k, e in enumerate(expressions)]


def positions(*expressions: Any) -> list[Given]:
    return [Given(f"row {k + 1}", sp.diff(e, t), e) for k, e in enumerate(expressions)]


def tractor(trailers: int) -> tuple[list[Given], list[Any]]:
    """A car-like tractor without steering, and trailers hitched at the middle of each axle.

    θ_i' = v_i sin(θ_(i−1) − θ_i)/d_i with v_i = v_(i−1) cos(θ_(i−1) − θ_i). Source: J. P. Laumond, Controllability of a
    multibody mobile robot, IEEE Transactions on Robotics and Automation 9, 1993.
    """
    angles = functions(" ".join(f"theta{k}" for k in range(trailers + 1)))
    speed = dx * cos(angles[0]) + dy * sin(angles[0])
    rows = [dx * sin(angles[0]) - dy * cos(angles[0])]
    for k in range(1, trailers + 1):
        turn = angles[k - 1] - angles[k]
        rows.append(sp.Symbol(f"d{k}", positive=True) * dot(angles[k]) - speed * sin(turn))
        speed = speed * cos(turn)
    return rates(*rows), [x, y, *angles]


KNIFE = rates(dx * sin(theta) - dy * cos(theta))
DISC = rates(dx - r * cos(psi) * dphi, dy - r * sin(psi) * dphi)
CAR = rates(dx * sin(theta) - dy * cos(theta), dx * sin(theta + phi) - dy * cos(theta + phi) - ell * dtheta * cos(phi))
AXLE = rates(
    dx * sin(theta) - dy * cos(theta),
    dx * cos(theta) + dy * sin(theta) + w * dtheta - r * dright,
    dx * cos(theta) + dy * sin(theta) - w * dtheta - r * dleft,
)
ROLL = rates(  # Euler angles z, x, z; the velocity of the contact is zero
    dx - r * (dtheta * sin(psi) - dphi * cos(psi) * sin(theta)),
    dy + r * (dtheta * cos(psi) + dphi * sin(psi) * sin(theta)),
)
HIDDEN = sp.diff(x**2 + y**2 + z**2 - sin(x * y), t) * cos(z) / (1 + y**2)

GROWTHS: dict[str, tuple[list[Given], list[Any], tuple[int, ...]]] = {
    "y dx - x dy": (rates(y * dx - x * dy), [x, y], (1,)),
    "y dx - x dy, z free": (rates(y * dx - x * dy), SPACE, (2,)),
    "times an exponential": (rates((y * dx - x * dy) * exp(x * z)), SPACE, (2,)),
    "knife edge": (KNIFE, [x, y, theta], (2, 3)),
    "rolling disc": (DISC, [x, y, theta, phi, psi], (3, 4, 5)),
    "car": (CAR, [x, y, theta, phi], (2, 3, 4)),
    "tractor with a trailer": (*tractor(1), (2, 3, 4)),
    "tractor with two trailers": (*tractor(2), (2, 3, 4, 5)),
    "tractor with three trailers": (*tractor(3), (2, 3, 4, 5, 6)),
    "two wheels on an axle": (AXLE, [x, y, theta, right, left], (2, 3, 4)),
    "ball on a plane": (ROLL, [x, y, theta, phi, psi], (3, 5)),
    "dx = z dy": (rates(dx - z * dy), SPACE, (2, 3)),
    "dx = z dy, dz = 0": (rates(dx - z * dy, dz), SPACE, (1,)),
    "hidden": (rates(HIDDEN), SPACE, (2,)),
    "x' = a sin t": (rates(dx - a * sin(t)), [x], (0,)),
    "rod of length 1 + t": (positions(x**2 + y**2 - (1 + t) ** 2), [x, y], (1,)),
    "direction that turns": (rates(dx * sin(w * t) - dy * cos(w * t)), [x, y], (1, 2)),
    "x' = y t": (rates(dx - y * t), [x, y], (1, 2)),
    "a turned edge, 60 degrees": (
        rates(dx * sin(theta + sp.pi / 3) - dy * cos(theta + sp.pi / 3)),
        [x, y, theta],
        (2, 3),
    ),
    "zero written long": (rates(dx + (2 * sin(theta + sp.pi / 3) - sin(theta) - sp.sqrt(3) * cos(theta)) * dy),
                          [x, y, theta], (2,)),
    "decimal constants": (rates(sp.Rational("0.1") * dx + (sp.Rational("0.7") * y) * dy), [x, y], (1,)),
    "decimals that cancel": (
        rates(dx + (sp.Rational("0.1") + sp.Rational("0.2") * sin(z) ** 2 + sp.Rational("0.2") * cos(z) ** 2
              - sp.Rational("0.3")) * y * dy), SPACE, (2,)),
}  # fmt: skip


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", rest_slow(GROWTHS, set(GROWTHS) - {"tractor with three trailers"}))
def test_growth(name: str) -> None:
    rows, coordinates, growth = GROWTHS[name]
    verdict = judge(rows, coordinates, t)
    assert verdict.growth == growth
    assert verdict.exact
    assert verdict.complete
    assert verdict.holonomic is (len(growth) == 1)
    assert (growth[0], growth[-1]) == (verdict.DDOF, verdict.GC)
    assert verdict.degree == growth[-1] - growth[0]


def derivative_vanishes(f: sp.Expr, rows: Sequence[Given], coordinates: Sequence[Any]) -> bool:
    """Whether d f/dt is zero along motions that satisfy the rows, at random numbers, by plain linear algebra."""
    speeds = [dot(q) for q in coordinates]
    moving = [*coordinates, *sorted(set().union(*(g.rate.free_symbols for g in rows), f.free_symbols), key=str)]
    for k in range(3):
        point = {s: sp.Float(sp.Rational(3 + 7 * i + 2 * k, 11 + 5 * i), 40) for i, s in enumerate(moving)}
        vectors = []
        for e in [*(g.rate for g in rows), sp.diff(f, t)]:
            flat = sp.expand(e.doit().subs({s: sp.Symbol(f"u{i}") for i, s in enumerate(speeds)}))
            us = [sp.Symbol(f"u{i}") for i in range(len(speeds))]
            vectors.append([*(flat.coeff(u).subs(point) for u in us), flat.subs(dict.fromkeys(us, 0)).subs(point)])
        matrix = sp.Matrix(vectors)
        last: Any = matrix[-1, :]
        share = (matrix[:-1, :] * matrix[:-1, :].T).LUsolve(matrix[:-1, :] * last.T)
        if (last.T - matrix[:-1, :].T * share).norm() > sp.Float("1e-25") * last.norm():
            return False
    return True


INTEGRALS: dict[str, tuple[list[Given], list[Any], list[Any]]] = {
    "y/x": (rates(y * dx - x * dy), [x, y], [y / x]),
    "times an exponential": (rates((y * dx - x * dy) * exp(x * z)), SPACE, [x / y]),
    "two wheels on an axle": (AXLE, [x, y, theta, right, left], [left - right + 2 * w * theta / r]),
    "two rows together": (rates(dx - z * dy, dz), SPACE, [z, x - y * z]),
    "hidden": (rates(HIDDEN), SPACE, [x**2 + y**2 + z**2 - sin(x * y)]),
    "x' = a sin t": (rates(dx - a * sin(t)), [x], [x + a * cos(t)]),
    "rod that grows, by rates": (rates(x * dx + y * dy - 1 - t), [x, y], [t**2 + 2 * t - x**2 - y**2]),
    "rolling on a line": (rates(dx - r * dphi), [x, phi], [r * phi - x]),
    "product": (rates(y * z * dx + x * z * dy + x * y * dz), SPACE, [x * y * z]),
    "a factor of one variable": (rates(dx - x * dpsi - dphi * exp(psi)), [x, psi, phi], [phi - x * exp(-psi)]),
    "a factor of z": (rates((z + 1) * (y * dx + x * dy) - x * y * dz), SPACE, [x * y / (z + 1)]),
    "decay": (rates(dx + w * x), [x], [t * w + sp.log(x)]),
    "circle": (rates((x * dy - y * dx) / (x**2 + y**2) - dtheta), [x, y, theta], [theta - sp.atan(y / x)]),
}


@pytest.mark.sampled(9)
@pytest.mark.parametrize("name", INTEGRALS)
def test_integrals(name: str) -> None:
    rows, coordinates, expected = INTEGRALS[name]
    verdict = judge(rows, coordinates, t)
    assert verdict.missing == 0
    assert len(verdict.integrals) == len(expected)
    for integral, known in zip(verdict.integrals, expected, strict=True):
        assert derivative_vanishes(integral.expression, rows, coordinates), integral
        assert derivative_vanishes(known, rows, coordinates)
        assert set(integral.rows) <= set(verdict.independent)


def test_the_integral_of_an_axle_comes_from_its_two_wheels() -> None:
    (integral,) = judge(AXLE, [x, y, theta, right, left], t).integrals
    assert integral.rows == ("row 2", "row 3")
    assert sp.expand(integral.expression - (left - right + 2 * w * theta / r)) == 0


@pytest.mark.slow
def test_an_integral_that_is_not_elementary_is_said_to_be_missing() -> None:
    """Y z dx − x z dy + y² e^z dz is y² z times d(x/y) + (e^z/z) dz: an exponential integral."""
    verdict = judge(rates(y * z * dx - x * z * dy + y**2 * exp(z) * dz), SPACE, t)
    assert (verdict.holonomic, verdict.missing, verdict.integrals) == (True, 1, ())
    assert "no elementary integral was found for 1 of 1 (tried: exact forms" in verdict.notes[0]


@pytest.mark.slow
def test_natani_finds_what_no_factor_finds() -> None:
    u = x**3 * y + y**3
    form = sp.diff(u, t) * (u * z + 1) + dz * u * u / 2  # d(u²z/2 + u)
    rows = rates(sp.expand(form) * (1 + x**2 + z) * cos(y))
    verdict = judge(rows, SPACE, t)
    assert verdict.holonomic
    for integral in verdict.integrals:
        assert derivative_vanishes(integral.expression, rows, SPACE)


def test_positions_are_their_own_integrals() -> None:
    f = x**2 + y**2 - ell**2
    verdict = judge(positions(f), [x, y], t)
    (integral,) = verdict.integrals
    assert (integral.expression, integral.level, integral.rows) == (f, 0, ("row 1",))
    assert (verdict.GC, verdict.DDOF) == (1, 1)


def test_a_row_given_twice_is_redundant_by_name() -> None:
    rows = [Given("edge", KNIFE[0].rate), Given("again", 3 * x * KNIFE[0].rate), Given("still", dz)]
    verdict = judge(rows, [x, y, z, theta], t)
    assert [(d.name, d.repeats) for d in verdict.redundant] == [("again", ("edge",))]
    assert verdict.independent == ("edge", "still")
    assert verdict.contradictions == ()


@pytest.mark.slow
def test_a_combination_of_rows_names_those_that_it_repeats() -> None:
    rows = rates(dx - z * dy, dz - 2 * dtheta, dtheta + dy, (dx - z * dy) * sin(x) - 5 * (dtheta + dy))
    verdict = judge(rows, [x, y, z, theta], t)
    assert [(d.name, d.repeats) for d in verdict.redundant] == [("row 4", ("row 1", "row 3"))]


@pytest.mark.parametrize(
    ("rows", "repeats"),
    [
        (rates(dx - 1, dx - 2), ("row 1",)),
        (rates(dx - y, dz, 2 * dx - 2 * y - 3 * dz - t), ("row 1", "row 2")),
        (positions(x - 1, x - 2), ("row 1",)),
        (positions(x**2 + y**2 - a**2, sp.sqrt(x**2 + y**2) - 2 * a), ("row 1",)),
        (positions(x - a, y - b, x + y - a - b - 1), ("row 1", "row 2")),
        (positions(x - 1, sp.S.One + t), ()),
    ],
)
def test_contradictions_are_found(rows: list[Given], repeats: tuple[str, ...]) -> None:
    verdict = judge(rows, SPACE, t)
    assert [(d.name, d.repeats) for d in verdict.contradictions] == [(rows[-1].name, repeats)]


@pytest.mark.parametrize(
    "rows",
    [
        positions(x - 1, 2 * x - 2),
        positions(x**2 + y**2 - a**2, sp.sqrt(x**2 + y**2) - a),
        positions(x - a, y - b, x * y - a * b),
        positions(x - y, sin(x - y)),
    ],
)
def test_positions_that_agree_are_redundant(rows: list[Given]) -> None:
    verdict = judge(rows, SPACE, t)
    assert [d.name for d in verdict.redundant] == [rows[-1].name]
    assert verdict.contradictions == ()


def test_values_that_make_a_row_integrable_are_noticed() -> None:
    rows = rates(dx - a * z * dy)
    verdict = judge(rows, SPACE, t, values={a: sp.S.Zero})
    assert verdict.holonomic is False
    assert verdict.special is not None
    assert verdict.special.holonomic is True
    assert judge(rows, SPACE, t, values={a: sp.Rational(1, 2)}).special is None


def test_a_car_whose_wheels_cannot_steer_is_special() -> None:
    """With a = b the two edges are parallel: z' − (a − b) z θ' − …; the bracket is proportional to a − b."""
    rows = rates(dx - a * y * dz, dy - b * x * dz)
    assert judge(rows, SPACE, t, values={a: sp.S.Zero, b: sp.S.Zero}).special is None  # one field and no bracket
    rows = rates(dz - a * y * dx - b * x * dy)
    special = judge(rows, SPACE, t, values={a: sp.Rational(2), b: sp.Rational(2)}).special
    assert special is not None
    assert special.holonomic
    assert sp.simplify(special.integrals[0].expression / (z - 2 * x * y)).is_number


@pytest.mark.parametrize(
    ("row", "growth", "operation"),
    [
        (dx - sp.Abs(z) * dy, (2, 3), "abs"),
        (dx - sp.Max(z, x) * dy, (2, 3), "max"),
        (dx - (1 + z**2) ** sp.Rational(1, 17) * dy, (2, 3), "the power"),
        (sp.Abs(x) * dx - dy, (2,), "abs"),
    ],
)
def test_operations_outside_are_decided_with_many_digits(row: Any, growth: tuple[int, ...], operation: str) -> None:
    verdict = judge(rates(row), SPACE, t)
    assert verdict.growth == growth
    assert not verdict.exact
    assert "50 digits" in verdict.notes[0]
    assert operation in verdict.notes[0]


def test_regions_that_differ_are_said() -> None:
    (_, sides, *_) = judge(rates(dx - sp.Max(z, 0) * dy), SPACE, t).notes
    assert sides == "the growth differs from region to region: (2,), (2, 3)"


def test_an_integral_on_one_side_of_a_kink_is_not_taken() -> None:
    """|x| x' = y' has x|x|/2 − y; x²/2 − y is right for x > 0 alone."""
    verdict = judge(rates(sp.Abs(x) * dx - dy), [x, y], t)
    assert all(derivative_vanishes(i.expression.subs(x, -x), [Given("", -sp.Abs(x) * dx - dy)], [x, y])
               for i in verdict.integrals)  # fmt: skip


def test_depth_is_bounded_and_said() -> None:
    rows, coordinates = tractor(9)
    verdict = judge(rows, coordinates, t, limit=3_000)
    assert not verdict.complete
    assert verdict.GC is None
    assert verdict.holonomic is False
    assert verdict.growth[0] == 2
    assert str(verdict).startswith("nonholonomic by at least")
    assert "brackets were followed to depth" in verdict.notes[0]


def test_nothing_is_decided_where_the_first_brackets_are_too_long() -> None:
    deep = z
    for _ in range(30):
        deep = sin(deep) + y
    verdict = judge(rates(dx - deep * dy, *(dot(q) - deep * dy for q in functions("u v"))), [*functions("x y z u v")],
                    t, limit=10)  # fmt: skip
    assert verdict.holonomic is None or verdict.holonomic is False
    assert not verdict.complete


@pytest.mark.slow
def test_many_rows_of_positions_need_no_brackets() -> None:
    names = functions(" ".join(f"q{k}" for k in range(40)))
    rows = positions(*(names[k] ** 2 + names[k + 1] ** 2 - ell**2 for k in range(39)))
    verdict = judge(rows, names, t)
    assert (verdict.holonomic, verdict.GC, len(verdict.integrals)) == (True, 1, 39)


@pytest.mark.slow
def test_many_rows_of_rates_end() -> None:
    names = functions(" ".join(f"q{k}" for k in range(24)))
    rows = rates(*(dot(names[k]) - names[k + 2] * dot(names[k + 1]) for k in range(22)))
    verdict = judge(rows, names, t)
    assert verdict.DDOF == 2
    assert verdict.holonomic is False


@pytest.mark.parametrize("rate", [dx**2 - 1, dx * dy - z, sin(dx) + dy])
def test_rows_that_are_not_linear_are_refused_by_name(rate: Any) -> None:
    with pytest.raises(ModelError, match=r"constraint 'row 1'.*linear in the rates"):
        judge(rates(rate), SPACE, t)


def test_a_row_that_is_linear_once_it_is_multiplied_out_is_taken() -> None:
    assert judge(rates((dx + 1) ** 2 - dx**2 - dy), [x, y], t).holonomic


def test_a_verdict_reads_in_one_line() -> None:
    assert str(judge(CAR, [x, y, theta, phi], t)) == "nonholonomic by 2: #DDOF = 2, #GC = 4, growth (2, 3, 4)"
    assert str(judge(rates(dx - y * dy), [x, y], t)) == "holonomic: #GC = #DDOF = 1"
    assert isinstance(judge(KNIFE, [x, y, theta], t), Holonomy)


def test_all_random_starts_move_together(monkeypatch: pytest.MonkeyPatch) -> None:
    """A parallelogram, which moves in one way where its rows hold: every step is one evaluation for all starts."""
    calls: list[int] = []
    once = closed.evaluate_together

    def counted(program: Any, groups: Any) -> Any:
        calls.append(max(len(x) for x in groups["q"]))
        return once(program, groups)

    monkeypatch.setattr(closed, "evaluate_together", counted)
    rows = positions(x - sin(left), y - cos(left), x - sin(right), y - cos(right))
    assert judge(rows, [x, y, left, right], t).growth == (1,)
    assert calls[0] == closed.STARTS and len(calls) <= closed.STEPS and calls == sorted(calls, reverse=True)

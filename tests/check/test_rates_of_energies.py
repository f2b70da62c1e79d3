"""Balances of powers: dT/dt and dV/dt are judged as rates of the energies, and what follows from a wrong one."""

from __future__ import annotations

from functools import cache

import pytest
import sympy as sp
from test_rounded_terms import ladder

import lagrangian as lg
from lagrangian.check.verdict import Status

HEAD = (
    "T = 1/2 I psi'^2, I = m l^2/3 + M l^2/9 + (M/3 + mw) l^2 cos(psi)^2, dI/dpsi = -2 (M/3 + mw) l^2 sin(psi) cos(psi)"
)
RATE = "dT/dt = I psi' psi'' + 1/2 (dI/dpsi) psi'^3"
TWICE = "dT/dt = I psi' psi'' + (dI/dpsi) psi'^3"
SLOPE = "((m/2 + 2 M/3 + mw) g l cos(psi) - k l sin(psi) (l cos(psi) - x0))"
FORCE = "F l sin(psi) - c l^2 sin(psi)^2 psi'"
ROW = f"I psi'' + 1/2 (dI/dpsi) psi'^2 + {SLOPE} = {FORCE}"
ROW_TWICE = f"I psi'' + (dI/dpsi) psi'^2 + {SLOPE} = {FORCE}"


@pytest.mark.parametrize("letter", ["T", "E_kin"])
def test_a_right_balance_of_powers_is_right(letter: str) -> None:
    text = "\n".join([HEAD, RATE, f"dV/dt = {SLOPE} psi'", ROW]).replace("T", letter)
    verdict = ladder().check(text)
    assert verdict.right
    assert "⟨" not in str(verdict)


@pytest.mark.slow
@pytest.mark.parametrize("letter", ["T", "E_kin"])
def test_a_wrong_rate_of_the_kinetic_energy_is_the_cause(letter: str) -> None:
    """The inertia depends on the position: its rate is counted with ½."""
    text = "\n".join([HEAD, TWICE, f"dV/dt = {SLOPE} psi'", ROW_TWICE]).replace("T", letter)
    verdict = ladder().check(text)
    open_ones = [f.line.number for f in verdict.findings if not f.status.right and not f.follows]
    assert open_ones == [2]
    assert [f.line.number for f in verdict.findings if f.follows] == [4]
    assert "the factor 2 too much" in str(verdict.mistake.what)
    assert "∂" not in str(verdict.mistake.what) + str(verdict.mistake.why)
    assert "⟨" not in str(verdict)


def test_a_wrong_rate_of_the_potential_energy_is_the_cause() -> None:
    wrong = SLOPE.replace("- k l", "+ k l")
    verdict = ladder().check(f"{HEAD}\n{RATE}\ndV/dt = {wrong} psi'\n{ROW.replace(SLOPE, wrong)}")
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [3]
    assert [f.line.number for f in verdict.findings if f.follows] == [4]


def test_a_rate_of_an_energy_beside_forces_is_an_equation_of_motion() -> None:
    """What the rate of T is by the forces is Newton's law, no derivative."""
    verdict = ladder().check(f"{HEAD}\ndT/dt = ({FORCE}) psi' - {SLOPE} psi'\n{ROW}")
    assert verdict.right
    assert not ladder().check(f"{HEAD}\ndT/dt = ({FORCE}) psi' + {SLOPE} psi'\n{ROW_TWICE}").right


INERTIA = "I(psi) = m l^2/3 + M l^2/9 + (M/3 + mw) l^2 cos(psi)^2"
PRIMED = [
    ("T = 1/2 I(psi) psi'^2", True),
    ("dT/dpsi' = I psi'", True),
    ("dT/dpsi = 1/2 I' psi'^2", True),
    ("dT/dpsi = I' psi'^2", False),
    ("d/dt dT/dpsi' = I psi'' + I' psi'", True),
    ("d/dt dT/dpsi' = I psi'' + I'(psi) psi'^2", True),
    ("d/dt dT/dpsi' = I psi'' + I' psi'^2", True),
    ("d/dt dT/dpsi' = I psi'' + 1/2 I' psi'^2", False),
    ("dT/dt = I psi' psi'' + 1/2 I' psi'^2", True),
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize(("line", "right"), PRIMED)
def test_a_prime_of_a_function_of_a_coordinate_is_its_slope_before_a_square(line: str, right: bool) -> None:
    """And its rate elsewhere."""
    verdict = ladder().check(
        f"T = 1/2 I(psi) psi'^2, {INERTIA}\n{line}\n{ROW.replace('(dI/dpsi)', 'DI')}\n".replace("DI", "I'(psi)")
    )
    found = [f.status.right for f in verdict.findings if f.line.number == 2]
    assert found and all(found) == right, str(verdict)


SHORT = "T = 1/2 I psi'^2, I = m l^2/3 + M l^2/9 + (M/3 + mw) l^2 cos(psi)^2"
INNER = "2 (M/3 + mw) l^2 sin(psi) cos(psi)"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("rate", "right"),
    [
        ("dT/dt = I psi' psi'' + 1/2 I' psi'^3", True),
        (f"dT/dt = I psi' psi'' + 1/2 I' psi'^3 = I psi' psi'' - 1/2 {INNER} psi'^3", True),
        ("dT/dt = I psi' psi'' + 1/2 I' psi'^2", True),
        ("dT/dt = I psi' psi'' + I' psi'^3", False),
        (f"dT/dt = I psi' psi'' + I' psi'^3 = I psi' psi'' - {INNER} psi'^3", False),
        ("dT/dt = I psi' psi'' + I' psi'^2", False),
    ],
)
def test_a_prime_is_the_slope_where_only_so_the_terms_beside_it_fit(rate: str, right: bool) -> None:
    """I' ψ'³ beside I ψ' ψ'' has a dot too many with the rate; I' ψ'² has as many as it."""
    row = ROW if right else ROW_TWICE
    verdict = ladder().check(f"{SHORT}\n{rate}\n{row.replace('(dI/dpsi)', f'(-{INNER})')}")
    assert all(f.status.right for f in verdict.findings if f.line.number == 2) == right, str(verdict)
    assert verdict.right == right
    if not right:
        assert "the factor 2 too much" in str(verdict.mistake.what)
        assert "4" not in str(verdict.mistake.what)  # no ψ̇⁴


def test_a_written_derivative_by_time_is_no_slope() -> None:
    for rate in ("dI/dt psi'^3", "(dI/dt) psi'^3", "d/dt(I) psi'^3"):
        verdict = ladder().check(
            f"{SHORT}\ndT/dt = I psi' psi'' + 1/2 {rate}\n{ROW.replace('(dI/dpsi)', f'(-{INNER})')}"
        )
        assert not all(f.status.right for f in verdict.findings if f.line.number == 2), rate


@cache
def swing() -> lg.Derivation:
    """A rod in a hinge with friction and a spring: J θ̈ + c θ̇ + k θ + m g l sin θ = 0."""
    s = lg.System("swing")
    theta = s.coordinate("theta")
    m, l, J, k, c, g = s.parameters("m l J k c g")
    s.particle(m, at=s.point("A", (l * sp.sin(theta), -l * sp.cos(theta))), name="ball")
    s.kinetic(J * theta.diff() ** 2 / 2, name="rod")
    s.gravity((0, -1), g)
    s.spring(k, deflection=theta, name="spring")
    s.damper(c, deflection=theta, name="hinge")
    return s.derive()


@pytest.mark.parametrize(
    "power", ["E = T + V\n\ndE/dt = P = -c theta'^2", "E = T + V\n\ndE/dt = -c theta'^2", "d(T + V)/dt = -c theta'^2"]
)
def test_the_rate_of_a_potential_energy_leaves_it_one(power: str) -> None:
    """dV/dt beside a V of positions and a T: V is no name of something else, and dT/dt is judged, too."""
    first, _, rest = power.rpartition("\n\n")
    head = f"{first}\nT = 1/2 (J + m l^2) theta'^2\nV = 1/2 k theta^2 - m g l cos(theta)\n{rest}\n"
    rates = "dT/dt = (J + m l^2) theta' theta''\ndV/dt = k theta theta' + m g l sin(theta) theta' = {} theta'\n"
    row = "(J + m l^2) theta'' + c theta' + k theta + m g l sin(theta) = 0"
    given = head + rates.format("(k theta + m g l sin(theta))") + row
    verdict = swing().check(given)
    assert verdict.right
    assert {"T", "V"} <= {f.line.kind for f in verdict.findings}
    assert not any("T + V" in str(note) for note in verdict.notes)
    for wrong in (given.replace("theta' theta''", "2 theta' theta''"), given.replace("= (k theta", "= (2 k theta")):
        assert any(f.status is Status.WRONG for f in swing().check(wrong).findings)
    assert not swing().check(given.replace("-c theta'^2", "c theta'^2").replace("+ c theta'", "- c theta'")).right

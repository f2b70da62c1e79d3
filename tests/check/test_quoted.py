"""What is told quotes only what the student wrote: over random answers, for D, and beside names of lines."""

from __future__ import annotations

import random
import re
from typing import cast

import pytest
import sympy as sp
from sympy.core.function import AppliedUndef

import lagrangian as lg
from built_in import derivation
from lagrangian.check.reference import truth_of
from lagrangian.page.plain import plain

QUOTED = re.compile(
    r"(?:^|In [^.]*, |: )([^.,:]+?) stands in place of |(?:taken|made of|stretched by) (?:as )?([^.;]+?)[.;]"
)
"""What a sentence says was written."""


def names(text: str) -> set[str]:
    return set(re.findall(r"[A-Za-z_][A-Za-z0-9_]*", text))


def mutated(rows: list[sp.Expr], symbols: list[sp.Symbol], source: random.Random) -> list[sp.Expr]:
    """The rows with one letter lost, replaced, squared or inverted, or a term left out or turned, in one row or all."""
    here = source.choice([None, *range(len(rows))])
    kind = source.randrange(5)
    letter, other = source.choice(symbols), source.choice(symbols)
    new = {0: sp.S.One, 1: other, 2: letter**2, 3: 1 / letter}.get(kind)
    found: list[sp.Expr] = []
    for i, row in enumerate(rows):
        if here not in (None, i):
            found.append(row)
        elif new is not None:
            found.append(cast("sp.Expr", row.subs(letter, new)))
        else:
            term = source.choice(sp.Add.make_args(sp.expand(row)))
            found.append(sp.expand(row) - source.choice([1, 2, sp.S.Half]) * term)
    return found


def check_quotes(name: str, count: int) -> int:
    """The number of sentences in which something is quoted, all of which stands in the answer."""
    d = derivation(name)
    truth, source = truth_of(d), random.Random(name)
    symbols = [p.symbol for p in truth.model.parameters]
    known = {x.name for x in (*truth.model.parameters, *truth.model.coordinates, *truth.model.inputs)}
    quotes = 0
    for _ in range(count):
        rows = mutated(list(truth.rows), symbols, source)
        verdict = d.check([sp.Eq(r, 0) for r in rows])
        written = {plain(x) for r in rows for x in (*r.free_symbols, *r.atoms(AppliedUndef))}
        for mistake in (*verdict.mistakes, *verdict.alternatives):
            for match in QUOTED.finditer(str(mistake.what)):
                said = names(match.group(1) or match.group(2)) & known
                quotes += bool(said)
                assert said <= written, f"{rows}: {mistake.what}"
    return quotes


@pytest.mark.slow
def test_no_sentence_quotes_what_was_not_written() -> None:
    assert check_quotes("two-disk-shaft", 20) > 0


@pytest.mark.slow
@pytest.mark.thinned(3)
@pytest.mark.parametrize(
    "name", ["cart-pole", "double-pendulum", "quarter-car", "lecture-1", "rolling-cylinder", "wedge"]
)
def test_no_sentence_quotes_what_was_not_written_in_many_answers(name: str) -> None:
    check_quotes(name, 60)


def test_no_letter_stands_in_place_of_another_where_none_is_left() -> None:
    """ω = r₁θ̇/r₂: with ω = θ̇ both radii are lost, and r₂ does not stand in place of r₁."""
    s = lg.System("gear")
    theta = s.coordinates("theta")
    J, r1, r2, tau = *s.parameters("J r_1 r_2"), s.inputs("tau")
    frame = s.frame(r1 * theta / r2)
    s.rigid_body(0, J, at=s.origin, frame=frame, name="wheel")
    s.torque(tau, on=theta, name="motor")
    verdict = s.derive().check("J*theta'' = tau")
    assert verdict.mistakes
    for mistake in (*verdict.mistakes, *verdict.alternatives):
        assert "in place of" not in str(mistake.what), str(mistake.what)


@pytest.mark.slow
@pytest.mark.parametrize(
    "wrong", ["b*x1'^2/2", "b*x2r'^2", "b*(x1' + x2r')^2/2", "b*x1'*x2r'/2", "b*(x1'^2 + x2r'^2)/2"]
)
def test_a_dissipation_has_no_ends(wrong: str) -> None:
    s = lg.System("two carts and a damper")
    x1, x2r = s.coordinates("x1 x2r")
    m1, m2, b = s.parameters("m1 m2 b")
    one = s.origin + (x1, 0)
    s.particle(m1, at=one, name="cart 1")
    s.particle(m2, at=one + (x2r, 0), name="cart 2")
    s.damper(b, between=(one, one + (x2r, 0)), name="damper")
    verdict = s.derive().check(f"D = {wrong}")
    assert not verdict.right
    for mistake in (*verdict.mistakes, *verdict.alternatives):
        said = str(mistake.what)
        assert not any(x in said for x in (" end ", "reaction", "equation of")), said


def test_the_name_of_a_line_is_no_term() -> None:
    with pytest.raises(lg.ParseError, match="what is 'Q7'"):
        derivation("pendulum").check("m*L^2*theta'' + m*g*L*sin(theta) + b*theta' = Q7")


def test_a_spring_that_is_missing_is_no_matter_of_kinetic_energy() -> None:
    verdict = derivation("lecture-3b").check("(m1+m2)*x1'' + m2*x2r'' = 0\nm2*(x1''+x2r'') = F")
    (mistake,) = verdict.mistakes
    assert mistake.element == "spring 'k'" and mistake.step in (3, 5)


def test_a_factor_two_beside_a_missing_force_is_told_of_the_force() -> None:
    """The equations hold one acceleration each and may be halved: the kinetic energy is not to blame for it."""
    rows = "m1*x1'' + k*(x1 - x2) = -F\nm2*x2'' + k*(x2 - x1) = F"
    wrong = rows.replace(" = -F", " = 0").replace("+ k*(x2 - x1)", "+ 2*k*(x2 - x1)")
    verdict = derivation("lecture-3a").check(wrong)
    assert {m.element for m in verdict.mistakes} == {"force 'F'", "spring 'k'"}, [str(m.what) for m in verdict.mistakes]

"""Two derivations side by side: the lecture's comparison row by row, systems that differ, and the report of both."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import sympy as sp
from typer.testing import CliRunner

import built_in
import lagrangian as lg
from lagrangian import examples
from lagrangian.cli import main
from lagrangian.cli.app import app
from size import rest_slow


def _example(name: str) -> lg.System:
    return built_in.system(name)


def _words(found: lg.Comparison) -> list[str]:
    return [str(r.words) for r in found.rows]


# -- the lecture ------------------------------------------------------------------------------------------------------


def test_the_lecture_s_example_3_row_by_row() -> None:
    found = lg.compare(_example("lecture-3a"), _example("lecture-3b"))
    assert found.same
    assert found
    assert sp.ImmutableMatrix([[1, 0], [1, 1]]) == found.J
    # lecture 9: "Equation B-2 matches 2r. Now, add B-1 and B-2 … Matches 1r!"
    assert _words(found) == ["Add B-1 and B-2: matches 1r.", "Equation B-2 matches 2r."]
    assert [str(r.check.what) for r in found.rows] == ["1r = B-1 + B-2", "2r = B-2"]
    assert [r.check.figure for r in found.rows] == ["exact", "exact"]
    assert [r.source for r in found.rewritten] == ["1a", "2a"]
    x1, x2r = (sp.Function(n)(sp.Symbol("t")) for n in ("x1", "x2r"))
    m1, m2, k = sp.symbols("m1 m2 k")
    F = sp.Function("F")(sp.Symbol("t"))
    a1, a2 = (sp.Derivative(x, (sp.Symbol("t"), 2)) for x in (x1, x2r))
    first, second = found.rewritten
    # lecture 9: B-1 is -F = m1 x1'' - k x2r, B-2 is F = m2 x1'' + m2 x2r'' + k x2r
    assert (sp.Add(*first.left), sp.Add(*first.right)) == (m1 * a1 - k * x2r, -F)
    assert (sp.Add(*second.left), sp.Add(*second.right)) == (m2 * a1 + m2 * a2 + k * x2r, F)


def test_the_other_way_round() -> None:
    found = lg.compare(_example("lecture-3b"), _example("lecture-3a"))
    assert _words(found) == ["From B-1 subtract B-2: matches 1a.", "Equation B-2 matches 2a."]
    assert [str(r.words) for r in found.back] == ["Add 1a and 2a: matches B-1.", "Equation 2a matches B-2."]


def test_the_lecture_s_example_2_relative_and_absolute() -> None:
    found = lg.compare(_example("lecture-2-absolute"), _example("lecture-2"))
    assert found.same
    assert [str(r.check.what) for r in found.rows] == ["1r = B-1 + B-2", "2r = B-2"]
    assert all(c.holds and c.figure == "exact" for c in (*found.energies, *found.forces))
    text = found.to_text()
    assert "θ_2a = θ₁ + θ_2r" in text  # one letter, two angles
    assert "Now, add B-1 and B-2:" in text


def test_generalized_forces_are_j_transposed_times_the_old_ones() -> None:
    found = lg.compare(_example("lecture-2-absolute"), _example("lecture-2"))
    assert found.J is not None
    old, new = (sp.Matrix(list(s.derivation.Xi.values())) for s in (found.a, found.b))
    assert found.J.T * old == new


# -- other coordinates ------------------------------------------------------------------------------------------------


@pytest.mark.sampled(6)
@pytest.mark.parametrize(
    ("name", "change"),
    [
        pytest.param(
            "triple-pendulum", {"theta3": "theta2 + theta3", "theta2": "theta1 + theta2"}, marks=pytest.mark.slow
        ),
        pytest.param("spring-net", {"x1": "r*cos(a)", "y1": "r*sin(a)"}, marks=pytest.mark.slow),
        ("cart-pole", {"theta": "phi - pi/2"}),
        ("elastic-pendulum", {"r": "sqrt(x^2 + y^2)", "theta": "atan2(x, -y)"}),
        ("spherical-pendulum", {"phi": "psi - theta"}),
        ("quarter-car", {"z_u": "z_u/2 + 3*z_s"}),
        ("crane", {"l": "l + x"}),
        pytest.param("furuta-pendulum", {"theta2": "theta2 - theta1"}, marks=pytest.mark.slow),
        pytest.param("scara", {"theta2": "psi - theta1"}, marks=pytest.mark.slow),
    ],
)
def test_the_change_is_found_from_what_both_put_in_the_same_places(name: str, change: dict[str, str]) -> None:
    system = _example(name)
    found = system.compare(system.in_coordinates(change))
    assert found.same
    assert not found.assumed
    assert all(r.holds for r in (*found.rows, *found.back))
    assert found.change is not None
    assert found.change.replaced


@pytest.mark.parametrize("links", [3, pytest.param(6, marks=[pytest.mark.slow, pytest.mark.exhaustive])])
def test_chains_absolute_and_relative(links: int) -> None:
    def chain(relative: bool) -> lg.System:
        s = lg.System("chain")
        m, L = s.parameters("m L")
        at, angle = s.origin, sp.S.Zero
        for i in range(links):
            q = s.coordinate(f"q{i}")
            angle = angle + q if relative else q
            at = at + (L * sp.sin(angle), -L * sp.cos(angle))
            s.particle(m, at=at, name=f"bob {i}")
        s.gravity()
        return s

    found = lg.compare(chain(False), chain(True))
    assert found.same
    assert {r.check.figure for r in found.rows} == {"exact"}
    last = found.rows[0]
    assert str(last.check.what) == "1r = " + " + ".join(f"B-{i + 1}" for i in range(links))


def test_energies_alone_are_compared_with_a_change_that_is_said() -> None:
    t = sp.Symbol("t")
    x, y, u, v = (sp.Function(n)(t) for n in "xyuv")
    m, k = sp.symbols("m k")
    F = sp.Function("F")(t)
    a = lg.System.from_energies((x, y), T=m * (x.diff(t) ** 2 + y.diff(t) ** 2) / 2, V=k * (x - y) ** 2 / 2, Xi=[F, 0])
    b = lg.System.from_energies(
        (u, v), T=m * (u.diff(t) ** 2 + v.diff(t) ** 2), V=2 * k * v**2, Xi=[F, F], name="sum and difference"
    )
    with pytest.raises(lg.ModelError, match="cannot be found by comparing"):
        lg.compare(a, b)
    assert lg.compare(a, b, {x: u + v, y: u - v}).same
    turned = lg.compare(a, b, {"u": "(x + y)/2", "v": "(x - y)/2"})
    assert turned.same
    assert turned.source.tag == "B"
    assert "A-1" in str(turned.rows[0].words)


def test_the_change_may_say_one_system_s_coordinates_or_the_other_s() -> None:
    a, b = _example("lecture-3a"), _example("lecture-3b")
    assert a.compare(b, {"x2": "x1 + x2r"}).same
    assert a.compare(b, {"x2r": "x2 - x1"}).same
    wrong = a.compare(b, {"x2": "2*x2r + x1"})
    assert not wrong.same


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"x3": "x1"}, "no coordinate 'x3'"),
        ({"x2": "x1 + x2r'"}, "holds"),
        ({"x2": "x1 + z"}, "unknown symbol"),
        ({"x2": "x1"}, "singular"),
        ({"x2": sp.Symbol("q")}, "holds 'q'"),
        ({"x1": "x1"}, "does not say what 'x2'"),
        (["x2"], "mapping"),
    ],
)
def test_a_change_that_is_none_is_refused(change: Any, words: str) -> None:
    with pytest.raises(lg.ModelError, match=words) as caught:
        lg.compare(_example("lecture-3a"), _example("lecture-3b"), change)
    assert caught.value.fix


def test_what_is_no_system_is_refused() -> None:
    with pytest.raises(lg.ModelError, match="the second of the two is not a system"):
        lg.compare(_example("lecture-3a"), "lecture-3b")  # type: ignore[arg-type]


# -- systems that differ ----------------------------------------------------------------------------------------------

ABSOLUTE = examples.text("lecture-3a")
RELATIVE = examples.text("lecture-3b")
ARM = examples.text("lecture-2")


def _edited(text: str, old: str, new: str) -> str:
    assert old in text
    return text.replace(old, new)


DIFFERENT = {
    "another spring constant": (
        ABSOLUTE,
        _edited(RELATIVE, 'k = "k"', 'k = "3*k"'),
        (3, "V", None, "spring 'k'", "spring 1"),
    ),
    "another deflection": (
        ABSOLUTE,
        _edited(RELATIVE, 'k = "k"\ndeflection = "x2r"', 'k = "k"\ndeflection = "x1 + x2r"'),
        (3, "V", None, "spring 'k'", "spring 'k'"),
    ),
    "no spring": (
        ABSOLUTE,
        _edited(RELATIVE, '[[spring]]\nk = "k"\ndeflection = "x2r"\n', ""),
        (3, "V", None, "spring 'k'", None),
    ),
    "a damper more": (
        _edited(ABSOLUTE, "[simulate]", '[[damper]]\nb = "3"\ndeflection = "x2 - x1"\n\n[simulate]'),
        RELATIVE,
        (6, "Xi", "x2r", "damper 1", None),
    ),
    "the reaction missing": (
        ABSOLUTE,
        _edited(RELATIVE, 'value = "F"\ndeflection = "x2r"', 'value = ["F", "0"]\nat = "cart2"'),
        (6, "Xi", "x1", "force 'F'", "force 'F'"),
    ),
    "another mass": (
        ABSOLUTE,
        _edited(RELATIVE, 'mass = "m2"', 'mass = "m1"'),
        (2, "T*", None, "particle 'm2'", "particle 'm1 2'"),
    ),
    "gravity upwards": (
        ARM,
        _edited(examples.text("lecture-2-absolute"), "direction = [0, -1]", "direction = [0, 1]"),
        (3, "V", None, "gravity 'g'", "gravity 'g'"),
    ),
    "the motor on the ground": (
        ARM,
        _edited(examples.text("lecture-2-absolute"), 'reaction = "theta1"', ""),
        (6, "Xi", "theta1", "torque 'tau'", "torque 'tau'"),
    ),
}


@pytest.mark.sampled(2)
@pytest.mark.parametrize("case", rest_slow(DIFFERENT, list(DIFFERENT)[::4]))
def test_systems_that_differ_and_where_first(case: str) -> None:
    one, other, expected = DIFFERENT[case]
    found = lg.compare(lg.loads(one), lg.loads(other))
    assert not found.same
    assert not found.equations_same
    assert not all(r.holds for r in found.rows)
    first = found.differences[0]
    assert (first.step, first.quantity, first.coordinate, first.element_a, first.element_b) == expected
    assert first.term != 0
    assert "The first difference." in found.to_text()
    back = lg.compare(lg.loads(other), lg.loads(one)).differences[0]
    assert (back.step, back.quantity, back.element_a, back.element_b) == (*expected[:2], expected[4], expected[3])


def test_what_is_left_over_is_the_difference_of_the_equations() -> None:
    one, other, _ = DIFFERENT["the reaction missing"]
    found = lg.compare(lg.loads(one), lg.loads(other))
    assert [r.rest for r in found.rows] == [-sp.Function("F")(sp.Symbol("t")), 0]


def test_another_value_is_another_motion() -> None:
    found = lg.compare(lg.loads(ABSOLUTE), lg.loads(_edited(RELATIVE, '"40 N/m"', '"60 N/m"')))
    assert found.equations_same
    assert not found.same
    assert [(p.name, p.a, p.b) for p in found.parameters] == [("k", 40.0, 60.0)]
    assert "not the same values" in found.to_text()


def test_another_datum_of_height_is_no_difference() -> None:
    higher = _edited(ARM, "direction = [0, -1]", 'direction = [0, -1]\ndatum = "top"')
    higher = _edited(higher, "[points]\n", '[points]\ntop = ["0", "L_a"]\n')
    found = lg.compare(lg.loads(ARM), lg.loads(higher))
    assert found.same
    assert "up to what does not depend on the coordinates" in found.to_text()


def test_the_same_force_booked_as_a_potential_is_the_same_motion() -> None:
    booked = _edited(
        RELATIVE, '[[spring]]\nk = "k"\ndeflection = "x2r"', '[[force]]\nvalue = "-k*x2r"\ndeflection = "x2r"'
    )
    found = lg.compare(lg.loads(ABSOLUTE), lg.loads(booked))
    assert found.same
    assert [d.quantity for d in found.differences] == ["V", "Xi"]
    assert "count the same forces in different places" in found.to_text()


def test_more_coordinates_are_another_system() -> None:
    found = lg.compare(_example("pendulum"), _example("double-pendulum"))
    assert not found.same
    assert found.why is not None
    assert "(A) has 1 generalized coordinate and (B) has 2" in found.to_text()


def test_definitions_of_one_name_and_another_meaning_are_told_apart() -> None:
    def with_length(length: sp.Expr | int) -> lg.System:
        s = lg.System("pendulum")
        q = s.coordinate("q")
        m, a = s.parameters("m a")
        L = s.define("L", length * a)
        s.particle(m, at=s.origin + (L * sp.sin(q), -L * sp.cos(q)))
        s.gravity()
        return s

    assert lg.compare(with_length(2), with_length(2)).same
    found = lg.compare(with_length(2), with_length(3))
    assert not found.same
    assert found.assumed


# -- reports and the command ------------------------------------------------------------------------------------------


@pytest.mark.sampled(4)
@pytest.mark.parametrize("notation", ["lecture", "physics", "robotics"])
def test_every_format_is_written(notation: Any) -> None:
    found = lg.compare(_example("lecture-3a"), _example("lecture-3b"))
    assert "(B-1)" in found.to_text(notation=notation)
    assert "B-1" in found.to_markdown(notation=notation)
    assert r"\begin{document}" in found.to_latex(notation=notation)
    assert "<math" in found.to_html(notation=notation)
    assert "<math" in found._repr_html_()


def test_the_data_says_the_same() -> None:
    data = lg.compare(_example("lecture-3a"), _example("lecture-3b")).to_dict()
    assert data["same"] is True
    assert data["J"] == [["1", "0"], ["1", "1"]]
    assert data["change"] == {
        "of": "A",
        "in": "B",
        "coordinates": {"x1": "x1", "x2": "x1 + x2r"},
        "assumed": False,
    }
    assert data["rewritten"][0]["equation"] == "m1*x1'' - k*x2r = -F"
    assert data["rows"][0]["factors"] == {"B-1": "1", "B-2": "1"}
    json.dumps(data, allow_nan=False)


@pytest.mark.slow
def test_the_command_and_its_exits(tmp_path: Path) -> None:
    run = CliRunner()
    same = run.invoke(app, ["compare", "-e", "lecture-3a", "-e", "lecture-3b"])
    assert same.exit_code == 0
    assert "Equation B-2 matches 2r." in same.stdout
    file = tmp_path / "mine.toml"
    file.write_text(DIFFERENT["no spring"][1], encoding="utf-8")
    differ = run.invoke(app, ["compare", str(file), "-e", "lecture-3a", "--json"])
    assert differ.exit_code == 1
    assert json.loads(differ.stdout)["differences"][0]["B"]["element"] == "spring 'k'"
    said = run.invoke(app, ["compare", "-e", "lecture-3a", "-e", "lecture-3b", "--change", "x2 = x1 + x2r"])
    assert said.exit_code == 0


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    "arguments",
    [
        ["compare", "-e", "lecture-3a"],
        ["compare", "-e", "lecture-3a", "-e", "lecture-3b", "-e", "pendulum"],
        ["compare", "-", "-"],
        ["compare", "-e", "lecture-3a", "-e", "lecture-3b", "--change", "x2"],
        ["compare", "-e", "lecture-3a", "-e", "lecture-3b", "--change", "x2=x1+x2r", "--change", "x2=x1"],
        ["compare", "-e", "lecture-3a", "-e", "no-such-example"],
        ["compare", "-e", "lecture-3a", "-e", "lecture-3b", "--change", "x2 = 9^9^9^9"],
        ["compare", "-e", "lecture-3a", "-e", "lecture-2"],
        ["compare", "no-such-file.toml", "-e", "lecture-2"],
    ],
)
def test_a_mistake_in_what_was_given_is_exit_2(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == 2
    captured = capsys.readouterr()
    assert not captured.out
    assert "Traceback" not in captured.err


@pytest.mark.slow
def test_kinks_and_roots_are_compared_too() -> None:
    s = lg.System("cart on a rail")
    x = s.coordinate("x")
    s.particle(s.parameter("m"), at=s.origin + (x, 0))
    s.spring(4, deflection=sp.sqrt(4 + x**2))
    s.damper(law=lambda rate: sp.sign(rate) * rate**2, deflection=x)
    found = s.compare(s.in_coordinates({"x": "y^3 + y"}))
    assert found.same
    assert str(found.rows[0].check.what) == "1b = (3*y^2 + 1) (B-1)"
    assert found.back[0].holds


@pytest.mark.slow
def test_a_long_row_of_carts_is_solved_by_elimination() -> None:
    def row(relative: bool) -> lg.System:
        s = lg.System("row")
        at, before, k = s.origin, None, s.parameter("k")
        for i in range(8):
            q = s.coordinate(f"q{i}")
            at = (at if relative else s.origin) + (q, 0)
            s.particle(s.parameter(f"m{i}"), at=at)
            s.spring(k, deflection=q if relative or before is None else q - before)
            before = q
        return s

    found = lg.compare(row(True), row(False))
    assert found.same
    assert found.J is not None
    # each relative coordinate is a difference of neighbours
    assert sp.ImmutableMatrix(8, 8, lambda i, j: int(i == j) - int(i == j + 1)) == found.J

"""Exercises: sheets, solutions and variants; the oracle of a variant is `check`, with its own model file."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from functools import cache
from pathlib import Path

import pytest

import lagrangian as lg
from built_in import derivation
from lagrangian.check import Status
from lagrangian.cli import main
from lagrangian.errors import Error, ModelError, ParseError
from lagrangian.worksheet.dice import Dice
from lagrangian.worksheet.letters import new_letters, relabelled
from lagrangian.worksheet.proof import sheet_checks


@cache
def sheet(name: str, seed: int | None) -> lg.Worksheet:
    return lg.example(name).worksheet(seed=seed)


def kinds(system: lg.System) -> list[str]:
    return sorted(e.kind for e in system.model.elements)


def check_variant(name: str, seed: int) -> None:
    made = sheet(name, seed)
    saved = lg.loads(made.to_toml())
    original = lg.example(name)
    assert len(saved.model.coordinates) == len(original.model.coordinates)
    assert kinds(saved) == kinds(original)
    judge = saved.derive()
    assert judge.check(made.solution("markdown"), hint=0).right
    if made.substantial:
        try:
            copied = judge.check(derivation(name).to_markdown(), hint=0)
        except ParseError as asked:  # the variant has other letters
            assert asked.code == "E402", asked
        else:
            assert copied.status is Status.WRONG, made.changes


@pytest.mark.slow
def test_a_variants_own_solution_is_right_and_a_copied_one_wrong() -> None:
    check_variant("lecture-3b", 1)


@pytest.mark.thinned(7)
@pytest.mark.slow
@pytest.mark.parametrize("seed", [1, 2, 3])
@pytest.mark.parametrize(
    "name",
    ["lecture-1", "lecture-2", "lecture-2-absolute", "lecture-3a", "lecture-3b", "two-carts", "cart-pole"]
    + ["three-masses", "quarter-car", "crane", "double-pendulum", "double-pendulum-relative", "furuta-pendulum"],
)
def test_variants_of_many_systems(name: str, seed: int) -> None:
    check_variant(name, seed)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["lecture-1", "lecture-2", "lecture-3b", "cart-pole", "three-masses", "quarter-car"])
def test_systems_with_forces_have_variants_that_differ_in_substance(name: str) -> None:
    assert all(sheet(name, seed).substantial for seed in (1, 2, 3))


@pytest.mark.slow
def test_the_same_seed_gives_the_same_bytes() -> None:
    made, again = sheet("lecture-3b", 1), lg.example("lecture-3b").worksheet(seed=1)
    assert made.to_toml() == again.to_toml()
    for format in ("text", "markdown", "latex", "html"):
        assert made.question(format) == again.question(format)
    assert made.solution("latex", brief=True) == again.solution("latex", brief=True)
    assert sheet("lecture-3b", 3).to_toml() != made.to_toml()


def test_a_question_sheet_says_what_is_given_and_asks_for_seven_steps() -> None:
    words = sheet("cart-pole", None).question()
    flat = " ".join(words.split())
    assert "A cart on a horizontal track; a pole hinged on the cart." in flat
    assert "Force F is positive to the right." in flat
    assert "pole, from upright, positive where it leans forward" in flat
    assert "pole (mass) 0.2 kg" in flat and "0.006 kg·m²" in flat and "gravitational acceleration 9.81 m/s²" in flat
    assert [line[0] for line in words.splitlines() if re.match(r"[0-6]   ", line)] == list("0123456")
    assert "ẍ" not in words  # nothing of the solution


def test_a_question_sheet_has_the_figure_where_the_format_has_figures() -> None:
    made = sheet("lecture-3b", None)
    assert "<svg" in made.question("html") and r"\begin{tikzpicture}" in made.question("latex")
    assert "Spring k between cart m₁ and cart m₂" in " ".join(made.question().split())


@pytest.mark.slow
def test_words_follow_what_a_variant_changes() -> None:
    found = (sheet("lecture-3b", seed) for seed in range(100, 130))
    made = next(m for m in found if {"x2r absolute"} < {*m.changes} and not any("spring" in c for c in m.changes))
    assert made.substantial
    one, two = made.model.coordinates
    assert two.description == one.description.replace("cart 1", "cart 2")
    assert "relative" not in made.model.name and "pushes the carts apart" not in made.question()


@pytest.mark.slow
def test_a_coordinate_is_relative_to_one_that_stays() -> None:
    """q2 relative to mass 1 means that mass 2 is at q1 + q2, so q1 itself is not turned round."""
    made = sheet("three-masses", 3)
    (what,) = [c for c in made.changes if "relative" in c]
    assert what == "x2 relative to x1" and "x1 the other way round" not in made.changes
    first, second, third = (made.model.position(b.at)[0] for b in made.model.bodies)
    q1, q2, q3 = (c.symbol for c in made.model.coordinates)
    assert first == q1 and second == q1 + q2 and abs(third.coeff(q3)) == 1


def test_letters_keep_their_index_and_never_collide() -> None:
    pools = [("m1", ("m", "M")), ("m2", ("m", "M")), ("k", ("k", "c")), ("l_a", ("l", "a"))]
    for seed in range(20):
        found = new_letters(pools, ["c", "M3"], Dice(seed))
        assert found["m1"] == "M1" and found["m2"] == "M2"
        assert found["k"] == "k"  # c is taken
        assert found["l_a"] == "l_a"  # a is an index already


def test_dice_are_the_same_everywhere() -> None:
    dice = Dice(7, 1)
    assert dice.shuffled(range(8)) == Dice(7, 1).shuffled(range(8))
    assert sorted(dice.shuffled("abc")) == ["a", "b", "c"]
    drawn = {Dice(seed, 1).one("abcd") for seed in range(60)}
    assert drawn == set("abcd")


def test_wrong_arguments() -> None:
    for seed in (-1, 1.5, True):
        with pytest.raises(ModelError, match="seed"):
            lg.example("pendulum").worksheet(seed=seed)  # type: ignore[arg-type]
    with pytest.raises(ModelError, match="sheet"):
        sheet("lecture-3b", None).question("pdf")  # type: ignore[arg-type]


@pytest.mark.slow
def test_the_command_writes_sheets_solutions_and_models(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    sheets = tmp_path / "sheets"
    assert (
        main(["worksheet", "-e", "pendulum", "--variants", "1", "--seed", "5", "-o", str(sheets), "-f", "latex"]) == 0
    )
    said = capsys.readouterr().err
    assert "other letters and values" in said
    assert "not read back: --verify" in said
    assert said.count("wrote ") == 3 == len(list(sheets.iterdir()))
    names = ["pendulum-5-questions.tex", "pendulum-5-solution.tex", "pendulum-5.toml"]
    assert sorted(p.name for p in sheets.iterdir()) == names
    answer = tmp_path / "answer.tex"
    answer.write_text((sheets / names[1]).read_text(encoding="utf-8"), encoding="utf-8")
    assert main(["check", str(sheets / names[2]), str(answer), "--hint", "0"]) == 0
    capsys.readouterr()
    assert (
        main(["worksheet", "-e", "pendulum", "--variants", "1", "--seed", "5", "-o", str(sheets), "-f", "latex"]) == 2
    )
    assert "exists already" in capsys.readouterr().err
    assert main(["worksheet", "-e", "pendulum"]) == 0
    assert "What is asked" in capsys.readouterr().out
    assert main(["worksheet", "-e", "pendulum", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["seed"] is None
    for wrong in (["--variants", "2"], ["-f", "json"], ["-o", str(tmp_path / "a" / "b")]):
        assert main(["worksheet", "-e", "pendulum", *wrong]) == 2


@pytest.mark.slow
def test_a_sheet_is_held_against_its_model_file_and_what_differs_is_found() -> None:
    made, own = sheet("pendulum", None), derivation("pendulum")
    questions = {name: made.question(name) for name in ("markdown", "html")}
    solutions = {name: made.solution(name, brief=True) for name in ("markdown", "text", "latex", "html")}

    def found(asked: Callable[[str], str] = str, told: Callable[[str], str] = str) -> list[bool | None]:
        checks = sheet_checks(lambda: own, lambda f: asked(questions[f]), lambda f, _: told(solutions[f]))
        return [check.holds for check in checks]

    assert found() == [True] * 6
    assert found(asked=_another_value) == [True] * 4 + [False] * 2
    assert found(told=lambda text: text.replace("sin", "cos")) == [False] * 4 + [True] * 2


def _another_value(sheet: str) -> str:
    """A question sheet on which one digit is wrong."""
    return re.sub(r"(\d)( m/s|&#xa0;m/s)", lambda m: f"{(int(m[1]) + 1) % 10}{m[2]}", sheet, count=1)


@pytest.mark.slow
def test_the_command_verifies_its_sheets_and_fails_with_them(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    command = ["worksheet", "-e", "pendulum", "-o", str(tmp_path), "--force"]
    write = lg.Worksheet.to_toml
    monkeypatch.setattr(lg.Worksheet, "to_toml", lambda self: write(self).replace("9.81", "1.62"))
    assert main([*command, "--verify", "--json"]) == 1
    shown = capsys.readouterr()
    assert "✗ pendulum: the values on the question sheet" in shown.err and "4 of 6 checks hold" in shown.err
    assert [c["holds"] for c in json.loads(shown.out)[0]["checks"]] == [True] * 4 + [False] * 2


def test_the_manuals_example_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page = (Path(__file__).parents[2] / "docs" / "worksheets.md").read_text(encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    for code in re.findall(r"^```python\n(.*?)^```", page, flags=re.M | re.S):
        exec(code, {})
    assert (tmp_path / "pendulum-questions.html").exists()
    with pytest.raises(Error, match="exists already"):
        sheet("pendulum", None).save(tmp_path, "pendulum")


SPOOL = """name = "weight on a thread"
[coordinates]
x = "drum, turned clockwise; its rim moves by r*x"
y = "weight, downwards"
[parameters]
m = { value = "1 kg", description = "mass of the drum" }
M = { value = "2 kg", description = "weight" }
r = { value = "0.1 m", description = "radius of the drum" }
k = { value = "9 N/m", description = "thread" }
J1 = { value = "0.1 kg*m^2", description = "crank" }
[[kinetic]]
name = "crank"
value = "J1*x'^2/2"
[[particle]]
name = "drum"
mass = "m"
at = ["r*x", "0"]
[[particle]]
name = "weight"
mass = "M"
at = ["3", "-y"]
[[spring]]
name = "thread"
k = "k"
deflection = "y - 2*r*x"
[[constraint]]
name = "slot"
expression = "sin(x) - y/r"
"""


def test_a_sheet_states_what_no_picture_shows() -> None:
    """The constraint, what a thread joins and how far it is stretched, an energy that is given."""
    flat = " ".join(lg.loads(SPOOL).worksheet().question().split())
    assert "Spring 'thread' joins the drum and the weight." in flat
    assert "The extension of spring thread is y − 2 r x." in flat
    assert "The constraint 'slot' is" in flat and "The kinetic co-energy 'crank' is given" in flat


def test_descriptions_follow_the_letters_of_a_variant() -> None:
    names = {"phi": "gamma", "R": "d", "x": None, "mass": "M", "m": "M"}
    said = "turn of the spool, clockwise; the centre moves by R*phi"
    assert relabelled(said, names) == "turn of the spool, clockwise; the centre moves by d*gamma"
    assert relabelled("spring, relaxed at x = 0", names) == "spring"
    assert relabelled("mass of a spool, 2 m long", names) == "mass of a spool, 2 m long"


def test_a_damper_in_a_hinge_is_between_what_the_hinge_joins() -> None:
    cart = lg.loads("""name = "cart with a pendulum"
[coordinates]
x = "cart"
beta = "pendulum, from hanging down"
[parameters]
m = "1 kg"
M = "2 kg"
l = "0.5 m"
b = "0.1 N*m*s"
[[particle]]
name = "cart"
mass = "M"
at = ["x", "0"]
[[particle]]
name = "bob"
mass = "m"
at = ["x + l*sin(beta)", "-l*cos(beta)"]
[[damper]]
name = "hinge"
b = "b"
deflection = "beta"
""")
    assert "amper hinge between the cart and the rod of the bob" in " ".join(cart.worksheet().question().split())

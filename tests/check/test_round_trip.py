"""What the program prints, and what SymPy prints of it, is read back and found right.

Oracle: the derivation that was printed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
import sympy as sp

from built_in import LARGE, derivation
from lagrangian import Derivation, check, examples
from lagrangian.check.html_formulas import as_markdown
from lagrangian.check.printed import printed_checks
from lagrangian.check.reading import parse_answer
from size import rest_slow

SAMPLE = ("lecture-2", "duffing", "ladder")
"""Several bodies with long energies, names with spaces, and constraints."""

PRINTERS: tuple[Callable[[sp.Basic], str], ...] = (
    str,
    lambda x: str(sp.latex(x)),
    lambda x: str(sp.mathematica_code(x)),
    lambda x: str(sp.octave_code(x, strict=False)),
)
NOTATIONS = ("lecture", "physics", "robotics")


def in_latex(lines: list[str]) -> str:
    return "\n".join(f"\\[{line}\\]" for line in lines)


def pages(derivation: Derivation, turn: int) -> Iterator[tuple[str, str]]:
    """The checklist in every format, each in another notation, which depends on ``turn``, and the data."""
    for k, write in enumerate((derivation.to_text, derivation.to_markdown, derivation.to_latex)):
        notation = NOTATIONS[(k + turn) % 3]
        yield f"{write.__name__} {notation}", write(notation=notation, brief=True)
    data = derivation.to_dict()
    for kind in ("plain", "latex"):
        equations = [f"{e['left'][kind]} = {e['right'][kind]}" for e in data["equations"]]
        energies = [f"{name} = {data[name][kind]}" for name in "TVL"]
        letter = "\\Xi" if kind == "latex" else "Xi"
        forces = [f"{letter}_{k} = {x[kind]}" for k, x in enumerate(data["Xi"].values(), 1)]
        lines = [*energies, *forces, *equations]
        yield f"json {kind}", in_latex(lines) if kind == "latex" else "\n".join(lines)


def printed(derivation: Derivation) -> Iterator[tuple[str, str]]:
    """The energies and equations as SymPy prints them."""
    for k, write in enumerate(PRINTERS):
        energies = [f"{name} = {write(getattr(derivation, name))}" for name in "TVL"]
        lines = [*energies, *map(write, derivation.equations)]
        yield f"sympy {k}", in_latex(lines) if k == 1 else "\n".join(lines)


def judged(derivation: Derivation, text: str) -> check.Verdict:
    """The verdict without a search for mistakes."""
    answer = parse_answer(text, derivation.model)
    return check.check(derivation, check.lines_of(answer), explain=False)


def is_right(verdict: check.Verdict) -> bool:
    """Whether all lines are right; energies alone are no complete answer to a system with constraints."""
    return verdict.right or (
        verdict.status is check.Status.INCOMPLETE and all(f.status.right for f in verdict.findings)
    )


@pytest.mark.parametrize("name", rest_slow(SAMPLE, {"duffing"}))
def test_what_is_printed_of_some_examples_is_right(name: str) -> None:
    own = derivation(name)
    for what, text in (*pages(own, 0), *printed(own)):
        assert is_right(judged(own, text)), (what, text)


@pytest.mark.slow
@pytest.mark.thinned(8)
@pytest.mark.parametrize(("turn", "name"), list(enumerate(n for n in examples.names() if n not in LARGE)))
def test_what_is_printed_of_all_examples_is_right(turn: int, name: str) -> None:
    own = derivation(name)
    for what, text in (*pages(own, turn), *printed(own)):
        assert is_right(judged(own, text)), (what, text)


def test_verification_reads_the_pages_back_and_notices_a_fraction_turned_over() -> None:
    own = derivation("duffing")
    pages = {"text": own.to_text(brief=True), "LaTeX": own.to_latex(brief=True)}
    assert [c.holds for c in printed_checks(own, pages)] == [True, True]
    wrong = {"text": pages["text"].replace("/4", "/3").replace("¼", "⅓"), "LaTeX": pages["LaTeX"].replace("{4}", "{3}")}
    assert wrong["text"] != pages["text"] and wrong["LaTeX"] != pages["LaTeX"]
    checks = printed_checks(own, wrong)
    assert [c.holds for c in checks] == [False, False] and "lines differ" in checks[0].figure
    (unread,) = printed_checks(own, {"text": "x = ) ("})
    assert unread.holds is None and "not read back" in unread.figure


@pytest.mark.slow
def test_a_page_in_html_is_read_back_and_a_changed_formula_noticed() -> None:
    for name in ("duffing", "kapitza-pendulum"):
        own = derivation(name)
        page = own.to_html(brief=True)
        (check,) = printed_checks(own, {"HTML": as_markdown(page)})
        assert check.holds and check.figure == "7 lines"
    changes = [
        ("<mn>2</mn>", "<mn>3</mn>"),
        ("<mi>sin</mi>", "<mi>cos</mi>"),
        ('<mo form="infix">−', '<mo form="infix">+'),
    ]
    for old, new in changes:
        assert old in page
        (check,) = printed_checks(own, {"HTML": as_markdown(page.replace(old, new))})
        assert check.holds is False, (old, check)


def test_matrices_that_are_drawn_are_read() -> None:
    drawn = "    q = ⎡ x ⎤\n        ⎣ θ ⎦\n    M = ⎡ M + m   m l cos θ ⎤\n        ⎣ sym.    J + m l²  ⎦\n"
    drawn += (
        "    h = ⎡ b ẋ − m l θ̇² sin θ ⎤\n        ⎣    −m g l sin θ    ⎦\n    M q̈ + h = ⎡ {F} ⎤\n              ⎣ 0 ⎦"
    )
    own = derivation("cart-pole")
    assert judged(own, drawn.format(F="F")).right
    assert not judged(own, drawn.format(F="b")).right


@pytest.mark.parametrize(
    ("written", "right"),
    [
        ("T = T_1 + T_2 = 1/2 M x'^2 + 1/2 m (x_2'^2 + y_2'^2) + 1/2 J theta'^2 = {T}", True),
        (
            "T_1 = 1/2 M x'^2, T_2 = 1/2 m x'^2 + m l x' theta' cos theta + 1/2 (J + m l^2) theta'^2, T = T_1 + T_2",
            True,
        ),
        ("T_1 = 1/2 M x'^2, T_2 = 1/2 m x'^2 + m l x' theta' cos theta + 1/2 J theta'^2, T = T_1 + T_2", False),
        ("T = T_1 + T_2 = {T} + 1/2 m l^2 theta'^2", False),
    ],
)
def test_sums_of_parts_are_judged_by_what_they_come_to(written: str, right: bool) -> None:
    T = "1/2 (M + m) x'^2 + m l x' theta' cos theta + 1/2 (J + m l^2) theta'^2"
    verdict = judged(derivation("cart-pole"), written.format(T=T))
    kinds = [f.line.kind for f in verdict.findings if f.line.kind != "definition"]
    assert kinds == ["T"] and verdict.right is right, verdict


@pytest.mark.parametrize(
    ("left", "right"), [("{T}", True), ("{T} + m l theta'' cos theta", False), ("(M + m) x''", False)]
)
def test_left_hand_sides_are_judged(left: str, right: bool) -> None:
    T = "(M + m) x'' + m l theta'' cos theta - m l theta'^2 sin theta"
    verdict = judged(derivation("cart-pole"), f"d/dt(∂L/∂x') - ∂L/∂x = {left.format(T=T)}")
    assert [f.line.kind for f in verdict.findings] == ["left"] and verdict.right is right

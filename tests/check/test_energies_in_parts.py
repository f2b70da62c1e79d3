"""Energies of parts that words alone name, in lists, in tables and behind labels, are those of these parts."""

import unicodedata
from typing import Literal

import pytest
import sympy as sp
from small_systems import wheels

import lagrangian as lg
from built_in import derivation
from lagrangian.check.explain.bodies_said import BodiesSaid
from lagrangian.check.lines import lines_of
from lagrangian.check.reading import parse_answer
from lagrangian.check.reference import truth_of
from lagrangian.check.verdict import AnsweredLine


@pytest.fixture(scope="module")
def swing() -> lg.Derivation:
    """A rod that hangs from a turning wheel, by a spring at the wheel."""
    s = lg.System("swing")
    phi, theta = s.coordinates("phi theta")
    J, R, m, l, k, b = s.parameters("J R m l k b")
    tau = s.inputs("tau")
    centre = s.point("C", (R * sp.sin(phi) + l * sp.sin(theta) / 2, -R * sp.cos(phi) - l * sp.cos(theta) / 2))
    s.rigid_body(0, J, at=s.origin, frame=s.frame(phi, name="wheel"), name="wheel")
    s.rigid_body(m, m * l**2 / 12, at=centre, frame=s.frame(theta, name="rod"), name="rod")
    s.gravity()
    s.spring(k, deflection=R * phi, name="spring")
    s.damper(b, deflection=phi, name="axle")
    s.torque(tau, on=phi, name="motor")
    return s.derive()


ROD = "1/2 m (R^2 phi'^2 + l^2 theta'^2/4 + R l phi' theta' cos(phi - theta)) + 1/24 m l^2 theta'^2"
SLIP = ROD.replace(" + 1/24 m l^2 theta'^2", "")
"""Without the energy of its rotation."""
ROWS = """(J + m R^2) phi'' + 1/2 m R l (theta'' cos(phi - theta) + theta'^2 sin(phi - theta)) + m g R sin(phi)
  + k R^2 phi = tau - b phi'
1/3 m l^2 theta'' + 1/2 m R l (phi'' cos(phi - theta) - phi'^2 sin(phi - theta)) + 1/2 m g l sin(theta) = 0"""
LIST = f"""Kinetic energy
  wheel   1/2 J phi'^2
  rod     {ROD}

Potential energy
- rod: -m g (R cos(phi) + l/2 cos(theta))      (zero at the axle)
- spring: 1/2 k (R phi)^2

{ROWS}"""
TABLE = f"""| body | kinetic energy | V |
|---|---|---|
| wheel | ½ J φ'² | ½ k R² φ² |
| rod | {ROD} | -m g (R cos(phi) + l/2 cos(theta)) |

{ROWS}"""


@pytest.mark.parametrize(("answer", "count"), [(LIST, 4), (TABLE, 4)])
def test_energies_in_lists_and_tables_are_judged(swing: lg.Derivation, answer: str, count: int) -> None:
    verdict = swing.check(answer)
    energies = [f for f in verdict.findings if f.line.kind == "definition"]
    assert verdict.right and len(energies) == count
    assert all(f.status.right and " energy of " in str(f.note) for f in energies)


@pytest.mark.slow
@pytest.mark.parametrize("answer", [LIST, TABLE])
def test_a_wrong_energy_in_a_list_is_named_in_its_line(swing: lg.Derivation, answer: str) -> None:
    verdict = swing.check(answer.replace(ROD, SLIP).replace("1/3 m l^2 theta''", "1/4 m l^2 theta''"))
    (mistake,) = verdict.mistakes
    line = next(n for n, x in enumerate(answer.split("\n"), 1) if ROD in x)
    assert str(mistake.what).startswith(f"Line {line} is not right: the kinetic energy of rigid body 'rod'")
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [line]


@pytest.mark.parametrize("label", ["Rod (König): ", "energy of the rod: ", "rod:\n   "])
def test_the_t_of_one_body_is_not_the_whole(swing: lg.Derivation, label: str) -> None:
    """T of the rod, with all its letters; T_total below is the whole."""
    found = parse_answer(f"{label}T = {ROD}\nT_total = 1/2 J phi'^2 + {ROD}\n{ROWS}", swing.model)
    assert [(x.kind, x.name) for x in found.lines][:2] == [("definition", "T_rod"), ("T", None)]


@pytest.mark.slow
def test_a_wrong_t_of_one_body_is_named(swing: lg.Derivation) -> None:
    verdict = swing.check(f"rod: T = {SLIP}\nT_total = 1/2 J phi'^2 + {SLIP}\n{ROWS.replace('1/3', '1/4')}")
    (mistake,) = verdict.mistakes
    assert str(mistake.what).startswith("Line 1 is not right: the kinetic energy of rigid body 'rod'")
    assert [f.line.number for f in verdict.findings if not f.status.right and not f.follows] == [1]


@pytest.mark.parametrize("label", ["wheel and rod: ", "The rod turns, too: ", "rod: "])
def test_a_t_with_the_letters_of_two_bodies_is_the_whole(swing: lg.Derivation, label: str) -> None:
    found = parse_answer(f"{label}T = 1/2 J phi'^2 + {ROD}", swing.model)
    assert [x.kind for x in found.lines] == ["T"]


@pytest.mark.parametrize(
    "line",
    ["axle: 1/2 b phi'^2", "Rayleigh: 1/2 m phi'^2", "wheel: J phi''", "phi: m R^2 phi'^2", "wheel: turns by phi"],
)
def test_what_is_no_energy_has_no_name(swing: lg.Derivation, line: str) -> None:
    found = parse_answer(f"{line}\n{ROWS}", swing.model)
    assert not [x for x in found.lines if x.kind in ("definition", "T", "V")]


WHEEL = "T_wheel = 1/2 J phi'^2"


@pytest.mark.sampled(16)
@pytest.mark.parametrize(
    ("wheel", "rod", "right"),
    [
        (WHEEL, f"T_rod = {ROD}", True),
        (WHEEL, "T_rod = 1/24 m l^2 theta'^2", True),  # of its rotation alone
        (WHEEL, f"T_rod = {SLIP}", True),  # of its translation alone
        ("T_wheel = J phi'^2", f"T_rod = {ROD}", False),
        (WHEEL, "T_rod = 1/6 m l^2 theta'^2", False),
        (WHEEL, "T_rod = 1/2 m R^2 phi'^2", False),
        ("T_wheel = tau - b phi'", f"T_rod = {ROD}", True),  # a torque
        (WHEEL, "V_rod = -m g (R cos(phi) + l/2 cos(theta))", True),
        (WHEEL, "V_rod = m g (R + l - R cos(phi) - l/2 cos(theta))", True),  # from the lowest place
        (WHEEL, "V_rod = m g (R cos(phi) + l/2 cos(theta))", False),
        (WHEEL, "V_rod = -m g (R cos(phi) + l cos(theta))", False),
        ("V_wheel = 1/2 k R^2 phi^2", f"T_rod = {ROD}", True),
        ("T_wheel = 1/2 J phi'^2 + 1/6 m l^2 theta'^2", f"T_rod = {ROD} - 1/6 m l^2 theta'^2", True),  # T* in all
    ],
)
def test_the_energy_of_a_body_that_nothing_uses_is_judged_by_its_name(
    swing: lg.Derivation, wheel: str, rod: str, right: bool
) -> None:
    assert swing.check(f"{wheel}\n{rod}\n{ROWS}", hint=0).right == right


def test_a_wrong_energy_of_a_body_explains_the_equations(swing: lg.Derivation) -> None:
    verdict = swing.check(f"T_wheel = J phi'^2\nT_rod = {ROD}\n{ROWS.replace('(J +', '(2 J +')}")
    first, *others = (f for f in verdict.findings if not f.status.right)
    assert first.line.number == 1 and not first.follows and all(f.follows for f in others) and others
    assert "kinetic energy of rigid body 'wheel'" in str(verdict.mistakes[0].what)


def test_energies_of_parts_alone_are_no_answer(swing: lg.Derivation) -> None:
    potential = "V = 1/2 k (R phi)^2 - m g (R cos(phi) + l/2 cos(theta))"
    for parts in (WHEEL, f"{WHEEL}\nT_rod = {ROD}", "E1 = 1/2 J phi'^2", "K_w = 1/2 J phi'^2"):
        verdict = swing.check(f"{parts}\n{potential}")
        assert verdict.status == "incomplete" and any("No line states" in str(note) for note in verdict.notes)
    assert swing.check(potential, hint=0).right  # the answer to a question about V
    assert swing.check(f"{WHEEL}\nT = 1/2 J phi'^2 + {ROD}\n{potential}", hint=0).right


@pytest.mark.sampled(8)
@pytest.mark.parametrize("form", ["NFC", "NFD"])
@pytest.mark.parametrize(
    ("cart", "body"),
    [
        ("Kinetische Energie für die Körper:\n  Wagen: ", "\n  Körper: "),
        ("Kinetische Energie für den Wagen: ", "\nKinetische Energie für den Körper: "),
        ("T_Wagen = ", "\nT_Koerper = "),
    ],
)
def test_the_dots_of_a_vowel_in_a_word_are_no_rates(form: Literal["NFC", "NFD"], cart: str, body: str) -> None:
    s = lg.System("s")
    x, y = s.coordinates("x y")
    M, m, k = s.parameters("M m k")
    s.particle(M, at=s.point("A", (x, 0)), name="Wagen")
    s.particle(m, at=s.point("B", (x + y, 0)), name="Körper")
    s.spring(k, deflection=y)
    rows = "(M + m) x'' + m y'' = 0\nm (x'' + y'') + k y = 0"
    answer = f"{cart}1/2 M x'^2{body}1/2 m (x'^2 + 2 x' y' + y'^2)\n{rows}"
    verdict = s.derive().check(unicodedata.normalize(form, answer))
    assert verdict.right and [f.line.kind for f in verdict.findings].count("definition") == 2
    for wrong in (answer.replace("2 x' y'", "x' y'"), answer.replace("+ k y", "- k y")):
        assert not s.derive().check(unicodedata.normalize(form, wrong), hint=0).right


@pytest.mark.parametrize(("right", "open_ones"), [("v", {"v_1"}), ("v1", {"v"})])
def test_a_name_with_a_number_is_not_the_first_entry_of_a_column(right: str, open_ones: set[str]) -> None:
    truth = truth_of(derivation("cart-pole"))
    lines = lines_of(parse_answer("v_1 = 2 x'\nv = 3 x'\nT = M v_1^2 + M v^2", truth.model))
    proved = AnsweredLine("V", truth.V, 4, names=frozenset([right]))
    assert {part.line.name for part in BodiesSaid(truth, lines, [proved]).parts} == open_ones


DRIVEN = "(A + B R^2/r^2) φ'' + c R^2/r^2 φ' + k φ = M R/r\n"
OF_ROLLER = [
    "The roller turns with R φ'/r, so it has T = ½ B R² φ'²/r².",
    "Note on the roller: T = ½ B R² φ'²/r².",
]


@pytest.mark.sampled(4)
@pytest.mark.parametrize("said", OF_ROLLER)
@pytest.mark.parametrize("above", [True, False])
def test_a_sentence_beside_right_equations_may_say_the_energy_of_one_element(said: str, above: bool) -> None:
    """It is told as that of the roller; without right equations, or when it is none of one element, it stays wrong."""
    answer = f"{said}\n{DRIVEN}" if above else f"{DRIVEN}\n{said}"
    verdict = wheels().check(answer)
    assert verdict.right and "as the energy of 'roller' alone" in verdict.to_text()
    assert not wheels().check(answer.replace("½ B", "B")).right
    assert not wheels().check(answer.replace("+ k φ", "- k φ")).right


@pytest.mark.parametrize(
    "said",
    [
        "T = ½ B R² φ'²/r²",
        "Kinetic energy: T = ½ B R² φ'²/r²",
        "The kinetic energy of the system is T = ½ B R² φ'²/r².",
        "Altogether the roller and the drum have T = ½ B R² φ'²/r².",
        "First we write down T = ½ B R² φ'²/r².",
    ],
)
def test_an_energy_of_the_answer_that_lacks_a_body_stays_wrong(said: str) -> None:
    assert not wheels().check(f"{said}\n{DRIVEN}", hint=0).right

"""Habits of whole sheets: labels in brackets, words of other languages, names of the sheet's own, energies and numbers
apart.

Oracle: the equations of the cart with a pole, the elastic pendulum and the motor with an arm, in the grammar of model
files. Every sheet has a wrong twin, which is not accepted.
"""

import pytest

from built_in import derivation
from student_answers import CART, POLE, right

BROKEN = (
    "{0} (M + m) x'' + m l theta'' cos theta\n      - m l theta'^2 sin theta + b x' = F\n"
    "{1} (J + m l^2) theta'' + m l x'' cos theta\n      = m g l sin theta"
)


@pytest.mark.parametrize("labels", [("(x)", "(theta)"), ("(x)    ", "(theta)"), ("[x]", "[θ]")])
def test_names_of_all_coordinates_in_front_of_broken_equations_are_labels(labels: tuple[str, str]) -> None:
    sheet = BROKEN.format(*labels)
    assert right(sheet)
    assert not right(sheet.replace("= m g", "= -2 m g"))


@pytest.mark.sampled(4)
@pytest.mark.parametrize("word", ["mit", "wobei", "with", "avec", "con", "met", "dove"])
def test_a_word_between_a_formula_and_what_a_name_means_is_a_word(word: str) -> None:
    rows = f"(M + m) x'' + m s'' + b x' = F\n{POLE}"
    sheet = f"radial: x'' + s'' {word} s'' = theta'' l cos theta - l theta'^2 sin theta\n{rows}"
    assert right(sheet)
    assert not right(sheet.replace("- l theta'^2", "+ l theta'^2"))
    assert not right(f"(M + m) x'' + m s'' + b x' {word} s = l sin theta\n{POLE}")  # no right side


@pytest.mark.sampled(3)
@pytest.mark.parametrize("mark", ["   ...({})", " ..... eq. ({})", " ------[{}]", " … (1.{})"])
def test_what_dots_lead_to_is_a_number_of_an_equation(mark: str) -> None:
    numbers = ("i", "ii") if "1." not in mark else ("1", "2")
    first, second = (f"{row}{mark.format(k)}" for row, k in zip((CART, POLE), numbers, strict=True))
    assert right(f"{first}\n{second}")
    assert not right(f"{first}\n{second.replace('- m g', '+ m g')}")
    assert not right(f"{first.replace('b x', '2 b x')}\n{second}")


@pytest.mark.slow
def test_names_whose_rates_stand_alone_on_the_left_are_no_products() -> None:
    place = (
        "S: end of the pole\nxS'' = x'' + l theta'' cos theta - l theta'^2 sin theta\n"
        "yS'' = -l theta'' sin theta - l theta'^2 cos theta\n"
    )
    forces = "m xS'' = Hx\nm yS'' = Hy - m g\nM x'' + b x' = F - Hx\nJ theta'' = Hy l sin theta - Hx l cos theta\n"
    assert right(f"{place}{forces}")
    assert right(f"{place}{forces}{CART}\n{POLE}")
    assert not right(f"{place.replace('= -l', '= l')}{forces}")
    assert not right(f"{place.replace('= x', '= -x')}{forces}{CART}\n{POLE}")
    assert right(f"(M+m)x'' + ml theta'' cos theta - ml theta'^2 sin theta + bx' = F\n{POLE}")  # m l and b x' are


def test_a_velocity_relative_to_something_is_not_that_of_the_same_name() -> None:
    sheet = (
        "v_P (rel. to cart) = l theta', tangential\nv_P^2 = x'^2 + l^2 theta'^2 + 2 l x' theta' cos theta\n"
        f"T = 1/2 M x'^2 + 1/2 m v_P^2 + 1/2 J theta'^2\n{CART}\n{POLE}"
    )
    assert right(sheet)
    assert not right(sheet.replace("+ 2 l x'", "+ l x'"))
    assert right(sheet.replace("rel. to", "w.r.t."))
    assert not right(sheet.replace(" (rel. to cart)", ""))


@pytest.mark.slow
def test_a_sentence_behind_a_point_does_not_hide_what_a_coordinate_is() -> None:
    told = "the spring is longer by m g/k, so r = s + L_0 + m g/k. θ as in the figure.\n"
    rows = (
        "m s'' - m (s + L_0 + m g/k) θ'^2 - m g cos θ + m g + k s = 0\n"
        "m (s + L_0 + m g/k) θ'' + 2 m s' θ' + m g sin θ = 0"
    )
    assert right(told + rows, "elastic-pendulum")
    assert not right(told + rows.replace("+ m g + k s", "+ k s"), "elastic-pendulum")


SPRING = (
    "m r'' - m r θ'^2 - m g cos θ + k (r - L_0) = 0\nm r^2 θ'' + 2 m r r' θ' + m g r sin θ = 0\nMit Zahlen (SI):\n"
    "0,5 r'' - 0,5 r θ'^2 - 4,905 cos θ + 30 r - 18 = 0\n0,5 r^2 θ'' + r r' θ' + 4,905 r sin θ = 0"
)


@pytest.mark.slow
def test_equations_in_numbers_behind_the_same_in_letters_are_judged_with_values() -> None:
    assert right(SPRING, "elastic-pendulum")
    assert right(SPRING.rsplit("\n", 1)[0], "elastic-pendulum")
    for a, b in (("30 r", "3,0 r"), ("- 18", "+ 18"), ("m g r sin", "m g sin"), ("4,905 cos", "4,905 sin")):
        assert not right(SPRING.replace(a, b), "elastic-pendulum")
    verdict = derivation("elastic-pendulum").check(SPRING.replace("- 4,905", "+ 4,905"))
    assert [f.line.number for f in verdict.findings if not f.status.right] == [4]
    assert verdict.mistakes


@pytest.mark.slow
def test_values_of_a_list_and_the_value_of_the_system_for_a_letter_in_no_list_are_put_in_together() -> None:
    sheet = (
        "m = 0,5 kg; L_0 = 0,6 m; k = 30 N/m\n" + SPRING.replace(" - 0,5 r θ'^2", " - m r θ'^2").split("\n0,5 r^2")[0]
    )
    assert right(f"{sheet}\n0,5 r^2 θ'' + r r' θ' + 4,905 r sin θ = 0", "elastic-pendulum")
    assert not right(f"{sheet}\n0,5 r^2 θ'' + r r' θ' + 4,9 r sin θ = 0", "elastic-pendulum")


MOTOR = (
    "{0} = 1/2 L q'^2\nT = 1/2 (J + m l^2) theta'^2\nV = -m g l cos theta\nL q'' + R q' + K theta' = u\n"
    "(J + m l^2) theta'' + m g l sin theta = K q' - b theta'"
)


@pytest.mark.slow
def test_a_magnetic_co_energy_stated_apart_belongs_to_the_kinetic_one() -> None:
    sheet = MOTOR.format("Wm")
    assert right(sheet, "dc-motor")
    assert not right(sheet.replace("1/2 L", "L"), "dc-motor")
    assert not right(sheet.replace("1/2 (J", "(J"), "dc-motor")
    assert not right(sheet.split("\n", 1)[1], "dc-motor")
    assert not right(sheet + "\nL = T - V", "dc-motor")

"""Small files that write out to something huge: an answer or a word about it, after a bounded number of calls."""

import pytest

import lagrangian as lg
from built_in import derivation
from effort import at_most
from lagrangian import ModelError, bounded
from lagrangian.bounded import questions
from lagrangian.check import hardness
from lagrangian.check.explain.changes.ring import SumRing
from lagrangian.derive.algebra import algebra
from lagrangian.model import is_hard
from lagrangian.worksheet.directions import positive_sense

HEAD = """
name = "hostile"
[coordinates]
q = ""
w = ""
[parameters]
m = 1
a = 1
b = 1.5
c = 0.3
d = 0.4
e = 0.7
k = 2
g = 9.81
"""
BODY = '[[particle]]\nmass = "m"\nat = ["q", "w"]\n'
TURNED = '[points]\np = { frame = "f", offset = ["1", "w", "0"] }\n[[particle]]\nmass = "m"\nat = "p"\n'
FILES = {
    "axis": HEAD + '[[frame]]\nname = "f"\nangle = "q"\naxis = ["(a+b+c+d+e)^50", "0", "1"]\n' + TURNED,
    "gravity": HEAD + BODY + '[[gravity]]\ndirection = ["sin(a)^40*cos(b)^30+sin(c)^21", "cos(a)^50*sin(b+c)^20"]\n',
    "law": HEAD + BODY + '[[spring]]\ndeflection = "q"\nlaw = "1/(1+delta^97)"\n',
    "max": HEAD + BODY + f'[[potential]]\nvalue = "max({", ".join(f"{i + 2}*q+{i}*w^{i + 1}" for i in range(32))})"\n',
    "define": HEAD
    + '[define]\nd0 = "q+w"\n'
    + "".join(f'd{i} = "d{i - 1}+d{i - 1}^2"\n' for i in range(1, 60))
    + BODY
    + '[[potential]]\nvalue = "d59"\n',
    "fractions": HEAD
    + '[[particle]]\nmass = "m"\nat = ["1/(1+1/(1+1/(1+1/(1+1/(q^2+w)))))", "(w+q)/(a+b/(q+c/(w+1/q)))"]\n',
    "signs": HEAD
    + BODY
    + f'[[potential]]\nvalue = "{"*".join(f"1/cosh(atan(q/{i})+tanh(w*a)^{i})^0.5" for i in range(1, 9))}"\n',
    "nested": HEAD + f'[[particle]]\nmass = "m"\nat = ["{"sin(" * 40}q{")" * 40}", "w"]\n',
}
READING = 3_000_000
"""Calls of Python functions that reading such a file may take; it takes a tenth."""


def _or_a_word(make) -> object:  # type: ignore[no-untyped-def]
    try:
        return make()
    except ModelError as error:
        assert error.code and str(error)
        return error


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", FILES)
def test_a_file_is_read_or_refused_in_a_bounded_number_of_calls(name: str) -> None:
    assert bounded.searched(_or_a_word, lambda: lg.loads(FILES[name]).model, calls=READING) is not None


@pytest.mark.thinned(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["axis", "gravity", "max", "fractions", "nested"])
def test_a_derivation_is_written_or_refused_in_a_bounded_number_of_calls(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """After fewer steps and products than users are given, 6 and 5 million: all but two are written."""
    monkeypatch.setattr(questions, "QUESTION", 2_500_000)
    monkeypatch.setattr(algebra, "WORK", 1_000_000)
    with at_most(10_000_000):
        found = _or_a_word(lg.loads(FILES[name]).derive)
    assert isinstance(found, lg.Derivation) == (name not in ("gravity", "nested"))


def test_what_is_not_multiplied_out_is_said_on_the_page() -> None:
    derivation = lg.loads(HEAD + BODY + '[[potential]]\nvalue = "(a+b+c+d+e)^50*q"\n').derive()
    assert any("Not multiplied out" in str(note) for note in derivation.notes)
    page = derivation.to_text()
    assert "Not multiplied out, because the sum would be too long to read" in " ".join(page.split())
    assert "(a + b + c + d + e)⁵⁰" in page


def test_a_derivation_ends_when_its_products_are_spent(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(algebra, "WORK", 100)
    system = lg.loads(HEAD + BODY + '[[potential]]\nvalue = "(q + w)^9*sin(q)"\n')
    with pytest.raises(ModelError, match="takes more than 100 products of terms") as caught:
        system.derive(form="expanded")
    assert caught.value.fix is not None and "compile()" in caught.value.fix


def test_a_derivation_whose_products_are_spent_is_written_in_named_quantities(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(algebra, "WORK", 1_000)
    made = lg.loads(HEAD + BODY + '[[potential]]\nvalue = "(q + w)^9*sin(q)"\n').derive()
    assert made.form == "structured" and all(c.holds for c in made.verified)
    assert any("more than 1000 products of terms" in str(note) for note in made.notes)


def test_a_system_without_finite_forces_is_told_so() -> None:
    steep = HEAD + '[[particle]]\nmass = "m"\nat = ["(q+1/3)^100*(w+124999998860937500)^100", "w"]\n'
    with pytest.raises(ModelError, match="no finite value"):
        lg.loads(steep).conserved_quantities()


@pytest.mark.slow
def test_a_coordinate_that_moves_a_body_by_next_to_nothing_is_derived() -> None:
    flat = HEAD + '[[particle]]\nmass = "m"\nat = ["(q^3+a)/(1+q^2+w^3)^20", "(w+q)^9/(a+b*q+c*w)^30"]\n'
    assert _or_a_word(lg.loads(flat).derive) is not None


@pytest.mark.slow
def test_an_answer_to_long_equations_is_checked_in_a_bounded_number_of_calls(monkeypatch: pytest.MonkeyPatch) -> None:
    own = derivation("double-pendulum")
    assert not is_hard(own.model)  # what it is described by is short
    assert not own.check("theta1'' = 0").right
    monkeypatch.setattr(hardness, "WRITTEN", 20)
    monkeypatch.setattr(questions, "QUESTION", 2_000)
    fresh = lg.example("double-pendulum").derive()  # how hard a system is, is kept
    with pytest.raises(ModelError, match="checking the answer takes more than 2000 steps"):
        fresh.check("theta1'' = 0")


def test_a_slope_of_a_maximum_of_many_is_found_without_proofs() -> None:
    model = lg.loads(FILES["max"]).model
    ring = SumRing(model)
    value = ring.of(model.elements[-1].potential(model))
    with at_most(400_000):
        assert ring.slope(value, model.coordinates[0].symbol)


@pytest.mark.slow
def test_the_direction_of_a_coordinate_with_long_slopes_is_not_said_after_a_bounded_number_of_calls() -> None:
    """A worksheet asks for it: its search took over a minute."""
    model = lg.loads(FILES["fractions"]).model
    with at_most(3_000_000):
        assert [positive_sense(model, c) for c in model.coordinates] == [None, None]


def test_why_equations_too_long_to_write_hold_is_refused_with_what_there_is(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(algebra, "WORK", 1_000)
    made = lg.loads(HEAD + BODY + '[[potential]]\nvalue = "(q + w)^9*sin(q)"\n').derive()
    with pytest.raises(
        ModelError, match="why the equations hold is told with equations that are written out"
    ) as caught:
        _ = made.why
    assert caught.value.fix == "system.derive() writes the steps in named quantities, and system.verify() checks them"

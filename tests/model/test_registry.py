"""Every kind of element answers every question that the house asks an element; a missing answer is an error."""

from dataclasses import fields
from typing import Any, ClassVar

import pytest

from lagrangian.model import REGISTRY, Body, Element
from lagrangian.model.elements import FieldKind
from lagrangian.model.elements.base import QUESTIONS, QUESTIONS_OF

PAIRS = [(kind, q) for kind, made in REGISTRY.items() for q in (*QUESTIONS, *QUESTIONS_OF[made.ledger])]


@pytest.mark.parametrize(("kind", "question"), PAIRS)
def test_every_kind_answers_every_question(kind: str, question: str) -> None:
    """The answer is the kind's own, or that of a family that it belongs to: never the one of all elements."""
    made = REGISTRY[kind]
    family = made.__mro__[: made.__mro__.index(Element)]
    assert any(question in vars(base) for base in family)
    assert getattr(made, question) is not None


@pytest.mark.parametrize(("kind", "made"), REGISTRY.items())
def test_a_kind_is_registered_by_its_name_and_lists_its_fields(kind: str, made: type[Element]) -> None:
    assert made.kind == kind
    assert sorted(made.entries) == sorted(f.name for f in fields(made) if f.name not in ("name", "place"))
    assert all(entry.about.endswith(".") for entry in made.entries.values())
    assert made.about.endswith(".") and made.plural.endswith(".")
    assert all(entry.made_from in ("", *made.entries) for entry in made.entries.values())


def test_a_kind_that_leaves_a_question_open_is_refused() -> None:
    body: dict[str, Any] = {"kind": "friction", "ledger": "Ξ", "because": ("it rubs",), "works": lambda self, model: ()}
    with pytest.raises(TypeError, match="Friction does not answer: plural, about, entries, uses, measures, resists"):
        type("Friction", (Element,), body)


def test_what_belongs_to_another_column_is_not_asked() -> None:
    """A kind in Ξ has no energy to explain, and one in T* acts on nothing."""

    class Half(Element):  # a family, not a kind: it is asked nothing yet
        note: ClassVar[str] = "as given"

    assert "acts_on" not in QUESTIONS_OF["T*"] and "stored" not in QUESTIONS_OF["Ξ"]
    assert issubclass(Half, Element)


def test_every_way_to_write_a_field_has_a_schema_and_a_reader() -> None:
    from lagrangian.read import file_elements, file_schema

    assert set(file_schema._TYPES) == set(file_elements._FIELDS) == set(FieldKind)


def test_the_file_has_an_array_of_tables_for_every_kind_with_every_field() -> None:
    from lagrangian.read.file_schema import TABLES, ModelFile

    assert list(TABLES) == list(REGISTRY) and set(REGISTRY) <= set(ModelFile.model_fields)
    for kind, made in REGISTRY.items():
        assert list(TABLES[kind].model_fields) == ["name", *made.entries]


def test_every_kind_with_mass_is_a_body_to_the_second_route() -> None:
    """Gravity there pulls the bodies that were added; a kind taken by its energies alone would have no weight."""
    from lagrangian.dynamics.describe import ELEMENTS

    assert {kind for kind, made in REGISTRY.items() if issubclass(made, Body)} <= set(ELEMENTS)

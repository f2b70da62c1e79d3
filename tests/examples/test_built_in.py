"""The built-in model files: named, described, found with a hint when misspelled."""

from __future__ import annotations

import tomllib
from collections.abc import Callable

import jsonschema
import pytest

import lagrangian as lg
from built_in import SOME
from lagrangian import ModelError, examples, read

ASKED_FOR = {
    "lecture-1",
    "lecture-2",
    "lecture-2-absolute",
    "lecture-3a",
    "lecture-3b",
    "pendulum",
    "cart-pole",
    "double-pendulum",
    "double-pendulum-relative",
    "triple-pendulum",
    "triple-pendulum-relative",
    "elastic-pendulum",
    "spherical-pendulum",
    "furuta-pendulum",
    "quarter-car",
    "bead-on-hoop",
    "atwood",
    "wedge",
    "three-masses",
    "kapitza-pendulum",
    "two-carts",
}


def test_the_examples_that_were_asked_for_are_there() -> None:
    assert set(examples.names()) >= ASKED_FOR


def test_the_lectures_examples_come_first() -> None:
    assert examples.names()[:5] == ("lecture-1", "lecture-2", "lecture-2-absolute", "lecture-3a", "lecture-3b")


@pytest.mark.parametrize("name", examples.names())
def test_a_file_is_valid_toml_with_a_description_and_a_unit_for_every_parameter(name: str) -> None:
    text = examples.text(name)
    file = tomllib.loads(text)
    assert 20 < len(examples.describe(name)) <= 53  # the list fits 80 columns
    assert text.startswith(f"# {examples.describe(name)}\n")
    given = [value["value"] if isinstance(value, dict) else value for value in file["parameters"].values()]
    assert all(isinstance(value, str) and " " in value for value in given)
    assert all(len(line) <= 120 for line in text.splitlines())


def test_descriptions_differ() -> None:
    assert len({examples.describe(name) for name in examples.names()}) == len(examples.names())


@pytest.mark.parametrize("asked", [examples.text, lg.example])
def test_a_misspelled_name_is_answered_with_the_nearest(asked: Callable[[str], object]) -> None:
    with pytest.raises(ModelError, match="double-pendulun") as caught:
        asked("double-pendulun")
    assert "Did you mean 'double-pendulum'?" in str(caught.value)


def test_an_example_is_a_system_of_its_own() -> None:
    first, second = lg.example("cart-pole"), lg.example("cart-pole")
    assert isinstance(first, lg.System) and first is not second
    assert first.to_toml() == lg.loads(examples.text("cart-pole")).to_toml()


@pytest.mark.parametrize("name", ["", "../errors", "/etc/passwd", "x" * 10_000, "__init__.py", "pendulum.toml\0"])
def test_only_names_of_examples_open_files(name: str) -> None:
    with pytest.raises(ModelError) as caught:
        examples.text(name)
    assert len(str(caught.value)) < 300


@pytest.fixture(scope="module")
def published() -> jsonschema.Draft202012Validator:
    jsonschema.Draft202012Validator.check_schema(read.schema())
    return jsonschema.Draft202012Validator(read.schema())


@pytest.mark.sampled(4)
@pytest.mark.parametrize("name", examples.names())
def test_a_file_fits_the_published_schema(name: str, published: jsonschema.Draft202012Validator) -> None:
    published.validate(tomllib.loads(examples.text(name)))


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", examples.names())
def test_a_saved_system_is_the_same_system(name: str) -> None:
    first = lg.loads(examples.text(name), name=name)
    again = lg.loads(first.to_toml(), name="saved")
    for attribute in ("coordinates", "parameters", "inputs", "definitions"):
        assert getattr(again.model, attribute) == getattr(first.model, attribute)
    for one, other in zip(first.model.elements, again.model.elements, strict=True):
        assert (one.kind, one.name) == (other.kind, other.name)
        assert one.kinetic(first.model) == other.kinetic(again.model)
        assert one.potential(first.model) == other.potential(again.model)
        assert [(a.effort, a.rate) for a in one.works(first.model)] == [
            (a.effort, a.rate) for a in other.works(again.model)
        ]


@pytest.mark.sampled(SOME)
@pytest.mark.parametrize("name", [name for name in examples.names() if name != "two-carts"])
def test_every_symbol_but_g_is_described(name: str) -> None:
    model = lg.loads(examples.text(name), name=name).model
    assert [s.name for s in (*model.coordinates, *model.parameters, *model.inputs) if not s.description] in ([], ["g"])

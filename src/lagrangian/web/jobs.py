"""The jobs of the app: each returns what the command writes with ``--json``, and pieces of HTML beside it."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from lagrangian.check.reading import parse_answer
from lagrangian.check.verb import check_answer
from lagrangian.cli.formats import as_json
from lagrangian.cli.run_summary import figures
from lagrangian.derivation import Derivation
from lagrangian.derive import Derived, pages
from lagrangian.errors import Error
from lagrangian.page.formula import text
from lagrangian.simulate import plot
from lagrangian.simulate.trajectory import Trajectory
from lagrangian.structured.choose import derive_in_form
from lagrangian.system import System, loads
from lagrangian.web.answers import lines_of_answer, report_pieces
from lagrangian.web.requests import Arguments, LargeModel, Part, Task
from lagrangian.write.blocks import element_titles
from lagrangian.write.html_page import pieces
from lagrangian.write.quantities import NOTATIONS, Notation
from lagrangian.write.scene_svg import scene_svg

MAX_COORDINATES, MAX_ELEMENTS = 24, 200
"""A model with more of them is derived only if that is asked for expressly."""

MODEL = ("model", "name", "anyway")
"""The arguments that every job has: the text of a model, the name of its file, and whether it may be large."""

UNNAMED = "model.toml"

SERIES = 2001
"""The largest number of samples of a run."""

_STYLE = re.compile(r"<style>(.*?)</style>", re.DOTALL)

FIGURES = 6
"""Significant digits of the numbers that are plotted."""


def opened(arguments: Arguments) -> System:
    """Return the system of a request; raises `LargeModel` if it is larger than what is derived while somebody types."""
    system = _loaded(arguments.text("model"), arguments.title("name", UNNAMED))
    model = system.model
    counts = ((len(model.coordinates), MAX_COORDINATES, "coordinates"), (len(model.elements), MAX_ELEMENTS, "elements"))
    anyway = arguments.truth("anyway")
    for count, most, what in counts:
        if count > most and not anyway:
            raise LargeModel(
                f"this model has {count} {what}, more than the {most} that are derived while you type",
                fix="try anyway, or use the command",
                code="E601",
            )
    return system


@lru_cache(maxsize=4)
def _loaded(text: str, name: str) -> System:
    return loads(text, name=name)


@lru_cache(maxsize=4)
def _derived(system: System) -> Derived:
    return derive_in_form(system.model)


@lru_cache(maxsize=2)
def _verified(system: System) -> Derivation:
    return system.derive()


def _notation(arguments: Arguments) -> Notation:
    given = arguments.text("notation", NOTATIONS[0])
    for notation in NOTATIONS:
        if notation == given:
            return notation
    raise Error(f"there is no notation '{given[:40]}'", fix=f"use one of {', '.join(NOTATIONS)}", code="E405")


def derive_job(given: dict[str, Any], part: Part) -> dict[str, Any]:
    """Derive a model: the data of ``lagrangian derive --json``, its page in sections, and the SI unit of every
    parameter, coordinate and input, in which the other jobs take and give numbers."""
    arguments = Arguments(given, (*MODEL, "notation"))
    notation = _notation(arguments)
    derivation = _verified(opened(arguments))
    document = pages.lay_out(derivation, notation=notation, details=True)
    data = json.loads(pages.to_json(derivation, notation=notation))
    model, units = derivation.model, plot.Units(derivation.model)
    known = {x.name: units.of(x.symbol) for x in (*model.parameters, *model.coordinates, *model.inputs)}
    return {"data": data, "title": document.title, "sections": pieces(document), "units": known}


def look_job(given: dict[str, Any], part: Part) -> dict[str, Any]:
    """Draw a model: the schematic as SVG, the rules of its colours apart, and what its parts are called."""
    system = opened(Arguments(given, MODEL))
    picture = system.look()
    svg = scene_svg(picture.scene, embedded=True)
    style = "".join(_STYLE.findall(svg))
    return {
        "svg": _STYLE.sub("", svg),
        "style": style,
        "description": picture.description,
        "missing": list(picture.missing),
        "elements": element_titles(system.model),
    }


def page_job(given: dict[str, Any], part: Part) -> str:
    """Return the page of a model that moves, with its integrator in WebAssembly."""
    return opened(Arguments(given, MODEL)).look().to_html()


def check_job(given: dict[str, Any], part: Part) -> dict[str, Any]:
    """Check an answer: the data of ``lagrangian check --json``, each line as it was read, and the report."""
    arguments = Arguments(given, (*MODEL, "answer", "hint"))
    hint = arguments.whole("hint", 3, 0, 3)
    words = arguments.text("answer")
    derivation = _derived(opened(arguments))
    answer = parse_answer(words, derivation.model, name="answer")
    verdict = check_answer(derivation, answer, hint=hint)
    return {
        "data": verdict.to_dict(),
        "lines": lines_of_answer(derivation.model, answer),
        "sections": report_pieces(verdict.report()),
    }


def preview_job(given: dict[str, Any], part: Part) -> dict[str, Any]:
    """Read an answer without judging it: each line as mathematics, and notes on what was not read."""
    arguments = Arguments(given, (*MODEL, "answer"))
    words = arguments.text("answer")
    model = opened(arguments).model
    answer = parse_answer(words, model, name="answer")
    return {"lines": lines_of_answer(model, answer), "notes": [str(text(note)) for note in answer.notes]}


def simulate_job(given: dict[str, Any], part: Part) -> dict[str, Any]:
    """Simulate once: the data of ``lagrangian simulate --json``, and the curves to draw."""
    arguments = Arguments(given, (*MODEL, "duration", "initial", "params", "inputs", "samples"))
    run = opened(arguments).simulate(
        arguments.value("duration"),
        initial=arguments.values("initial"),
        params=arguments.values("params"),
        inputs=arguments.values("inputs"),
        samples=arguments.whole("samples", 1001, 2, SERIES),
    )
    return {"data": json.loads(as_json(figures(run))), "curves": _curves(run)}


def _curves(run: Trajectory) -> dict[str, Any]:
    """The samples of the states, inputs and energies, with few digits."""
    table = plot.table(run)
    kept = [c for c in table.columns if "." not in c.name or c.name.startswith("energy.")]
    return {
        "t": rounded(run.t),
        "columns": [{"name": c.name, "unit": c.unit, "words": c.words, "values": rounded(c.values)} for c in kept],
    }


def rounded(values: Any) -> list[float | None]:
    """Return numbers with few digits; one that is not finite becomes None."""
    return [float(f"{x:.{FIGURES}g}") if abs(x) < float("inf") else None for x in map(float, values)]


JOBS: Mapping[str, Task] = {
    "derive": derive_job,
    "look": look_job,
    "page": page_job,
    "check": check_job,
    "preview": preview_job,
    "simulate": simulate_job,
}
"""The jobs by name."""

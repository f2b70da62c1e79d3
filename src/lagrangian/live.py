"""The live page of a system as one HTML file: picture, sliders with their ranges, solver and derivation."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from lagrangian import dynamics
from lagrangian.derive import pages
from lagrangian.derive.algebra import OutOfReach
from lagrangian.errors import ModelError
from lagrangian.graph import Output, Program, replaced
from lagrangian.model import Model
from lagrangian.page.scene import Scene, as_data
from lagrangian.quantities.quantity import unit_factor
from lagrangian.read import dumps
from lagrangian.simulate.browser import BrowserModule, browser_module
from lagrangian.simulate.events import Event
from lagrangian.simulate.inputs import driving
from lagrangian.simulate.simulation import named
from lagrangian.structured.choose import derive_in_form
from lagrangian.values.values import Given
from lagrangian.write.blocks import element_titles
from lagrangian.write.described import system_section
from lagrangian.write.document import Document, Paragraph, Section
from lagrangian.write.expression import Expressions
from lagrangian.write.interactive import Adjustable, PageContents, PageSolver, page_html
from lagrangian.write.numerals import unit as unit_text
from lagrangian.write.scene_svg import scene_svg
from lagrangian.write.text import clean
from lagrangian.write.unicode_math import unicode

FASTEST, SLOWEST = 0.5, 300.0
"""A run of a duration [s] between these is shown in its own time, others within ten seconds."""

NEVER_ZERO = ("kg", "m", "kg m^2")
"""Units of parameters that are not set to 0 by a slider: masses, lengths and inertias."""


LONGEST_SUBTITLE = 480
"""At most so many characters of what is seen stand below the name of a system."""

SUBSCRIPTS = str.maketrans("0123456789", "₀₁₂₃₄₅₆₇₈₉")

MAX_FUNCTIONS = 24_000
"""Functions in JavaScript of more characters are left out as far as WebAssembly replaces them."""


def live_page(model: Model, scene: Scene, anchors: Program, events: Sequence[Event] | Event = ()) -> str:
    """Return the page.

    ``anchors`` is the program of the scene, x, u, p, t → r. ``events`` are found in every run, and their resets are
    made. A positive coordinate without an initial value starts as it is drawn, because 0 is not positive. A system
    whose equations cannot be written out moves nevertheless, and the page says why it has none. Raises `RunError` for
    a system that a browser cannot integrate, and for parameters without a value.
    """
    module = _module(model, anchors, events, _starts(model, scene))
    adjustables = _adjustables(model, module.layout, 0.5 * max(scene.size) / scene.scale)
    contents = PageContents(
        _document(model),
        scene_svg(scene, embedded=True),
        adjustables,
        len(model.coordinates),
        _data(model, module.layout, scene, adjustables),
        PageSolver(module.code, module.layout, module.functions, module.driver),
        subtitle=_subtitle(scene),
        missing=scene.missing,
        space=len(scene.view[0]) == 3,
        bodies=bool(scene.handles),
        flows=bool(scene.flows),
    )
    return page_html(contents)


def _document(model: Model) -> Document:
    """The derivation, or the description of the system and the reason why its equations cannot be written out."""
    try:
        return pages.lay_out(derive_in_form(model), details=True)
    except (ModelError, OutOfReach) as reason:
        words = f"The equations are not written out: {reason.what}."
        said = Section("result", ("Result",), (Paragraph((words,), "note"),))
        return Document(model.name, (system_section(model), said))


def _subtitle(scene: Scene) -> str:
    """What is seen, without the name, which stands above it, and the coordinates, which have sliders."""
    words = scene.description.removeprefix(f"{scene.name}: ").partition(" Coordinates: ")[0]
    if len(words) > LONGEST_SUBTITLE:  # the picture's own description has all of it
        words = re.sub(r"[;.,]?[^;.]*\Z", " …", words[:LONGEST_SUBTITLE], count=1)
    words = re.sub(r"\b([A-Za-z])_?(\d{1,2})\b", lambda name: name[1] + name[2].translate(SUBSCRIPTS), words)
    return words[:1].upper() + words[1:]


def _starts(model: Model, scene: Scene) -> dict[str, float]:
    """The positive coordinates without an initial value, as they are drawn."""
    given = model.settings.get("initial", {})
    return {c.name: scene.pose[c.name] for c in model.coordinates if c.positive and c.name not in given}


def _module(
    model: Model, anchors: Program, events: Sequence[Event] | Event, initial: Mapping[str, float]
) -> BrowserModule:
    """The solver, with the energy balance and the places of the anchors as functions of the state."""
    given = Given.of(model, named(model))
    dims = dict(zip(given.inputs.names, given.inputs.dims, strict=True))
    drive = driving(model, None, model.settings.get("inputs", {}), dims)
    free = {u.name: k for k, u in enumerate(drive.free)}
    functions = {"power": dynamics.power_closed(model, drive.feedback), "anchors": _of_free_inputs(anchors, free)}
    return browser_module(
        model, initial=initial, events=events, functions=functions, fallback=MAX_FUNCTIONS, brief=True
    )


def _of_free_inputs(program: Program, free: Mapping[str, int]) -> Program:
    """The same program with the free inputs alone instead of all inputs."""
    graph, names = program.graph, program.inputs["u"]
    known = {graph.input("u", i): graph.input("u", free[name]) for i, name in enumerate(names) if name in free}
    outputs = {
        name: Output(tuple(replaced(graph, output.ids, known)), output.shape)
        for name, output in program.outputs.items()
    }
    return replace(program, inputs={**program.inputs, "u": tuple(free)}, outputs=outputs)


# -- sliders ----------------------------------------------------------------------------------------------------------


def _adjustables(model: Model, layout: Mapping[str, Any], reach: float) -> list[Adjustable]:
    """Sliders for parameters, free inputs and the initial state; ``reach`` [m] is half the size of the picture."""
    laid = Expressions(model)

    def made(group: Any, entry: Mapping[str, Any], thing: Any, value: float, ends: tuple[float, float]) -> Adjustable:
        label, (low, high) = laid(thing.symbol), sorted(ends)
        unit = unit_text(entry["unit"])
        return Adjustable(group, entry["name"], label, value, low, high, unit, thing.description, unicode(label))

    found = [
        made("p", entry, p, entry["value"], _of_parameter(entry["value"], entry["unit"]))
        for entry, p in zip(layout["parameters"], model.parameters, strict=True)
    ]
    free = [u for u in model.inputs if u.name not in layout["driven"]]
    for entry, u in zip(layout["inputs"], free, strict=True):
        value = _constant(entry["value"])
        size = 3 * abs(value) or _scale(model)
        found.append(made("u", entry, u, value, (-size, size)))
    states = (*model.coordinates, *model.velocities)
    for k, (entry, thing, value) in enumerate(zip(layout["states"], states, layout["start"], strict=True)):
        turning, rate = entry["unit"].startswith("rad"), k >= len(model.coordinates)
        size = (10.0 if rate else math.pi) if turning else reach * (3 if rate else 1)
        size = max(size, abs(value) if turning and not rate else 1.5 * abs(value))
        positive = not rate and getattr(thing, "positive", False)
        found.append(made("x", entry, thing, value, (0.02 * size if positive else -size, size)))
    return found


def _of_parameter(value: float, unit: str) -> tuple[float, float]:
    if value == 0:
        return -1.0, 1.0
    return (0.05 if unit in NEVER_ZERO else 0.0) * value, 3 * value


def _constant(source: Any) -> float:
    return float(source) if isinstance(source, (int, float)) else 0.0


def _scale(model: Model) -> float:
    """A force that moves the system visibly: about the weight of its heaviest parameter in kg."""
    masses = [abs(p.value) for p in model.parameters if p.unit == "kg" and p.value]
    return float(f"{10 * max(masses, default=1.0):.1g}")


# -- data for the scripts ---------------------------------------------------------------------------------------------


def _data(model: Model, layout: Mapping[str, Any], scene: Scene, adjustables: Sequence[Adjustable]) -> dict[str, Any]:
    def group(kind: str) -> dict[str, Any]:
        own = [a for a in adjustables if a.group == kind]
        return {"names": [a.name for a in own], "values": [a.value for a in own]}

    duration = float(layout["duration"])
    angles = [entry["unit"] == "rad" for entry in layout["states"][: len(model.coordinates)]]
    return {
        "file": re.sub(r"[^A-Za-z0-9]+", "-", model.name).strip("-")[:60] or "motion",
        "scene": {**_moving(scene), "flows": _flows(model, scene)},
        "coordinates": len(model.coordinates),
        "angles": angles,
        "constrained": bool(model.constraints),
        "machine": layout["machine"]["size"],
        "x": group("x"),
        "p": group("p"),
        "u": group("u"),
        "duration": duration,
        "pace": 1.0 if FASTEST <= duration <= SLOWEST else duration / 10,
        "section": {"period": _period(layout)},
        "trail": scene.trail or (scene.handles[-1:] if any(angles) else ()),
        "elements": {name: clean(title) for name, title in element_titles(model).items()},
        "model": _file(model, adjustables),
    }


def _period(layout: Mapping[str, Any]) -> float:
    """The time [s] after which a section by time looks again: that of the first parameter that is a speed in rad/s."""
    speeds = [x["value"] for x in layout["parameters"] if x["unit"] == "rad/s" and x["value"]]
    return 2 * math.pi / abs(speeds[0]) if speeds else 1.0


def _flows(model: Model, scene: Scene) -> list[dict[str, Any]]:
    """The charges that flow around loops, by the numbers of their states; see `Flow`."""
    number = {c.name: k for k, c in enumerate(model.coordinates)}
    return [{"state": number[x.coordinate], "box": _rounded(x.box), "sense": x.sense} for x in scene.flows]


def _moving(scene: Scene) -> dict[str, Any]:
    """What moves in the scene as data: in hundredths of a pixel, and positions in hundred thousandths of its size."""
    found = as_data(scene)
    places = max(0, 5 - math.floor(math.log10(max(scene.size) / scene.scale)))
    positions = [[round(x, places) for x in r] for r in found["positions"]]
    return {**found, "parts": _rounded(found["parts"]), "positions": positions}


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, 2 if abs(value) > 3 else 4)
    if isinstance(value, dict):
        return {key: _rounded(x) for key, x in value.items()}
    if isinstance(value, (list, tuple)):
        return [_rounded(x) for x in value]
    return value


_SLOT = re.compile(r"7\.25(\d{5})1e-301")


def _file(model: Model, adjustables: Sequence[Adjustable]) -> list[Any]:
    """The model file as texts with places for numbers between them: [group, index, unit, its
    factor].

    Empty if the model cannot be written as a file. Numbers that occur nowhere else mark the places.
    """
    marks = [float(f"7.25{k:05d}1e-301") for k in range(len(adjustables))]
    mark = {(a.group, a.name): x for a, x in zip(adjustables, marks, strict=True)}
    parameters = tuple(replace(p, value=mark["p", p.name], unit=None) for p in model.parameters)
    settings = {**model.settings, "initial": {a.name: mark["x", a.name] for a in adjustables if a.group == "x"}}
    inputs = {a.name: mark["u", a.name] for a in adjustables if a.group == "u"}
    if inputs:
        settings["inputs"] = {**model.settings.get("inputs", {}), **inputs}
    try:
        text = dumps(replace(model, parameters=parameters, settings=settings, _memo={}))
    except ModelError:
        return []
    pieces: list[Any] = list(_SLOT.split(text))
    for n in range(1, len(pieces), 2):
        a = adjustables[int(pieces[n])]
        unit = next((p.unit or "" for p in model.parameters if a.group == "p" and p.name == a.name), "")
        place = [b.name for b in adjustables if b.group == a.group].index(a.name)
        pieces[n] = [a.group, place, unit, unit_factor(unit) if unit else 1.0]
    return pieces

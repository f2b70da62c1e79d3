"""A run in a browser: the integrator of a model as WebAssembly, what a host needs to know, and functions in JavaScript.

BrowserModule.code       the module of WebAssembly
BrowserModule.layout     names, units, values and places in memory, as plain data
BrowserModule.functions  a JavaScript expression: an object of functions (state, params, inputs, t) → Float64Array
BrowserModule.driver     a script that runs the module: ``lagrangianSolver.makeSolver(code, layout)``
"""

from __future__ import annotations

import json
import math
from base64 import b64encode
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lagrangian.codegen.javascript import names_function
from lagrangian.codegen.labels import comment
from lagrangian.errors import RunError
from lagrangian.integrate import METHODS, RunStatus
from lagrangian.integrate.portable import driver
from lagrangian.model import Model
from lagrangian.records import dataclass
from lagrangian.simulate import drift, spared
from lagrangian.simulate.admission import check_masses
from lagrangian.simulate.browser_parts import BrowserParts, Quantities
from lagrangian.simulate.events import Event, events_of
from lagrangian.simulate.inputs import InputSignals, SampledInput, driving
from lagrangian.simulate.integrating import right_hand_side
from lagrangian.simulate.plot import Units
from lagrangian.simulate.settings import DEFAULT, RunSettings
from lagrangian.simulate.simulation import initial_state, named
from lagrangian.simulate.starts import held, onto_constraints
from lagrangian.values.values import Given

VERSION = 1
"""The version of the layout; the driver and the module of one version belong together."""

STEP = 1e-3
"""The default length [s] of fixed steps."""

MAX_STEPS = 1_000_000
"""The default limit on the steps of one call: a page must not stand still."""

CODES = {
    "reached": RunStatus.REACHED,
    "notFinite": RunStatus.NOT_FINITE,
    "tooMany": RunStatus.TOO_MANY,
    "late": RunStatus.LATE,
    "underflow": RunStatus.UNDERFLOW,
    "noConvergence": RunStatus.NO_CONVERGENCE,
    "chatters": RunStatus.CHATTERS,
    "broken": RunStatus.BROKEN,
    "apart": RunStatus.APART,
    "unfit": RunStatus.UNFIT,
}
"""The statuses that the driver gives or reads, by its names for them."""


_ABOUT = """/* Runs of a system with coordinates {names}, in a browser, a worker or Node.

   {stem}.wasm  the integrator by the method {method}, compiled from the equations of motion
   {stem}.json  its layout: states, parameters and inputs with their names, units and values
   {stem}.js    this script: the solver, and functions (state, params, inputs, t) such as {stem}.energy: T and V

   In a page, with this script loaded before:

     const bytes = await (await fetch("{stem}.wasm")).arrayBuffer();
     const layout = await (await fetch("{stem}.json")).json();
     const solver = await lagrangianSolver.load(bytes, layout, {stem});
     const run = solver.solve({{ t1: 10, samples: 601 }});          // run.t, run.states, run.status, run.message
     solver.start().advance(1 / 60).state;                          // or step by step, for a picture that moves

   In Node: const {{ lagrangianSolver, {stem} }} = require("./{stem}.js"), and the files by fs. A page whose policy
   (Content-Security-Policy) lacks 'wasm-unsafe-eval' gets fixed steps in JavaScript instead. Steps, events and
   constraints are those of the Python package; the last digits differ, because WebAssembly has no fused products. */
"""


@dataclass(frozen=True)
class BrowserModule:
    """An integrator for browsers; see the module's text for its parts."""

    code: bytes
    layout: Mapping[str, Any]
    functions: str
    driver: str

    def script(self, name: str = "physics") -> str:
        """The whole as one plain script that defines the constant ``name``: {bytes, layout, functions, solver()}.

        It can stand in a script element: nothing in it ends one.
        """
        code = b64encode(self.code).decode("ascii")
        lines = [
            self.driver,
            f"const {name} = (() => {{",
            f"const bytes = Uint8Array.from(atob({json.dumps(code)}), (c) => c.charCodeAt(0));",
            f"const layout = {self.layout_text};",
            f"const functions = {self.functions};",
            "const solver = () => lagrangianSolver.load(bytes, layout, functions);",
            "return {bytes, layout, functions, solver};",
            "})();",
        ]
        return "\n".join(lines) + "\n"

    def files(self, stem: str) -> dict[str, str | bytes]:
        """The module, its layout and a script as files, by name; the constant ``stem`` of the script has the functions.

        Raises `RunError` if a constant of JavaScript cannot have this name.
        """
        if not names_function(stem) or stem == "lagrangianSolver":
            raise RunError(f"'{stem}' cannot name a constant of JavaScript", fix="choose another name", code="E702")
        moving = self.layout["states"][: self.layout["coordinates"]]
        names = ", ".join(comment(state["name"]) for state in moving)
        about = _ABOUT.format(names=names, stem=stem, method=self.layout["method"])
        script = [
            about,
            self.driver,
            f"const {stem} = {self.functions};",
            "",
            f'if (typeof module !== "undefined") module.exports = {{ lagrangianSolver, {stem} }};',
        ]
        return {
            f"{stem}.wasm": self.code,
            f"{stem}.json": self.layout_text + "\n",
            f"{stem}.js": "\n".join(script) + "\n",
        }

    @property
    def layout_text(self) -> str:
        """The layout as JSON, in ASCII and without a character that has a meaning in a script element."""
        return json.dumps(dict(self.layout), allow_nan=False, indent=1).replace("<", "\\u003c").replace("&", "\\u0026")


def browser_module(
    system: Any,
    method: str = DEFAULT,
    *,
    initial: Mapping[Any, Any] | Sequence[float] | None = None,
    params: Mapping[Any, Any] | None = None,
    inputs: Mapping[Any, Any] | None = None,
    events: Sequence[Event] | Event = (),
    rtol: float = 1e-9,
    atol: float = 1e-12,
    step: float | str | None = None,
    functions: Mapping[str, Quantities] | None = None,
    fallback: float = math.inf,
    brief: bool = False,
    lanes: int = 1,
) -> BrowserModule:
    """Compile a system, or its model, for a browser.

    The state is [q; v]. Inputs given as expressions, in the model file or in ``inputs``, are compiled in; tables are
    followed; the others are held constant, and the page may change them. ``initial``, ``params`` and ``inputs`` set the
    values with which the page begins, ``rtol``, ``atol`` and ``step`` the defaults of a run, as in
    `lagrangian.System.simulate`.

    ``functions``: further functions of JavaScript, by name: expressions and points of the model, or a program over x,
    u, p, t. ``energy``, which returns T and V, is among them unless a ``power`` is asked for. ``fallback``: with what
    runs in JavaScript need where WebAssembly is forbidden, if that makes at most so many characters. ``brief``: in few
    characters, without comments. ``lanes``: 2 computes two runs at once.

    Raises `RunError` for a method that WebAssembly cannot run, for dry friction, for inputs that are Python functions,
    and otherwise as a simulation does.
    """
    model: Model = getattr(system, "model", system)
    settings = RunSettings(method=method, rtol=rtol, atol=atol, step=_step(method, step), events=events)
    given = Given.of(model, named(model))
    dims = dict(zip(given.inputs.names, given.inputs.dims, strict=True))
    drive = driving(model, inputs, model.settings.get("inputs", {}), dims)
    _check(model, method, drive)
    program = right_hand_side(model, drive)
    p = given.parameter_values(params)
    check_masses(model, p)
    guess = initial_state(given, model, program, model.settings.get("initial", {}), initial, {})
    x0, _ = onto_constraints(model, guess, p, float(settings.start), held(model, None), compiled=False)
    knowing, _ = spared.of_run(model, x0, p, float(settings.start))
    parts = BrowserParts.of(knowing, drive, method, events_of(model, settings.events))
    made = parts.compiled(method, lanes, settings.of_a_step()[0])
    layout = {
        "version": VERSION,
        "name": model.name,
        "method": method,
        "adaptive": METHODS[method].adaptive,
        **_named_values(model, drive, p),
        "start": x0[: len(model.coordinates) + len(model.velocities)].tolist(),
        **_run(settings, parts, p, _duration(model)),
        **parts.layout(),
        "statuses": {str(int(s)): s.message for s in RunStatus},
        "codes": {name: int(status) for name, status in CODES.items()},
        "machine": made.layout,
    }
    return BrowserModule(made.code, layout, parts.functions(functions or {}, fallback=fallback, brief=brief), driver())


def _run(settings: RunSettings, parts: BrowserParts, p: NDArray[np.float64], duration: float) -> dict[str, Any]:
    """The duration of a run [s], and the options that a page can leave out."""
    relative, absolute = settings.of_a_step()
    defaults = {
        "rtol": relative,
        "atol": absolute,
        "step": STEP if settings.step is None else float(settings.step),
        "maxStep": parts.longest(p, duration),
        "maxSteps": MAX_STEPS,
        "maxEvents": settings.max_events,
    }
    return {"duration": duration, "defaults": defaults}


def _step(method: str, step: float | str | None) -> float | str | None:
    """The length of fixed steps, `STEP` unless it is given."""
    fixed = method in METHODS and not METHODS[method].adaptive
    return STEP if fixed and step is None else step


def _check(model: Model, method: str, drive: InputSignals) -> None:
    """Raise `RunError` for what a browser cannot integrate."""
    if method not in METHODS:
        raise RunError(
            f"method '{method}' does not run in a browser", fix=f"use one of {', '.join(METHODS)}", code="E402"
        )
    drift.check_method(model, method)
    if model.frictions:
        raise RunError(
            f"{model.frictions[0].title} sticks and slips, so that the equations change during a run: no page "
            "integrates that",
            fix="see its run as curves: with simulate in Python, with the command or in the app",
            code="E501",
        )
    called = [u.name for u, source in zip(drive.free, drive.sources, strict=True) if callable(source)]
    if called:
        raise RunError(
            f"input '{called[0]}' is a Python function, which a browser cannot call",
            fix="give the input as an expression or a table",
            code="E501",
        )


def _duration(model: Model) -> float:
    """The duration of a run [s]: that of the model file, or 10 s."""
    if model.settings.get("duration") is None:
        return 10.0
    times = RunSettings(samples=2).instants(model, 1)
    return float(times[-1] - times[0]) or 10.0


def _named_values(model: Model, drive: InputSignals, p: NDArray[np.float64]) -> dict[str, Any]:
    """States, parameters and inputs with their units, and the values with which a page begins."""
    units = Units(model)

    def row(x: Any, **more: Any) -> dict[str, Any]:
        return {"name": x.name, "unit": units.of(x.symbol), **more}

    def source(given: Any) -> dict[str, Any]:
        if isinstance(given, SampledInput):
            table = {"times": given.times.tolist(), "values": given.values.tolist(), "hold": given.hold}
            return {"value": float(given.values[0]), "table": table}
        return {"value": float(given)}

    return {
        "coordinates": len(model.coordinates),
        "states": [row(x) for x in (*model.coordinates, *model.velocities)],
        "parameters": [row(x, value=float(value)) for x, value in zip(model.parameters, p, strict=True)],
        "inputs": [row(u, **source(given)) for u, given in zip(drive.free, drive.sources, strict=True)],
        "driven": [u.name for u in model.inputs if u.symbol in drive.feedback],
    }

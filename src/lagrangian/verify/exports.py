"""Runs exported source code and compares it with the slow evaluation of its programs."""

from __future__ import annotations

import ctypes
import importlib.util
import json
import shutil
import subprocess
import tempfile
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from lagrangian.graph import Program
from lagrangian.page.formula import Check, text
from lagrangian.verify.states import Expected, State, cancelling, relative

Array: TypeAlias = NDArray[np.float64]

Sources: TypeAlias = Callable[[str, str], Mapping[str, str]]
"""(language, stem) → file name → text."""

Call: TypeAlias = Callable[[State], Sequence[Array]]
"""A function of an exported file that takes a state and returns its outputs in order."""

Caller: TypeAlias = Callable[[str, Program], Call]
"""The name of a program, and the program → its function in an exported file."""

Unrun: TypeAlias = tuple[bool | None, str]
"""Whether a file that could not be run is at fault (False) or this machine (None), and why."""

TOLERANCE = 1e-9
"""Two numbers are equal if their difference, relative to the largest term of the output, is at most this."""

COMPILERS = ("cc", "gcc", "clang")
"""C compilers that accept these options, in the order in which they are tried."""

OPTIONS = ("-std=c99", "-O1", "-ffp-contract=off", "-shared", "-fPIC")
"""Options for compiling the exported C: every product and sum is rounded, as in the slow evaluation."""

STEM = "exported"

NODE = "node"
"""What runs JavaScript outside a browser."""

_CALLS = f"""const made = require("./{STEM}.js");
const wanted = JSON.parse(require("fs").readFileSync(0, "utf8"));
console.log(JSON.stringify(wanted.map(([name, given]) => Array.from(made[name](...given)))));
"""

PATIENCE = 300
"""The time [s] after which a C compiler, or Node, is stopped."""


def exported(
    programs: Mapping[str, Program], sources: Sources, expected: Expected, states: Sequence[State]
) -> tuple[Check, ...]:
    """Return checks of the exported Python, the exported C and the exported JavaScript.

    ``programs`` are those in the source, by name. If no C compiler is found, ``holds`` is None for the check of C, and
    so it is for that of JavaScript if Node is not found.
    """
    with tempfile.TemporaryDirectory(prefix="lagrangian-", ignore_cleanup_errors=True) as folder:
        kept = Path(folder)
        made = (
            _python(sources("python", STEM), kept),
            _c(sources("c", STEM), kept),
            _javascript(programs, sources("javascript", STEM), states, kept),
        )
        languages = ("Python", "C", "JavaScript")
        return tuple(
            Check(text(f"the exported {language} gives the same numbers"), *_judged(run, programs, expected, states))
            for language, run in zip(languages, made, strict=True)
        )


def _judged(
    run: Caller | Unrun, programs: Mapping[str, Program], expected: Expected, states: Sequence[State]
) -> tuple[bool | None, str]:
    """Whether the functions of a file agree with their programs, or why they could not be called; and the figure."""
    return run if isinstance(run, tuple) else _compared(programs, run, expected, states)


def _python(texts: Mapping[str, str], folder: Path) -> Caller:
    module = _imported(folder, texts)

    def caller(name: str, program: Program) -> Call:
        function = getattr(module, f"{STEM}_{name}")

        def call(state: State) -> Sequence[Array]:
            given = [np.array(state[group]) if group != "t" else np.array(state["t"][0]) for group in program.inputs]
            answer = function(*given)
            return answer if isinstance(answer, tuple) else (answer,)

        return call

    return caller


def _imported(folder: Path, texts: Mapping[str, str]) -> ModuleType:
    """Import the exported module from a file, as users do."""
    (file_name,) = texts
    path = folder / file_name
    path.write_text(texts[file_name], encoding="utf-8")
    spec = importlib.util.spec_from_file_location(STEM, path)
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def _c(texts: Mapping[str, str], folder: Path) -> Caller | Unrun:
    compiler = next((path for name in COMPILERS if (path := shutil.which(name))), None)
    if compiler is None:
        return None, f"not checked: no C compiler was found (looked for {', '.join(COMPILERS)})"
    for file_name, source in texts.items():
        (folder / file_name).write_text(source, encoding="utf-8")
    library = folder / f"{STEM}.shared"
    command = [compiler, *OPTIONS, "-o", str(library), str(folder / f"{STEM}.c"), "-lm"]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=PATIENCE, check=False)
    except (OSError, subprocess.TimeoutExpired) as error:
        return None, f"not checked: the C compiler could not be run ({error})"
    if done.returncode:
        said = next((line for line in done.stderr.splitlines() if "error" in line), f"exit {done.returncode}")
        return False, f"the C compiler refuses it: {said[:200]}"
    loaded = ctypes.CDLL(str(library))

    def caller(name: str, program: Program) -> Call:
        function = getattr(loaded, f"{STEM}_{name}")
        function.restype = None

        def call(state: State) -> Sequence[Array]:
            given = [np.array(state[group], float) for group in program.inputs]
            answers = [np.full(len(output.ids), np.nan) for output in program.outputs.values()]
            function(*(x.ctypes.data_as(ctypes.c_void_p) for x in (*given, *answers)))
            return answers

        return call

    return caller


def _javascript(
    programs: Mapping[str, Program], texts: Mapping[str, str], states: Sequence[State], folder: Path
) -> Caller | Unrun:
    node = shutil.which(NODE)
    if node is None:
        return None, "not checked: Node was not found (looked for node)"
    for file_name, source in texts.items():
        (folder / file_name).write_text(source, encoding="utf-8")
    (folder / "calls.js").write_text(_CALLS, encoding="utf-8")
    wanted = [
        [f"{STEM}_{name}", [state[group] if group != "t" else state["t"][0] for group in program.inputs]]
        for state in states
        for name, program in programs.items()
    ]
    command = [node, str(folder / "calls.js")]
    try:
        done = subprocess.run(
            command, input=json.dumps(wanted), capture_output=True, text=True, timeout=PATIENCE, check=False
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        return None, f"not checked: Node could not be run ({error})"
    if done.returncode:
        said = next((line for line in done.stderr.splitlines() if "Error" in line), f"exit {done.returncode}")
        return False, f"Node refuses it: {said[:200]}"
    answers = iter(json.loads(done.stdout))
    known = {(name, id(state)): next(answers) for state in states for name in programs}

    def caller(name: str, program: Program) -> Call:
        ends = np.cumsum([len(output.ids) for output in program.outputs.values()])[:-1]
        return lambda state: np.split(np.array(known[name, id(state)], float), ends)

    return caller


def _compared(
    programs: Mapping[str, Program], caller: Caller, expected: Expected, states: Sequence[State]
) -> tuple[bool, str]:
    """Whether every function agrees with the slow evaluation of its program, and the figure."""
    worst, calls = 0.0, {name: caller(name, program) for name, program in programs.items()}
    for state in states:
        M = np.array(expected.at("mass_matrix", state)["M"], float)
        for name, call in calls.items():
            terms = np.ravel(cancelling(name, state, M))
            for slow, answer in zip(expected.at(name, state).values(), call(state), strict=True):
                found = np.ravel(np.array(slow, float))
                worst = float(np.maximum(worst, relative(np.ravel(answer) - found, found, terms)))
    n = f"{len(states)} random state{'s' if len(states) != 1 else ''}"
    return worst < TOLERANCE, f"largest relative difference {worst:.1e} at {n}"

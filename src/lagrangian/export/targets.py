"""The targets of exports: their names, the endings of their files, and who writes them."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping
from importlib import import_module
from typing import TypeAlias

from lagrangian.errors import ModelError
from lagrangian.export.names import HEADERS, LONGEST_STEM, MODULES, WORDS_OF_C, WORDS_OF_MODELICA, check_stem
from lagrangian.model import Model
from lagrangian.records import dataclass

_log = logging.getLogger(__name__)

Files: TypeAlias = Mapping[str, str | bytes]
"""Everything that an export writes, as file name → text or bytes."""


@dataclass(frozen=True)
class ExportTarget:
    """A language or a program: the ending of its main file, and the longest name that it takes.

    ``module`` is the file of this room that writes it, by its function ``files``; it is imported when it is needed.
    ``reserved`` are names that the target has another use for.
    ``whole``: the files contain the right-hand side, multipliers and residuals as well (`programs.exported`).
    """

    ending: str
    module: str
    longest: int = LONGEST_STEM
    whole: bool = True
    reserved: frozenset[str] = frozenset()

    def write(self, model: Model, stem: str) -> Files:
        """Everything that is written, as file name → text or bytes."""
        function: Callable[[Model, str], Files] = import_module(f"lagrangian.export.{self.module}").files
        return function(model, stem)


TARGETS: dict[str, ExportTarget] = {
    "c": ExportTarget(".c", "c99", whole=False, reserved=HEADERS),
    "python": ExportTarget(".py", "numpy_module", whole=False, reserved=MODULES),
    "javascript": ExportTarget(".js", "javascript", whole=False),
    "wasm": ExportTarget(".wasm", "wasm"),
    "matlab": ExportTarget(".m", "matlab", longest=50),  # MATLAB reads 63 characters of stem_mass_matrix
    "jax": ExportTarget(".py", "jax_module", reserved=MODULES),
    "casadi": ExportTarget(".py", "casadi_module", reserved=MODULES),
    "julia": ExportTarget(".jl", "julia_module"),
    "simulink": ExportTarget(".c", "simulink.sfunction", longest=50, reserved=WORDS_OF_C),
    "modelica": ExportTarget(".mo", "modelica", reserved=WORDS_OF_MODELICA),
    "fmu2": ExportTarget(".fmu", "fmu.fmu2"),
    "fmu3": ExportTarget(".fmu", "fmu.fmu3"),
}
"""Everything that a system can be exported to; of targets with the same ending the first is meant by it."""

ENDINGS = {name: target.ending for name, target in TARGETS.items()}
"""The endings of the main files."""


def target_of(ending: str, to: str | None, title: str) -> str:
    """Return the name of the target: ``to``, or the first one whose files have this ending.

    Raises `ModelError` for a target that does not exist, an ending that no target has, and one that ``to`` has not.
    """
    if to is None:
        for name, target in TARGETS.items():
            if target.ending == ending:
                return name
        listed = ", ".join(dict.fromkeys(ENDINGS.values()))
        raise ModelError(f"the ending of '{title}' is not supported", fix=f"use one of {listed}", code="E402")
    _known(to)
    if TARGETS[to].ending != ending:
        raise ModelError(f"'{title}' does not end in {TARGETS[to].ending}, as files of '{to}' do", code="E402")
    return to


def _known(language: str) -> None:
    if language not in TARGETS:
        raise ModelError(f"there is no export to '{language}'", fix=f"use one of {', '.join(TARGETS)}", code="E402")


def exported_files(model: Model, language: str, stem: str) -> Files:
    """Return everything that an export to one of `TARGETS` writes; functions are called ``stem_forward``, ….

    The files run without this package. Raises `ModelError` for an unknown target and for a name that cannot be used.
    """
    _known(language)
    check_stem(stem, TARGETS[language].longest, f" in {language}" if TARGETS[language].longest < LONGEST_STEM else "")
    if stem in TARGETS[language].reserved:
        raise ModelError(
            f"'{stem}' cannot name files for {language}: it has a meaning there",
            fix=f"use another name, such as {stem}_system",
            code="E702",
        )
    _log.info("writing %s", language)
    return TARGETS[language].write(model, stem)


def sources(model: Model, language: str, stem: str) -> dict[str, str]:
    """Return the same of a target that writes nothing but text."""
    return {
        name: content for name, content in exported_files(model, language, stem).items() if isinstance(content, str)
    }

"""The class `Derivation`: the data of `derive`, with methods that write and verify them."""

from __future__ import annotations

from dataclasses import replace
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any

from lagrangian import bounded, derive, dynamics
from lagrangian.advice import Advice, Verb
from lagrangian.calls import DERIVATION, Guided
from lagrangian.derive import pages
from lagrangian.errors import Error
from lagrangian.model import Model
from lagrangian.model.rows import pressing_rows
from lagrangian.page.formula import Check, text
from lagrangian.records import dataclass
from lagrangian.structured.choose import AskedForm, derive_in_form, is_structured, takes_long
from lagrangian.values.multiplier_units import units_of_multipliers
from lagrangian.verify.equations import verify
from lagrangian.verify.listed import verify_listed
from lagrangian.viewed import Viewed

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence
    from pathlib import Path

    from lagrangian.check.classes import CheckedClass
    from lagrangian.check.classes.judge import FeedbackFormat
    from lagrangian.check.classes.scheme import AllowedCoordinates
    from lagrangian.check.verb import CheckedAnswer
    from lagrangian.derive import Why
    from lagrangian.page.report import Report
    from lagrangian.write import Notation
    from lagrangian.write.document import HeadPicture


@dataclass(frozen=True, eq=False)
class Derivation(Guided, derive.Derived):
    """The seven steps of a derivation, its results in SymPy, and methods that write it in several formats."""

    _guide = DERIVATION

    def to_text(
        self, *, notation: Notation = "lecture", brief: bool = False, full: bool = False, width: int = 80
    ) -> str:
        """Return Unicode text for a terminal of ``width`` columns."""
        return pages.to_text(self, notation=notation, brief=brief, full=full, width=width)

    def to_markdown(self, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
        """Return Markdown with LaTeX mathematics."""
        return pages.to_markdown(self, notation=notation, brief=brief, full=full)

    def to_latex(self, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
        """Return a complete LaTeX article."""
        return pages.to_latex(self, notation=notation, brief=brief, full=full)

    def to_html(self, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> str:
        """Return one self-contained HTML page that works offline."""
        return pages.to_html(self, notation=notation, brief=brief, full=full)

    def to_dict(self, *, notation: Notation = "lecture", brief: bool = False, full: bool = False) -> dict[str, Any]:
        """Return plain data that can be written as JSON."""
        return pages.to_dict(self, notation=notation, brief=brief, full=full)

    def verify(self, *, states: int = 50, seed: int = 1, exports: bool = False) -> tuple[Check, ...]:
        """Check the equations, and everything that is made of them, by independent routes at random states.

        The equations are compared with virtual work and with automatic differentiation of L; every function of
        `lagrangian.Compiled` with its formulas and with those equations; the exported Python and C by running them; the
        linearization with difference quotients. Every check has its figure. ``holds`` is None if something could not be
        checked on this machine, such as C without a compiler. ``exports``: the exports to other programs are run in
        them as well, where they are installed, a run and its files are compared with another run, and the checklist as
        text, Markdown, LaTeX and HTML is read back. Raises
        `ModelError` if ``states`` is not a valid number.
        """
        found = verify_lines(self, states=states, seed=seed)
        if exports and self.form == "expanded":
            from lagrangian.check.html_formulas import as_markdown
            from lagrangian.check.printed import printed_checks

            formats = {"text": self.to_text, "Markdown": self.to_markdown, "LaTeX": self.to_latex}
            pages = {name: write(brief=True) for name, write in formats.items()}
            found += printed_checks(self, {**pages, "HTML": as_markdown(self.to_html(brief=True))})
        return (*found, *verify_compiled(self.model, states=states, seed=seed, exports=exports))

    def check(self, answer: Any, *, hint: int = 3) -> CheckedAnswer:
        """Return whether an answer is right, in what sense, or where it is wrong and why.

        ``answer`` is plain text or LaTeX (equations, T = …, V = …, Ξ, whole derivations by hand), a list of SymPy
        equations, or energies by name. ``hint`` limits how much the result reveals: 0 right or wrong, 1 the line, 2 the
        element and the step, 3 the term. Raises `ParseError` if a text cannot be read.
        """
        from lagrangian.check.verb import check_answer

        return check_answer(self, answer, hint=hint)

    def check_class(
        self,
        answers: str | Path | Mapping[str, str],
        *,
        points: Mapping[str, float] | None = None,
        require: Sequence[str] = (),
        coordinates: AllowedCoordinates = "any",
        other: float = 0.5,
        hint: int = 3,
        told: int | None = None,
        feedback: FeedbackFormat | None = None,
        roster: str | Path | None = None,
        store: str | Path | None = None,
        processes: int | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> CheckedClass:
        """Check the answers of a class: a folder with a file for each, or texts by name.

        ``points`` says what each part is worth ({"T": 2, "V": 2, "Xi": 2, "equations": 4}), ``require`` lists the parts
        without which a right answer is incomplete, and with ``coordinates="given"`` an answer in other coordinates gets
        only the share ``other`` of its points. What follows from a wrong line above costs nothing again. ``hint``
        limits the results as in `check`, and ``told`` (by default the same) what students are told; ``feedback``
        ("text", "markdown" or "html") makes a page for each, which `CheckedClass.write_feedback` writes. ``roster`` is
        a list of the class as CSV. ``store`` is a file in which verdicts are kept, so that the same answer is not
        judged twice. ``processes`` judge side by side, by default as many as there are cores and work for; the results
        are the same. ``progress`` is called with the number of answers that are done and of all.

        Raises `ModelError` for arguments that do not fit, and `Error` for files that cannot be read. An answer that
        cannot be read does not stop the others.
        """
        from lagrangian.check.classes import Judging, MarkingScheme, check_class

        scheme = MarkingScheme(points=points or {}, require=require, coordinates=coordinates, other=other)
        judging = Judging(scheme=scheme, hint=hint, told=hint if told is None else told, feedback=feedback)
        run: dict[str, Any] = {"roster": roster, "store": store, "processes": processes, "progress": progress}
        return check_class(self.model, answers, judging=judging, derivation=self, **run)

    @cached_property
    def why(self) -> Why:
        """Why Lagrange's equations hold for this system: F = ma for every mass, and how constraint forces drop out.

        The lecture's equations (1) to (12) with the symbols of this system, every equality checked, and the constraint
        force on every body. Raises `ModelError` for a system that is given by its energies, which has no masses, and
        for one whose equations cannot be written in the coordinates alone.
        """
        if self.form == "expanded":
            return derive.why(self)
        try:
            return derive.why(derive.derive(self.model))
        except bounded.TooLarge as error:
            raise bounded.TooLarge(
                f"why the equations hold is told with equations that are written out, and {error.what}",
                fix=Advice(
                    Verb("derive"), " writes the steps in named quantities, and ", Verb("verify"), " checks them"
                ),
                code="E601",
            ) from None

    @property
    def reasoning(self) -> Report[Model] | None:
        """The page of `why`; None for a system that has none, and where its equations are too long to read."""
        if self.form == "structured" and is_structured(self.model):
            return None
        try:
            return self.why.report()
        except Error:
            return None

    @property
    def picture(self) -> HeadPicture | None:
        """The picture at the head of the HTML and LaTeX pages, made when it is first asked for."""
        from lagrangian.look.heading import head_picture

        return head_picture(self.model)

    def _repr_html_(self) -> str:
        return pages.to_html_fragment(self)

    def __str__(self) -> str:
        """Return the derivation as text."""
        return self.to_text()


def verify_lines(derivation: derive.Derived, *, states: int, seed: int) -> tuple[Check, ...]:
    """Check the equations as they are written, in the coordinates or in named quantities."""
    if derivation.form == "structured":
        return verify_listed(derivation, states=states, seed=seed)
    return verify(derivation, states=states, seed=seed)


def verify_compiled(model: Model, *, states: int, seed: int, exports: bool) -> tuple[Check, ...]:
    """Check the compiled code, the exported code and the linearization of a model."""
    from lagrangian.compiled import Compiled
    from lagrangian.export import targets
    from lagrangian.verify.products import verify_products  # imported here because deriving needs none of these

    if pressing_rows(model):
        why = "not made: they are functions of the system whose regime says what slips and what sticks"
        return (Check(text("compiled functions"), None, why),)
    sources = partial(targets.sources, model)
    return verify_products(model, Compiled(model), sources, states=states, seed=seed, exports=exports)


def verify_floating(model: Model, *, states: int, seed: int, exports: bool) -> tuple[Check, ...]:
    """Check a model with floating frames: compare its programs with each other, then check what is made of them."""
    from lagrangian.verify.motion import verify_motion

    found = verify_motion(model, states=states, seed=seed)
    return (*found, *verify_compiled(model, states=states, seed=seed, exports=exports))


@bounded.answered("writing the equations out", takes_long)
def derive_and_verify(model: Model, *, detail: derive.Detail = "usual", form: AskedForm = "auto") -> Derivation:
    """Derive a model and add the checks at the end; see `lagrangian.System.derive`."""
    data = derive_in_form(model, form, detail=detail, units=units_of_multipliers(model))
    made = Derivation(**vars(data))
    known = dynamics.notices(model)
    if made.constraints is not None:  # a row that the machine leaves out as well is said once
        told = " ".join(map(str, known))
        known += tuple(n for n in made.constraints.notices() if n.where.removeprefix("constraint ") not in told)
    made = replace(made, notices=known, verified=verify_lines(made, states=10, seed=1))
    steps = tuple(replace(step, view=partial(_section, made, f"step-{step.number}")) for step in made.steps)
    steps = Viewed(steps, partial(pages.steps_to_html, made))
    return replace(made, steps=steps, ledger=Viewed(made.ledger, partial(_ledger, made)))


def _section(derivation: Derivation, anchor: str) -> str:
    return pages.section_to_html(derivation, anchor)


def _ledger(derivation: Derivation) -> str:
    from lagrangian.write.views import table_view

    rows = [(row.element, row.column, str(row.reason)) for row in derivation.ledger]
    return table_view(derivation.model.name, ["Every element once"], ("element", "counted in", "because"), rows)

"""A verdict in the words of the lecture; the hint level limits how much it reveals."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

import sympy as sp

from lagrangian import bounded
from lagrangian.check.by_letters import called_by_letters
from lagrangian.check.terms.sides import differs, on_side
from lagrangian.check.verdict import Finding, Mistake, Status, TermDifference, Verdict
from lagrangian.errors import listed
from lagrangian.model import Model
from lagrangian.page.formula import Item, Left, Table, Text, Verbatim, text
from lagrangian.page.report import Part, Report

STEPS = {
    0: "Is it holonomic?",
    1: "Generalized coordinates",
    2: "Kinetic co-energy",
    3: "Potential energy",
    4: "Lagrangian",
    5: "Left-hand sides",
    6: "Non-conservative forces",
}
"""The steps of the lecture."""


def step_title(step: int) -> str:
    """Return the title of a step within a sentence; names keep their capitals."""
    title = STEPS[step]
    return title if title.startswith("Lagrang") else title[:1].lower() + title[1:]


MOST_SAID_FIRST = 2
"""The most terms that are named where it is said that only this line is wrong."""

MOST_SAID_ABOVE = 3
"""The most lines above a wrong one that are said not to be judged, by number."""

UNSEEN = frozenset({"not_squared", "lost", "lost_in_a_sum", "wrong_number"})
"""Kinds that say nothing new of an equation as second choices: a term is missing there, or has a wrong number."""


def report(verdict: Verdict, model: Model) -> Report:
    """Return the verdict as a report."""
    parts = [Part(text("Is it right?"), tuple(_summary(verdict, model)))]
    if verdict.hint >= 1 and verdict.findings:
        parts.append(Part(text("Line by line"), (_lines(verdict, model),)))
    if verdict.hint >= 2 and (verdict.mistakes or _differing(verdict) or verdict.open_findings):
        parts.append(Part(text("What went wrong"), tuple(_why(verdict, model))))
    if verdict.hint >= 3 and (found := tuple(_terms(verdict, model))):
        parts.append(Part(text("Term by term"), found))
    parts = [replace(part, items=called_by_letters(part.items, model)) for part in parts]
    return Report(f"Your answer: {model.name}", model, tuple(parts), Verdict.to_dict(verdict))


def _summary(verdict: Verdict, model: Model) -> Iterator[Item]:
    yield text(*_headline(verdict))
    if verdict.hint == 0:
        return
    first = verdict.first_wrong
    if verdict.status is Status.WRONG and first is not None and first.clash:
        yield text(
            "Look at ", first.line.title, *_of(first, model), f", and {first.clash}: they do not fit each other."
        )
    elif verdict.status is Status.WRONG and first is not None and not verdict.motion:
        yield text("Look at ", first.line.title, *_of(first, model), *_as_first(verdict))
    if any(f.follows for f in verdict.findings):
        yield text("What follows consistently from a wrong line is marked so; it needs no correction of its own.")
    yield from verdict.told


def _as_first(verdict: Verdict) -> tuple[str, ...]:
    """That a line is the first that is not right, or only the first of those that were judged."""
    above, partly = verdict.unjudged, verdict.partly
    if not above and not partly:
        return (": that is the first that is not right.",)
    said = [(above, "not judged"), (partly, "judged only in part")]
    told = [f"{_numbered(x)} above it {'was' if len(x) == 1 else 'were'} {how}" for x, how in said if x]
    return (f": of what was judged, that is the first that is not right; {', and '.join(told)}.",)


def _numbered(lines: Sequence[int]) -> str:
    """Some lines by their numbers, if they are few."""
    return f"line{'s' * (len(lines) > 1)} {listed([*map(str, lines)])}" if len(lines) <= MOST_SAID_ABOVE else "lines"


def _headline(verdict: Verdict) -> tuple[str | Verbatim | Left, ...]:
    if not verdict.findings:
        return ("Nothing is stated that can be checked: write equations, T = …, V = …, L = … or a Ξ.",)
    shown = _shown(verdict.findings)
    wrong = sum(not f.status.right for f in shown)
    lines = len(shown)
    match verdict.status:
        case Status.RIGHT:
            return ("Right.",)
        case Status.EQUIVALENT:
            return ("Right. It is written in another way than ours, and says the same.",)
        case Status.OTHER_COORDINATES:
            return ("Right, in other coordinates: any independent and complete set is OK.",)
        case Status.SAME_MOTION:
            return (
                "The motion is right. These are not Lagrange's equations one by one, but they say the same together.",
            )
        case Status.INCOMPLETE:
            named = [
                (", " if k else ": ", *lacks.parts) for k, lacks in enumerate(verdict.missing if verdict.hint else ())
            ]
            said = [x for words in named for x in words]
            return ("Right as far as it goes, but something is missing", *said, ".")
        case Status.WRONG:
            if wrong == lines or verdict.hint == 0:
                return ("Not right yet.",)
            if verdict.motion:
                return _beside_right_equations(verdict)
            return (f"Not right yet: {lines - wrong} of {lines} lines {'is' if lines - wrong == 1 else 'are'} right.",)


def _beside_right_equations(verdict: Verdict) -> tuple[str | Left, ...]:
    """What is said first if only lines beside the equations of motion are wrong: which, and how the first differs."""
    wrong = [f for f in verdict.findings if f.status is Status.WRONG]
    titles = [f.line.title for f in wrong if not f.follows] or [f.line.title for f in wrong]
    each = list(dict.fromkeys(titles))
    agrees, names = "does not agree" if len(each) == 1 else "do not agree", listed(each)
    said: list[str | Left] = [f"Your equations of motion are right. {names[:1].upper()}{names[1:]} {agrees} with them"]
    differing = wrong[0].differences if len(titles) == 1 and verdict.hint >= 3 else ()
    if not 0 < len(differing) <= MOST_SAID_FIRST:
        return (*said, ".")
    for k, d in enumerate(differing):
        said += [" and " if k else ": ", *differs(on_side(wrong[0].line, d)[1])]
    return (*said, ".")


def _of(finding: Finding, model: Model) -> tuple[str | Left, ...]:
    """The coordinate whose equation a line is."""
    if finding.line.kind != "equation" or finding.coordinate is None:
        return ()
    symbols = {c.name: c.symbol for c in model.coordinates}
    return (", the equation of ", symbols.get(finding.coordinate, finding.coordinate))


_NAMED_KINDS = ("definition", "Xi", "T", "V", "L")
MOST_QUOTIENTS = 400
"""The most quotients of terms of an equation by those of a name in it."""
_NAME = re.compile(r"\\?[^\W\d_][\w{}]{0,15}\*?")
_ENERGY_OF = re.compile(r"(?:∂|(?<![^\W_])d|\\partial|partial)[ ({]{0,2}\\?(?:mathcal[ {]{0,2}|cal[ ])?[LTℒ]\b")
"""A derivative of an energy, which is not carried out."""


def _lines(verdict: Verdict, model: Model) -> Table:
    """A row for every line; of several equations in one line, as of matrices, each with its coordinate."""
    shown = _shown(verdict.findings)
    often = Counter(f.line.title for f in shown)
    rows: list[tuple[Text, ...]] = []
    every = list(dict.fromkeys(f.line.title for f in shown if f.is_open))
    roots: list[str] = []
    for f in shown:
        words: list[str | Left] = [_named(f, shown) or _word(f, roots or every, "above" if roots else "below")]
        if (note := f.told(verdict.hint)) is not None:
            words += [": ", *note.parts]
        of = _which(f, model) if often[f.line.title] > 1 else ()
        rows.append((text(f.line.title, *of), text(*words)))
        if f.is_open and f.line.title not in roots:
            roots.append(f.line.title)
    return Table((text("line"), text("verdict")), tuple(rows))


def _shown(findings: Sequence[Finding]) -> list[Finding]:
    """The findings without those that say no more than another of the same line: a left-hand side whose equation has
    the same verdict, and what follows from a mistake in the same line."""
    alone = [f for f in findings if f.coordinate is None]
    roots = {(f.line.number, f.line.kind) for f in alone if f.is_open}
    equations = {(f.line.number, f.status, f.follows) for f in findings if f.line.kind == "equation"}

    def repeats(f: Finding) -> bool:
        if f.line.kind == "left":
            return (f.line.number, f.status, f.follows) in equations
        return f.follows and f.coordinate is None and (f.line.number, f.line.kind) in roots

    return [f for f in findings if not repeats(f)]


def _which(finding: Finding, model: Model) -> tuple[str | Left, ...]:
    """Which of several statements in a line is meant: the coordinate of an equation, or the name of a quantity."""
    kind, name = finding.line.kind, finding.line.name
    if kind not in ("definition", "identity") or not name:
        return _of(finding, model)
    return (f" ({name})",)


def _named(finding: Finding, findings: Sequence[Finding]) -> str | None:
    """The verdict on an equation that is wrong only because of what it calls S₂ or L, and does not write out."""
    if not finding.follows or finding.line.kind != "equation":
        return None
    for root in (f for f in findings if f.is_open and f.line.kind in _NAMED_KINDS):
        name = root.line.text.partition("=")[0].strip()
        called = _ENERGY_OF.search(finding.line.text) if root.line.kind in ("T", "V", "L") else None
        alone = _NAME.fullmatch(name) and re.search(rf"(?<![\w\\]){re.escape(name)}(?![\w'’′])", finding.line.text)
        if called or (alone and _is_in_name(finding, root.line.expr)):
            return f"right as written, but {name} of line {root.line.number} is not"
    return None


def _is_in_name(finding: Finding, value: sp.Expr) -> bool:
    """Whether the terms that differ in an equation can all be those of a name in it, each with the same factor: what
    the name gave besides, such as 2 m r ṙ φ̇ of (m r² φ̇)˙, is wrong as it is written."""
    written = [t for d in finding.differences for t in sp.Add.make_args(bounded.expand(d.written)) if t != 0]
    parts = sp.Add.make_args(bounded.expand(value))
    if len(written) * len(parts) > MOST_QUOTIENTS:
        return True
    factors = [{t / x for x in parts} for t in written]
    return not factors or bool(set[sp.Expr].intersection(*factors))


def _word(finding: Finding, roots: Sequence[str], where: str) -> str:
    """The verdict on a line; ``roots`` are the titles of lines ``where`` something is wrong that follows from none."""
    if finding.follows:
        return f"not right, but only because of {roots[0] if len(roots) == 1 else f'the lines {where}'}"
    if finding.status is Status.WRONG:
        return f"not right together with {finding.clash}" if finding.clash else "not right"
    return {Status.INCOMPLETE: "says nothing", Status.SAME_MOTION: "true"}.get(finding.status, "right")


def _why(verdict: Verdict, model: Model) -> Iterator[Item]:
    """The mistakes or, if none was found, what is right in the wrong lines and where they differ.

    Below hint level 3 a mistake is described by its kind and place, never by its terms.
    """
    coordinates: dict[str | None, Left] = {c.name: c.symbol for c in model.coordinates}
    first_words = () if verdict.sure else ("This would explain it, and may not be what you did: ",)
    if verdict.mistakes and not verdict.sure:
        yield from _places(verdict)
    for k, mistake in enumerate(verdict.mistakes):
        begins = ("And: ",) if k else first_words
        if verdict.hint >= 3:
            yield text(*begins, *mistake.what.parts)
            yield text("To put it right: ", *mistake.why.parts)
        else:
            yield text(*begins, *mistake.hinted(coordinates.get(mistake.coordinate)).parts)
            yield text(mistake.advice)
        yield from (text(x) for x in _where(mistake, verdict))
    if verdict.mistakes:
        first = verdict.first_wrong
        row = first is not None and first.line.kind in ("equation", "definition")
        others = [m for m in verdict.alternatives if not any(_repeats(m, told, row) for told in verdict.mistakes)]
        if others and verdict.hint >= 3:
            yield text("It could also be this: ", *others[0].what.parts)
        return
    if places := list(_places(verdict)):
        yield text("No mistake was found that explains all of it; these are the places to look at.")
        yield from places
        return
    first = verdict.first_wrong
    where = f": go through {first.line.title} once more, term by term" if first is not None else ""
    yield text(f"No mistake was found that explains all of it{where}.")


_DIFFERENT = {
    "missing": "something is missing",
    "extra": "something does not belong there",
    "sign": "a sign is not right",
    "coefficient": "a factor or a power is not right",
}
"""What is told of terms that differ where their formulas are not."""


def _places(verdict: Verdict) -> Iterator[Item]:
    """For every wrong line, what is right in it and where it differs."""
    for f in verdict.findings:
        if not f.status.right and not f.follows:
            yield from _right_and_differing(f)
            kinds = [_DIFFERENT[kind] for kind in f.kinds if kind in _DIFFERENT]
            if kinds and verdict.hint < 3:
                yield text(f"In {f.line.title}, {listed(kinds)}.")


def _repeats(mistake: Mistake, told: Mistake, row: bool) -> bool:
    """Whether a mistake adds nothing to one that is reported: same element, and words that the other has too.

    Of an equation (``row``), neither does a number or a power that nobody wrote: "ẋ stands once, and belongs squared".
    """
    if mistake.element not in (None, told.element):
        return False
    one, other = ({w.strip(".,;:").lower() for w in str(m.what).split()} for m in (mistake, told))
    return one <= other or other <= one or (row and mistake.name in UNSEEN)


def _right_and_differing(finding: Finding) -> Iterator[Item]:
    """What is right in a wrong line, by element, and what its differences come from; what does not belong there may be
    of any element."""
    differing = list(dict.fromkeys((o.element, o.step) for d in finding.differences for o in d.origins))
    names = {element for element, _ in differing}
    fine = [e for e in finding.elements if e not in names]
    known = all(d.origins for d in finding.differences)
    if fine and differing and known:
        yield text(f"Right in {finding.line.title}: what comes from {listed([*map(_called, fine)])}.")
    if differing:
        places = [f"{_called(element)}, step {step} ({step_title(step)})" for element, step in differing]
        what = "What differs" if known else "Some of what differs"
        yield text(f"{what} in {finding.line.title} comes from {'; '.join(places)}.")


FORCES_TAKEN = " unknown force"
"""What a note says of unknown forces in balances."""
SAID = ("_of_body", "_said")
"""How the names of mistakes end that are wrong definitions."""
OF_ENERGIES = ("kinetic", "potential", "translation", "rotation", "inertia", "axis", "mass")
"""How the names of those begin that are of energies and of what stands in them."""
BODIES = ("particle", "rigid body")
"""Kinds of elements that are called by a name that is a word: the wheel."""
PLACES = {
    "first", "second", "third", "last", "left", "right", "upper", "lower", "inner", "outer", "top", "bottom", "front",
    "rear", "back", "middle", "small", "large",
}  # fmt: skip
"""Words that name no thing by themselves: the left particle."""


def _called(title: str) -> str:
    """An element as it is called in a sentence: rigid body 'wheel' is the wheel, and damper 'damper' the damper."""
    kind, quote, name = title.removesuffix("'").partition(" '")
    words = name.split()
    if not quote or not all(w.isalpha() and w.isascii() and len(w) > 2 for w in words):
        return title
    if kind in words or (kind in BODIES and words[-1] not in PLACES):
        return f"the {name}"
    return f"the {name} {kind}" if words[-1] in PLACES else title


def _where(mistake: Mistake, verdict: Verdict) -> tuple[str, ...]:
    """The step of a mistake, and its element or those whose terms differ because of it."""
    elements = verdict.concerned(mistake)
    if _is_of_balances(mistake, verdict):
        return (f"It concerns {listed([*map(_called, elements)])}.",) if elements else ()
    concerns = f"; it concerns {listed([*map(_called, elements)])}" if elements else ""
    return (f"This belongs to step {mistake.step}, {step_title(mistake.step)}{concerns}.",)


def _is_of_balances(mistake: Mistake, verdict: Verdict) -> bool:
    """Whether a mistake belongs to no step: one of step 5 in an answer that has balances with forces of its own and no
    energy, or a place, a velocity or an acceleration that is said wrongly where nothing of Lagrange's is stated."""
    kinds = {f.line.kind for f in verdict.findings}
    if mistake.step == 5 and any(FORCES_TAKEN in str(note) for note in verdict.notes):
        return kinds.isdisjoint(("T", "V", "L", "Xi", "D"))
    moved = mistake.name.endswith(SAID) and not mistake.name.startswith(OF_ENERGIES)
    return moved and kinds <= {"definition", "equation", "identity", "statement"}


def _differing(verdict: Verdict) -> bool:
    return any(f.differences for f in verdict.findings)


def _terms(verdict: Verdict, model: Model) -> Iterator[Item]:
    """All differences of the lines that need a correction of their own; of a matrix, each with its equation."""
    often = Counter(f.line.title for f in verdict.findings)
    for f in verdict.findings:
        of = _of(f, model) if often[f.line.title] > 1 else ()
        for d in f.differences if not f.follows else ():
            side, said = on_side(f.line, d)
            yield text(
                f.line.title,
                *of,
                f"{f', {side}' if side else ''}: ",
                *differs(said),
                *_source(said, verdict),
                *_above(f, d, verdict),
            )


def _above(finding: Finding, d: TermDifference, verdict: Verdict) -> tuple[str, ...]:
    """Where the wrong Ξ of an equation stands above it, in which the same term differs."""
    alike = {(d.term, d.written), (-d.term, -d.written)}
    for f in verdict.open_findings if finding.line.kind == "equation" else ():
        own = f.line.kind == "Xi" and f.line.name == finding.coordinate and f.line.number < finding.line.number
        if own and not alike.isdisjoint((x.term, x.written) for x in f.differences):
            return (f" It follows from {f.line.title}.",)
    return ()


def _source(d: TermDifference, verdict: Verdict) -> tuple[str | Left, ...]:
    """From which elements a term comes, and in which step, unless the mistake is told of another step of these."""
    if not d.origins:
        return (".",)
    origins = " and ".join(dict.fromkeys(_called(o.element) for o in d.origins))
    steps = sorted({o.step for o in d.origins})
    verb = "It comes from" if d.kind != "extra" else "Such a term comes from"
    of = {o.element for o in d.origins}
    concerned = ((m.step, [m.element] if m.element else verdict.concerned(m)) for m in verdict.mistakes)
    told = {step for step, elements in concerned if of.intersection(elements)}
    if told and not told & set(steps):
        return (f". {verb} {origins}.",)
    return (f". {verb} {origins} in step{'s' if len(steps) > 1 else ''} {' and '.join(map(str, steps))}.",)

"""What a class got wrong: the answers with each mistake, at each step, with each element, each in a sentence."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from lagrangian.check.classes.rows import ClassRow
from lagrangian.check.explain.term_said import REASON
from lagrangian.check.verdict import Status
from lagrangian.check.words import step_title
from lagrangian.records import dataclass
from lagrangian.viewed import Brief

STEP_OF = {"T": 2, "V": 3, "L": 4, "D": 6, "Xi": 6, "p": 5, "p-rate": 5, "slope": 5, "left": 5}
"""The step to which a line belongs that states one quantity."""

GENERAL = {
    "incomplete": "is right as far as it goes, but incomplete",
    "wrong": "is wrong",
    "unexplained": "is wrong in a way that no known mistake explains",
    "unreadable": "could not be read",
    "unjudged": "could not be judged",
    "other_coordinates": "is right, but in other coordinates than those asked for",
}
"""What is said of answers for which no mistake is named."""


@dataclass(frozen=True)
class ClassCount(Brief):
    """How many answers have something in common: ``kind`` is "mistake", "step" or "element", ``name`` what it is.

    ``sentence`` says it in words; ``files`` are the answers.
    """

    kind: str
    name: str
    count: int
    of: int
    sentence: str
    files: tuple[str, ...]

    def to_dict(self) -> dict[str, Any]:
        """Return plain data."""
        return {
            "kind": self.kind,
            "name": self.name,
            "answers": self.count,
            "of": self.of,
            "sentence": self.sentence,
            "files": list(self.files),
        }


def counted(rows: Sequence[ClassRow]) -> tuple[ClassCount, ...]:
    """Count the mistakes, then the steps, then the elements; in each kind the most frequent first."""
    found = [*_mistakes(rows)]
    found += _grouped(rows, "step", _steps, lambda key: f"went wrong in step {key}, {step_title(key)}")
    found += _grouped(rows, "element", _elements, lambda key: f"went wrong with {key}")
    return tuple(found)


def _mistakes(rows: Sequence[ClassRow]) -> list[ClassCount]:
    """The counts of every mistake, by its name and its element."""
    groups: dict[tuple[str, str], list[str]] = {}
    said: dict[tuple[str, str], str] = {}
    for row in rows:
        named = row.record["mistakes"] if row.hint >= 2 and row.status is Status.WRONG else []
        which = "name" if row.hint >= 3 else "kind"
        told = [(m[which], _words(m, row.hint)) for m in named] or [(x, f" {GENERAL.get(x, x)}") for x in row.mistakes]
        keys = {(name, _WHERE.sub("", words)): words for name, words in reversed(told)}
        for key, words in keys.items():
            groups.setdefault(key, []).append(row.file)
            said.setdefault(key, words)
    found = [
        ClassCount("mistake", key[0], len(files), len(rows), _said(len(files), len(rows), said[key]), tuple(files))
        for key, files in groups.items()
    ]
    return sorted(found, key=lambda c: (-c.count, c.name, c.sentence))


_WHERE = re.compile(r" in (?:T\*|V|L)(?=[ .,:]|\Z)")
"""In which energy a mistake was made, which is said only where one is stated: it is the same mistake without."""


def _words(mistake: dict[str, Any], hint: int) -> str:
    """What is said after "7 of 31": the mistake without the term, which differs from answer to answer, if it is known
    so."""
    what = mistake["what"].rpartition(REASON.lstrip())[2]
    said = (mistake["brief"] or what) if hint >= 3 else mistake["hinted"]
    return f": {said.rstrip('.')} (step {mistake['step']})"


def _said(count: int, of: int, words: str) -> str:
    return f"{count} of {of}{words if count == 1 else _plural(words)}."


def _plural(words: str) -> str:
    return f" are{words[3:]}" if words.startswith(" is ") else words


def _grouped(
    rows: Sequence[ClassRow], kind: str, keys: Callable[[ClassRow], Iterable[Any]], words: Callable[[Any], str]
) -> list[ClassCount]:
    groups: dict[Any, list[str]] = {}
    for row in rows:
        if row.hint >= 2 and row.status is Status.WRONG:
            for key in dict.fromkeys(keys(row)):
                groups.setdefault(key, []).append(row.file)
    ordered = sorted(groups.items(), key=lambda item: (-len(item[1]), str(item[0])))
    of = len(rows)
    return [ClassCount(kind, str(k), len(f), of, f"{len(f)} of {of} {words(k)}.", tuple(f)) for k, f in ordered]


def _steps(row: ClassRow) -> list[int]:
    """The steps of the mistakes, of the wrong lines, and of the terms that differ if no mistake explains them."""
    own = [x for x in row.record["lines"] if not x["right"] and x["said"] and not x["follows"]]
    steps = [m["step"] for m in row.record["mistakes"]]
    steps += [STEP_OF[x["kind"]] for x in own if x["kind"] in STEP_OF]
    return sorted(set(steps or [s for x in own for s in x["steps"]]))


def _elements(row: ClassRow) -> list[str]:
    """The elements of the mistakes, or those of the terms that differ if no mistake explains them."""
    named = [m["element"] for m in row.record["mistakes"] if m["element"]]
    own = [x for x in row.record["lines"] if not x["right"] and x["said"] and not x["follows"]]
    return sorted(set(named or [e for x in own for e in x["elements"] if not row.record["mistakes"]]))

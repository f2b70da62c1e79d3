"""CPU time of the check of an answer, in a class of 500 wrong answers to one system.

    python bench/check.py                          print a Markdown table
    python bench/check.py cart-pole --count 100    one system, fewer answers
    python bench/check.py --texts                  answers as people write them, half of them right, read and judged
    python bench/check.py --append                 and append the table to bench/RESULTS.md, with the machine

The answers have one random mistake each (`tests/check/mutations.py`). The first answer to a system pays for everything
that is kept for the others: the right equations in normal form, and all small changes of the derivation. With
``--texts`` they are texts in all notations (`tests/check/students.py`), and `Derivation.check_class` judges them in one
process with explanations and points; what takes the time before the first answer is in the sum.
"""

from __future__ import annotations

import statistics
import sys
import time
from pathlib import Path

from record import append, command_line, this_machine

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tests"), str(HERE.parent / "tests" / "check")]

SYSTEMS = ("lecture-3b", "cart-pole", "double-pendulum", "three-masses", "spherical-pendulum")


def row(name: str, count: int) -> str:
    """A row of the table: the first answer, the median, the 90th percentile and the most of all others, and all."""
    from built_in import derivation
    from mutations import Mutator

    mutator = Mutator(derivation(name), "bench")
    taken: list[float] = []
    named = 0
    for _ in range(count):
        lines = mutator.mutation().lines
        start = time.process_time()
        verdict = derivation(name).check(lines)
        taken.append(time.process_time() - start)
        named += bool(verdict.mistakes)
    first, rest = taken[0], sorted(taken[1:])
    figures = (first, statistics.median(rest), rest[int(0.9 * len(rest))], rest[-1], sum(taken))
    return f"| {name} | {count} | {named} | " + " | ".join(f"{x:.3f}" for x in figures) + " |"


def class_row(name: str, count: int) -> str:
    """A row of the table of a class: how many are right, wrong, unreadable, and all of its CPU time."""
    from students import Students

    from built_in import derivation
    from lagrangian.check.verdict import Status

    made = derivation(name)
    students = Students(made, "bench")
    answers = {f"s{k}": students.answer(students.spoiled() if k % 2 else None) for k in range(count)}
    start = time.process_time()
    found = made.check_class(answers, points={"equations": 4}, processes=1)
    taken = time.process_time() - start
    right = sum(row.right for row in found.rows)
    wrong = sum(row.status is Status.WRONG for row in found.rows)
    return (
        f"| {name} | {count} | {right} | {wrong} | {count - right - wrong} | {taken:.1f} | {1000 * taken / count:.0f} |"
    )


def main() -> None:
    parser = command_line(__doc__)
    parser.add_argument("systems", nargs="*", default=list(SYSTEMS))
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--texts", action="store_true", help="texts in all notations, with check_class")
    given = parser.parse_args()
    head = "| system | answers | a mistake is named | first [s] | median [s] | 90 % [s] | most [s] | all [s] |"
    rule = "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |"
    if given.texts:
        head = "| system | answers | right | wrong | others | all [s] | each [ms] |"
        rule = rule.removesuffix(" ---: |")
    command = f"python bench/check.py --count {given.count}{' --texts' * given.texts}"
    lines = [
        "## Checking a class\n",
        f"`{command}`, CPU. {this_machine('sympy', 'numpy')}.\n",
        head,
        rule,
    ]
    print("\n".join(lines), flush=True)
    for name in given.systems:
        lines.append((class_row if given.texts else row)(name, given.count))
        print(lines[-1], flush=True)
    text = "\n".join(lines) + "\n"
    if given.append:
        append([text])


if __name__ == "__main__":
    main()

"""Random mistakes in the printed equations of the built-in examples: how many are found, and what is told of them.

    python tools/mutations.py                        100 mistakes in each of the examples
    python tools/mutations.py --count 20 cart-pole   20 in one
    python tools/mutations.py --show false           also print those of which something false is told

The mistakes are made by `tests/check/mutations.py`, which knows nothing of the checker, and judged by SymPy alone.
"""

from __future__ import annotations

import argparse
import statistics
import sys
import time
from collections import Counter
from pathlib import Path

TESTS = Path(__file__).parents[1] / "tests"

LONG = {"robot-arm", "scara", "spring-net", "triple-pendulum-relative", "whipple-bicycle"}
"""Examples that take long."""


def main() -> None:
    sys.path[:0] = [str(TESTS), str(TESTS / "check")]
    from mutation_judge import judged

    import built_in
    from lagrangian.check.verb import check_answer
    from mutations import Mutator

    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("examples", nargs="*")
    parser.add_argument("--count", type=int, default=100)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--show", nargs="*", default=[], help="false, nothing, two, fits, proved, right")
    options = parser.parse_args()
    total: Counter[str] = Counter()
    taken: list[float] = []
    for name in options.examples or [n for n in built_in.FREE if n not in LONG | built_in.LARGE]:
        derivation = built_in.derivation(name)
        mutator = Mutator(derivation, options.seed)
        found: Counter[str] = Counter()
        for _ in range(options.count):
            mutation = mutator.mutation()
            start = time.process_time()
            verdict = check_answer(derivation, mutation.lines)
            taken.append(time.process_time() - start)
            kind = "right" if verdict.right else judged(mutator, mutation, verdict)
            found[kind] += 1
            if kind in options.show:
                print(f"{kind}: {name}, {mutation}", *(f"\n    {m.what}" for m in verdict.mistakes), flush=True)
        total += found
        print(name, dict(sorted(found.items())), flush=True)
    print(f"{sum(total.values())} mistakes:", dict(sorted(total.items())))
    print(f"CPU time of an answer: median {statistics.median(taken):.3f} s, most {max(taken):.2f} s")


if __name__ == "__main__":
    main()

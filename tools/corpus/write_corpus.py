"""Writes the corpus of answers: ``python tools/corpus/write_corpus.py [system …]``.

Right answers come from SymPy's LagrangesMethod (`write_systems`), are proved against Kane's equations at random states,
and are disguised; wrong ones carry one mistake (`write_mistakes`). What mistakes give the very same equations are noted
together. Nothing here imports the package. The files that it writes are the corpus; this script is how they came to be.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from random import Random
from typing import Any

import sympy as sp
from write_mistakes import MISTAKES, Wrong
from write_systems import SYSTEMS, System, t
from write_words import FORMS, SIDES, STYLES, latex, matrix_form, newton_form, plain, two_sides, written

TESTS = Path(__file__).parents[2] / "tests"
sys.path.insert(0, str(TESTS / "examples"))  # the oracle by Kane's equations
MOST_WRONG = 14
"""Wrong answers per system."""

Answer = dict[str, Any]


class Numbers:
    """Rows as numbers at three random states."""

    def __init__(self, s: System) -> None:
        self.s = s
        self.free = sorted(set().union(*[r.free_symbols for r in s.rows()]) - {t}, key=str)
        rng = Random(s.name)
        self.states = [lambda key, k=k: Random(f"{s.name} {key} {k}").uniform(0.3, 1.7) for k in range(3)]
        self.rng = rng

    def of(self, expr: sp.Expr, k: int) -> float:
        """The value of an expression at state ``k``."""
        expr = sp.sympify(expr).doit()
        atoms = [*expr.atoms(sp.Derivative), *expr.atoms(sp.core.function.AppliedUndef), *expr.free_symbols]
        return float(sp.N(expr.xreplace({a: sp.Float(self.states[k](str(a)), 30) for a in atoms}), 20))

    def rows(self, rows: Sequence[sp.Expr]) -> tuple[float, ...]:
        """The fingerprint of rows."""
        return tuple(round(self.of(r, k), 9) for k in range(3) for r in rows)

    def motion(self, rows: Sequence[sp.Expr]) -> tuple[float, ...] | None:
        """The accelerations that rows give, at every state; None where they give none."""
        found: list[float] = []
        n = len(self.s.q)
        still = dict.fromkeys(self.s.a, sp.S.Zero)
        for k in range(3):
            M = sp.Matrix(n, n, lambda i, j, k=k: self.of(sp.expand(rows[i]).diff(self.s.a[j]), k))
            rest = sp.Matrix([self.of(sp.expand(r).xreplace(still), k) for r in rows])
            if abs(M.det()) < 1e-9:
                return None
            found += [round(float(x), 7) for x in M.LUsolve(-rest)]
        return tuple(found)


def prove(s: System) -> None:
    """Compare the rows with Kane's equations from the examples' oracle."""
    from kane_route import State
    from kane_systems import oracle

    rows = s.rows()
    for k in range(3):
        rng = Random(f"{s.name} {k}")
        names = [x.func.__name__ for x in s.q]
        value: dict[str, float] = {}
        atoms = set().union(*[r.atoms(sp.core.function.AppliedUndef) | r.free_symbols for r in rows])
        p = {str(x): rng.uniform(0.4, 1.6) for x in sorted(atoms, key=str) if isinstance(x, sp.Symbol)}
        p |= {x: rng.uniform(0.4, 1.6) for x in ("m1", "m2", "m_p", "D") if x not in p}
        u = {x.func.__name__: rng.uniform(-1, 1) for x in sorted(atoms, key=str) if not isinstance(x, sp.Symbol)}
        q, v, a = ({n: rng.uniform(0.3, 1.2) for n in names} for _ in range(3))
        time = p.pop("t", rng.uniform(0.4, 1.6))
        state = State(q=q, v=v, a=a, p=p, u={n: x for n, x in u.items() if n not in names}, t=time)
        for x, n in zip(s.q, names, strict=True):
            value |= {x.diff(t, 2): a[n], x.diff(t): v[n], x: q[n]}
        for x in atoms:
            if x not in value:
                value[x] = time if x == t else p[str(x)] if isinstance(x, sp.Symbol) else u[x.func.__name__]
        mine = [float(sp.N(r.xreplace({k2: sp.Float(w) for k2, w in value.items()}))) for r in rows]
        theirs = oracle(s.name)(state)
        for x, y in zip(mine, theirs, strict=True):
            assert abs(x - y) < 1e-9 * (1 + abs(y)), (s.name, mine, theirs)


# -- right answers ----------------------------------------------------------------------------------------------------


def right(s: System, at: int) -> Iterator[Answer]:
    """Right answers in many disguises; ``at`` turns the wheel of styles."""
    rows = s.rows()
    n = len(rows)
    forms = list(FORMS)

    def put(rows: Sequence[sp.Expr], k: int, form: str | None = None) -> str:
        made = [FORMS[form or forms[(at + k) % len(forms)]](r, s) for r in rows]
        sides = SIDES[(at + k) % len(SIDES)]
        return written([two_sides(r, s, sides) for r in made], STYLES[(at + k) % len(STYLES)])

    for k in range(3):
        yield {"is": "right", "text": put(rows, k)}
    factors = [sp.Rational(1, 2), sp.S(-3), *sorted({b.m for b in s.bodies if b.m != 0}, key=str)]
    scaled = [sp.expand(r / factors[(at + i) % len(factors)]) for i, r in enumerate(rows)]
    yield {"is": "scaled", "text": put(scaled, 3, "expanded")}
    whole = f"T = {plain(s.T())}\nV = {plain(s.V())}\n" if s.V() != 0 else f"T = {plain(s.T())}\n"
    if at % 2:
        whole = f"\\begin{{align}} T^* &= {latex(s.T())} \\\\ V &= {latex(s.V())} \\end{{align}}\n"
    yield {"is": "right", "text": whole + written([(r, sp.S.Zero) for r in rows], "align" if at % 2 else "primes")}
    yield {"is": "right", "text": f"T = {plain(sp.expand(s.T()))}\n"}
    if s.V() != 0:
        yield {"is": "right", "text": f"V = {plain(sp.expand_trig(s.V()))}\n"}
    if n > 1:
        yield {"is": "reordered", "text": put(rows[::-1], 4)}
        mixed = [rows[0] + rows[1], *rows[1:]] if _same_kind(s) else [rows[0], *(2 * r for r in rows[1:])]
        yield {"is": "combined" if _same_kind(s) else "scaled", "text": put(mixed, 5, "expanded")}
        yield {"is": "right", "text": matrix_form(rows, s, "plain" if at % 2 else "latex")}
        yield {"is": "incomplete", "text": put(rows[:1], 6)}
    if n <= 2:
        text = written(newton_form(rows, s), STYLES[(at + 1) % len(STYLES)])
        yield {"is": "same motion", "text": text}
    if s.other is not None:
        yield from other_coordinates(s, at)
    if any(x != 0 for x in s.Xi()):
        text = "".join(f"Xi_{x.func.__name__} = {plain(y)}\n" for x, y in zip(s.q, s.Xi(), strict=True))
        yield {"is": "right", "text": text}


def _same_kind(s: System) -> bool:
    """Whether the first two coordinates have one unit, so that their equations can be added."""
    return str(s.q[0])[0] == str(s.q[1])[0]


def other_coordinates(s: System, at: int) -> Iterator[Answer]:
    """The same system in a coordinate of the person's own, said on a line before and not said."""
    assert s.other is not None
    name, change = s.other
    new = sp.Function(name)(t)
    ((old, value),) = change.items()
    q = tuple(new if x == old else x for x in s.q)

    def through(x: sp.Expr) -> sp.Expr:
        return x.subs(old, value).doit()

    moved = System(s.name, q, (), inputs=s.inputs)
    T, V = through(s.T()), through(s.V())
    rates = [(p.f, through(p.rate)) for p in s.inputs] + [(-d.f * through(d.rate), through(d.rate)) for d in s.dampers]
    Xi = [sum((f * r.diff(v) for f, r in rates), sp.S.Zero) for v in moved.v]
    rows = [sp.trigsimp(sp.expand(r)) for r in moved.rows(T=T, V=V, Xi=Xi)]
    said = f"{plain(old)} = {plain(value)}\n"
    yield {"is": "other coordinates", "text": said + written([(r, sp.S.Zero) for r in rows], "primes")}


# -- wrong answers -----------------------------------------------------------------------------------------------------


def wrong(s: System, at: int, numbers: Numbers) -> Iterator[Answer]:
    """Wrong answers, one mistake each; mistakes of the same equations share their names."""
    truth, motion = numbers.rows(s.rows()), numbers.motion(s.rows())
    known: dict[tuple[float, ...], list[Wrong]] = {}
    for make in MISTAKES.values():
        for made in make(s):
            mark = numbers.rows(made.rows)
            if mark != truth and numbers.motion(made.rows) != motion:
                known.setdefault(mark, []).append(made)
    every = list(known.values())
    rng = Random(f"wrong {s.name}")
    rng.shuffle(every)
    counted: dict[str, int] = {}
    chosen: list[list[Wrong]] = []
    for limit in (1, 2):
        for group in every:
            if group not in chosen and counted.get(group[0].name, 0) < limit and len(chosen) < MOST_WRONG:
                chosen.append(group)
                counted[group[0].name] = counted.get(group[0].name, 0) + 1
    for k, group in enumerate(chosen):
        yield from told(s, group, at + k)


def told(s: System, group: list[Wrong], k: int) -> Iterator[Answer]:
    """A wrong answer in words: its equations, or the energy or Ξ where it shows, or a whole derivation."""
    made = group[0]
    names = list(dict.fromkeys(w.name for w in group))
    data: Answer = {"is": "wrong", "mistake": made.name}
    if len(names) > 1:
        data["also"] = names[1:]
    form = list(FORMS)[k % 4]
    sides = SIDES[k % len(SIDES)]
    rows = written([two_sides(FORMS[form](r, s), s, sides) for r in made.rows], STYLES[k % len(STYLES)])
    if made.where == "rows" or k % 3 == 0:
        yield data | {"text": rows}
        return
    if made.where in ("T", "V") and k % 3 == 1:
        energy = made.T if made.where == "T" else made.V
        yield data | {"text": f"{made.where} = {plain(energy)}\n"}  # type: ignore[arg-type]
        return
    if made.where == "Xi":
        assert made.Xi is not None
        lines = "".join(f"Xi_{i + 1} = {plain(y)}\n" for i, y in enumerate(made.Xi))
        yield data | {"text": lines if k % 3 == 1 else rows}
        return
    T = s.T() if made.T is None else made.T
    V = s.V() if made.V is None else made.V
    lines = f"T = {plain(T)}\nV = {plain(V)}\nL = T - V\n"
    equations = written([(sp.expand(r), sp.S.Zero) for r in made.rows], "primes")
    first = 1 if sp.expand(T - s.T()) != 0 else 2
    yield data | {"line": first, "text": lines + equations}


# -- files -----------------------------------------------------------------------------------------------------------


def file_of(s: System, answers: list[Answer]) -> str:
    """The system's answers as TOML."""
    lines = [f'system = "{s.name}"']
    for i, answer in enumerate(answers):
        assert "'''" not in answer["text"], answer["text"]
        lines += ["", "[[answer]]", f'id = "{s.name}-{i + 1:02}"', f'is = "{answer["is"]}"']
        if "mistake" in answer:
            lines.append(f'mistake = "{answer["mistake"]}"')
        if "also" in answer:
            lines.append("also = [" + ", ".join(f'"{x}"' for x in answer["also"]) + "]")
        if "line" in answer:
            lines.append(f"line = {answer['line']}")
        lines.append(f"text = '''\n{answer['text']}'''")
    return "\n".join(lines) + "\n"


def main() -> None:
    """Write the files of the systems that are named, or of all."""
    for at, (name, make) in enumerate(SYSTEMS.items()):
        if len(sys.argv) > 1 and name not in sys.argv[1:]:
            continue
        s = make()
        prove(s)
        answers = [*right(s, at), *wrong(s, at, Numbers(s))]
        (TESTS / "check" / "corpus" / f"{name}.toml").write_text(file_of(s, answers), encoding="utf-8")
        print(f"{name}: {len(answers)} answers")


if __name__ == "__main__":
    main()

"""Random model files under 10 kB that are hostile to whoever writes things out: a seed each, the same everywhere."""

from __future__ import annotations

import random
from collections.abc import Callable

LONGEST = 10_000
"""Bytes that a file may have."""

PARAMETERS = ("a", "b", "c", "d", "e")
SMOOTH = ("sin", "cos", "sin", "cos", "tan", "atan", "sinh", "cosh", "tanh", "exp", "asinh")
KINKED = ("abs", "sign", "sqrt", "abs", "sqrt", "log", "asin", "atanh")


class Source:
    """Random expressions of given names."""

    def __init__(self, seed: int) -> None:
        self.random = random.Random(seed)
        self.wild = self.random.random()  # how often a function is no smooth one, a number no small one
        self.bent = True  # whether kinks are allowed where they are drawn
        self.high = self.random.choice((3, 3, 9, 40, 97))

    def number(self) -> str:
        r = self.random
        if r.random() > 0.2 * self.wild:
            return r.choice(("2", "3", "0.5", "1.7", "1/3", "5", "7"))
        return r.choice(("1e30", "1e-30", "1e300", "123456789012345678901234567890", "0.1234567890123456789",
                         "99999999999999999/7", "1e-300", "2^97", "sqrt(2)", "pi"))  # fmt: skip

    def expr(self, names: tuple[str, ...], depth: int) -> str:
        """An expression nested so deep at most."""
        r = self.random
        if depth <= 0 or r.random() < 0.12:
            return r.choice(names) if r.random() < 0.8 else self.number()
        kind = r.choices(("sum", "product", "power", "quotient", "function", "kink", "case"),
                         (5, 4, 3, 2, 4, 2 * self.wild * self.bent, self.wild * self.bent))[0]  # fmt: skip
        sub = lambda down=1: self.expr(names, depth - down)  # noqa: E731
        if kind == "sum":
            return "(" + "".join(f"{r.choice('+-') if i else ''}{sub()}" for i in range(r.randint(2, 5))) + ")"
        if kind == "product":
            return "*".join(sub() for _ in range(r.randint(2, 4)))
        if kind == "power":
            power = r.choice((2, 2, 3, r.randint(2, self.high), -r.randint(1, self.high), "(1/3)", "0.5", "(-3/2)"))
            return f"({sub()})^{power if not str(power).startswith('-') else f'({power})'}"
        if kind == "quotient":
            return f"({sub()})/({sub()}+{self.number()})"
        if kind == "function":
            return f"{r.choice(SMOOTH)}({sub()})"
        if kind == "kink":
            if r.random() < 0.5:
                return f"{r.choice(('max', 'min'))}({', '.join(sub(2) for _ in range(r.randint(2, 6)))})"
            return f"{r.choice(KINKED)}({sub()})"
        cases = ", ".join(f"{sub(2)} {r.choice(('<', '>='))} {sub(2)}, {sub(2)}" for _ in range(r.randint(1, 3)))
        return f"piecewise({cases}, {sub(2)})"

    def smooth(self, names: tuple[str, ...], depth: int) -> str:
        """An expression without kinks, as the position of a point must be."""
        bent, self.bent = self.bent, False
        made = self.expr(names, depth)
        self.bent = bent
        return made

    def sized(self, names: tuple[str, ...], length: int) -> str:
        """An expression about so long."""
        parts = [self.expr(names, self.random.randint(2, 5))]
        while sum(map(len, parts)) < length:
            parts.append(self.expr(names, self.random.randint(1, 5)))
        parts = [p for p in parts if len(p) <= max(length, 60)] or [names[0]]
        return self.random.choice(("+", "+", "*")).join(parts)


def _head(name: str, coordinates: list[str], inputs: bool = True, extra: str = "") -> str:
    lines = [f'name = "{name}"', "[coordinates]", *(f'{q} = ""' for q in coordinates), "[parameters]", "m = 1.3"]
    lines += ["a = 1.1", "b = 1.5", "c = 0.3", "d = 0.4", "e = 0.7", "k = 2.0", "g = 9.81"]
    lines += ["[inputs]", 'F = "from outside"'] if inputs else []
    return "\n".join(lines) + "\n" + extra


def _names(n: int) -> list[str]:
    return [f"q{i}" for i in range(n)]


def _bodies(names: list[str]) -> str:
    return "".join(
        f'[[particle]]\nmass = "m"\nat = ["{x}", "{y}"]\n' for x, y in zip(names, [*names[1:], "0"], strict=True)
    )


def _points(s: Source, room: int) -> str:
    q = _names(s.random.randint(1, 3))
    s.bent = s.random.random() < 0.1
    leaves = (*q, *q, *PARAMETERS, *(["t"] if s.random.random() < 0.3 else []))
    bodies = s.random.randint(1, 3)
    each = room // (2 * bodies)
    at = [f'["{s.sized(leaves, each)}", "{s.sized(leaves, each)}"]' for _ in range(bodies)]
    held = "".join(f'[[spring]]\nk = "k"\ndeflection = "{x}"\n' for x in q)
    return (
        _head("points", q)
        + "".join(f'[[particle]]\nmass = "m"\nat = {a}\n' for a in at)
        + held
        + '[[gravity]]\ndirection = ["0", "-1"]\n'
    )


def _energy(s: Source, room: int) -> str:
    q = _names(s.random.randint(1, 4))
    kind = s.random.choice(("potential", "dissipation", "kinetic"))
    if kind == "potential":
        value = s.sized((*q, *q, *PARAMETERS), room)
    else:
        rates = "".join(f"{x}'" for x in q[:1])
        value = f"({s.sized((*q, *PARAMETERS), room)})*{rates}^2"
        if kind == "kinetic" and s.random.random() < 0.3:
            value += f"+({s.sized((*q, *PARAMETERS, rates), room // 4)})"
    return _head("energy", q) + _bodies(q) + f'[[{kind}]]\nvalue = "{value}"\n'


def _energies(s: Source, room: int) -> str:
    q = _names(s.random.randint(1, 4))
    leaves = (*q, *PARAMETERS)
    T = "+".join(f"({s.sized(leaves, room // (3 * len(q)))})^2*{x}'^2+m*{x}'^2" for x in q)
    if len(q) > 1:
        T += f"+({s.expr(leaves, 2)})*q0'*q1'/7"
    return (
        _head("energies", q)
        + f'[energies]\nT = "{T}"\nV = "{s.sized(leaves, room // 2)}"\n'
        + f'[energies.Xi]\nq0 = "F-{s.sized((*leaves, chr(113) + "0" + chr(39)), room // 8)}"\n'
    )


def _springs(s: Source, room: int) -> str:
    q = _names(s.random.randint(2, 4))
    local = ("delta", "delta", *PARAMETERS)
    how = s.random.choice(("law", "energy", "energy"))
    where = s.random.choice(
        (f'deflection = "{q[1]}+{s.sized((*q, *PARAMETERS), room // 3)}"', 'between = ["origin", "A"]')
    )
    text = _head("springs", q) + f'[points]\nA = ["{q[0]}", "{s.smooth((*q, *PARAMETERS), 3)}"]\n' + _bodies(q)
    text += f'[[spring]]\n{how} = "{s.sized(local, room // 2)}"\n{where}\n'
    text += f'[[damper]]\nlaw = "{s.sized(("rate", *PARAMETERS), room // 6)}"\nbetween = ["origin", "A"]\n'
    return text


def _gravity(s: Source, room: int) -> str:
    q = _names(2)
    parts = [s.sized(PARAMETERS, room // 3) for _ in range(2)]
    return (
        _head("gravity", q)
        + _bodies(q)
        + f'[[gravity]]\ndirection = ["{parts[0]}", "{parts[1]}"]\n'
        + (f'g = "{s.sized(PARAMETERS, room // 4)}"\n' if s.random.random() < 0.4 else "")
    )


def _crowd(s: Source, room: int) -> str:
    """As many elements as fit."""
    q = _names(s.random.randint(2, 12))
    text = _head("crowd", q) + _bodies(q)
    while True:
        x = s.random.choice(q)
        more = s.random.choice((
            f'[[spring]]\nk = "{s.expr(PARAMETERS, 1)}"\ndeflection = "{x}+{s.expr((*q, *PARAMETERS), 2)}"\n',
            f'[[damper]]\nb = "a"\ndeflection = "{x}-{s.smooth((*q, *PARAMETERS), 2)}"\n',
            f'[[force]]\nvalue = ["F*t", "{s.expr((*q, *PARAMETERS), 1)}"]\nat = ["{x}", "{s.smooth((*q, "t"), 2)}"]\n',
            f'[[generalized_force]]\ncoordinate = "{x}"\nvalue = "{s.expr((*q, f"{x}" + chr(39), "t"), 2)}"\n',
            f'[[particle]]\nmass = "m"\nat = ["{s.smooth((*q, *PARAMETERS), 2)}", "{x}"]\n',
        ))  # fmt: skip
        if len(text) + len(more) > room + 400:
            return text
        text += more


def _constrained(s: Source, room: int) -> str:
    """Constraints on positions and rates, of anything that moves."""
    q = _names(s.random.randint(2, 4))
    leaves, s.bent = (*q, *q, *PARAMETERS), False
    text = _head("constrained", q) + _bodies(q) + '[[gravity]]\ndirection = ["0", "-1"]\n'
    for k in range(s.random.randint(1, len(q) - 1)):
        if s.random.random() < 0.6:
            text += f'[[constraint]]\nname = "c{k}"\nexpression = "{q[k]}-{s.sized((*leaves, "t"), room // 3)}"\n'
        else:
            rates = "+".join(f"({s.sized(leaves, room // 6)})*{x}'" for x in q[:2])
            text += f'[[velocity_constraint]]\nname = "c{k}"\nexpression = "{q[-1]}\'-({rates})"\n'
    return text


def _jointed(s: Source, room: int) -> str:
    """Links that turn by hostile angles, held together by joints and rods, with friction in them."""
    r, q = s.random, _names(s.random.randint(3, 5))
    leaves, s.bent = (*q, *PARAMETERS), False
    each = room // (2 * len(q))
    points = "".join(f'P{k} = ["{x}+{s.sized(leaves, each)}", "{s.sized(leaves, each)}"]\n' for k, x in enumerate(q))
    text = _head("jointed", q) + "[points]\n" + points + '[[gravity]]\ndirection = ["0", "-1"]\n'
    for k, x in enumerate(q):
        text += f'[[frame]]\nname = "R{k}"\nangle = "{x}+{s.sized(leaves, each // 2)}"\norigin = "P{k}"\n'
        text += f'[[rigid_body]]\nname = "B{k}"\nmass = "m"\ninertia = "a*m"\nat = "P{k}"\nframe = "R{k}"\n'
    for k in range(r.randint(1, 2)):
        through = f'through = ["P{k}", "P{k + 1}"]\n'
        ends = f'between = ["P{k}", "P{k + 1}"]\n'
        text += r.choice((
            f'[[pin]]\nname = "j{k}"\n{ends}',
            f'[[constraint]]\nname = "j{k}"\n{ends}distance = "{s.sized(PARAMETERS, each)}"\n',
            f'[[slider]]\nname = "j{k}"\n{ends}along = ["{s.expr(PARAMETERS, 2)}", "b"]\n',
            f'[[rope]]\nname = "j{k}"\n{through}length = "{s.sized((*PARAMETERS, "t"), each)}"\n',
            f'[[rolling]]\nname = "j{k}"\nbody = "B{k}"\nat = "P{k}"\nalong = [1, 0]\n',
        ))  # fmt: skip
    s.bent = True
    how = r.choice((f'limit = "{s.sized(PARAMETERS, each)}"', f'mu = "c"\nnormal = "{s.sized((*leaves, "t"), each)}"',
                    f'mu = "c"\npressed_by = "j0{".x" * ("[[pin]]" in text)}"'))  # fmt: skip
    return text + f'[[friction]]\nname = "dry"\n{how}\ndeflection = "{q[0]}"\n'


KINDS: tuple[Callable[[Source, int], str], ...] = (_points, _energy, _energies, _springs, _gravity, _crowd)


def model(seed: int) -> str:
    """The model file of a seed; those from 100 on have constraints, those from 200 on joints and friction."""
    source = Source(seed)
    kind = _jointed if seed >= 200 else _constrained if seed >= 100 else KINDS[seed % len(KINDS)]
    room = source.random.choice((150, 400, 400, 1200, 3000, 8000))
    while True:
        text = kind(source, room) + '[simulate]\nduration = "1 s"\n[simulate.initial]\nq0 = 0.1\n'
        if len(text.encode()) <= LONGEST:
            return text
        room = room * 2 // 3

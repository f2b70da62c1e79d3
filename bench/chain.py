"""Measure a batch of chains beside code that was written by hand for them, in one run.

    python bench/chain.py                 print a Markdown table
    python bench/chain.py --append        and append it to bench/RESULTS.md, with the machine

The chain is that of `engine.py`: n point masses on massless rods in the plane, angles relative to the rod before. By
hand the tensions T_i of the rods come first. With the directions e_i of the rods and their rates ω_i,
(r̈_i − r̈_{i−1})·e_i = −L_i ω_i² is a tridiagonal system, and the part across the rod is L_i ω̇_i:

    (1/m_i + 1/m_{i−1}) T_i − cos q_i/m_{i−1} T_{i−1} − cos q_{i+1}/m_i T_{i+1} = L_i ω_i²   (+ g cos q_1 for i = 1)
    L_i ω̇_i = sin q_{i+1}/m_i T_{i+1} − sin q_i/m_{i−1} T_{i−1}                              (− g sin q_1 for i = 1)

It is C, four or eight states side by side, whichever is faster, with masses and lengths as constants and a sine and
cosine of its own, compiled for this processor. It gets its states in blocks, as it likes them best, and once more a
state after the other, as ours are. A compiler is needed: $CC, or cc.
"""

from __future__ import annotations

import ctypes
import math
import os
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

import engine_systems as systems
from engine import NUMBERS, best
from engine_peers import Timed, address
from engine_systems import Array
from lagrangian import codegen as machine
from record import append, command_line, one_core, table, this_machine

LANES = (4, 8)
"""States side by side that are tried; the faster counts."""

SIZES = (2, 8, 64)
COUNTS = (1024, 65_536, 1_048_576)
FLAGS = (
    "-O3",
    "-march=native",
    "-ffp-contract=fast",
    "-fno-math-errno",
    "-fno-trapping-math",
    "-Wno-psabi",
    "-shared",
    "-fPIC",
)

SOURCE = """
typedef double V __attribute__((vector_size(8 * LANES)));
typedef long W __attribute__((vector_size(8 * LANES)));
static const double L[N] = {LENGTHS}, m[N] = {MASSES};

static inline V if_(W c, V a, V b) { return (V)((c & (W)a) | (~c & (W)b)); }

static inline void sincos_(V x, V *s, V *c) {    /* r = x − k π/2 in |r| <= π/4, Taylor series of sin r and cos r */
    V big = (V){} + 0x1.8p52, k = x * 0x1.45f306dc9c883p-1 + big;
    W quarter = (W)k;
    k -= big;
    V r = (x - k * 0x1.921fb54442d18p0) - k * 0x1.1a62633145c07p-54, z = r * r;
    V p = SINE, u = COSINE;
    p = r + r * z * p;
    u = 1.0 - 0.5 * z + z * z * u;
    W odd = -(quarter & 1), low = (quarter & 2) << 62, lower = ((quarter + 1) & 2) << 62;
    *s = (V)((W)if_(odd, u, p) ^ low);
    *c = (V)((W)if_(odd, p, u) ^ lower);
}

static inline void one(const V *q, const V *v, V *a) {
    V s[N + 1], c[N + 1], e[N + 1], f[N + 1], T[N + 2], w = (V){}, rate[N], last = (V){};
    for (int i = 0; i < N; i++) { sincos_(q[i], s + i, c + i); w += v[i]; rate[i] = L[i] * w * w; }
    rate[0] += GRAVITY * c[0];
    for (int i = N - 1; i >= 0; i--) {
        V d = (V){} + (1 / m[i] + (i ? 1 / m[i - 1] : 0)), r = rate[i];
        if (i < N - 1) { V k = c[i + 1] * (1 / m[i]); d -= k * e[i + 1]; r += k * f[i + 1]; }
        V inverse = 1 / d;
        f[i] = r * inverse;
        if (i) e[i] = c[i] * (1 / m[i - 1]) * inverse;
    }
    T[0] = f[0];
    for (int i = 1; i < N; i++) T[i] = f[i] + e[i] * T[i - 1];
    for (int i = 0; i < N; i++) {
        V x = i ? s[i] * T[i - 1] * (-1 / m[i - 1]) : -GRAVITY * s[0];
        if (i < N - 1) x += s[i + 1] * T[i + 1] * (1 / m[i]);
        x *= 1 / L[i];
        a[i] = x - last;
        last = x;
    }
}

void blocks(long count, const V *q, const V *v, V *a) {
    for (long k = 0; k < count; k++) one(q + k * N, v + k * N, a + k * N);
}

void rows(long count, const double *q, const double *v, double *a) {
    for (long k = 0; k < count; k++, q += LANES * N, v += LANES * N, a += LANES * N) {
        V x[N], y[N], z[N];
        for (int i = 0; i < N; i++)
            for (int j = 0; j < LANES; j++) { x[i][j] = q[j * N + i]; y[i][j] = v[j * N + i]; }
        one(x, y, z);
        for (int j = 0; j < LANES; j++)
            for (int i = 0; i < N; i++) a[j * N + i] = z[i][j];
    }
}
"""


def horner(coefficients: list[float]) -> str:
    """Σ c_k z^k, the lowest first."""
    text = f"{coefficients[-1]!r}"
    for x in coefficients[-2::-1]:
        text = f"({text} * z + {x!r})"
    return f"(V){{}} + {text}"


def by_hand(n: int, lanes: int, folder: Path) -> ctypes.CDLL:
    """The C code for n links and a number of states side by side, compiled."""
    lengths, masses = systems.chain_values(n)
    sine = [(-1) ** k / math.factorial(2 * k + 1) for k in range(1, 8)]
    cosine = [(-1) ** k / math.factorial(2 * k) for k in range(2, 9)]
    text = SOURCE.replace("LENGTHS", ", ".join(map(repr, lengths))).replace("MASSES", ", ".join(map(repr, masses)))
    text = text.replace("SINE", horner(sine), 1).replace("COSINE", horner(cosine), 1)
    source, library = folder / f"chain{n}x{lanes}.c", folder / f"chain{n}x{lanes}.so"
    source.write_text(text, encoding="utf-8")
    defined = (f"-DN={n}", f"-DLANES={lanes}", f"-DGRAVITY={systems.GRAVITY!r}")
    subprocess.run([os.environ.get("CC", "cc"), *FLAGS, *defined, str(source), "-o", str(library)], check=True)
    return ctypes.CDLL(str(library))


def prepared(code: ctypes.CDLL, name: str, blocks: int, q: Array, v: Array, a: Array) -> Timed:
    """A call of the C code without anything of Python's but the call."""
    call = getattr(code, name)
    call.argtypes, call.restype = [ctypes.c_long, *[ctypes.c_void_p] * 3], None
    given = (blocks, address(q), address(v), address(a))
    return lambda kept=(q, v, a): call(*given)  # the arrays live as long as the call


def aligned(x: Array) -> Array:
    """A copy that begins at a multiple of 64 bytes."""
    made = machine.aligned(x.size).reshape(x.shape)
    made[:] = x
    return made


@dataclass(frozen=True)
class Batch:
    """A batch of states of n links: ours, and the code by hand with either number of states side by side."""

    n: int
    count: int
    folder: Path

    def measured(self, rounds: int, seconds: float) -> tuple[dict[str, float], float]:
        """ns a state of ours, of `forward`, of the code by hand in blocks and in rows; and the largest difference."""
        n, count = self.n, self.count
        rng, none = np.random.default_rng(n), np.zeros((count, 0))
        q, v = rng.uniform(-3, 3, (count, n)), rng.uniform(-1, 1, (count, n))
        system = systems.chain(n, relative=True).compile(threads=1)
        kernel = machine.compile(system.program("forward"), optional={"u": 0.0, "t": 0.0}, threads=1)
        contenders: dict[str, Timed] = {"ours": kernel.prepared(q, v, none), "forward": lambda: system.forward(q, v)}
        mine, off = kernel(q, v, none), 0.0
        for lanes in LANES:
            code = by_hand(n, lanes, self.folder)
            in_blocks = [aligned(x.reshape(-1, lanes, n).transpose(0, 2, 1)) for x in (q, v, np.zeros_like(q))]
            in_rows = [aligned(x) for x in (q, v, np.zeros_like(q))]
            for how, given in (("blocks", in_blocks), ("rows", in_rows)):
                call = contenders[f"{how} {lanes}"] = prepared(code, how, count // lanes, *given)
                call()
            for theirs in (in_blocks[2].transpose(0, 2, 1).reshape(-1, n), in_rows[2]):
                off = max(off, float((np.abs(mine - theirs).max(axis=1) / np.abs(mine).max(axis=1)).max()))
        times = {name: t / count * 1e9 for name, t in best(contenders, rounds, seconds).items()}
        fastest = {how: min(times[f"{how} {x}"] for x in LANES) for how in ("blocks", "rows")}
        return {"ours": times["ours"], "forward": times["forward"], **fastest}, off


def chain_row(n: int, folder: Path) -> list[str]:
    """ns a state, and how many times as long ours takes."""
    times, off = Batch(n, NUMBERS // (3 * n) // 16 * 16, folder).measured(12, 0.1)
    cells = [f"{times[how]:.3g} ({times['ours'] / times[how]:.2f})" for how in ("blocks", "rows")]
    return [f"{n} links", f"{times['ours']:.3g}", *cells, f"{off:.0e}"]


def traffic_row(count: int, folder: Path) -> list[str]:
    """ns a state of a batch of double pendula."""
    times, _ = Batch(2, count, folder).measured(8, 0.06)
    return [f"{count} states", *(f"{times[how]:.3g}" for how in ("ours", "forward", "blocks", "rows"))]


def main() -> None:
    parser = command_line(__doc__)
    given = parser.parse_args()
    one_core()
    with tempfile.TemporaryDirectory() as folder:
        rows = [chain_row(n, Path(folder)) for n in SIZES]
        batches = [traffic_row(count, Path(folder)) for count in COUNTS]
    lines = ["## Chains beside code by hand", "", f"`python bench/chain.py`. {this_machine('llvmlite')}.", ""]
    lines += ["In brackets how many times as long ours takes.", ""]
    lines += table(["a batch, ns a state", "ours", "by hand, in blocks", "by hand, as ours", "difference"], rows)
    lines += ["", "Double pendula: what a batch that leaves the caches costs; `forward` makes its result anew.", ""]
    lines += table(["ns a state", "ours", "`forward`", "by hand, in blocks", "by hand, as ours"], batches)
    print("\n".join(lines), flush=True)
    if given.append:
        append(lines)


if __name__ == "__main__":
    main()

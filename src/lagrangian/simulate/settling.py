"""Which regime follows a state: every friction at rest that can hold its place sticks, the others slip."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from lagrangian import dynamics
from lagrangian.errors import RunError
from lagrangian.records import dataclass
from lagrangian.simulate.regimes import Modes, Regimes

Array = NDArray[np.float64]

NEAR = 1e-9
"""A friction that broke away by an event sticks again if its force is below the limit by more than this part."""


class Paradox(RunError):
    """Coulomb's law allows no acceleration at a state, or several."""


MOST_AT_ONCE = 6
"""Up to this many frictions at rest, all their regimes are tried where the direct way finds none."""


PARADOX = (
    "at t = {t:.6g} s friction and the force that presses on it do not determine each other: Coulomb's law allows no "
    "acceleration there, or several (Painlevé's paradox)"
)
PARADOX_FIX = "a smaller mu, or a spring in place of the constraint that presses"


@dataclass(frozen=True)
class Crossroads:
    """A state at which the regime may change; a speed of slip up to ``near`` is rest."""

    regimes: Regimes
    x: Array
    u: Array
    p: Array
    t: float
    near: float

    def judged(self, modes: Modes) -> dict[str, Array]:
        """The verdict of a regime on the state."""
        return self.regimes.judged(modes, self.x, self.u, self.p, self.t)

    def settled(self, modes: Modes, resting: set[int], forced: Mapping[int, int]) -> Modes:
        """The regime that follows a state.

        ``resting``: the frictions that may be at rest, besides those that are; ``forced``: those that just broke away,
        and the rows that press and just changed their sides.
        """
        count = self.regimes.count
        rates = self.judged(modes)["rate"]
        arrived = {i for i in range(count) if abs(rates[i]) <= self.near} | resting
        moving = {i: int(np.sign(rates[i])) for i in range(count) if i not in arrived}
        start = {**dict(enumerate(modes)), **moving, **dict.fromkeys(arrived, 0), **forced}
        tried: set[Modes] = set()
        trial = tuple(start[i] for i in range(len(modes)))
        while trial not in tried:
            tried.add(trial)
            wrong = self._wrong(trial, arrived, forced)
            if wrong is None:
                self._check_split(trial)
                return trial
            trial = wrong
        for trial in self._all(start, sorted(arrived)):
            if trial not in tried and self._wrong(trial, arrived, forced) is None:
                return trial
        raise Paradox(
            f"at t = {self.t:.6g} s no regime of the frictions that are at rest agrees with the forces there",
            fix="check that no static limit is below the limit while slipping, and that friction cannot jam by itself",
            code="E505",
        )

    def _all(self, start: Mapping[int, int], arrived: Sequence[int]) -> Iterator[Modes]:
        """All regimes of the frictions at rest, those in which most stick first, with all sides of what presses."""
        count, sides = self.regimes.count, range(self.regimes.count, len(start))
        if len(arrived) + len(sides) > MOST_AT_ONCE:
            return
        for chosen in sorted(product((0, -1, 1), repeat=len(arrived)), key=lambda c: sum(map(abs, c))):
            for on in product((1, -1), repeat=len(sides)):
                made = {**start, **dict(zip(arrived, chosen, strict=True)), **dict(zip(sides, on, strict=True))}
                yield tuple(made[i] for i in range(count + len(sides)))

    def _wrong(self, trial: Modes, arrived: set[int], forced: Mapping[int, int]) -> Modes | None:
        """None if a regime agrees with the forces in it; else the regime in which what disagrees most is changed."""
        found = self.judged(trial)
        effort, most, least = found["effort"], found["most"], found["least"]
        if not found["regularity"] > dynamics.LEAST_REGULARITY:
            raise Paradox(PARADOX.format(t=self.t), fix=PARADOX_FIX, code="E505")
        if over := self._other_sides(trial, found, forced):
            return over
        self._check(most, least)
        worst, changed = 0.0, None
        for i in sorted(arrived):
            if trial[i] == 0:
                over, mode = abs(effort[i]) - most[i], -int(np.sign(effort[i]))
                if i in forced and over > -NEAR * most[i]:
                    over, mode = max(over, NEAR * most[i]), forced[i]
            else:
                over, mode = -trial[i] * float(found["change"][i]), 0
                if i in forced and trial[i] == forced[i] and self._at_limit(trial, i):
                    continue
            if over > worst:
                worst, changed = over, (i, mode)
        if changed is None:
            return None
        return tuple(changed[1] if i == changed[0] else mode for i, mode in enumerate(trial))

    def _other_sides(self, trial: Modes, found: Mapping[str, Array], forced: Mapping[int, int]) -> Modes | None:
        """The regime with the rows that press on the wrong side turned over; None if there are none."""
        count = self.regimes.count
        scale = max((float(np.abs(found[name]).max(initial=0.0)) for name in ("normal", "effort", "most")), default=0.0)
        wrong = {
            count + i
            for i, force in enumerate(found["normal"])
            if force < -NEAR * (max(1.0, scale) if count + i in forced else 1e-3 * scale)
        }
        return tuple(-mode if i in wrong else mode for i, mode in enumerate(trial)) if wrong else None

    def _at_limit(self, trial: Modes, i: int) -> bool:
        """Whether a friction that broke away could not hold its place, but for rounding."""
        stuck = tuple(0 if k == i else mode for k, mode in enumerate(trial))
        found = self.judged(stuck)
        return bool(abs(found["effort"][i]) > (1 - NEAR) * found["most"][i])

    def _check_split(self, modes: Modes) -> None:
        """Refuse what sticks where it depends on other rows, so that its force is not known."""
        count = self.regimes.count
        if all(modes[:count]):
            return
        slipping = (1,) * count + modes[count:]
        before = self.judged(slipping)["dependent"] if self.regimes.model.constraints else 0
        if self.judged(modes)["dependent"] > before:
            stuck = [f for f, mode in zip(self.regimes.model.frictions, modes, strict=False) if not mode]
            names = " and ".join(f"'{f.name}'" for f in stuck)
            raise RunError(
                f"at t = {self.t:.6g} s the share of each of {names} cannot be told: what sticks depends on other rows",
                fix="describe frictions that act together as one, and none where a constraint prevents the slip",
                code="E310",
            )

    def _check(self, most: Array, least: Array) -> None:
        for friction, high, low in zip(self.regimes.model.frictions, most, least, strict=True):
            if low < (-NEAR * max(1.0, float(np.abs(most).max())) if friction.pressing else 0.0):
                raise RunError(
                    f"{friction.title} has the limit {low:.6g} at t = {self.t:.6g} s, and friction is not negative",
                    fix="positive mu, normal and limit",
                    code="E501",
                )
            if high < low - NEAR * abs(low):
                raise RunError(
                    f"{friction.title} has the limit {high:.6g} at rest, below {low:.6g} while it slips, "
                    f"at t = {self.t:.6g} s",
                    fix="static must not be below mu (or limit)",
                    code="E501",
                )

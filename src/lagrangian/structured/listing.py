"""A listing: the equations of motion as short lines in quantities that are defined once.

All of it is read off the graph that `dynamics` computes with. With P = m v and H = J ω of every body as weights on its
velocities, one pass backwards over the velocities leaves at every velocity node the momentum of everything that hangs
on it, and at every rate ∂T*/∂ξ̇_i; with the inertial and conservative forces as weights it leaves the forces and the
left-hand sides. ∂v/∂ξ_i = d/dt ∂v/∂ξ̇_i, so of d/dt(m v·∂v/∂ξ̇_i) − m v·∂v/∂ξ_i only m a·∂v/∂ξ̇_i is left.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence

from lagrangian.derive import QuantityKind
from lagrangian.dynamics.axes import Axes, PlaceMotion
from lagrangian.dynamics.describe import described
from lagrangian.dynamics.description import Description, Inputs
from lagrangian.dynamics.mechanics import Mechanics, Pairs
from lagrangian.dynamics.rows import Drag
from lagrangian.dynamics.vectors import Vector, bare, dot, plus, times, transposed
from lagrangian.graph import Graph, backwards, gradient, reached
from lagrangian.model import Gravity, Model
from lagrangian.records import dataclass, field
from lagrangian.structured.held_rows import ListedRow, pushes, slips, ties
from lagrangian.structured.names import Indices, component
from lagrangian.structured.quantities import BodyMotion, Candidate, body_motions
from lagrangian.structured.slopes import CoordinateSlopes


@dataclass
class Listing:
    """The nodes of a listing: what may get a name, and the lines of every coordinate.

    ``momenta`` are ∂T*/∂ξ̇_i, ``gradients`` ∂T*/∂ξ_i, ``rows`` the left-hand sides d/dt(∂L/∂ξ̇_i) − ∂L/∂ξ_i, ``forces``
    the Ξ_i, ``pushes`` what the constraints' rows, the ``ties``, add to them; of a floating frame the same for its
    quasi-velocities, see `floating`. ``given`` are the kinetic co-energies that are no body's, by the titles of their
    elements, ``slips`` the frictions that constraints press on, with their efforts.
    """

    model: Model
    graph: Graph
    description: Description
    mechanics: Mechanics
    indices: Indices
    bodies: list[BodyMotion]
    candidates: list[Candidate]
    momenta: Vector
    gradients: Vector
    rows: Vector
    forces: Vector
    heights: dict[str, Vector] = field(default_factory=dict[str, Vector])
    ties: list[ListedRow] = field(default_factory=list[ListedRow])
    pushes: Vector = field(default_factory=list[int])
    given: dict[str, int] = field(default_factory=dict[str, int])
    slips: list[tuple[Drag, int]] = field(default_factory=list[tuple[Drag, int]])

    def outputs(self) -> list[int]:
        """The nodes that the lines end in."""
        return [
            *self.momenta,
            *self.gradients,
            *self.rows,
            *self.forces,
            *self.pushes,
            *self.given.values(),
            *(x for tie in self.ties for x in (tie.rate, tie.change)),
            *(tie.held for tie in self.ties if tie.held is not None),
            *(h for heights in self.heights.values() for h in heights),
        ]


def listing(model: Model, rows: Collection[str] = ()) -> Listing:
    """Build the nodes of a model's listing; ``rows`` are the names of the constraints' rows that count."""
    graph = Graph()
    inputs = Inputs.of(graph, model)
    m, d = described(model, graph, inputs)
    vdot = [graph.input("a", i) for i in range(len(m.v))]
    acc = m.accelerations(vdot)
    indices = Indices(d)
    bodies = body_motions(d, m, acc, indices)
    given = _given(d)
    raw = m.raw_kinetic
    kinetic = [pair for b in bodies for pair in b.momenta()]
    kinetic += zip(m.v, gradient(graph, raw, m.v), strict=True)
    inertial = [*(pair for b in bodies for pair in b.inertial()), *m.raw_inertial(vdot)]
    held = ties(model, m, acc, rows)
    slipping = slips(m, held)
    stored = [(rate, graph.neg(effort)) for rate, effort in m.stores]
    momenta = _backwards(graph, kinetic, [*m.v, *m.q])  # a prescribed velocity has momentum, too
    forces = _backwards(graph, [*inertial, *stored], m.v)
    reactions = _backwards(graph, pushes(held), m.v)
    moving = _Moving(d, indices)
    velocities = list(moving.velocities())
    slopes = CoordinateSlopes(d, [bare(graph, node)[0] for node, *_ in velocities], momenta)
    heights = dict(_heights(d, bodies))
    candidates = [*moving.verticals(), *moving.positions(), *_lengths(d, m)]
    candidates += [Candidate(node, "velocity", letter, index, words) for node, letter, index, words in velocities]
    candidates += _own(bodies, "momentum")
    candidates += list(_inward(graph, velocities, momenta, "momentum", {"omega": "H", "v": "P"}))
    candidates += slopes.candidates(indices)
    candidates += moving.accelerations(acc.alpha, acc.a)
    candidates += _own(bodies, "force")
    candidates += list(_inward(graph, velocities, forces, "force", {"omega": "N", "v": "F"}))
    candidates += list(_inward(graph, velocities, reactions, "constraint", {"omega": "K", "v": "R"}))
    zero = graph.zero
    slope = plus(graph, [slopes.of(q) for q in m.q], gradient(graph, raw, m.q))
    return Listing(
        model,
        graph,
        d,
        m,
        indices,
        bodies,
        candidates,
        [momenta.get(v, zero) for v in m.v],
        m.motion.along_velocities(slope),
        [forces.get(v, zero) for v in m.v],
        m.gathered([*m.efforts, *((drag.rate, effort) for drag, effort in slipping)]),
        heights,
        held,
        [reactions.get(v, zero) for v in m.v] if held else [],
        given,
        slipping,
    )


def _given(d: Description) -> dict[str, int]:
    """The kinetic co-energies that were given directly, by the titles of their elements."""
    elements = [e for e in d.model.elements if e.ledger == "T*" and e not in d.model.bodies]
    return {e.title: d.node(e.kinetic(d.model)) for e in elements}


def _backwards(g: Graph, pairs: Pairs, v: Sequence[int]) -> dict[int, int]:
    kept = [(node, weight) for node, weight in pairs if g.zero not in (node, weight)]
    return backwards(g, [node for node, _ in kept], [weight for _, weight in kept], v)


Named = tuple[int, str, tuple[str, ...], str]
"""A velocity component: its node, its letter, the parts of its index, and what it belongs to in words."""


class _Moving:
    """The velocities, accelerations and places of a description, component by component."""

    def __init__(self, d: Description, indices: Indices) -> None:
        self.d, self.indices, self.motion = d, indices, d.motion
        self.flat = d.motion.dimension == 2

    def _spins(self) -> Iterator[tuple[Axes, str, str]]:
        for axes, index in self.indices.axes.items():
            yield axes, index, f"frame {index}"

    def velocities(self) -> Iterator[Named]:
        """ω of all axes and v of all places, in their axes; and v turned into the axes of what hangs there."""
        done: set[int] = set()
        steps: list[tuple[int, list[Named]]] = []
        for axes, index, words in self._spins():
            steps.append((min(axes.omega), list(_components(axes.omega, "omega", index, words, self.flat))))
        for place, index in self.indices.places.items():
            steps.append((max(place.velocity), list(self._v(place.velocity, index, ""))))
        for place, axes in self._turned():
            v = self.motion.turned(place.velocity, place.axes, axes)
            steps.append((max(v), list(self._v(v, self.indices.places[place], self.indices.axes[axes]))))
        for _, found in sorted(steps, key=lambda step: step[0]):
            for named in found:
                node, _ = bare(self.d.graph, named[0])
                if node not in done and self.d.graph.nodes[node][0] != "const":
                    done.add(node)
                    yield named

    def _v(self, v: Vector, place: str, axes: str) -> Iterator[Named]:
        for k, node in enumerate(v):
            yield node, "v", (*component(k, place), axes), _point(place, axes)

    def _turned(self) -> Iterator[tuple[PlaceMotion, Axes]]:
        """Places that carry others in axes of their own, with these axes."""
        if self.flat:
            return
        for place in self.indices.places:
            parent = place.parent
            if parent in self.indices.places and parent.axes is not place.axes and place.axes in self.indices.axes:
                yield parent, place.axes

    def accelerations(self, alpha: dict[Axes, Vector], a: dict[PlaceMotion, Vector]) -> list[Candidate]:
        """α of all axes and a of all places."""
        found: list[Candidate] = []
        for axes, index, words in self._spins():
            for node, letter, at, what in _components(alpha[axes], "alpha", index, words, self.flat):
                found.append(Candidate(node, "acceleration", letter, at, what))
        named = [(a[place], index, "") for place, index in self.indices.places.items()]
        for place, axes in self._turned():
            turned = self.motion.turned(a[place], place.axes, axes)
            named.append((turned, self.indices.places[place], self.indices.axes[axes]))
        for vector, index, axes in named:
            for k, node in enumerate(vector):
                at = (*component(k, index), axes)
                found.append(Candidate(node, "acceleration", "a", at, _point(index, axes)))
        return sorted(found, key=lambda c: c.node)

    def _upwards(self) -> Iterator[tuple[str, Vector]]:
        """The directions against the gravities, with a name for each if there are several."""
        gravities = [e for e in self.d.model.elements if isinstance(e, Gravity)]
        for gravity in gravities:
            name = gravity.name if len(gravities) > 1 else ""
            yield name, [self.d.graph.neg(x) for x in self.d.nodes(gravity.direction)]

    def verticals(self) -> list[Candidate]:
        """The upward vertical in the axes of every frame in space."""
        found = list[Candidate]()
        for name, up in self._upwards() if not self.flat else ():
            for axes, index in self.indices.axes.items():
                turned = times(self.d.graph, transposed(self.motion.rotation(axes)), up)
                for node, letter, at, words in _components(turned, "e", index, f"frame {index}", False):
                    found.append(Candidate(node, "vertical", letter, (*at, name), words))
        return found

    def positions(self) -> list[Candidate]:
        """The heights of places and bodies."""
        found = list[Candidate]()
        for name, up in self._upwards():
            for place, index in self.indices.places.items():
                node = dot(self.d.graph, up, self.motion.position(place))
                found.append(Candidate(node, "height", "h", (index, name), f"point {index}"))
        return sorted(found, key=lambda c: c.node)


def _point(index: str, axes: str) -> str:
    return f"point {index} in the axes of frame {axes}" if axes else f"point {index}"


def _components(vector: Iterable[int], letter: str, index: str, words: str, flat: bool) -> Iterator[Named]:
    for k, node in enumerate(vector):
        yield node, letter, (index,) if flat else component(k, index), words


def _own(bodies: Sequence[BodyMotion], kind: QuantityKind) -> list[Candidate]:
    """The momentum, or the inertial force, of every body itself."""
    found: list[Candidate] = []
    for b in bodies:
        flat = len(b.velocity) == 2
        straight, turning = (b.P, b.H) if kind == "momentum" else (b.F, b.N)
        letters = ("P", "H") if kind == "momentum" else ("F", "N")
        for vector, letter in ((straight, letters[0]), (turning, letters[1])):
            for node, at, index, words in _components(vector, letter, b.index, b.body.title, flat and letter in "HN"):
                found.append(Candidate(node, kind, at, index, words, False, (b.body.title,)))
    return found


def _inward(
    g: Graph, velocities: Sequence[Named], cotangents: dict[int, int], kind: QuantityKind, letters: dict[str, str]
) -> Iterator[Candidate]:
    """The sums over everything further out: what the pass backwards left at every velocity."""
    for node, letter, index, words in velocities:
        under, negative = bare(g, node)
        if under in cotangents:
            natural = g.neg(cotangents[under]) if negative else cotangents[under]
            yield Candidate(natural, kind, letters[letter], index, words, True)


def _lengths(d: Description, m: Mechanics) -> Iterator[Candidate]:
    """The lengths of what is between two points."""
    g = d.graph
    for element in d.model.elements:
        added = m.added.get(element.title)
        if added is None or getattr(element, "between", None) is None:
            continue
        ends = [*added.potentials, *(effort for _, effort in added.efforts)]
        for node in reached(g, ends):
            if g.nodes[node][0] == "sqrt":
                yield Candidate(node, "length", "delta", (element.name,), element.title, False, (element.title,))


def _heights(d: Description, bodies: Sequence[BodyMotion]) -> Iterator[tuple[str, Vector]]:
    """For every gravity, by its title, the heights of all bodies above its datum."""
    g = d.graph
    for gravity in (e for e in d.model.elements if isinstance(e, Gravity)):
        up = [g.neg(x) for x in d.nodes(gravity.direction)]
        level = dot(g, up, d.motion.position(d.places[gravity.datum])) if gravity.datum is not None else g.zero
        places = [d.motion.position(d.places[b.body.at]) for b in bodies]
        yield gravity.title, [g.sub(dot(g, up, place), level) for place in places]

"""Converts a Model to Mechanics: points and frames along their parents, elements as efforts on rates.

SymPy expressions are converted piece by piece, as they were written, so a definition or a parent point that is used
several times is one node. Elements of kinds that are not known here are converted from their own T*, V and actions.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import sympy as sp

from lagrangian import bounded
from lagrangian.dynamics.axes import Axes, PlaceMotion
from lagrangian.dynamics.bodies import Bodies
from lagrangian.dynamics.constraints import rows, slip_rate
from lagrangian.dynamics.description import Description, Inputs
from lagrangian.dynamics.floating import Float, floating_body, floating_rates, quaternion_rotation
from lagrangian.dynamics.mechanics import Mechanics, Pairs
from lagrangian.dynamics.motion import Motion
from lagrangian.dynamics.rotations import along_axis
from lagrangian.dynamics.rows import Added, Drag
from lagrangian.dynamics.vectors import Vector, dot, minus, plus, scaled, times, zeros
from lagrangian.errors import ModelError
from lagrangian.graph import Graph, gradient
from lagrangian.model import Body, Frame, Model, time
from lagrangian.model.elements.damper import RATE
from lagrangian.model.elements.spring import DELTA


def describe(model: Model, graph: Graph, inputs: Inputs) -> Mechanics:
    """The mechanics of a model over given input nodes. Raises `ModelError` that names the element at fault."""
    return described(model, graph, inputs)[0]


def described(
    model: Model, graph: Graph, inputs: Inputs, release: Callable[[Description], None] | None = None
) -> tuple[Mechanics, Description]:
    """The mechanics of a model, and the nodes of its points and frames.

    ``release`` may change the velocities of places and axes before the elements are described.
    """
    d, floats = placed(model, graph, inputs)
    motion = d.motion
    if release is not None:
        release(d)
    down = zeros(graph, model.dimension)
    m = Mechanics(graph, motion, Bodies(motion), moved(model), down, floats=tuple(floats.values()))
    for element in model.elements:
        if element.ledger == "λ":
            continue
        had = len(m.potentials), len(m.stores), len(m.efforts)
        try:
            ELEMENTS.get(element.kind, _any)(d, m, element)
        except ModelError as error:
            if error.element is None:
                error.element = element.title
            error.at(element.place)
            raise
        m.added[element.title] = Added(m.potentials[had[0] :], m.stores[had[1] :], m.efforts[had[2] :])
    m.rows, m.spare = rows(d), model.spare
    m.known = model.remembered("orders of rows", dict)
    return m, d


def placed(model: Model, graph: Graph, inputs: Inputs) -> tuple[Description, dict[Frame, Float]]:
    """The nodes of a model's points and frames without its elements, and its floating frames."""
    rates, floats = velocities(model, graph, inputs)
    motion = Motion(graph, model.dimension, inputs.q, inputs.v, rates, inputs.t)
    d = Description(model, graph, inputs, motion, _symbols(model, inputs, rates))
    for definition in model.definitions:
        node = d.table[definition.symbol] = d.node(definition.expression)
        if definition.moving and definition.symbol != time:
            d.table[sp.Derivative(definition.symbol, time)] = motion.rate([node])[0]
    _geometry(d, floats)
    return d, floats


def velocities(model: Model, graph: Graph, inputs: Inputs) -> tuple[list[int], dict[Frame, Float]]:
    """The rates q̇ = N(q) v, in the order of q, and where q and v hold what each floating frame floats by."""
    q_at = {c.name: i for i, c in enumerate(model.coordinates)}
    v_at = {v.name: i for i, v in enumerate(model.velocities)}
    floats: dict[Frame, Float] = {}
    rates = [inputs.v[v_at[f"{name}'"]] if f"{name}'" in v_at else graph.zero for name in q_at]
    for frame in model.floating:
        assert frame.floating is not None
        i, k = q_at[frame.floating.coordinates[0].name], v_at[frame.floating.velocities[0].name]
        at = floats[frame] = Float(i, k, frame.floating.held)
        own = [inputs.v[j] for j in at.velocities]
        rates[at.coordinates] = floating_rates(graph, inputs.q[at.coordinates], own)
    return rates, floats


def moved(model: Model) -> tuple[str, ...]:
    """For every velocity the name of what it moves: the coordinate, or the quasi-velocity itself."""
    return tuple(v.name.removesuffix("'") for v in model.velocities)


def _symbols(model: Model, inputs: Inputs, rates: Sequence[int]) -> dict[Any, int]:
    table: dict[Any, int] = {time: inputs.t}
    for c, q, rate in zip(model.coordinates, inputs.q, rates, strict=True):
        table[c.symbol], table[c.rate] = q, rate
    table.update((v.symbol, node) for v, node in zip(model.velocities, inputs.v, strict=True))
    table.update((p.symbol, node) for p, node in zip(model.parameters, inputs.p, strict=True))
    table.update((u.symbol, node) for u, node in zip(model.inputs, inputs.u, strict=True))
    return table


# -- geometry ---------------------------------------------------------------------------------------------------


def _geometry(d: Description, floats: Mapping[Frame, Float]) -> None:
    """All points and frames that are named in the model or used by its elements, parents first."""
    for frame, at in floats.items():
        if not at.held:
            u = [d.inputs.v[j] for j in at.velocities]
            d.axes[frame], d.places[frame.origin] = floating_body(d.motion, d.inputs.q[at.coordinates], u)
    things: dict[int, Any] = {}
    waiting: list[Any] = [*d.model.points, *d.model.frames]
    for element in d.model.elements:
        waiting += [point for _, point in element.points()]
        waiting += [frame for _, frame in element.frames()]
    while waiting:
        thing = waiting.pop()
        if thing is None or id(thing) in things:
            continue
        things[id(thing)] = thing
        waiting += [thing.parent, getattr(thing, "frame", None), getattr(thing, "origin", None)]
    for thing in sorted(things.values(), key=lambda x: x.serial):
        if thing in d.axes or thing in d.places:
            continue
        if hasattr(thing, "angle"):
            d.axes[thing] = _held(d, thing, floats[thing]) if thing in floats else _axes(d, thing)
        elif thing.is_origin:
            d.places[thing] = d.motion.ground
        else:
            axes = d.motion.root if thing.frame is None else d.axes[thing.frame]
            d.places[thing] = d.motion.place(d.places[thing.parent], axes, d.nodes(thing.offset))


def _held(d: Description, frame: Frame, at: Float) -> Axes:
    """The axes of a frame in a ball joint."""
    parent = d.motion.root if frame.parent is None else d.axes[frame.parent]
    turn = quaternion_rotation(d.graph, d.inputs.q[at.orientation])
    return d.motion.turned_axes(parent, turn, [d.inputs.v[j] for j in at.turning])


def _axes(d: Description, frame: Any) -> Axes:
    motion, g = d.motion, d.graph
    parent = motion.root if frame.parent is None else d.axes[frame.parent]
    if frame.axis is None:
        before = g.zero if frame.parent is None else d.angles[frame.parent]
        total = d.angles[frame] = g.add(before, d.node(frame.angle))
        return motion.plane_axes(parent, total)
    angle = d.node(frame.angle)
    main = [k for k in range(3) if frame.axis[k] != 0]
    if frame.angle.is_number:  # SymPy knows cos(π/2) = 0 exactly
        turn = [d.nodes(row) for row in frame.local_rotation.tolist()]
        return motion.turned_axes(parent, turn, zeros(g, 3))
    if len(main) == 1 and abs(frame.axis[main[0]]) == 1:
        return motion.turned_about(parent, main[0], angle if frame.axis[main[0]] == 1 else g.neg(angle))
    n = d.nodes(frame.axis)
    rate = motion.rate([angle])[0]
    return motion.turned_axes(parent, along_axis(g, n, angle), scaled(g, rate, n))


# -- elements ---------------------------------------------------------------------------------------------------


def _particle(d: Description, m: Mechanics, e: Any) -> None:
    m.bodies.add_point(d.places[e.at], d.node(e.mass))


def _rigid_body(d: Description, m: Mechanics, e: Any) -> None:
    axes, place, mass = d.axes[e.frame], d.places[e.at], d.node(e.mass)
    if d.motion.dimension == 2:
        m.bodies.add_in_plane(axes, place, mass, d.node(e.inertia[0, 0]))
    else:
        m.bodies.add(axes, place, mass, [d.nodes(row) for row in e.inertia.tolist()])


def _gravity(d: Description, m: Mechanics, e: Any) -> None:
    """Weight m g n on every mass; V counts from the datum: V = Σ m g n·(r_datum − r)."""
    g = d.graph
    down = scaled(g, d.node(e.g), d.nodes(e.direction))
    m.down = plus(g, m.down, down)
    if e.datum is not None:
        level = dot(g, down, d.motion.position(d.places[e.datum]))
        for body in d.model.bodies:
            m.potentials.append(g.mul(d.node(body.mass), level))


def _deflection(d: Description, e: Any) -> tuple[int, int | None, Vector, Vector]:
    """δ, δ̇ (None between points), and between points Δr and Δv in the fixed axes."""
    g, motion = d.graph, d.motion
    if e.between is None:
        delta = d.node(e.deflection)
        return delta, motion.rate([delta])[0], [], []
    start, end = (d.places[p] for p in e.between)
    apart = motion.between(start, end)
    velocity = minus(g, _velocity(d, end), _velocity(d, start))
    return g.sqrt(dot(g, apart, apart)), None, apart, velocity


def _velocity(d: Description, place: PlaceMotion) -> Vector:
    """The velocity of a place in the fixed axes."""
    return d.motion.turned(place.velocity, place.axes, d.motion.root)


def _pull(d: Description, pairs: Pairs, pull: int, delta: tuple[int, int | None, Vector, Vector]) -> None:
    """Add a pull along a deflection: −pull on δ̇, or −(pull/δ) Δr on Δv."""
    g = d.graph
    length, rate, apart, velocity = delta
    if rate is not None:
        pairs.append((rate, g.neg(pull)))
        return
    density = g.div(pull, length)
    pairs.extend((v, g.neg(g.mul(density, x))) for v, x in zip(velocity, apart, strict=True))


def _spring(d: Description, m: Mechanics, e: Any) -> None:
    """V = ½ k (δ − δ₀)² or the energy of its law; the pull is dV/dδ."""
    g = d.graph
    delta = _deflection(d, e)
    extension = g.sub(delta[0], d.node(e.rest))
    if e.k is not None:
        k = d.node(e.k)
        if e.between is not None and e.rest == 0:  # ½ k Δr·Δr: no root, no division
            square = dot(g, delta[2], delta[2])
            m.potentials.append(g.mul(g.const(0.5), g.mul(k, square)))
            m.stores.extend((v, g.neg(g.mul(k, x))) for v, x in zip(delta[3], delta[2], strict=True))
            return
        energy, pull = g.mul(g.const(0.5), g.mul(k, g.mul(extension, extension))), g.mul(k, extension)
    else:
        energy = d.node(e.energy, {DELTA: extension})
        pull = d.node(e.law if e.law is not None else bounded.diff(e.energy, DELTA), {DELTA: extension})
    m.potentials.append(energy)
    rest_moves = not d.motion.constant([d.node(e.rest)])
    _pull(d, m.stores, pull, delta)
    if rest_moves:  # a rest length that depends on coordinates is part of the extension that V is a function of
        m.stores.append((d.motion.rate([d.node(e.rest)])[0], pull))


def _damper(d: Description, m: Mechanics, e: Any) -> None:
    """The pull b δ̇, or its law of δ̇."""
    g = d.graph
    if e.between is not None and e.law is None:  # along one fixed line the separation's sign does not matter
        start, end = (d.places[p] for p in e.between)
        apart = d.motion.between(start, end)
        moving = [k for k, x in enumerate(apart) if x != g.zero]
        if len(moving) == 1:
            velocity = minus(g, _velocity(d, end), _velocity(d, start))[moving[0]]
            pull = g.mul(d.node(e.b), velocity)
            m.efforts.append((velocity, g.neg(pull)))
            m.losses.append(g.mul(pull, velocity))
            return
    delta = _deflection(d, e)
    rate = delta[1] if delta[1] is not None else g.div(dot(g, delta[2], delta[3]), delta[0])
    pull = g.mul(d.node(e.b), rate) if e.b is not None else d.node(e.law, {RATE: rate})
    m.losses.append(g.mul(pull, rate))
    _pull(d, m.efforts, pull, delta)


def _force(d: Description, m: Mechanics, e: Any) -> None:
    g, motion = d.graph, d.motion
    if not e.is_vector:
        _pull(d, m.efforts, g.neg(d.node(e.value)), _deflection(d, e))
        return
    source = motion.root if e.axes is None else d.axes[e.axes]
    value = d.nodes(e.value)
    if motion.dimension == 2 and e.axes is not None:
        value = times(g, source.turn, value)
    for sign, point in ((1, e.at), (-1, e.reaction)):
        if point is not None:
            place = d.places[point]
            there = motion.turned(value, source, place.axes)
            m.efforts.extend((v, f if sign == 1 else g.neg(f)) for v, f in zip(place.velocity, there, strict=True))


def _torque(d: Description, m: Mechanics, e: Any) -> None:
    g, motion = d.graph, d.motion
    for sign, target in ((1, e.on), (-1, e.reaction)):
        if target is None:
            continue
        if not isinstance(target, Frame):
            effort = d.node(e.value)
            m.efforts.append((motion.rate([d.node(target)])[0], effort if sign == 1 else g.neg(effort)))
            continue
        axes = d.axes[target]
        if motion.dimension == 2:
            value, source = [d.node(e.value)], axes
        elif isinstance(e.value, tuple):
            value, source = d.nodes(e.value), motion.root if e.axes is None else d.axes[e.axes]
        else:  # about the axis of the frame that is acted on
            source = d.axes[e.on]
            value = scaled(g, d.node(e.value), d.nodes(e.on.axis))
        there = motion.turned(value, source, axes)
        m.efforts.extend((w, f if sign == 1 else g.neg(f)) for w, f in zip(axes.omega, there, strict=True))


def _on_coordinates(d: Description, forces: Sequence[int]) -> list[tuple[int, int]]:
    return [(rate, f) for rate, f in zip(d.motion.rates, forces, strict=True) if f != d.graph.zero]


def _potential(d: Description, m: Mechanics, e: Any) -> None:
    _store(d, m, d.node(e.value))


def _store(d: Description, m: Mechanics, energy: int) -> None:
    g = d.graph
    m.potentials.append(energy)
    m.stores.extend(_on_coordinates(d, [g.neg(x) for x in gradient(g, energy, d.motion.q)]))


def _kinetic(d: Description, m: Mechanics, e: Any) -> None:
    m.kinetics.append(d.node(e.value))


def _dissipation(d: Description, m: Mechanics, e: Any) -> None:
    """Ξ_i = −∂D/∂ξ̇_i."""
    g = d.graph
    slope = gradient(g, d.node(e.value), d.inputs.v)
    m.efforts.extend((v, g.neg(x)) for v, x in zip(d.inputs.v, slope, strict=True) if x != g.zero)
    m.losses.append(dot(g, slope, d.inputs.v))


def _generalized_force(d: Description, m: Mechanics, e: Any) -> None:
    rate = d.table.get(sp.Derivative(e.coordinate, time), d.table[e.coordinate])  # a quasi-velocity is a rate itself
    m.efforts.append((rate, d.node(e.value)))


def _friction(d: Description, m: Mechanics, e: Any) -> None:
    """−μ |N| sign(δ̇) − b δ̇; with a multiplier as the normal force, its part is solved for with the multiplier."""
    g = d.graph
    rate = d.node(e.rate(d.model)) if e.between is None else slip_rate(d, *e.between)
    if e.pressed_by is None:
        sense = g.sign(rate) if e.sense is None else d.node(e.sense)
        effort = g.neg(g.mul(d.node(d.model.expand(e.slipping_limit)), sense))
        if e.viscous is not None:
            effort = g.sub(effort, g.mul(d.node(e.viscous), rate))
        m.efforts.append((rate, effort))
        m.losses.append(g.neg(g.mul(effort, rate)))
        return
    known = e.sense is not None and (e.side is not None or len(e.pressing) > 1)
    factor = d.node(-e.mu * e.sense * (e.side or 1)) if known else None
    if factor != g.zero:
        m.drags.append(Drag(rate, d.node(e.mu), factor, e.pressing, e))
    if e.viscous is not None:
        effort = g.neg(g.mul(d.node(e.viscous), rate))
        m.efforts.append((rate, effort))
        m.losses.append(g.neg(g.mul(effort, rate)))


def _any(d: Description, m: Mechanics, e: Any) -> None:
    """Convert an element by its own T*, V and actions; one with mass needs its own function, because of gravity."""
    if isinstance(e, Body):
        raise TypeError(f"the kind '{e.kind}' has mass: it needs a function in ELEMENTS, so that gravity pulls it")
    kinetic, potential = e.kinetic(d.model), e.potential(d.model)
    if kinetic != 0:
        m.kinetics.append(d.node(kinetic))
    if potential != 0:
        _store(d, m, d.node(potential))
    for action in e.works(d.model):
        rate, effort = d.node(action.rate), d.node(action.effort)
        m.efforts.append((rate, effort))
        if e.resists:
            m.losses.append(d.graph.neg(d.graph.mul(effort, rate)))


ELEMENTS: dict[str, Callable[[Description, Mechanics, Any], None]] = {
    "particle": _particle,
    "rigid_body": _rigid_body,
    "gravity": _gravity,
    "spring": _spring,
    "damper": _damper,
    "force": _force,
    "torque": _torque,
    "potential": _potential,
    "kinetic": _kinetic,
    "dissipation": _dissipation,
    "generalized_force": _generalized_force,
    "friction": _friction,
}

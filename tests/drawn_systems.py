"""Systems with pictures that are written by hand, for tests of what shows pictures."""

from __future__ import annotations

import math

import lagrangian as lg
from lagrangian.derive import Derived
from lagrangian.dynamics.places import point_program
from lagrangian.graph import Graph, Output, Program, copied
from lagrangian.model import Model
from lagrangian.page.scene import Disc, Label, Part, Path, Placement, Scene

ROD = Path((("M", (0.0, 0.0)), ("L", (1.0, 0.0))))
FLAT = ((1.0, 0.0), (0.0, -1.0))


def anchors(model: Model, names: tuple[str, ...]) -> Program:
    """q, v, u, p, t → the origin and the named points, one after another."""
    points = {p.name: p for p in model.points}
    graph = Graph()
    ids = [graph.zero] * model.dimension
    made = [point_program(model, points[name]) for name in names]
    for program in made:
        ids += copied(program.graph, program.outputs["r"].ids, graph)
    shape = (1 + len(names), model.dimension)
    return Program("anchors", graph, made[0].inputs, {"r": Output(tuple(ids), shape)}, made[0].defaults)


def double_pendulum() -> tuple[Derived, Scene, Program]:
    """The built-in double pendulum, with two rods and two discs."""
    system = lg.example("double-pendulum")
    elbow = (math.sin(0.6), -math.cos(0.6))
    hand = (elbow[0] + math.sin(1.05), elbow[1] - math.cos(1.05))
    parts = (
        Part(ROD, "rod", Placement(0, 1, "along"), outline=3.0),
        Part(ROD, "rod", Placement(1, 2, "along"), outline=3.0),
        Part(Disc((0.0, 0.0), 13.0), "body", Placement(1), ("m1",), "ball", filled=True, layer=1),
        Part(Disc((0.0, 0.0), 13.0), "body", Placement(2), ("m2",), "ball", filled=True, layer=1),
    )
    labels = (Label(("m1",), (250.0, 200.0), "body", ("m1",)), Label(("m2",), (400.0, 290.0), "body", ("m2",)))
    scene = Scene(
        "double pendulum", (480.0, 380.0), (140.0, 50.0), 160.0, FLAT, ((0.0, 0.0), elbow, hand), parts, labels,
        "Two rods in a row, with a mass at the end of each.", trail=(2,), handles=(1, 2),
    )  # fmt: skip
    return system.derive(), scene, anchors(system.model, ("P1", "P2"))

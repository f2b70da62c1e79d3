"""What a live page draws, run in Node: what lies in front of what as the view turns, dots of charges, trails."""

from __future__ import annotations

import json
import math
import shutil
import subprocess
from importlib.resources import files
from typing import Any

import pytest

from built_in import picture
from lagrangian.page.scene import as_data

NODE = shutil.which("node")
pytestmark = pytest.mark.skipif(NODE is None, reason="there is no Node on this machine")

ASK = """
const scene = JSON.parse(require("fs").readFileSync(0, "utf8"));
const picture = new Picture(scene, () => {});
picture.r.set(picture.rest);
const asked = [depthOrder(picture)];
picture.orbit(Math.PI, 0);
asked.push(depthOrder(picture), picture.ordered().map((part) => scene.parts.indexOf(part)));
console.log(JSON.stringify(asked));
"""


def in_node(question: str, scene: dict[str, Any]) -> Any:
    """What a question prints that is asked of the page's scripts about a scene."""
    folder = files("lagrangian.write") / "interactive"
    names = ("depth.js", "ground.js", "picture.js", "history.js", "motion.js")
    script = "\n".join((folder / name).read_text(encoding="utf-8") for name in names)
    done = subprocess.run([str(NODE), "-e", script + question], input=json.dumps(scene), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def asked(scene: dict[str, Any]) -> tuple[list[int], list[int], list[int]]:
    """The order of the solids from the first side and from the other one, and then that of all parts."""
    first, second, parts = in_node(ASK, scene)
    return first, second, parts


@pytest.mark.sampled(("furuta-pendulum", "balancing-robot"))
@pytest.mark.parametrize("name", ["furuta-pendulum", "balancing-robot", "robot-arm", "scara", "spinning-top"])
def test_from_the_first_side_a_page_draws_in_the_order_of_the_schematic(name: str) -> None:
    scene = as_data(picture(name).scene)
    first, _, _ = asked(scene)
    assert first == list(range(len(scene["solids"]))) and len(first) > 1


def test_from_behind_the_other_wheel_lies_in_front() -> None:
    scene = as_data(picture("balancing-robot").scene)
    first, second, parts = asked(scene)
    wheels = {part["elements"][0]: part["group"] for part in scene["parts"] if part["kind"] == "wheel"}
    left, right = wheels["left wheel"], wheels["right wheel"]
    assert (first.index(left) < first.index(right)) is not (second.index(left) < second.index(right))
    drawn = [scene["parts"][i]["group"] for i in parts]
    assert (drawn.index(left) < drawn.index(right)) is (second.index(left) < second.index(right))
    assert sorted(parts) == list(range(len(scene["parts"])))


DOTS = """
const scene = JSON.parse(require("fs").readFileSync(0, "utf8"));
const picture = new Picture(scene, () => {});
picture.spread([0, 1].map((q) => ({ x: [q], t: 0 })));
const seen = (charge) => {
  const spots = [];
  const context = { beginPath() {}, fill() {}, arc: (x, y) => spots.push([x, y]) };
  picture.x = [charge];
  picture.drawFlow(context, scene.flows[0]);
  return spots;
};
console.log(JSON.stringify([0, 0.05, 0.05, 0.5].map(seen)));
"""


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_dots_go_along_with_the_charge_in_its_sense_within_the_loop(sense: float) -> None:
    """Two rounds for the most that flows: 0.05 of it is a tenth of a round, 20 px of the 200 px around 60 × 40."""
    left, top, right, bottom = box = (10.0, 20.0, 70.0, 60.0)
    scene = as_data(picture("pendulum").scene) | {"flows": [{"state": 0, "box": box, "sense": sense}]}
    start, later, same, round_later = in_node(DOTS, scene)
    assert len(start) == round(200 / 26) and later == same
    for x, y in (*start, *later):
        on_sides = (x in (left, right) and top <= y <= bottom) or (y in (top, bottom) and left <= x <= right)
        assert on_sides
    along = [_along(spot, box) for spot in (start[0], later[0])]
    assert (along[1] - along[0]) * sense % 200 == pytest.approx(20.0)
    assert _along(round_later[0], box) % 200 == pytest.approx(along[0] % 200, abs=1e-6)  # 1 round: 0.5 of it


def _along(spot: list[float], box: tuple[float, float, float, float]) -> float:
    """How far a place on a rectangle is from its left upper corner, clockwise."""
    (x, y), (left, top, right, bottom) = spot, box
    w, h = right - left, bottom - top
    return (
        x - left
        if y == top
        else w + y - top
        if x == right
        else w + h + right - x
        if y == bottom
        else 2 * w + h + bottom - y
    )


ASIDE = """
const scene = JSON.parse(require("fs").readFileSync(0, "utf8"));
const picture = new Picture(scene, () => {});
picture.r.set(picture.rest);
const bodies = [Infinity, Infinity, -Infinity, -Infinity], circuit = [...bodies];
picture.cover(bodies);
bodies[0] -= 500;
const box = [...bodies];
picture.giveWay(box);
picture.cover(circuit, true);
console.log(JSON.stringify([bodies, circuit, box]));
"""


def test_a_circuit_gives_way_to_bodies_that_move_to_the_left() -> None:
    scene = as_data(picture("dc-motor").scene) | {"flows": []}
    bodies, circuit, box = in_node(ASIDE, scene)
    assert circuit[2] == pytest.approx(bodies[0] - 24.0)
    assert box == [min(bodies[0], circuit[0]), min(bodies[1], circuit[1]), bodies[2], max(bodies[3], circuit[3])]


TRAILS = """
const scene = JSON.parse(require("fs").readFileSync(0, "utf8"));
globalThis.element = () => ({ getContext: () => null });
let computed = 0;
const picture = new Picture(scene, (x, t, r) => { computed++; r.fill(x[0]); });
const history = makeHistory(1, 0), stored = (i) => [history.at(i, 1)];
for (let i = 0; i < 50; i++) history.add(i, [0.1 * i], 0, 0, 0, []);
const motion = new Motion({ history, stored, data: { trail: [1, 2] } }, picture);
const all = () => { for (let i = 0; i < history.count; i++) motion.spots(i); return [computed, ...motion.spots(7)]; };
const first = all(), again = all();
history.keep(8);
history.keep(7);
history.add(7, [9], 0, 0, 0, []);
console.log(JSON.stringify([first, again, all()]));
"""


def test_a_trail_computes_every_sample_once_until_the_history_changes() -> None:
    first, again, changed = in_node(TRAILS, as_data(picture("double-pendulum").scene))
    assert first == again == [50, *4 * [pytest.approx(0.7)]]
    assert changed == [58, *4 * [9.0]]


GROUND = """
const scene = JSON.parse(require("fs").readFileSync(0, "utf8"));
const picture = new Picture(scene, () => {}), [ground] = picture.grids, handle = scene.handles[0];
const path = [["M", 0, 0], ["L", 43, 0], ["M", 3, 0], ["L", 0, 5], ["M", 13, 0], ["L", 10, 5]];
const floor = { kind: "floor", path };
picture.r.set(picture.rest);
const drawn = [];
for (const far of [0, 4]) {
  picture.r[3 * handle] = picture.rest[3 * handle] + far;
  ground.lay(picture);
  const xs = ground.part.path.map(([, x]) => x * ground.counts[0]);
  drawn.push([Math.min(...xs), Math.max(...xs), ground.places(picture)[0][0]]);
}
console.log(JSON.stringify([drawn, ground.counts[0], picture.copies(floor, [1, 0, 0, 1, 0, 0, 1], 60, 40)]));
"""


def test_the_ground_of_a_page_reaches_where_bodies_go_and_its_strokes_stay_even() -> None:
    (near, far), count, copies = in_node(GROUND, as_data(picture("rolling-disc").scene))
    assert near[0] == 0 and near[2] < count <= near[1] <= count + 2
    assert far[0] <= 0 and far[2] > count and far[1] >= far[2] + 2
    assert all(along % 10 == 0 and up == 0 for along, up in copies) and len(copies) > 1


SLOPE = """
const scene = JSON.parse(require("fs").readFileSync(0, "utf8"));
const picture = new Picture(scene, () => {}), [floor] = scene.parts.filter((part) => part.kind === "floor");
const [[, x0, y0], [, x1, y1]] = floor.path, along = [1, 0, 0, 1, 0, 0, 1];
const reach = (far) => {
  [picture.left, picture.top] = [200 - far * (x1 - x0), 150 - far * (y1 - y0)];
  return picture.copies(floor, along, 400, 300).map(([x, y]) => [x, y, x / (x1 - x0) - far]);
};
console.log(JSON.stringify([[x1 - x0, y1 - y0], reach(0), reach(100)]));
"""


def test_the_ground_of_an_incline_goes_on_along_the_slope_wherever_the_view_is() -> None:
    (x, y), near, far = in_node(SLOPE, as_data(picture("wheel-on-incline").scene))
    half = 250 / math.hypot(x, y)  # from the middle of a canvas of 400 × 300 pixels to its corner
    assert abs(y) > 10
    for copies in (near, far):
        assert all(along * y == pytest.approx(up * x, abs=1e-6) for along, up, _ in copies)
        lengths = [by for _, _, by in copies]
        assert min(lengths) < -half + 1 and max(lengths) + 1 > half and max(lengths) - min(lengths) < 2 * half + 3

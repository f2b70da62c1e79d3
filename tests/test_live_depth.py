"""What lies in front of what on a live page, as the view turns: `depth.js`, run in Node."""

from __future__ import annotations

import json
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


def asked(scene: dict[str, Any]) -> tuple[list[int], list[int], list[int]]:
    """The order of the solids from the first side and from the other one, and then that of all parts."""
    folder = files("lagrangian.write") / "interactive"
    script = "\n".join((folder / name).read_text(encoding="utf-8") for name in ("depth.js", "picture.js"))
    done = subprocess.run([str(NODE), "-e", script + ASK], input=json.dumps(scene), capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    first, second, parts = json.loads(done.stdout)
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

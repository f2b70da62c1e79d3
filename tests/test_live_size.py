"""What a live page weighs, and how it is packed."""

import base64
import html
import json
import random
import re
import shutil
import subprocess
from importlib import resources

import pytest
from sympy import cos, sin

import built_in
import lagrangian as lg
from lagrangian import live
from lagrangian.simulate.browser import browser_module
from lagrangian.write.interactive import page
from lagrangian.write.interactive.columns import in_columns
from lagrangian.write.interactive.page import DIGITS, dense

NODE = shutil.which("node")


def interactive(name: str) -> str:
    return resources.files("lagrangian.write.interactive").joinpath(name).read_text(encoding="utf-8")


def in_node(script: str, *parts: str) -> str:
    assert NODE is not None
    told = subprocess.run([NODE, "-e", script, *parts], capture_output=True, text=True, check=True)
    return told.stdout


@pytest.mark.sampled(6)
@pytest.mark.skipif(NODE is None, reason="there is no Node on this machine")
@pytest.mark.parametrize("size", [0, 1, 11, 12, 13, 26, 4000])
def test_what_is_packed_is_read_again(size: int) -> None:
    content = "".join(random.Random(size).choices('aé\u2212<"', k=size))
    packed = dense(json.dumps([["engine", content, "text/plain"]]).encode())
    assert set(packed) <= set(DIGITS)
    around = """const made = [], document = {
      getElementById: (id) => (id === "packed" ? { textContent: ` ${process.argv[1]} ` } : {}),
      createElement: () => ({}), body: { append: (e) => made.push(e.textContent) } };"""
    told = "process.on('exit', () => console.log(JSON.stringify(made)));"
    assert json.loads(in_node(f"{around}{interactive('unpack.js')}{told}", packed)) == [content]


def test_the_digits_of_a_page_mean_nothing_in_html() -> None:
    assert len(set(DIGITS)) == 91 and html.escape(DIGITS, quote=True).count("&") == len("'>")
    assert not re.search(r"[<&\"\s]", DIGITS)


@pytest.mark.sampled(2)
@pytest.mark.skipif(NODE is None, reason="there is no Node on this machine")
@pytest.mark.parametrize("method", ["dop853", "gauss4"])
def test_webassembly_comes_out_of_its_columns_as_it_was(method: str) -> None:
    system = built_in.system("pendulum")
    code = browser_module(system, method, events=lg.event(system["theta"]), lanes=2).code
    columns = in_columns(code)
    assert columns[0] == 7  # no unknown instruction
    script = (
        'const { readFileSync } = require("fs"), read = (x) => new Uint8Array(Buffer.from(x, "base64"));'
        f"{interactive('columns.js')}"
        'process.stdout.write(Buffer.from(fromColumns(read(process.argv[1]))).toString("base64"));'
    )
    assert base64.b64decode(in_node(script, base64.b64encode(columns).decode())) == code
    assert base64.b64decode(in_node(script, base64.b64encode(b"\0" + code).decode())) == code


def test_a_module_with_an_unknown_instruction_is_left_as_it_is() -> None:
    """One function of no arguments with the instruction 0xFE, which belongs to threads."""
    module = bytes.fromhex("0061736d01000000 0104 01600000 0302 0100 0a06 01 04 00 fe00 0b")
    assert in_columns(module) == b"\0" + module
    known = module.replace(b"\xfe\x00", b"\x01\x01")
    assert in_columns(known)[0] == 7 and sorted(in_columns(known)[8:]) == sorted(known)


def test_outlines_in_steps_go_through_the_same_points() -> None:
    """The points of a path are those of its steps added up, to the tenth of a pixel; errors do not add up."""
    absolute = "M10.04 -0.02L10.34 0.26 10.64 0.54C11 1 12 2.04 13.33 3ZM1 2L0 0.04"
    assert page._in_steps(absolute) == "m10 0l.3 .3 .3 .2c.4 .5 1.4 1.5 2.7 2.5zm-9 2l-1-2"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["stewart-platform", "whipple-bicycle"])
def test_the_largest_pages_are_below_150_kb(name: str) -> None:
    assert len(built_in.picture(name).to_html().encode()) < 150_000


def test_a_long_description_is_cut_below_the_name_and_whole_in_the_picture() -> None:
    system = lg.System("chain")
    at = system.origin
    for i in range(14):
        q = system.coordinate(f"q{i}")
        at = at + (0.1 * sin(q), -0.1 * cos(q))
        system.particle(1, at=at, name=f"number {i} of a long chain")
    words = live._subtitle(system.look().scene)
    assert len(words) < live.LONGEST_SUBTITLE + 3 and words.endswith(" …")
    assert system.look().scene.description.startswith(words.removesuffix(" …"))


def test_letters_with_a_number_have_subscripts_below_the_name_of_a_system() -> None:
    words = live._subtitle(built_in.picture("lecture-3a").scene)
    assert words.startswith("Cart m₁ ") and "cart m₂" in words and not re.search(r"\b[A-Za-z]\d", words)


def test_a_positive_coordinate_without_a_start_begins_as_it_is_drawn() -> None:
    system = lg.System("ball on a spring")
    r = system.coordinate("r", positive=True)
    theta = system.coordinate("theta")
    m, k, L = system.parameters("m k L", m="1 kg", k="10 N/m", L="0.8 m")
    system.particle(m, at=system.point("P", (r * sin(theta), -r * cos(theta))))
    system.spring(k, deflection=r - L)
    look = system.look()
    starts = live._starts(system.model, look.scene)
    assert starts == {"r": look.pose["r"]} and starts["r"] > 0
    assert live._module(system.model, look.program, (), starts).layout["start"] == [starts["r"], 0.0, 0.0, 0.0]
    with pytest.raises(lg.RunError, match="'r' is declared positive") as caught:
        system.simulate(1.0)
    assert caught.value.fix == "give a start above 0: initial={'r': 1}"

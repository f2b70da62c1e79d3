"""What the app answers: exactly what the command writes with ``--json``, and pieces of HTML beside it."""

import json
import sys
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

import httpx
import pytest
from served_app import Served

import lagrangian as lg
from lagrangian import examples
from lagrangian.cli import main
from lagrangian.web.app import PAGES
from lagrangian.write.scene_svg import scene_svg

sys.path.append(str(Path(__file__).parent.parent / "read"))  # where the collections of bad models are

import test_bad_constraints
import test_bad_file

CART = "\n".join(
    ['name = "cart"', "[coordinates]", 'x = "m"', "[parameters]", 'm = "2 kg"', 'k = "8 N/m"', "[inputs]", 'F = "N"']
    + ["[[particle]]", 'mass = "m"', 'at = ["x", 0]', "[[spring]]", 'k = "k"', 'deflection = "x"']
    + ["[[force]]", 'value = "F"', 'deflection = "x"', "[simulate]", 'duration = "2 s"', "initial = { x = 0.1 }"]
)


def written(capsys: pytest.CaptureFixture[str], *words: str) -> Any:
    main([*words, "--json"])
    return json.loads(capsys.readouterr().out)


class Balanced(HTMLParser):
    """Fails if an element is not closed, or one is closed that is not open."""

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        if tag != "wbr":
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


@pytest.mark.slow
def test_numbers_of_the_views_are_in_si_units_whatever_the_file_has(kind_app: Served) -> None:
    answer = kind_app.ask("derive", {"model": CART.replace("2 kg", "200 g").replace("8 N/m", "2 N/mm")}).json()
    assert answer["units"] == {"m": "kg", "k": "N/m", "x": "m", "F": "N"}
    assert [p["value_si"] for p in answer["data"]["parameters"]] == [0.2, 2000.0]


def check_pieces(sections: list[dict[str, str]]) -> None:
    for section in sections:
        parser = Balanced()
        parser.feed(section["html"])
        assert not parser.open
        assert " style=" not in section["html"]
        assert "<style" not in section["html"]


@pytest.mark.sampled(9)
@pytest.mark.parametrize("name", ["lecture-3b", "cart-pole", "four-bar", "lecture-2"])
@pytest.mark.parametrize("notation", ["lecture", "robotics"])
def test_a_derivation_is_that_of_the_command(
    kind_app: Served, capsys: pytest.CaptureFixture[str], name: str, notation: str
) -> None:
    answer = kind_app.ask("derive", {"model": examples.text(name), "notation": notation}).json()
    assert answer["data"] == written(capsys, "derive", "--example", name, "--notation", notation)
    check_pieces(answer["sections"])
    assert {"step-2", "result", "verified"} <= {section["anchor"] for section in answer["sections"]}


ANSWERS = {
    "right": "m*x'' + k*x = F",
    "scaled": "2*m*x'' + 2*k*x = 2*F",
    "wrong": "m*x'' - k*x = F",
    "energies": "T = m*x'^2/2\nV = k*x^2\nL = T - V",
    "momentum": "L = m*x'^2/2 - k*x^2/2\ndL/dx' = m*x'\nd/dt(dL/dx') = m*x''\ndL/dx = -k*x",
    "own names": "u = x/2\nm*x'' + 2*k*u = F",
    "latex": r"m \ddot{x} + k x = F",
    "force": "Q_x = F",
    "general": "d/dt(dL/dx') - dL/dx = Xi_1\nT = m*x'^2/2",
}


@pytest.mark.sampled(15)
@pytest.mark.parametrize("hint", range(4))
@pytest.mark.parametrize("case", ANSWERS)
def test_a_verdict_is_that_of_the_command(
    kind_app: Served, capsys: pytest.CaptureFixture[str], tmp_path: Path, case: str, hint: int
) -> None:
    model, answer = tmp_path / "model.toml", tmp_path / "answer"
    model.write_text(CART)
    answer.write_text(ANSWERS[case])
    found = kind_app.ask("check", {"model": CART, "answer": ANSWERS[case], "hint": hint}).json()
    assert found["data"] == written(capsys, "check", str(model), str(answer), "--hint", str(hint))
    assert [line["html"] is None for line in found["lines"]] == [line["kind"] == "statement" for line in found["lines"]]
    assert all("<math" in line["html"] for line in found["lines"] if line["html"])
    check_pieces(found["sections"])


def test_a_preview_reads_an_answer_and_does_not_judge_it(kind_app: Served) -> None:
    found = kind_app.ask("preview", {"model": CART, "answer": "T = 7*m*x'^2\n\nm*x'' = F"}).json()
    assert [(line["line"], line["kind"]) for line in found["lines"]] == [(1, "T"), (3, "equation")]
    assert set(found) == {"lines", "notes"}
    assert found["notes"] == []
    assert "<msup><mi>T</mi><mo>*</mo></msup>" in found["lines"][0]["html"]


def test_a_preview_tells_where_it_cannot_read_on(kind_app: Served) -> None:
    error = kind_app.ask("preview", {"model": CART, "answer": "k = m\nm*x'' = m*("}).json()["error"]
    assert (error["code"], error["line"]) == ("E701", 2)


def test_a_preview_tells_what_it_leaves_out(kind_app: Served) -> None:
    found = kind_app.ask("preview", {"model": CART, "answer": "m*x'' = F\nk*x = m*("}).json()
    assert [line["line"] for line in found["lines"]] == [1]
    assert len(found["notes"]) == 1 and found["notes"][0].startswith("Line 2 ")


@pytest.mark.slow
def test_a_run_is_that_of_the_command(kind_app: Served, capsys: pytest.CaptureFixture[str], tmp_path: Path) -> None:
    model = tmp_path / "model.toml"
    model.write_text(CART)
    asked = {"model": CART, "params": {"k": 2}, "initial": {"x'": "1 m/s"}, "inputs": {"F": "sin(t)"}, "samples": 50}
    found = kind_app.ask("simulate", asked).json()
    words = ["--set", "k=2", "--init", "x'=1 m/s", "--input", "F=sin(t)", "--samples", "50"]
    assert found["data"] == written(capsys, "simulate", str(model), *words)
    assert len(found["curves"]["t"]) == 50
    assert {c["name"] for c in found["curves"]["columns"]} >= {"x", "x'", "F", "energy.kinetic", "energy.potential"}


def messages(app: Served, data: Any) -> list[Any]:
    return [json.loads(line) for line in app.ask("sweep", data).text.splitlines()]


@pytest.mark.sampled(3)
@pytest.mark.parametrize("axes", [["k=2:8:5"], ["k=2:8:4", "x=0:1:3"], ["m=1:2:41"]], ids=str)
def test_a_sweep_is_that_of_the_command_and_comes_row_by_row(
    kind_app: Served, capsys: pytest.CaptureFixture[str], tmp_path: Path, axes: list[str]
) -> None:
    model = tmp_path / "model.toml"
    model.write_text(CART)
    parts = [axis.replace("=", ":").split(":") for axis in axes]
    asked = [{"name": n, "low": float(a), "high": float(b), "count": int(c)} for n, a, b, c in parts]
    *found, last = messages(kind_app, {"model": CART, "axes": asked, "output": "max x"})
    assert last["answer"]["data"] == written(capsys, "sweep", str(model), *axes, "--output-of", "max x")
    rows = [row for message in found[1:] for row in message["part"]["rows"]]
    assert len(rows) == asked[0]["count"]
    assert max(map(max, rows)) == pytest.approx(last["answer"]["data"]["results"][0]["greatest"], rel=1e-5)
    assert [message["part"]["start"] for message in found[1:]] == sorted({m["part"]["start"] for m in found[1:]})


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("changed", "code"),
    [
        ({"axes": []}, "E406"),
        ({"axes": [{"name": "k", "low": 1, "high": 2, "count": 1}]}, "E406"),
        ({"axes": [{"name": "k", "low": 1, "high": "2", "count": 3}]}, "E406"),
        ({"axes": [{"name": "kk", "low": 1, "high": 2, "count": 3}]}, "E402"),
        ({"axes": [{"name": "k", "low": 1, "high": 2, "count": 3}] * 2}, "E404"),
        ({"axes": [{"name": n, "low": 1, "high": 2, "count": 200} for n in "km"]}, "E703"),
        ({"output": "max z"}, "E402"),
        ({"output": "store('x')"}, "E701"),
        ({"store": "/tmp/x.zarr"}, "E405"),
    ],
    ids=str,
)
def test_a_sweep_that_does_not_fit_is_one_error(kind_app: Served, changed: dict[str, Any], code: str) -> None:
    asked = {"model": CART, "axes": [{"name": "k", "low": 1, "high": 2, "count": 3}], "output": "max x", **changed}
    assert messages(kind_app, asked)[-1]["error"]["code"] == code


def test_a_large_model_is_derived_only_if_that_is_asked_for(kind_app: Served) -> None:
    names = [f"q{i}" for i in range(25)]
    lines = ['name = "many"', "[coordinates]", *(f'{q} = ""' for q in names)]
    for q in names:
        lines += ["[[particle]]", "mass = 1", f'at = ["{q}", 0]']
    error = kind_app.ask("derive", {"model": "\n".join(lines)}).json()["error"]
    assert (error["code"], error["anyway"]) == ("E601", True)
    assert len(kind_app.ask("derive", {"model": "\n".join(lines), "anyway": True}).json()["data"]["equations"]) == 25


MISFITS: dict[str, dict[str, Any]] = {
    "model a number": {"model": 3},
    "model a list": {"model": ["x"]},
    "a path": {"path": "/etc/passwd"},
    "name an object": {"name": {}},
    "anyway a number": {"anyway": 1},
    "hint too high": {"hint": 9},
    "initial a list": {"initial": [1]},
    "a value an object": {"params": {"k": {}}},
    "too many samples": {"samples": 10**9},
    "a notation that is a path": {"notation": "../x"},
}


@pytest.mark.sampled(5)
@pytest.mark.parametrize("verb", ["derive", "look", "page", "check", "preview", "simulate"])
@pytest.mark.parametrize("case", MISFITS)
def test_arguments_that_do_not_fit_are_one_error(kind_app: Served, verb: str, case: str) -> None:
    given = {"answer": "x = 0"} if verb in ("check", "preview") else {}
    answer = kind_app.ask(verb, {"model": CART, **given, **MISFITS[case]})
    assert answer.status_code == 200
    assert answer.json()["error"]["code"] in ("E405", "E406")


@pytest.mark.sampled(4)
@pytest.mark.parametrize("verb", ["derive", "look", "page", "check", "preview", "simulate"])
def test_a_request_without_a_model_is_one_error(kind_app: Served, verb: str) -> None:
    answer = kind_app.ask(verb, {})
    assert answer.json()["error"]["code"] == "E401"


@pytest.mark.sampled(4)
@pytest.mark.parametrize(
    ("changed", "code"),
    [
        ({"params": {"k": "@/etc/passwd"}}, None),
        ({"inputs": {"F": "@/etc/passwd"}}, None),
        ({"inputs": {"F": "__import__('os').getpid()"}}, None),
        ({"initial": {"x": "1 kg"}}, "E408"),
        ({"initial": {"y": 1}}, "E402"),
        ({"params": {"m": -1}}, None),
        ({"params": {"m": "nan"}}, None),
        ({"inputs": {"F": "1/x"}, "initial": {"x": 0}}, None),
        ({"duration": "1e9 s"}, None),
        ({"duration": "-1 s"}, None),
    ],
    ids=str,
)
def test_a_run_that_cannot_be_is_told(kind_app: Served, changed: dict[str, Any], code: str | None) -> None:
    """An error, or a run that says why it stopped; never a number that is none."""
    answer = kind_app.ask("simulate", {"model": CART, **changed})
    assert answer.status_code in (200, 408)
    assert "NaN" not in answer.text
    found = answer.json()
    assert found.get("error", {}).get("what") or not found["data"]["success"]
    assert code is None or found["error"]["code"] == code


def test_examples_are_those_of_the_package(kind_app: Served) -> None:
    found = kind_app.ask("models").json()
    assert [example["name"] for example in found["examples"]] == list(examples.names())
    assert all(example["text"] == examples.text(example["name"]) for example in found["examples"])
    assert found["opened"] is None


@pytest.mark.sampled(2)
@pytest.mark.parametrize("name", ["lecture-3b", "cart-pole", "four-bar", "spinning-top"])
def test_a_schematic_is_that_of_the_system(kind_app: Served, name: str) -> None:
    found = kind_app.ask("look", {"model": examples.text(name)}).json()
    system = lg.example(name)
    whole = found["svg"].replace("</desc>\n", f"</desc>\n<style>{found['style']}</style>", 1)
    picture = system.look()
    assert "".join(whole.split()) == "".join(scene_svg(picture.scene, embedded=True).split())
    assert found["elements"].keys() == {element.name for element in system.model.elements}
    assert (found["description"], found["missing"]) == (picture.description, list(picture.missing))


@pytest.mark.slow
def test_a_page_that_moves_has_an_address_that_nobody_guesses_and_a_policy_of_its_own(kind_app: Served) -> None:
    addresses = [kind_app.ask("page", {"model": CART}).json()["address"] for _ in range(PAGES + 1)]
    assert len(set(addresses)) == PAGES + 1
    assert all(len(address) == len("/page/") + 32 for address in addresses)
    first, *kept = (httpx.get(kind_app.address + address) for address in addresses)
    assert first.status_code == 404  # the oldest one has made room
    for page in kept:
        policy = page.headers["content-security-policy"]
        assert policy.startswith("sandbox allow-scripts allow-downloads; default-src 'none'")
        assert "allow-same-origin" not in policy
        assert "connect-src" not in policy
        assert "frame-ancestors 'self'" in policy
        assert page.text == lg.loads(CART).look().to_html()
    assert httpx.get(f"{kind_app.address}/page/{'a' * 32}").status_code == 404


def test_a_motion_that_no_browser_can_integrate_is_refused(kind_app: Served) -> None:
    friction = '[[friction]]\nname = "f"\nmu = 0.3\nnormal = "m*9.81"\ndeflection = "x"\n'
    unknown = CART.replace('k = "8 N/m"', 'k = { unit = "N/m" }')
    for model, what in ((CART + "\n" + friction, "no page integrates that"), (unknown, "Missing: k")):
        error = kind_app.ask("page", {"model": model}).json()["error"]
        assert error["what"].endswith(what) and error["fix"], error


# -- the bad models of the reader's tests: each is one error with its line, and never a failure of the app -----------

FILES = {name: (text, line, column) for name, text, line, column, _ in test_bad_file.BAD}
CONSTRAINTS = {f"constraint: {name}": case for name, case in test_bad_constraints.BAD.items()}


@pytest.mark.sampled(12)
@pytest.mark.parametrize("case", FILES)
def test_a_bad_file_is_told_at_its_line(kind_app: Served, case: str) -> None:
    text, line, column = FILES[case]
    answer = kind_app.ask("derive", {"model": text})
    assert answer.status_code == 200
    error = answer.json()["error"]
    assert error["what"] and error["fix"] and error["code"]
    assert error["line"] is not None
    assert line is None or error["line"] == line
    assert column is None or error["column"] == column


@pytest.mark.sampled(24)
@pytest.mark.parametrize("case", CONSTRAINTS)
def test_a_bad_constraint_is_told(kind_app: Served, case: str) -> None:
    text, code, fragment = CONSTRAINTS[case]
    asked = {"model": test_bad_constraints.HEAD + text}
    start = {"duration": 0.5, "initial": {"x": 0.3, "y": 0.2}}
    answers = [kind_app.ask("derive", asked), kind_app.ask("simulate", {**asked, **start})]
    assert [answer.status_code for answer in answers] == [200, 200]
    errors = [answer.json()["error"] for answer in answers if "error" in answer.json()]
    assert errors[0]["code"] == code
    assert fragment in errors[0]["message"]


def test_there_are_a_hundred_bad_models() -> None:
    assert len(FILES) + len(CONSTRAINTS) >= 100

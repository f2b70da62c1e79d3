"""Every format of whole derivations: the lecture's examples by exact strings, and what a reader of the format asks."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from html.parser import HTMLParser
from pathlib import Path

import pytest
from sympy import cos, sin

import lagrangian as lg
from lagrangian.derive import Derived, derive
from lagrangian.derive.data import to_dict
from lagrangian.derive.pages import FORMATS, lay_out, to_html, to_html_fragment, to_latex, to_markdown, to_text
from lagrangian.errors import ModelError
from lagrangian.model import Builder, Damper, Force, Gravity, Particle, Spring, Torque
from lagrangian.page import formula as data
from lagrangian.page.formula import Check, text
from lagrangian.write import NOTATIONS, html_page
from lagrangian.write.numerals import figures, unit
from lagrangian.write.unicode_math import columns


def example_1() -> Builder:
    b = Builder("mass on a lever")
    theta = b.coordinate("theta").symbol
    m, L_m, k, L_k, c, L_b = (b.parameter(n).symbol for n in ["m", "L_m", "k", "L_k", "b", "L_b"])
    tau = b.input("tau").symbol
    b.add(Particle(mass=m, at=b.point(None, (L_m * sin(theta), -L_m * cos(theta)))))
    b.add(Gravity(direction=(0, -1), g=b.standard_gravity(9.81)))
    b.add(Spring(k=k, deflection=L_k * theta))
    b.add(Damper(b=c, deflection=L_b * theta))
    b.add(Torque(value=tau, on=theta))
    return b


def example_2() -> Builder:
    b = Builder("two-link arm")
    th1, th2 = b.coordinate("theta1").symbol, b.coordinate("theta2").symbol
    L_a, L_b, L_c, m1, m2, m3 = (b.parameter(n).symbol for n in ["L_a", "L_b", "L_c", "m1", "m2", "m3"])
    tau = b.input("tau").symbol
    p1 = b.point(None, (L_a * cos(th1), L_a * sin(th1)))
    p2 = b.point(None, (L_b * cos(th1), L_b * sin(th1)), parent=p1)
    p3 = b.point(None, (L_c * cos(th1 + th2), L_c * sin(th1 + th2)), parent=p2)
    for mass, at in ((m1, p1), (m2, p2), (m3, p3)):
        b.add(Particle(mass=mass, at=at))
    b.add(Gravity(direction=(0, -1), g=b.standard_gravity(9.81)))
    b.add(Torque(value=tau, on=th1 + th2, reaction=th1))
    return b


def example_3(relative: bool) -> Builder:
    b = Builder("two carts and a spring")
    x1, x2 = b.coordinate("x1").symbol, b.coordinate("x2r" if relative else "x2").symbol
    m1, m2, k = (b.parameter(n).symbol for n in ["m1", "m2", "k"])
    F = b.input("F").symbol
    apart = x2 if relative else x2 - x1
    b.add(Particle(mass=m1, at=b.point("A", (x1, 0))))
    b.add(Particle(mass=m2, at=b.point("B", (x1 + x2 if relative else x2, 0))))
    b.add(Spring(k=k, deflection=apart))
    b.add(Force(value=F, deflection=apart))
    return b


HOSTILE = "<script>alert(1)</script> $x_% \\input{/etc/passwd} | `a` & 中"


def hostile() -> Builder:
    """Names that mean something in one of the formats; symbols that clash with the letters of every notation."""
    b = Builder(HOSTILE)
    theta = b.coordinate("theta", description="angle of <b>arm</b> | from V $y$ \\% L").symbol
    slide = b.coordinate("lambda_").symbol
    names = "m L V T Q M q2 pos_of_end θ Ξ_1 ж1 tau1"
    m, L, V, T, Q, M, q2, pos, other, xi, zhe, tau1 = (b.parameter(n).symbol for n in names.split())
    tau = b.input("tau").symbol
    at = b.point(None, (L * sin(theta) + slide, -L * cos(theta)))
    b.add(Particle(mass=(m + M) * pos / zhe, at=at, name="<img src=x onerror=alert(1)>"))
    b.add(Gravity(direction=(0, -1), g=b.standard_gravity(9.81), name="$x_% | \\end{document}"))
    b.add(Spring(k=V + T + Q + q2 + other + xi + tau1, deflection=theta, name="ẋ→中"))
    b.add(Torque(value=tau, on=theta, name='a\' V "b"'))
    return b


MODELS = {
    "example 1": example_1,
    "example 2": example_2,
    "example 3A": lambda: example_3(False),
    "example 3B": lambda: example_3(True),
    "hostile": hostile,
}


@pytest.fixture(scope="module")
def derivations() -> dict[str, Derived]:
    return {name: derive(make().model()) for name, make in MODELS.items()}


# -- text -----------------------------------------------------------------------------------------------------------


def boxed(rendered: str) -> list[str]:
    return [line.strip("│ ") for line in rendered.splitlines() if line.startswith("│")]


def test_equations_of_the_lecture_in_their_box(derivations):
    assert boxed(to_text(derivations["example 1"])) == ["m L_m² θ̈ + b L_b² θ̇ + k L_k² θ + m g L_m sin θ = τ"]
    assert boxed(to_text(derivations["example 3A"])) == [
        "m₁ ẍ₁ + k (x₁ − x₂) = −F  (1)",
        "m₂ ẍ₂ − k (x₁ − x₂) = F   (2)",
    ]
    assert boxed(to_text(derivations["example 3B"])) == [
        "(m₁ + m₂) ẍ₁ + m₂ ẍ_2r = 0    (1)",
        "m₂ ẍ₁ + m₂ ẍ_2r + k x_2r = F  (2)",
    ]


def test_energies_of_the_lecture(derivations):
    lines = [line.strip() for line in to_text(derivations["example 1"]).splitlines()]
    assert "ℒ = T* − V = ½ m L_m² θ̇² + m g L_m cos θ − ½ k L_k² θ²" in lines
    assert "∂ℒ/∂θ̇ = m L_m² θ̇" in lines
    assert "d/dt (∂ℒ/∂θ̇) = m L_m² θ̈" in lines
    assert "d/dt (∂ℒ/∂θ̇) − ∂ℒ/∂θ = m L_m² θ̈ + k L_k² θ + m g L_m sin θ" in lines
    assert "Ξ₁ = τ − b L_b² θ̇" in lines
    lines = [line.strip() for line in to_text(derivations["example 3B"]).splitlines()]
    assert "T* = T₁* + T₂* = ½ m₁ ẋ₁² + ½ m₂ (ẋ₁ + ẋ_2r)²" in lines
    lines = [line.strip() for line in to_text(derivations["example 2"]).splitlines()]
    assert "x₃ = x₂ + L_c cos(θ₁ + θ₂)" in lines
    assert "ẋ₃ = ẋ₂ − L_c (θ̇₁ + θ̇₂) sin(θ₁ + θ₂)" in lines


def test_letters_of_every_notation(derivations):
    d = derivations["example 3A"]
    assert "ξ₁ = x₁" in to_text(d)
    assert "M q̈ + C q̇ + G = Ξ" in to_text(d)
    physics = to_text(d, notation="physics")
    assert "q₁ = x₁" in physics and "ℒ = T − V" in physics and "M q̈ + C q̇ + G = Q" in physics
    robotics = to_text(d, notation="robotics")
    assert "ℒ = K − P" in robotics and "M(q) q̈ + C(q, q̇) q̇ + g(q) = τ" in robotics
    for rendered in (physics, robotics):
        assert "Ξ" not in rendered and "ξ" not in rendered and "T*" not in rendered


def test_letters_that_mean_something_already_give_way(derivations):
    rendered = to_text(derivations["hostile"], notation="physics")
    assert "ℒ = K − U" in rendered
    assert "torque 'a' V \"b\"'" in rendered, "what somebody named stays as it is"


def test_unknown_notation_and_narrow_width_are_refused(derivations):
    for writer in FORMATS.values():
        with pytest.raises(ModelError, match="unknown notation 'robotic'") as caught:
            writer(derivations["example 1"], notation="robotic")
        assert "robotics" in str(caught.value)
    with pytest.raises(ModelError, match="too narrow"):
        to_text(derivations["example 1"], width=10)


@pytest.mark.sampled(8)
@pytest.mark.parametrize("width", [40, 50, 80, 200])
@pytest.mark.parametrize("notation", NOTATIONS)
def test_no_line_is_wider_than_the_terminal(derivations, width, notation):
    for name, d in derivations.items():
        for line in to_text(d, notation=notation, width=width).splitlines():
            assert columns(line) <= width, (name, line)
            assert line == line.rstrip()


def test_the_checklist_is_one_page(derivations):
    for name in ("example 1", "example 3A", "example 3B"):
        rendered = to_text(derivations[name], brief=True)
        assert len(rendered.splitlines()) <= 60
        for number in range(7):
            assert re.search(rf"^{number}  \w", rendered, re.MULTILINE)
        assert boxed(rendered) == boxed(to_text(derivations[name]))


def test_what_is_too_long_is_summarised_and_written_on_request(derivations):
    d = derivations["example 1"]
    long = data.formula(data.Name("T*"), data.Elided(d.T, 4321))
    step = type(d.steps[2])(2, "Kinetic co-energy", text("a"), text("b"), (long,))
    changed = type(d)(**{**vars(d), "steps": (*d.steps[:2], step, *d.steps[3:])})
    assert "T* = ⟨4321 operations⟩" in to_text(changed)
    assert "T* = ½ m L_m² θ̇²" in to_text(changed, full=True)
    assert "4321" not in to_text(changed, full=True)
    assert to_dict(changed)["steps"][2]["items"][0]["operations"] == 4321
    page = to_html(
        type(d)(
            **{
                **vars(d),
                "steps": (
                    type(step)(2, "T", text("a"), text("b"), (data.formula(data.Name("T*"), data.Elided(d.T, 700)),)),
                ),
            }
        )
    )
    assert "<details><summary>written out: 700 operations</summary>" in page


def test_a_check_that_fails_is_shown_as_failing(derivations):
    d = derivations["example 1"]
    changed = type(d)(**{**vars(d), "verified": (Check(text("energy"), False, "3e-1"), Check(text("M"), True))})
    assert "✗ energy (0.3)" in to_text(changed)
    assert "✗ energy (0.3)" in to_text(changed, brief=True)
    assert 'class="fails"' in to_html(changed)
    assert to_dict(changed)["verified"][0] == {"what": "energy", "holds": False, "figure": "3e-1"}


# -- Markdown -------------------------------------------------------------------------------------------------------


@pytest.mark.sampled(4)
@pytest.mark.parametrize("notation", NOTATIONS)
def test_markdown_tables_are_well_formed(derivations, notation):
    for d in derivations.values():
        rendered = to_markdown(d, notation=notation)
        tables = [block for block in rendered.split("\n\n") if block.startswith("|")]
        assert tables
        for table in tables:
            counts = {len(re.findall(r"(?<!\\)\|", line)) for line in table.splitlines()}
            assert len(counts) == 1, table


def test_markdown_mathematics_is_closed_and_user_text_is_escaped(derivations):
    rendered = to_markdown(derivations["hostile"])
    assert rendered.count("$$") % 2 == 0
    outside = re.sub(r"\$\$.*?\$\$", "", rendered, flags=re.DOTALL)
    for line in outside.splitlines():
        assert len(re.findall(r"(?<!\\)\$", line)) % 2 == 0, line
    assert "<" not in rendered.replace("&lt;", "").replace("< 0", "")
    assert "\\lbrace" in rendered or "\\\\input\\{" in rendered
    assert "```" not in rendered


# -- LaTeX ----------------------------------------------------------------------------------------------------------


@pytest.mark.skipif(shutil.which("pdflatex") is None, reason="pdflatex is not installed")
@pytest.mark.parametrize("name", MODELS)
def test_latex_compiles(derivations, name, tmp_path):
    (tmp_path / "a.tex").write_text(to_latex(derivations[name], notation="robotics"), encoding="utf-8")
    command = ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "-no-shell-escape", "a.tex"]
    run = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, errors="replace", check=False)
    assert run.returncode == 0, run.stdout[-2000:]
    too_wide = [float(x) for x in re.findall(r"Overfull \\hbox \(([\d.]+)pt", run.stdout)]
    assert name == "hostile" or max(too_wide, default=0) < 6


def test_latex_never_obeys_a_name(derivations):
    rendered = to_latex(derivations["hostile"])
    assert "\\input{" not in rendered
    assert rendered.count("\\end{document}") == 1


# -- HTML -----------------------------------------------------------------------------------------------------------

VOID = {"meta"}


class Page(HTMLParser):
    """Holds a page to its structure: every element closed in order, nothing that loads or runs anything."""

    def __init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self.open: list[str] = []
        self.ids: list[str] = []
        self.links: list[str] = []
        self.seen: dict[str, int] = {}
        self.words = ""

    def handle_starttag(self, tag, attrs):
        self.seen[tag] = self.seen.get(tag, 0) + 1
        for key, value in attrs:
            assert not key.startswith("on") and key not in ("src", "srcset", "style", "action"), (tag, key)
            if key == "id":
                self.ids.append(value)
            if key == "href":
                self.links.append(value)
        if tag not in VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words += data


@pytest.mark.sampled(4)
@pytest.mark.parametrize("brief", [False, True])
@pytest.mark.parametrize("name", MODELS)
def test_html_is_well_formed_and_self_contained(derivations, name, brief):
    rendered = to_html(derivations[name], brief=brief)
    page = Page()
    page.feed(rendered)
    page.close()
    assert page.open == []
    assert not {"script", "img", "link", "iframe", "object", "b"} & set(page.seen)
    assert not re.search(r"https?://|@import|url\(", rendered)
    assert len(page.ids) == len(set(page.ids))
    assert all(link.startswith("#") and link[1:] in page.ids for link in page.links)
    assert '<html lang="en">' in rendered
    assert page.seen["h1"] == 1
    if not brief:
        assert {f"step-{i}" for i in range(7)} <= set(page.ids)
        assert page.seen["th"] > 0 and 'scope="col"' in rendered
    if name == "hostile":
        assert HOSTILE.split(" |")[0] in page.words


def test_html_tells_where_each_term_came_from(derivations):
    rendered = to_html(derivations["example 1"])
    terms = re.findall(r'<span class="term (\w+)" tabindex="0" role="group" aria-label="from ([^"]*)"', rendered)
    assert terms == [
        ("inertia", "particle m"),
        ("damping", "damper b"),
        ("stiffness", "spring k"),
        ("gravity", "gravity g"),
        ("input", "torque τ"),
    ]


def test_html_for_a_notebook_is_a_fragment(derivations):
    rendered = to_html_fragment(derivations["hostile"])
    page = Page()
    page.feed(rendered)
    assert page.open == []
    assert rendered.startswith('<div class="lagrangian" lang="en">')
    assert not {"html", "head", "body", "script", "img"} & set(page.seen)
    assert page.ids == []


# -- JSON -----------------------------------------------------------------------------------------------------------


def test_json_says_the_equations(derivations):
    d = derivations["example 3B"]
    read = json.loads(FORMATS["json"](d))
    assert read == to_dict(d)
    assert read["schema"] == 1
    assert read["Xi"]["x2r"]["plain"] == "F"
    assert [e["coordinate"] for e in read["equations"]] == ["x1", "x2r"]
    assert read["equations"][0]["left"]["latex"] == r"(m_{1} + m_{2}) \ddot{x}_{1} + m_{2} \ddot{x}_{2r}"
    assert read["equations"][1]["terms"][-1] == {
        "plain": "F",
        "latex": "F",
        "kind": "input",
        "elements": ["force 'F'"],
    }
    assert read["mass_matrix"] == [["m1 + m2", "m2"], ["m2", "m2"]]
    assert [s["number"] for s in read["steps"]] == list(range(7))


def test_json_of_everything_is_plain_data(derivations):
    for d in derivations.values():
        for brief in (False, True):
            data_ = to_dict(d, brief=brief)
            assert json.loads(json.dumps(data_)) == data_


# -- the layout -----------------------------------------------------------------------------------------------------


def test_every_item_is_laid_out(derivations):
    d = derivations["example 1"]
    document = lay_out(d)
    shown = sum(len(s.blocks) for s in document.sections if s.number is not None)
    items = sum(len(s.items) + 3 + bool(s.checked) for s in d.steps)  # what, why, and where to read why
    assert shown == items


def test_the_style_sheet_is_whole():
    sheet = (Path(html_page.__file__).parent / "page.css").read_text(encoding="utf-8")
    assert sheet.count("{") == sheet.count("}")
    used = set(re.findall(r'class="([\w ]+)"', Path(html_page.__file__).read_text(encoding="utf-8")))
    names = {name for group in used for name in group.split()} - {"whole", "lagrangian"}
    known = set(re.findall(r"\.([a-z]+)", sheet))
    assert names <= known | {"sign"}, names - known
    assert ".number, .tag {" in sheet


def test_units_and_small_values_stand_as_people_write_them() -> None:
    system = lg.loads(
        'name = "rotor"\n[coordinates]\nx = "m, place"\n[parameters]\nJ = "2e-5 kg m^2"\ng = "9.81 m/s^2"\nm = "1 kg"\n'
        '[[particle]]\nmass = "m"\nat = ["x", "0"]\n[[gravity]]\ndirection = [0, -1]\n'
    )
    shown = system.derive().to_text()
    assert "2·10⁻⁵ kg·m²" in shown and "9.81 m/s²" in shown


def test_units_have_dots_between_factors_whatever_they_were_typed_with() -> None:
    assert [unit(u) for u in ("N*m", "N m s", "kg*m^2", "m/s^2", "1/s", "N*s/m", None)] == [
        "N·m",
        "N·m·s",
        "kg·m²",
        "m/s²",
        "1/s",
        "N·s/m",
        "",
    ]


def test_figures_are_numbers_as_people_write_them() -> None:
    assert figures("largest difference 0.0e+00") == "largest difference 0"
    assert figures("5.5e-16 at 10 random states") == "5.5·10⁻¹⁶ at 10 random states"
    assert figures("smallest eigenvalue 1.59e-01") == "smallest eigenvalue 0.159"
    assert figures("2 of 2") == "2 of 2" and figures("1e-12") == "10⁻¹²"
    assert figures("the run1e5 of 0x1e5") == "the run1e5 of 0x1e5"


def test_a_name_in_words_is_the_symbol_of_the_formulas(derivations) -> None:
    """What is named after a symbol reads as the symbol, in titles, tables, reasons and checks; other names stay."""
    for name in ("example 1", "example 2", "example 3A"):
        shown = to_text(derivations[name], width=200)
        assert not re.search(r"'(m|k|b|tau|g|F)\d?'", shown)
    shown = to_text(derivations["example 2"], width=200)
    for words in ("\nParticle m₁\n", "torque τ  ", "particle m₁, particle m₂, particle m₃", "particle m₂   T*"):
        assert words in shown
    system = lg.System("named")
    x = system.coordinate("x")
    system.particle(system.parameter("m"), at=system.origin + (x, 0), name="trolley")
    assert "Particle 'trolley'" in system.derive().to_text()


def test_why_is_a_reason(derivations) -> None:
    """The reason of a step says the same for every system: no number of coordinates is a reason."""
    for number in range(7):
        whys = {str(derivations[name].steps[number].why) for name in ("example 1", "example 2")}
        assert len(whys) == 1
        assert not re.search(r"\d", whys.pop().replace("T*", ""))


def bar() -> lg.System:
    """A rigid bar on two springs at the distances a and b from its centre of mass."""
    s = lg.System("bar")
    x, phi = s.coordinates("x phi")
    m, J, k1, k2, a, b = s.parameters("m J k1 k2 a b")
    s.rigid_body(m, J, at=s.origin + (0, x), frame=phi)
    s.spring(k1, deflection=x - a * phi)
    s.spring(k2, deflection=x + b * phi)
    return s


def test_factors_keep_one_order_whatever_their_letters_mean_elsewhere() -> None:
    shown = bar().derive().to_text(width=120)
    assert "k₂ b" in shown and "b k₂" not in shown and "b² k₂" not in shown
    damped = bar()
    damped.damper(damped.parameter("c"), deflection=damped["x"])
    assert "c ẋ" in damped.derive().to_text()


def test_the_same_factors_stand_in_the_same_order_and_squares_face_one_way() -> None:
    s = lg.System("net")
    x, y = s.coordinates("x y")
    m, k1, k2, D, L0 = s.parameters("m k1 k2 D L_0")
    at = s.origin + (x, y)
    s.particle(m, at=at)
    s.spring(k1, between=(s.origin, at), rest=L0)
    s.spring(k2, between=(s.origin + (D, 0), at), rest=L0)
    shown = s.derive().to_text(width=120)
    assert "m ẍ + k₁ x (1 − L₀/√(x² + y²)) + k₂ (x − D) (1 − L₀/√((x − D)² + y²)) = 0" in shown
    assert "(L₀ − √" not in shown and "½ k₂ (√((x − D)² + y²) − L₀)²" in shown


def matrix_form(shown: str) -> str:
    return shown.split("Matrix form")[1].split("Energy ledger")[0]


@pytest.mark.slow
def test_the_lower_half_of_the_mass_matrix_is_not_printed_again(derivations) -> None:
    d = derivations["example 2"]
    for width, once in (
        (120, "m₃ L_c (L_c + (L_a + L_b) cos θ₂)"),
        (80, "M₁₂ = M₂₁ = m₃ L_c (L_c + (L_a + L_b) cos θ₂)"),
    ):
        shown = matrix_form(to_text(d, width=width))
        assert shown.count("(L_c + (L_a + L_b) cos θ₂)") == 1 and once in shown
    assert "sym." in matrix_form(to_text(d, width=120)) and "    M₂₁" not in to_text(d)
    for rendered in (to_latex(d), to_markdown(d)):
        assert r"\mathbf{M}_{12} &= \mathbf{M}_{21} = m_{3} L_{c}" in rendered
    diagonal = matrix_form(to_text(derivations["example 3A"]))
    assert "sym." not in diagonal and "⎡ m₁   0  ⎤" in diagonal and "C = 0\n" in diagonal
    assert to_dict(d)["mass_matrix"][1][0] == to_dict(d)["mass_matrix"][0][1], "data hold every entry"


def test_a_table_that_does_not_fit_is_written_row_by_row(derivations) -> None:
    narrow = to_text(derivations["example 2"], width=40)
    assert "torque τ\n  the box: what turns with θ₁ + θ₂ is\n" in narrow
    assert re.search(r"^element    the box +virtual work   adds$", to_text(derivations["example 2"]), re.MULTILINE)


def test_steps_fold_away_in_html_and_are_open_at_first(derivations) -> None:
    rendered = to_html(derivations["example 2"])
    steps = re.findall(
        r'<section id="step-(\d)">\n<details class="step" open><summary><h2>(.*?)</h2></summary>', rendered
    )
    assert [number for number, _ in steps] == [str(i) for i in range(7)]
    assert "<details" not in re.sub(
        r"<style>.*?</style>", "", to_html(derivations["example 2"], brief=True), flags=re.S
    )
    assert "details.step::details-content" in rendered, "folded steps are printed too"


def test_a_formula_in_html_can_end_its_line_before_every_term(derivations) -> None:
    """Every term is an element of its own, so that a narrow screen wraps between them."""
    rendered = to_html(derivations["example 2"])
    terms = re.search(r"Equation 1:.*?(<div class=\"terms\">.*?</div>)", rendered, re.DOTALL)
    assert terms is not None and terms.group(1).count("<math") >= 4


def test_heads_of_a_latex_table_stand_over_their_columns_at_once(derivations) -> None:
    """Without a second run: `longtable` finds the widths of natural columns only by then."""
    rendered = to_latex(derivations["example 2"])
    assert r"\begin{tabular}{ll" in rendered
    assert not re.search(r"begin\{longtable\}\[l\]\{l", rendered)


@pytest.mark.slow
def test_long_roots_and_fractions_fit_a_narrow_page() -> None:
    """A damper and a spring between two free points: every fraction holds a root of squares of differences."""
    s = lg.System("net")
    x1, y1, x2, y2 = s.coordinates("x1 y1 x2 y2")
    m1, m2, k, b, L0 = s.parameters("m1 m2 k b L_0")
    one, two = s.origin + (x1, y1), s.origin + (x2, y2)
    s.particle(m1, at=one)
    s.particle(m2, at=two)
    s.spring(k, between=(one, two), rest=L0)
    s.damper(b, between=(one, two))
    derivation = derive(s.model)
    for width in range(40, 61, 3):
        assert max(map(columns, to_text(derivation, width=width).splitlines())) <= width


def test_a_parameter_that_measures_gravity_is_described_as_its_acceleration() -> None:
    s = lg.System("falling")
    z = s.coordinates("z")
    m, g0 = s.parameters("m g0")
    s.particle(m, at=s.origin + (0, z))
    s.gravity(g=g0)
    lines = [line.split(maxsplit=1) for line in s.derive().to_text().splitlines()[:12]]
    assert ["g₀", "gravitational acceleration"] in lines and ["m", "parameter"] in lines

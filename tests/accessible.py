"""What scripts in a browser ask a page about its accessibility; used for the live page and for the app."""

from importlib.resources import files
from typing import Any

AXE = files("axe_core_python").joinpath("axe.min.js").read_text(encoding="utf-8")
"""The script of axe-core."""

RULES = """async (only) => (await axe.run(document, { resultTypes: ["violations"], ...only })).violations
  .map(({ id, nodes }) => [id, nodes.filter((n) => !(id === "empty-table-header" && n.html.includes("<math")))])
  .filter(([, nodes]) => nodes.length)
  .map(([id, nodes]) => `${id}: ${nodes.slice(0, 3).map((n) => n.html.slice(0, 120)).join(" | ")}`)"""
"""The rules of axe-core that a page breaks. It does not read MathML, which readers of the screen do: a header that is a
formula is not empty."""

COLOURS = {"runOnly": ["color-contrast"]}
"""The one rule of axe-core that says something else in the dark."""


def broken_rules(page: Any) -> list[str]:
    """The rules of axe-core that a page in the light breaks, then those in the dark."""
    page.emulate_media(color_scheme="light")
    page.evaluate(AXE)
    found = page.evaluate(RULES, {})
    page.emulate_media(color_scheme="dark")
    return [*found, *page.evaluate(RULES, COLOURS)]


CONTRAST = """() => {
  const linear = (x) => x <= .04045 ? x / 12.92 : ((x + .055) / 1.055) ** 2.4;
  const light = (c) => {
    const s = c.slice(0, 3).map((x) => linear(x / 255));
    return .2126 * s[0] + .7152 * s[1] + .0722 * s[2];
  };
  const rgb = (s) => s.match(/[\\d.]+/g).map(Number);
  const bad = [];
  for (const e of document.querySelectorAll("main *, header *, body > *")) {
    if (!e.checkVisibility() || e.closest(".old, .field, svg, option, :disabled")
        || ![...e.childNodes].some((n) => n.nodeType === 3 && n.data.trim())) continue;
    let back = e; while (back && (rgb(getComputedStyle(back).backgroundColor)[3] ?? 1) === 0) back = back.parentElement;
    const a = light(rgb(getComputedStyle(e).color)), b = light(rgb(getComputedStyle(back).backgroundColor));
    const ratio = (Math.max(a, b) + .05) / (Math.min(a, b) + .05);
    if (ratio < 4.5) bad.push(`${ratio.toFixed(2)} ${e.localName}.${e.className} ${e.textContent.slice(0, 30)}`);
  }
  return bad;
}"""
"""Texts with a contrast below 4.5 to 1, which WCAG 2.2 asks for (success criterion 1.4.3)."""

NAMELESS = """() => {
  const named = (e) => e.getAttribute("aria-label") || e.labels?.length || e.textContent.trim();
  return [...document.querySelectorAll("button, input, select, textarea, a, progress, [role=img]")]
    .filter((e) => e.checkVisibility() && !named(e)).map((e) => e.outerHTML);
}"""
"""Controls without a name."""

STOP = """() => {
  const e = document.activeElement, words = e.getAttribute("aria-label") || e.labels?.length || e.textContent.trim();
  return e === document.body ? "" : words || e.title ? "named" : e.outerHTML.slice(0, 120);
}"""
"""Whether what has the focus has a name: "named", "" if nothing has the focus, or what has none."""


def nameless_stops(page: Any, most: int = 60) -> list[str]:
    """What the Tab key reaches, one after another, and has no name."""
    found: list[str] = []
    for _ in range(most):
        page.keyboard.press("Tab")
        found.append(page.evaluate(STOP))
        if not found[-1]:
            break
    assert len(found) > 10
    return [said for said in found if said not in ("named", "")]


LOST = """() => {
  const slides = (e) => /auto|scroll/.test(getComputedStyle(e).overflowX);
  const scrolls = (e) => e && e !== document.documentElement && (slides(e) || scrolls(e.parentElement));
  const named = (e) => `${e.localName}#${e.id}.${e.className}`, whole = document.documentElement.scrollWidth, bad = [];
  if (whole > innerWidth) bad.push(`the page is ${whole} px wide`);
  for (const e of document.querySelectorAll("body *")) {
    if (!e.checkVisibility() || e.closest("svg, math, .unseen, pre.shown") || scrolls(e)) continue;
    const box = e.getBoundingClientRect(), hides = getComputedStyle(e).overflowX === "hidden";
    if (box.width && box.height && box.right > innerWidth + 1) bad.push(`outside: ${named(e)}`);
    if (hides && box.width > 2 && e.scrollWidth > e.clientWidth + 1) bad.push(`cut: ${named(e)}`);
  }
  return bad;
}"""
"""What lies outside the window or is cut, where nothing scrolls. What only readers of the screen are told is left out,
and so is the coloured text of an editor, which lies under its field and slides with it."""

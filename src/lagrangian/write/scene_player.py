"""Writes a motion as an HTML page of its own, with buttons, or as a frame of a notebook.

The animation runs without script; the script only holds it, and moves it to another time. The page asks for nothing.
"""

from __future__ import annotations

from lagrangian.page.motion import SceneMotion
from lagrangian.page.palette import DARK, LIGHT
from lagrangian.write.html_page import escape
from lagrangian.write.scene_motion import scene_motion
from lagrangian.write.scene_svg import number
from lagrangian.write.tracks import TOLERANCE

POLICY = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'"

_STYLE = f"""
:root {{
  color-scheme: light dark;
  --page: {LIGHT.paper}; --text: {LIGHT.line("body")}; --mark: {LIGHT.line("coordinate")};
}}
@media (prefers-color-scheme: dark) {{
  :root {{ --page: {DARK.paper}; --text: {DARK.line("body")}; --mark: {DARK.line("coordinate")}; }}
}}
body {{ margin: 0; background: var(--page); color: var(--text); font: 1rem/1.4 system-ui, "Segoe UI", sans-serif; }}
main {{ max-width: 60rem; margin: 0 auto; padding: .8rem; }}
h1 {{ font-size: 1.2rem; margin: 0 0 .5rem; overflow-wrap: anywhere; }}
.framed h1 {{ display: none; }}
.controls {{ display: flex; gap: .7rem; align-items: center; margin-top: .4rem; }}
.controls[hidden] {{ display: none; }}
.controls input {{ flex: 1; min-width: 4rem; accent-color: var(--mark); }}
.controls output {{ min-width: 6.5rem; font-variant-numeric: tabular-nums; }}
button {{
  font: inherit; color: inherit; background: none; padding: .2rem .8rem;
  border: 1px solid currentColor; border-radius: .4rem;
}}
:focus-visible {{ outline: 2px solid var(--mark); outline-offset: 2px; }}
@media print {{ .controls {{ display: none; }} }}
"""

_SCRIPT = """
(function () {
  var svg = document.querySelector("svg.lagrangian-scene"), box = document.querySelector(".controls");
  var button = box.querySelector("button"), slider = box.querySelector("input"), clock = box.querySelector("output");
  var length = Number(box.dataset.duration), first = Number(box.dataset.first), last = Number(box.dataset.last);
  var held = matchMedia("(prefers-reduced-motion: reduce)").matches;
  function shown() { return svg.getCurrentTime() % length; }
  function write() {
    var time = first + (last - first) * shown() / length;
    clock.textContent = "t = " + time.toFixed(2) + " s";
    slider.value = String(Math.round(1000 * shown() / length));
    slider.setAttribute("aria-valuetext", clock.textContent);
  }
  function hold(wanted) {
    held = wanted;
    if (held) { svg.pauseAnimations(); } else { svg.classList.add("playing"); svg.unpauseAnimations(); }
    button.textContent = held ? "Play" : "Pause";
    write();
  }
  button.addEventListener("click", function () { hold(!held); });
  slider.addEventListener("input", function () {
    svg.classList.add("playing");
    hold(true);
    svg.setCurrentTime(length * Math.min(Number(slider.value), 999.9) / 1000);
    write();
  });
  box.hidden = false;
  hold(held);
  (function tick() { if (!held) { write(); } requestAnimationFrame(tick); })();
})();
"""


def player_page(
    motion: SceneMotion, *, width: float | None = None, tolerance: float = TOLERANCE, framed: bool = False
) -> str:
    """Return an HTML page with the motion, a button that holds it, and a slider of time; ``framed`` without a title."""
    svg = scene_motion(motion, embedded=True, width=width, tolerance=tolerance)
    title = escape(motion.scene.name)
    controls = (
        f'<div class="controls" hidden data-duration="{number(motion.duration, 3)}" data-first="{motion.times[0]:.9g}" '
        f'data-last="{motion.times[-1]:.9g}"><button type="button">Pause</button>'
        '<input type="range" min="0" max="1000" value="0" aria-label="time"><output></output></div>'
        f"<script>{_SCRIPT}</script>"
    )
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta http-equiv="Content-Security-Policy" content="{POLICY}">'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f"<title>{title}</title><style>{_STYLE}</style></head>\n"
        f"<body{' class=framed' if framed else ''}><main><h1>{title}</h1>\n{svg}"
        f"{controls if motion.count > 1 else ''}</main></body></html>\n"
    )


def player_frame(motion: SceneMotion, *, width: float | None = None, tolerance: float = TOLERANCE) -> str:
    """Return the page in a frame for a notebook, which can reach nothing outside of it."""
    page = player_page(motion, width=width, tolerance=tolerance, framed=True)
    _, _, w, h = motion.frame
    shown = motion.usual_width if width is None else width
    high = shown * h / w + 70
    style = f"width:100%;max-width:{number(max(shown, 300) + 30)}px;height:{number(high)}px;border:0"
    words = escape(f"{motion.scene.name} in motion")
    quoted = page.replace("&", "&amp;").replace('"', "&quot;")
    return f'<iframe sandbox="allow-scripts" title="{words}" style="{style}" srcdoc="{quoted}"></iframe>'

r"""Habits of those who typeset: \text p for an index, names by macros, space before the brace of rows, \mathcal P.

Oracle: small systems with equations by hand. Every form has a wrong twin.
"""

from __future__ import annotations

import pytest
from small_systems import mass, rack, rod

ROD = r"""\newcommand{\jt}{J_{\text{tot}}}
With $\jt(r) = J + m r^2$ we get
\begin{align*}
\text{turning, rod and puck:} && \jt(r)\,\ddot\varphi + 2 m r \dot r \dot\varphi &= M \\
\text{puck:} && m \ddot r - m r \dot\varphi^2 + k (r - a) &= 0
\end{align*}"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize(
    "name",
    [
        r"J_{\text{tot}}",
        r"J_{\text t}",
        r"J_\mathrm{tot}",
        r"J_{\mathrm t}",
        r"J_\text{t}",
        r"J_t",
        r"\Theta_{\text{ges}}",
    ],
)
def test_a_name_by_a_macro_is_no_factor_of_what_it_depends_on(name: str) -> None:
    text = ROD.replace(r"J_{\text{tot}}", name)
    assert rod().check(text, hint=0).right
    assert not rod().check(text.replace("+ m r^2", "- m r^2"), hint=0).right
    assert not rod().check(text.replace(r"\jt(r)\,", r"r\,\jt(r)\,"), hint=0).right


RACK = r"""\begin{align}
\text{pinion, motor:} && J_{\text p}\,\ddot x/R &= M - N R \\
\text{rack:} && m_{\text r}\,\ddot x &= N - k (x - d)
\end{align}
with $J_{\text p} = J$ and $m_{\text r} = m$"""


def test_an_index_may_be_a_single_upright_letter() -> None:
    assert rack().check(RACK, hint=0).right
    assert not rack().check(RACK.replace("- N R", "+ N R"), hint=0).right
    assert not rack().check(RACK.replace(r"m_{\text r} = m", r"m_{\text r} = 2 m"), hint=0).right


BRACED = r"""\begin{gather*}
\mu = m r,\qquad I = J + \mu r\\[4pt]
\left.\;\begin{aligned}
I\ddot\varphi + 2\mu\dot r\dot\varphi &= M\\
m\ddot r - \mu\dot\varphi^2 + k(r-a) &= 0
\end{aligned}\;\right\}
\end{gather*}"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize("space", [r"\;", r"\,\!", "~", r"\quad", "{}", "\n", ""])
def test_there_may_be_space_in_front_of_a_brace_behind_rows(space: str) -> None:
    text = BRACED.replace(r"\;\right", rf"{space}\right")
    assert rod().check(text, hint=0).right
    assert not rod().check(text.replace(r"2\mu", r"\mu"), hint=0).right


def test_so_may_there_be_in_arrays() -> None:
    rows = r"J\ddot\varphi + m r^2\ddot\varphi + 2 m r\dot r\dot\varphi = M \\ m\ddot r - m r\dot\varphi^2 + k(r-a) = 0"
    text = rf"\[\left.\begin{{array}}{{l}}{rows}\end{{array}}\,\right\}}\]"
    assert rod().check(text, hint=0).right
    assert not rod().check(text.replace("2 m", "m"), hint=0).right


POWER = r"""Power: $\frac{\mathrm dE_c}{\mathrm dt} = \mathcal{P}$ with $E_c = \frac12 m v^2$, $v = \dot x$, hence
\[ m \ddot x = F - b \dot x - k x \]"""


@pytest.mark.sampled(3)
@pytest.mark.parametrize("letter", [r"\mathcal{P}", "P"])
@pytest.mark.parametrize("rate", [r"\frac{\mathrm dE_c}{\mathrm dt}", r"\dot E_c", r"\frac{d}{dt}E_c"])
def test_what_equals_the_rate_of_an_energy_is_a_power(letter: str, rate: str) -> None:
    text = POWER.replace(r"\mathcal{P}", letter).replace(r"\frac{\mathrm dE_c}{\mathrm dt}", rate)
    verdict = mass().check(text)
    assert verdict.right and "(V)" not in verdict.to_text()
    assert not mass().check(text.replace("- k x", "+ k x"), hint=0).right


def test_a_power_is_judged_by_the_energy_theorem() -> None:
    text = "E = m x'^2/2 + k x^2/2\ndE/dt = P\nP = F x' - b x'^2\nm x'' = F - b x' - k x"
    assert mass().check(text).right
    assert not mass().check(text.replace("- b x'^2", "- 2 b x'^2"), hint=0).right


def test_p_is_potential_energy_where_no_rate_equals_it() -> None:
    text = "T = m x'^2/2\nP = k x^2/2\nm x'' = F - b x' - k x"
    assert "(V)" in mass().check(text).to_text()
    assert not mass().check(text.replace("P = k x^2/2", "P = k x^2"), hint=0).right

"""Errors for wrong arguments and unknown names that say which arguments a method takes and which name was probably
meant."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from functools import wraps
from types import FunctionType
from typing import Any, TypeVar

from lagrangian.errors import Error, ModelError, did_you_mean

C = TypeVar("C", bound=type)

MEANT: Mapping[str, str] = {
    **dict.fromkeys(("pos", "position", "point", "location", "where", "com", "center", "centre"), "at"),
    **dict.fromkeys(("stiffness", "constant"), "k"),
    **dict.fromkeys(("c", "d", "damping", "coefficient"), "b"),
    **dict.fromkeys(("l0", "L0", "length", "rest_length", "free_length", "natural_length"), "rest"),
    **dict.fromkeys(("I", "J", "moment", "moment_of_inertia"), "inertia"),
    **dict.fromkeys(("m", "M"), "mass"),
    **dict.fromkeys(("points", "ends"), "between"),
    **dict.fromkeys(("F", "force", "torque", "tau"), "value"),
    **dict.fromkeys(("parameters", "p"), "params"),
    **dict.fromkeys(("u", "input"), "inputs"),
    **dict.fromkeys(("label", "title"), "name"),
    **dict.fromkeys(("orientation", "axes"), "frame"),
    **dict.fromkeys(("gravity", "strength"), "g"),
}
"""Names of arguments that are common in other programs, and what they are called here."""


class CallError(ModelError, TypeError):
    """A method was called with arguments that it does not take."""


class NoSuchName(Error, AttributeError):
    """An object does not have an attribute of that name."""


def worded(cls: C) -> C:
    """Decorate a class: its public methods answer wrong arguments with a `CallError` that says which arguments they
    take.

    A correct call costs no extra time.
    """
    for name, method in list(vars(cls).items()):
        if isinstance(method, FunctionType) and (not name.startswith("_") or name == "__init__"):
            setattr(cls, name, _worded(method))
    return cls


def _worded(method: Callable[..., Any]) -> Callable[..., Any]:
    @wraps(method)
    def call(*given: Any, **named: Any) -> Any:
        try:
            return method(*given, **named)
        except TypeError:
            signature, called = inspect.signature(method), method.__name__
            if called == "__init__":
                called = type(given[0]).__name__
            try:
                signature.bind(*given, **named)
            except TypeError as trouble:
                raise _misfit(signature, called, given, named, str(trouble)) from None
            raise  # the arguments were right; the error came from inside the method

    return call


def _misfit(
    signature: inspect.Signature, called: str, given: tuple[Any, ...], named: Mapping[str, Any], trouble: str
) -> CallError:
    """The error for arguments that a signature does not accept."""
    taken = [p for p in signature.parameters.values() if p.name != "self" and not p.name.startswith("_")]
    known = [p.name for p in taken]
    usage = f"{called}({', '.join(_shown(taken))})"
    for name in named:
        if name not in known:
            meant = MEANT.get(name)
            hint = f"Did you mean '{meant}'?" if meant in known else did_you_mean(name, known)
            return CallError(
                f"{called} has no argument '{name}'", fix=f"{hint + ' ' if hint else ''}{usage}", code="E402"
            )
    positional = [p for p in taken if p.kind is p.POSITIONAL_OR_KEYWORD]
    if len(given) - 1 > len(positional):
        return CallError(
            f"{called} takes {len(positional)} argument{'s' if len(positional) != 1 else ''} by position "
            f"(got {len(given) - 1})",
            fix=f"{usage}; give what follows * by name",
            code="E501",
        )
    passed = {p.name for p in positional[: len(given) - 1]} | set(named)
    lacking = [p.name for p in taken if p.default is p.empty and p.name not in passed and p.kind is not p.VAR_KEYWORD]
    what = f"{called} needs '{lacking[0]}'" if lacking else f"{called}: {trouble}"
    return CallError(what, fix=usage, code="E401")


def _shown(parameters: list[inspect.Parameter]) -> list[str]:
    """The parameters as they are written in a call: names, defaults, and * before those that are passed by name."""
    shown, starred = [], False
    for p in parameters:
        if p.kind is p.VAR_KEYWORD:
            shown.append(f"**{p.name}")
            continue
        if p.kind is p.KEYWORD_ONLY and not starred:
            shown.append("*")
            starred = True
        shown.append(p.name if p.default is p.empty else f"{p.name}={p.default!r}")
    return shown


class Guided:
    """A class whose objects suggest the right name when an unknown attribute is requested.

    ``_guide`` maps names that are common elsewhere to the advice.
    """

    _guide: Mapping[str, str] = {}

    def _own_name(self, name: str) -> str | None:
        """How to access a symbol of this object by its name, if the unknown attribute is one."""
        return None

    def __getattr__(self, name: str) -> Any:
        kind = type(self).__name__
        if name.startswith("_"):
            raise AttributeError(f"'{kind}' object has no attribute '{name}'")
        known = [n for n in dir(type(self)) if not n.startswith("_")]
        fix = self._guide.get(name) or self._own_name(name) or did_you_mean(name, known) or f"it has {', '.join(known)}"
        raise NoSuchName(f"{kind} has no '{name}'", fix=fix, code="E402")


_DERIVED = {
    **dict.fromkeys(("equations", "eom", "eoms", "equations_of_motion"), "derive().equations"),
    **dict.fromkeys(("lagrangian", "L"), "derive().L"),
    "mass_matrix": "derive().mass_matrix in symbols, compile().mass_matrix(q) in numbers",
    "M": "derive().mass_matrix in symbols, compile().mass_matrix(q) in numbers",
    "T": "derive().T",
    "V": "derive().V",
    "to_latex": "derive().to_latex()",
    "to_html": "derive().to_html()",
    "to_text": "derive().to_text()",
    "latex": "derive().to_latex()",
}

SYSTEM: Mapping[str, str] = {
    **_DERIVED,
    **dict.fromkeys(
        ("constraints", "add_constraint", "holonomic"), "constraint(expression), or constraint(between=(P, Q))"
    ),
    **dict.fromkeys(("nonholonomic", "no_slip"), "velocity_constraint(expression), or rolling(body, at=P, along=…)"),
    **dict.fromkeys(
        ("solve", "run", "integrate", "solve_ivp", "simulation"), "simulate(10.0, theta=0.2), or compile()"
    ),
    **dict.fromkeys(("body", "link", "rod", "rigidbody", "add_body"), "rigid_body(mass, inertia, at=P, frame=F)"),
    **dict.fromkeys(("mass", "point_mass", "add_particle", "bob"), "particle(mass, at=P)"),
    **dict.fromkeys(("param", "params", "constant", "constants"), 'parameter("m", "1 kg"), or parameters("m L")'),
    **dict.fromkeys(
        ("symbols", "symbol", "coord", "coords", "dof", "generalized_coordinates"), 'coordinates("x theta")'
    ),
    **dict.fromkeys(("ground", "world", "O"), "origin"),
    **dict.fromkeys(("forward", "rhs", "lambdify"), "compile().forward(q, v)"),
    **dict.fromkeys(("derivatives", "jacobian"), "compile().derivatives(q, v, u)"),
    **dict.fromkeys(("sensitivities", "gradient"), "simulate(10.0).sensitivities(['m'])"),
    "plot": "simulate(10.0).plot()",
    "animate": "simulate(10.0).animate()",
    "actuator": "torque(tau, on=angle) or force((F, 0), at=P)",
    "motor": "torque(tau, on=angle, reaction=other_angle)",
}
"""Common names that a system does not have, with advice."""

DERIVATION: Mapping[str, str] = {
    **dict.fromkeys(("eom", "eoms", "equations_of_motion"), "equations"),
    **dict.fromkeys(("latex", "to_tex", "tex"), "to_latex()"),
    **dict.fromkeys(("html", "text", "markdown"), "to_html(), to_text(), to_markdown()"),
    "M": "mass_matrix",
    "C": "coriolis_matrix",
    "G": "gravity_vector",
    "lagrangian": "L",
    "simulate": "system.simulate(10.0)",
    "save": 'pathlib.Path("arm.html").write_text(derivation.to_html(), encoding="utf-8")',
}
"""Common names that a derivation does not have, with advice."""

TRAJECTORY: Mapping[str, str] = {
    **dict.fromkeys(("time", "times"), "t"),
    **dict.fromkeys(("x", "q", "states_array", "data", "values"), 'y, one row a state; run["theta"] is one by name'),
    **dict.fromkeys(("savefig", "show"), "plot().savefig(…), or plot() and plt.show()"),
    "parameters": "params",
    **dict.fromkeys(("gradient", "jacobian", "derivatives"), "sensitivities(['m1', 'theta1'])"),
}
"""Common names that a run does not have, with advice."""

ENSEMBLE: Mapping[str, str] = {
    **dict.fromkeys(("animate", "animation"), "system.simulate(10.0, params={…}).animate() shows one of the runs"),
    **dict.fromkeys(("t", "time"), "times"),
}
"""Common names that an ensemble does not have, with advice."""

COMPILED: Mapping[str, str] = {
    **dict.fromkeys(("accelerations", "acceleration", "qdd", "forward_dynamics", "aba"), "forward(q, v, u)"),
    **dict.fromkeys(("inverse_dynamics", "rnea", "torques"), "inverse(q, v, a)"),
    **dict.fromkeys(("M", "inertia", "crba"), "mass_matrix(q)"),
    **dict.fromkeys(("jacobian", "J"), 'point(P, q)["J"], or frame(F, q)["J"]'),
    **dict.fromkeys(("simulate", "run", "solve"), "system.simulate(10.0)"),
    **dict.fromkeys(("C", "coriolis"), "coriolis_matrix(q, v)"),
    **dict.fromkeys(("Minv", "gradients", "partials"), "derivatives(q, v, u)"),
    **dict.fromkeys(("linearize", "A", "B"), "linearized(q, v, u), or system.linearize() about an equilibrium"),
}
"""Common names that a compiled system does not have, with advice."""

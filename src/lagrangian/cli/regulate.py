"""``lagrangian regulate``: the linear-quadratic regulator about an equilibrium."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

import typer

from lagrangian.advice import Advice, Argument, Verb
from lagrangian.cli.assignments import assignments, point
from lagrangian.cli.formats import FormatOption, chosen, put_report
from lagrangian.cli.terminal import (
    AtPoint,
    ConstantInputs,
    Example,
    FixedAtPoint,
    Force,
    Json,
    OptionalFile,
    Output,
    Parameters,
    Width,
    open_system,
)
from lagrangian.errors import Error, RunError

if TYPE_CHECKING:
    from lagrangian.linear.linearization import Linearization
    from lagrangian.system import System


DECLARED = Advice("declare one under [inputs], and let a force, a torque or a voltage source have it as its value")


def regulate(
    file: OptionalFile = None,
    example: Example = None,
    state_weights: Annotated[
        list[str] | None,
        typer.Option(
            "--state-weight",
            "-Q",
            metavar="NAME=WEIGHT",
            help='Weight of a state, 0 for those not named: -Q theta=100 -Q "x\'=1"; or one number for all, by default '
            "1. Repeatable.",
        ),
    ] = None,
    input_weights: Annotated[
        list[str] | None,
        typer.Option(
            "--input-weight",
            "-R",
            metavar="NAME=WEIGHT",
            help="Weight of an input: -R F=0.5; or one number for all, by default 1. Repeatable.",
        ),
    ] = None,
    at: AtPoint = None,
    values: Parameters = None,
    inputs: ConstantInputs = None,
    fixed: FixedAtPoint = None,
    format: FormatOption = None,
    json: Json = False,
    width: Width = None,
    output: Output = None,
    force: Force = False,
) -> None:
    """Find the linear-quadratic regulator about an equilibrium: law, gains, closed-loop poles; exit 1 if a check fails.

    It minimizes the integral of Q δx² + R δu², with the weights Q and R of states and inputs.

    \b
    Examples:
      lagrangian regulate --example cart-pole
      lagrangian regulate cart.toml -Q x=10 -Q theta=100 -R F=0.5 --at theta=0
      lagrangian regulate cart.toml -Q 1 -R 0.1 --json
    """
    wanted = chosen(format, json, output, force)
    system = open_system(file, example)
    if not system.model.inputs:
        raise RunError("the system has no input, so nothing can be regulated", fix=DECLARED, code="E401")
    linear = _linearized(system, point(at, values, inputs, fixed))
    found = linear.lqr(_weights(state_weights, "-Q", "theta"), _weights(input_weights, "-R", "F"))
    put_report(found.report(), wanted, width, output)
    if any(check.holds is False for check in found.verified):
        raise typer.Exit(1)


def _linearized(system: System, where: dict[str, Any]) -> Linearization:
    try:
        return system.linearize(**where)
    except RunError as error:
        if error.code != "E521":
            raise
        held = Advice(
            Verb("equilibria"),
            " finds equilibria; constant inputs may hold the point, ",
            Argument("inputs", "5", "F"),
        )
        raise RunError(error.what, fix=held, code=error.code) from error


def _weights(given: list[str] | None, option: str, name: str) -> dict[str, str] | str:
    """One weight for all, or weights by name."""
    if not given:
        return "1"
    if len(given) == 1 and "=" not in given[0]:
        return given[0]
    if any("=" not in item for item in given):
        raise Error(
            f"{option} takes name=weight, or one number for all",
            fix=f"{option} {name}=100, or {option} 1",
            code="E406",
        )
    return assignments(given, option)

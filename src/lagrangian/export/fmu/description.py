"""modelDescription.xml of both versions, and the list of sources of FMI 3."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from xml.sax.saxutils import quoteattr

from lagrangian.export.fmu.source import TOLERANCE
from lagrangian.export.fmu.variables import FmuVariable
from lagrangian.model import Model

HEAD = '<?xml version="1.0" encoding="UTF-8"?>'
TOOL = "lagrangian"


def description2(model: Model, variables: Sequence[FmuVariable], stem: str, token: str, duration: float) -> str:
    """modelDescription.xml of FMI 2.0."""
    can = 'canGetAndSetFMUstate="true" canSerializeFMUstate="true"'
    name, shown = _attribute(stem), _attribute(model.name)
    sources = [f'    <SourceFiles><File name="{stem}.c"/></SourceFiles>']
    lines = [
        HEAD,
        f'<fmiModelDescription fmiVersion="2.0" modelName={name} guid="{token}" description={shown}',
        f'  generationTool="{TOOL}" variableNamingConvention="flat" numberOfEventIndicators="0">',
        f"  <ModelExchange modelIdentifier={name} {can}>",
        *sources,
        "  </ModelExchange>",
        f'  <CoSimulation modelIdentifier={name} canHandleVariableCommunicationStepSize="true" {can}>',
        *sources,
        "  </CoSimulation>",
        *_units(variables),
        f'  <DefaultExperiment startTime="0" stopTime="{duration!r}" tolerance="{TOLERANCE!r}"/>',
        "  <ModelVariables>",
    ]
    for reference, v in enumerate(variables):
        kind, inner = _attributes2(v)
        about = f" description={_attribute(v.description)}" if v.description else ""
        lines += [
            f'    <ScalarVariable name={_attribute(v.name)} valueReference="{reference}" {kind}{about}>',
            f"      <Real{inner}/>",
            "    </ScalarVariable>",
        ]
    lines += ["  </ModelVariables>", "  <ModelStructure>"]
    for group, roles in (
        ("Outputs", ("state", "output")),
        ("Derivatives", ("derivative",)),
        ("InitialUnknowns", ("derivative", "output")),
    ):
        found = [f'      <Unknown index="{k}"/>' for k, v in enumerate(variables, 1) if v.role in roles]
        lines += [f"    <{group}>", *found, f"    </{group}>"]
    return "\n".join([*lines, "  </ModelStructure>", "</fmiModelDescription>", ""])


def _attributes2(v: FmuVariable) -> tuple[str, str]:
    """The attributes of a variable, and those of its type."""
    kind = {
        "time": 'causality="independent" variability="continuous"',
        "state": 'causality="output" variability="continuous" initial="exact"',
        "derivative": 'causality="local" variability="continuous" initial="calculated"',
        "input": 'causality="input" variability="continuous"',
        "parameter": 'causality="parameter" variability="tunable" initial="exact"',
        "output": 'causality="output" variability="continuous" initial="calculated"',
    }[v.role]
    inner = f" unit={_attribute(v.unit)}" if v.unit else ""
    if v.start is not None:
        inner += f' start="{v.start!r}"'
    if v.derivative is not None:
        inner += f' derivative="{v.derivative + 1}"'  # the number of the state in this list, from 1
    return kind, inner


def description3(model: Model, variables: Sequence[FmuVariable], stem: str, token: str, duration: float) -> str:
    """modelDescription.xml of FMI 3.0."""
    can = 'canGetAndSetFMUState="true" canSerializeFMUState="true"'
    name, shown = _attribute(stem), _attribute(model.name)
    lines = [
        HEAD,
        f'<fmiModelDescription fmiVersion="3.0" modelName={name} instantiationToken="{token}" description={shown}',
        f'  generationTool="{TOOL}" variableNamingConvention="flat">',
        f"  <ModelExchange modelIdentifier={name} {can}/>",
        f'  <CoSimulation modelIdentifier={name} canHandleVariableCommunicationStepSize="true" {can}/>',
        *_units(variables),
        f'  <DefaultExperiment startTime="0" stopTime="{duration!r}" tolerance="{TOLERANCE!r}"/>',
        "  <ModelVariables>",
    ]
    for reference, v in enumerate(variables):
        kind, _ = _attributes2(v)
        about = f" description={_attribute(v.description)}" if v.description else ""
        unit = f" unit={_attribute(v.unit)}" if v.unit else ""
        start = f' start="{v.start!r}"' if v.start is not None else ""
        rate = f' derivative="{v.derivative}"' if v.derivative is not None else ""
        first = f'    <Float64 name={_attribute(v.name)} valueReference="{reference}" '
        lines.append(f"{first}{kind}{about}{unit}{start}{rate}/>")
    lines += ["  </ModelVariables>", "  <ModelStructure>"]
    for tag, roles in (
        ("Output", ("state", "output")),
        ("ContinuousStateDerivative", ("derivative",)),
        ("InitialUnknown", ("derivative", "output")),
    ):
        lines += [f'    <{tag} valueReference="{k}"/>' for k, v in enumerate(variables) if v.role in roles]
    return "\n".join([*lines, "  </ModelStructure>", "</fmiModelDescription>", ""])


def build_description(stem: str) -> str:
    """buildDescription.xml of FMI 3.0: what has to be compiled."""
    lines = [
        HEAD,
        '<fmiBuildDescription fmiVersion="3.0">',
        f'  <BuildConfiguration modelIdentifier="{stem}">',
        '    <SourceFileSet language="C99">',
        f'      <SourceFile name="{stem}.c"/>',
        "    </SourceFileSet>",
        "  </BuildConfiguration>",
        "</fmiBuildDescription>",
    ]
    return "\n".join([*lines, ""])


def _units(variables: Sequence[FmuVariable]) -> Iterator[str]:
    """The units that occur, by name."""
    found = sorted({v.unit for v in variables if v.unit})
    if found:
        yield "  <UnitDefinitions>"
        yield from (f"    <Unit name={_attribute(unit)}/>" for unit in found)
        yield "  </UnitDefinitions>"


def _attribute(text: str) -> str:
    """A text as the value of an attribute, in characters that XML takes and that do not turn what follows them."""
    return quoteattr("".join(c if c.isprintable() else f"U+{ord(c):04X}" for c in text))

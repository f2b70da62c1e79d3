"""The model file as pydantic models, which validate files and produce the JSON Schema for editors."""

from __future__ import annotations

from typing import Annotated, Any, TypeAlias

from pydantic import BaseModel, ConfigDict, Discriminator, Field, Tag, create_model

from lagrangian.model import REGISTRY, Element
from lagrangian.model.elements import FieldKind
from lagrangian.model.hints import BODY_KINDS, LINE_KINDS


def _form(value: object) -> str | None:
    """The form in which a value was written."""
    if isinstance(value, bool):
        return None
    if isinstance(value, str):
        return "text"
    if isinstance(value, (int, float)):
        return "number"
    if isinstance(value, list):
        return "list"
    return "table" if isinstance(value, (dict, BaseModel)) else None


_Text: TypeAlias = Annotated[str, Tag("text")]
_Number: TypeAlias = Annotated[float, Tag("number")]
_ByForm = Discriminator(_form)


class _Table(BaseModel):
    """A table of the file: no unknown keys, no conversion between text and numbers."""

    model_config = ConfigDict(extra="forbid", strict=True, populate_by_name=False, allow_inf_nan=False)


Expression: TypeAlias = Annotated[_Text | _Number, _ByForm]
"""An expression as text, or a number."""

Quantity: TypeAlias = Annotated[_Text | _Number, _ByForm]
"""A number in SI units, or text with a unit."""

Vector: TypeAlias = Annotated[list[Expression], Field(min_length=2, max_length=3)]
_List: TypeAlias = Annotated[Vector, Tag("list")]

ExpressionOrVector: TypeAlias = Annotated[_Text | _Number | _List, _ByForm]

_Row: TypeAlias = Annotated[list[Expression], Field(min_length=3, max_length=3), Tag("list")]
_Rows: TypeAlias = Annotated[list[Annotated[_Text | _Number | _Row, _ByForm]], Tag("list")]
Inertia: TypeAlias = Annotated[_Text | _Number | _Rows, _ByForm]
"""A scalar, three principal moments or three rows."""

Between: TypeAlias = Annotated[list[str], Field(min_length=2, max_length=2, description="The two points it joins.")]


Points: TypeAlias = Annotated[list[str], Field(min_length=2, max_length=1000, description="Points, in order.")]
Frames: TypeAlias = Annotated[list[str], Field(min_length=1, max_length=2, description="One frame or two.")]
RowNames: TypeAlias = Annotated[
    _Text | Annotated[list[str], Field(min_length=1, max_length=3), Tag("list")],
    _ByForm,
]
"""A constraint or one of its rows, or two or three rows."""
Directions: TypeAlias = Annotated[list[Annotated[_Text | _Number | _List, _ByForm]], Field(min_length=1, max_length=3)]
"""A vector, or a list of vectors."""


class CoordinateTable(_Table):
    """A generalized coordinate."""

    description: str = Field("", description="What it measures, and from where.")
    unit: str | None = Field(None, description="Its unit, such as 'm' or 'rad'.")
    positive: bool = Field(False, description="It is a distance that is always positive: sqrt(r^2) is r.")


class ParameterTable(_Table):
    """A constant of the system."""

    value: Quantity | None = Field(None, description="A number in SI units, or text with a unit: '40 N/m'.")
    unit: str | None = Field(None, description="The unit of a value given as a number.")
    description: str = Field("", description="What it is.")


class InputTable(_Table):
    """A force, torque or other signal from outside."""

    description: str = Field("", description="What it is and which way it acts.")
    unit: str | None = Field(None, description="Its unit, such as 'N' or 'N*m'.")


class PointTable(_Table):
    """A point, by its offset from another point, along the axes of a frame."""

    offset: Vector = Field(description="Two components in the plane, three in space.")
    from_: str | None = Field(None, alias="from", description="The point it is measured from; the origin if left out.")
    frame: str | None = Field(None, description="The frame whose axes the offset is given in; fixed axes if left out.")


_Point: TypeAlias = Annotated[PointTable, Tag("table")]
PointValue: TypeAlias = Annotated[_List | _Point, _ByForm]
PointReference: TypeAlias = Annotated[_Text | _List | _Point, _ByForm]
"""The name of a point, or an inline point."""


class FrameTable(_Table):
    """Axes that turn about an axis, in a ball joint, or float."""

    model_config = ConfigDict(
        json_schema_extra={
            "anyOf": [
                {"required": ["angle"]},
                {"required": ["floating"], "properties": {"floating": {"const": True}}},
                {"required": ["ball"], "properties": {"ball": {"const": True}}},
            ]
        }
    )

    name: str = Field(description="The frame's name.")
    angle: Expression | None = Field(None, description="The angle from its parent's axes.")
    axis: Vector | None = Field(None, description="The axis it turns about, in its parent's axes; in space only.")
    parent: str | None = Field(None, description="The frame it turns from; the fixed axes if left out.")
    origin: str | None = Field(None, description="The point its points are measured from.")
    floating: bool = Field(
        False,
        description="It floats in space, instead of an angle: coordinates NAME_x, NAME_y, NAME_z and the quaternion "
        "NAME_qx … NAME_qw; velocities NAME_vx … and NAME_wx … in its own axes; its origin is the point NAME_origin.",
    )
    ball: bool = Field(
        False,
        description="It turns freely about its origin, instead of by an angle: the coordinates are the quaternion "
        "NAME_qx … NAME_qw, from its axes to its parent's; velocities NAME_wx … in its own axes, against its parent.",
    )
    after: str | None = Field(
        None,
        description="The coordinate, or the frame with a quaternion, that its coordinates follow; first if left out.",
    )

    @property
    def has_quaternion(self) -> bool:
        """Whether it has coordinates of its own."""
        return self.floating or self.ball


class ElementTable(_Table):
    """The fields that every element may have."""

    name: str = Field("", description="The element's name, its own in the system.")


_TYPES: dict[FieldKind, Any] = {
    FieldKind.EXPRESSION: Expression,
    FieldKind.VECTOR: Vector,
    FieldKind.EXPRESSION_OR_VECTOR: ExpressionOrVector,
    FieldKind.POINT: PointReference,
    FieldKind.TWO_POINTS: Between,
    FieldKind.FRAME: str,
    FieldKind.FRAME_OR_ANGLE: Expression,
    FieldKind.BODY_FRAME: Expression,
    FieldKind.INERTIA: Inertia,
    FieldKind.COORDINATE: str,
    FieldKind.POINTS: Points,
    FieldKind.FRAMES: Frames,
    FieldKind.BODY: str,
    FieldKind.ROWS: RowNames,
    FieldKind.DIRECTIONS: Directions,
    FieldKind.STRENGTH_OF_GRAVITY: Expression,
}


def _table(owner: type[Element]) -> type[ElementTable]:
    """The table of a kind of element, or of a family of kinds with the same fields."""
    given: dict[str, Any] = {}
    for key, entry in owner.entries.items():
        form = _TYPES[entry.kind] if entry.default is not None else _TYPES[entry.kind] | None
        default = float(entry.default) if isinstance(entry.default, int) else entry.default
        given[key] = (form, Field(default, description=entry.about))
    return create_model(
        f"{owner.__name__}Table", __base__=ElementTable, __doc__=owner.about, __module__=__name__, **given
    )


def _tables() -> dict[str, type[ElementTable]]:
    made: dict[type[Element], type[ElementTable]] = {}
    found: dict[str, type[ElementTable]] = {}
    for kind, element in REGISTRY.items():
        owner = next(c for c in element.__mro__ if "entries" in vars(c))
        found[kind] = made.setdefault(owner, made[owner] if owner in made else _table(owner))
    return found


TABLES = _tables()
"""The table of every kind of element, by its name."""


class EnergiesTable(_Table):
    """Energies of the whole system, if they are already known."""

    T: Expression | None = Field(None, description="Kinetic co-energy T*.")
    V: Expression | None = Field(None, description="Potential energy.")
    D: Expression | None = Field(None, description="Rayleigh's dissipation function.")
    Xi: dict[str, Expression] = Field(default_factory=dict, description="Generalized forces by coordinate.")


class SimulateTable(_Table):
    """What to simulate."""

    duration: Quantity | None = Field(None, description="How long, such as '10 s'.")
    initial: dict[str, Quantity] = Field(
        default_factory=dict, description='Initial coordinates, and rates as "x\'"; zero where left out.'
    )
    fixed: list[str] = Field(
        default_factory=list, description="Coordinates that stay as given where constraints move the others."
    )
    reactions: list[str] = Field(
        default_factory=list,
        description="Joints whose reactions are in tables: constraints, points, bodies by name; 'B on rod 1' is the "
        "other side, and 'B in axes of rod 2' turns the components.",
    )
    inputs: dict[str, Expression] = Field(default_factory=dict, description="Inputs as expressions in t.")


class ViewTable(_Table):
    """From where a system in space is seen."""

    azimuth: Quantity | None = Field(None, description="The direction of the eye about the vertical, such as '40 deg'.")
    elevation: Quantity | None = Field(None, description="How high the eye is above the floor, such as '20 deg'.")


_Names: TypeAlias = Annotated[list[str], Field(max_length=1000)]


class LookLineTable(_Table):
    """A line of the picture that carries no mass and no force: a string, a wire, a wall."""

    through: Points = Field(description="The points, or bodies, that it runs through, in order.")
    kind: str = Field("string", description="What it is drawn as.", json_schema_extra={"enum": list(LINE_KINDS)})


_Corner: TypeAlias = Annotated[list[Quantity], Field(min_length=2, max_length=3)]


class LookShapeTable(_Table):
    """An outline that moves with a body or a frame."""

    frame: str = Field(description="The frame, or the body, in whose axes the outline is given.")
    at: str | None = Field(None, description="Its origin, a point or body; if left out, that of the frame or body.")
    box: Annotated[list[Quantity], Field(min_length=2, max_length=2)] | None = Field(
        None, description="A rectangle about the origin: width along x and height along y."
    )
    points: Annotated[list[_Corner], Field(min_length=2, max_length=1000)] | None = Field(
        None, description="The corners of the outline, in order."
    )


class LookTable(_Table):
    """What a picture needs and the mechanics does not say."""

    pose: dict[str, Quantity] = Field(default_factory=dict, description="The coordinates of the picture.")
    kinds: dict[str, str] = Field(
        default_factory=dict,
        description="What bodies are drawn as.",
        json_schema_extra={"additionalProperties": {"type": "string", "enum": list(BODY_KINDS)}},
    )
    view: ViewTable | None = Field(None, description="From where a system in space is seen.")
    trail: _Names = Field(default_factory=list, description="Points whose paths are shown in motion.")
    hide: _Names = Field(default_factory=list, description="Elements and coordinates that are left out.")
    line: Annotated[list[LookLineTable], Field(max_length=200)] = Field(
        default_factory=list, description="Strings, wires, walls."
    )
    shape: Annotated[list[LookShapeTable], Field(max_length=200)] = Field(default_factory=list, description="Outlines.")


Coordinate: TypeAlias = Annotated[_Text | Annotated[CoordinateTable, Tag("table")], _ByForm]
Parameter: TypeAlias = Annotated[_Text | _Number | Annotated[ParameterTable, Tag("table")], _ByForm]
Input: TypeAlias = Annotated[_Text | Annotated[InputTable, Tag("table")], _ByForm]


class _Described(_Table):
    """The sections before the elements."""

    name: str = Field(description="The system's name.")
    coordinates: dict[str, Coordinate] = Field(
        default_factory=dict, description="Generalized coordinates, each with what it measures."
    )
    parameters: dict[str, Parameter] = Field(
        default_factory=dict, description="Constants: a number in SI units, or text with a unit."
    )
    inputs: dict[str, Input] = Field(default_factory=dict, description="Signals from outside: 'unit, description'.")
    define: dict[str, Expression] = Field(default_factory=dict, description="Named expressions, in order.")
    points: dict[str, PointValue] = Field(default_factory=dict, description="Named points.")
    frame: list[FrameTable] = Field(default_factory=list, description="Frames.")


_ARRAYS: dict[str, Any] = {
    kind: (list[table], Field(default_factory=list, description=REGISTRY[kind].plural))
    for kind, table in TABLES.items()
}
_WithElements = create_model("_WithElements", __base__=_Described, **_ARRAYS)


class ModelFile(_WithElements):
    """A mechanical system as a TOML file of the package `lagrangian`."""

    energies: EnergiesTable | None = Field(None, description="Energies of the whole system.")
    simulate: SimulateTable | None = Field(None, description="What to simulate.")
    look: LookTable | None = Field(None, description="What a picture needs and the mechanics does not say.")


def schema() -> dict[str, Any]:
    """Return the JSON Schema (draft 2020-12) of the model file."""
    made = ModelFile.model_json_schema(by_alias=True)
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **made}

"""A drawing as DXF (AutoCAD 2010, in mm): the object full size, writing and arrows as large as the sheet needs."""

import io
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from abu_calc.reporting.drawings.dimensions import ABOVE, ARROW, BEYOND, SIGNS, picture
from abu_calc.reporting.drawings.shapes import (
    HEIGHT,
    PENS,
    Arc,
    Drawing,
    Length,
    Line,
    Primitive,
    Radius,
    Region,
    Shape,
    Solid,
    Text,
    ToleranceFrame,
    plain,
)

if TYPE_CHECKING:
    from ezdxf.document import Drawing as Document
    from ezdxf.layouts.base import BaseLayout

STYLE = "ABU"
COLOURS = {"outline": 7, "hidden": 8, "centre": 1, "hatch": 8, "dimension": 5, "text": 7, "frame": 7}
"""Colours of the layers, by AutoCAD's numbers: visible on a dark and on a light ground."""
ANSI31 = 3.175
"""Distance between the lines of this pattern, unscaled [mm]."""


def dxf_text(drawing: Drawing) -> str:
    """The text of a DXF file. Needs ezdxf, of the extra `report`."""
    from ezdxf.document import Drawing as Document
    from ezdxf.units import MM

    document = Document.new("R2010")
    document.units = MM
    document.header["$LTSCALE"] = 1 / drawing.scale
    document.header["$MEASUREMENT"] = 1
    _styles(document, drawing.scale)
    space = document.modelspace()
    for shape in drawing.shapes:
        _add(document, space, shape, drawing.scale)
    low, high = drawing.low, drawing.high
    document.header["$EXTMIN"], document.header["$EXTMAX"] = (*low, 0.0), (*high, 0.0)
    document.set_modelspace_vport(1.05 * (high[1] - low[1]), ((low[0] + high[0]) / 2, (low[1] + high[1]) / 2))
    _paper(document, drawing)
    stream = io.StringIO()
    document.write(stream)
    return stream.getvalue()


def _styles(document: "Document", scale: float) -> None:
    """Layers by kind of line, one style of writing, one of dimensions."""
    document.styles.add(STYLE, font="arial.ttf")
    for layer, pen in PENS.items():
        name = "CONTINUOUS"
        if pen.dashes:
            name = f"{STYLE}_{layer.upper()}"
            signed = (length * (-1) ** index for index, length in enumerate(pen.dashes))
            document.linetypes.add(name, [sum(pen.dashes), *signed], description=f"{layer} line")
        document.layers.add(layer.upper(), color=COLOURS[layer], linetype=name, lineweight=round(100 * pen.width))
    document.dimstyles.add(
        STYLE,
        dxfattribs={
            "dimscale": 1 / scale, "dimtxt": HEIGHT, "dimasz": ARROW, "dimexe": BEYOND, "dimexo": 1.0, "dimgap": ABOVE,
            "dimtad": 1, "dimtih": 0, "dimtoh": 0, "dimdec": 3, "dimzin": 8, "dimtxsty": STYLE,
        },
    )  # fmt: skip


def _add(document: "Document", space: "BaseLayout", shape: Shape, scale: float) -> None:
    match shape:
        case Length() | Radius():
            _dimension(document, space, shape, scale)
        case Region():
            _region(space, shape, scale)
        case ToleranceFrame():
            _frame(space, shape, scale)
        case _:
            _draw(space, (shape,), scale)


def _draw(space: "BaseLayout", shapes: Iterable[Primitive], scale: float) -> None:
    for shape in shapes:
        match shape:
            case Line(layer, start, end):
                space.add_line(start, end, {"layer": layer.upper()})
            case Arc(layer, centre, radius, start_angle, end_angle):
                if end_angle - start_angle >= 360:
                    space.add_circle(centre, radius, {"layer": layer.upper()})
                else:
                    space.add_arc(centre, radius, start_angle % 360, end_angle % 360, True, {"layer": layer.upper()})
            case Solid(corners):
                space.add_solid(corners, {"layer": "DIMENSION"})
            case Text():
                _text(space, shape, scale)
            case Region():
                _region(space, shape, scale)


def _region(space: "BaseLayout", region: Region, scale: float) -> None:
    """A closed outline, and the hatch in it."""
    hatch = space.add_hatch(dxfattribs={"layer": "HATCH"})
    hatch.set_pattern_fill("ANSI31", angle=region.angle - 45, scale=region.spacing / ANSI31 / scale, color=256)
    path = hatch.paths.add_polyline_path(region.corners, is_closed=True)
    if region.outlined:
        outline = space.add_lwpolyline(region.corners, format="xyb", close=True, dxfattribs={"layer": "OUTLINE"})
        hatch.associate(path, [outline])


def _frame(space: "BaseLayout", frame: ToleranceFrame, scale: float) -> None:
    """A frame that CAD programs know as such."""
    name, *cells = frame.cells
    content = "%%v".join((f"{{\\Fgdt;{SIGNS[name]}}}", *map(written, cells)))
    # Its insertion point is the middle of its left edge.
    middle = frame.corner[0], frame.corner[1] - HEIGHT / scale
    space.new_entity("TOLERANCE", {"layer": "DIMENSION", "dimstyle": STYLE, "insert": middle, "content": content,
                                   "x_axis_vector": (1, 0, 0)})  # fmt: skip


def _paper(document: "Document", drawing: Drawing) -> None:
    """A layout as large as the sheet, filled by one window on the drawing at its scale."""
    wide, high = drawing.size
    layout = document.paperspace()
    layout.page_setup(size=(wide, high), margins=(0, 0, 0, 0), units="mm", scale=(1, 1))
    middle = (drawing.low[0] + drawing.high[0]) / 2, (drawing.low[1] + drawing.high[1]) / 2
    layout.add_viewport(center=(wide / 2, high / 2), size=(wide, high), view_center_point=middle,
                        view_height=drawing.high[1] - drawing.low[1], status=2)  # fmt: skip


def _text(space: "BaseLayout", text: Text, scale: float) -> None:
    from ezdxf.enums import TextEntityAlignment

    aligned = {"left": TextEntityAlignment.LEFT, "centre": TextEntityAlignment.CENTER,
               "right": TextEntityAlignment.RIGHT}[text.align]  # fmt: skip
    attributes: dict[str, Any] = {"layer": "TEXT", "style": STYLE, "rotation": text.angle}
    entity = space.add_text(written(text.text), height=text.height / scale, dxfattribs=attributes)
    entity.set_placement(text.at, align=aligned)


def _dimension(document: "Document", space: "BaseLayout", dim: Length | Radius, scale: float) -> None:
    """A dimension that CAD programs know as such, with the picture that every format has."""
    drawn = picture(dim, scale)
    text = f"{written(dim.text)}\\X{written(dim.below)}" if isinstance(dim, Length) and dim.below else written(dim.text)
    attributes = {"layer": "DIMENSION"}
    if isinstance(dim, Length):
        base = (dim.at, dim.start[1]) if dim.upright else (dim.start[0], dim.at)
        angle = 90 if dim.upright else 0
        entity = space.add_linear_dim(
            base, dim.start, dim.end, angle=angle, text=text, dimstyle=STYLE, dxfattribs=attributes
        ).dimension
    elif dim.full:
        entity = space.add_diameter_dim(
            dim.centre, mpoint=dim.touch, text=text, dimstyle=STYLE, dxfattribs=attributes
        ).dimension
    else:
        entity = space.add_radius_dim(
            dim.centre, mpoint=dim.touch, text=text, dimstyle=STYLE, dxfattribs=attributes
        ).dimension
    block = document.blocks.new_anonymous_block(type_char="D")
    _draw(block, drawn, scale)
    entity.dxf.geometry = block.name
    entity.dxf.actual_measurement = 2 * dim.value if isinstance(dim, Radius) and dim.full else dim.value
    entity.dxf.text_midpoint = next(shape.at for shape in drawn if isinstance(shape, Text))


def written(text: str) -> str:
    """A text that DXF takes as it stands: its escapes are %%, ^, and \\U+.

    >>> written("50%%c ^x")
    '50%%%%%%c ^ x'
    """
    escaped = plain(text).replace("%%", "%%%%%%").replace("^", "^ ")
    return escaped.replace("\\U+", "\\ U+").replace("\\M+", "\\ M+")

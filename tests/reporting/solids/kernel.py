"""An independent kernel of solids, OpenCASCADE: reads STEP files, measures, checks and cuts solids."""

from pathlib import Path
from typing import Any, NamedTuple

import pytest

pytest.importorskip("OCP", reason='the kernel is not installed: pip install "abu-calc[solids]"')

from OCP.BRepAlgoAPI import BRepAlgoAPI_Common
from OCP.BRepCheck import BRepCheck_Analyzer
from OCP.BRepExtrema import BRepExtrema_DistShapeShape
from OCP.BRepGProp import BRepGProp
from OCP.collections import Sequence_TDF_Label
from OCP.GProp import GProp_GProps
from OCP.STEPCAFControl import STEPCAFControl_Reader
from OCP.TCollection import TCollection_ExtendedString
from OCP.TDataStd import TDataStd_Name
from OCP.TDF import TDF_Label
from OCP.TDocStd import TDocStd_Document
from OCP.XCAFDoc import XCAFDoc_DocumentTool, XCAFDoc_ShapeTool


class ReadSolid(NamedTuple):
    """One item of an assembly as the kernel has it: its name, that of its part, and its shape in its place."""

    name: str
    part: str
    shape: Any

    @property
    def volume(self) -> float:
        """Volume [mm³]."""
        return volume(self.shape)

    @property
    def centre(self) -> tuple[float, float, float]:
        """Centre of mass [mm]."""
        properties = GProp_GProps()
        BRepGProp.VolumeProperties_s(self.shape, properties, 1e-9)
        found: tuple[float, float, float] = properties.CentreOfMass().Coord()
        return found

    @property
    def valid(self) -> bool:
        """Whether the kernel finds nothing wrong with it."""
        return bool(BRepCheck_Analyzer(self.shape).IsValid())


def volume(shape: Any) -> float:
    """Volume [mm³] to 1e-9 of itself."""
    properties = GProp_GProps()
    BRepGProp.VolumeProperties_s(shape, properties, 1e-9)
    return float(properties.Mass())


def common_volume(first: ReadSolid, second: ReadSolid) -> float:
    """Volume [mm³] that two solids share."""
    cut = BRepAlgoAPI_Common(first.shape, second.shape)
    assert cut.IsDone()
    return volume(cut.Shape())


def distance(first: ReadSolid, second: ReadSolid) -> float:
    """Least distance [mm] of two solids."""
    found = BRepExtrema_DistShapeShape(first.shape, second.shape)
    assert found.IsDone()
    return float(found.Value())


class ReadAssembly(NamedTuple):
    """Assembly as the kernel has it."""

    name: str
    items: list[ReadSolid]


def read_step(file: Path) -> ReadAssembly:
    """Assembly of a file, by its product structure."""
    document = TDocStd_Document(TCollection_ExtendedString("doc"))
    reader = STEPCAFControl_Reader()
    assert reader.ReadFile(str(file)).name == "IFSelect_RetDone"
    assert reader.Transfer(document)
    tool = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    roots, parts = Sequence_TDF_Label(), Sequence_TDF_Label()
    tool.GetFreeShapes(roots)
    assert roots.Length() == 1
    assert XCAFDoc_ShapeTool.IsAssembly_s(roots.Value(1))
    XCAFDoc_ShapeTool.GetComponents_s(roots.Value(1), parts)
    items = []
    for index in range(1, parts.Length() + 1):
        label, part = parts.Value(index), TDF_Label()
        assert XCAFDoc_ShapeTool.GetReferredShape_s(label, part)
        items.append(ReadSolid(_name(label), _name(part), XCAFDoc_ShapeTool.GetShape_s(label)))
    return ReadAssembly(_name(roots.Value(1)), items)


def _name(label: Any) -> str:
    attribute = TDataStd_Name()
    assert label.FindAttribute(TDataStd_Name.GetID_s(), attribute)
    return str(attribute.Get().ToExtString())

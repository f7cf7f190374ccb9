"""Prints what usd-core finds in a file of one BasisCurves, floats as their bits: usage: dump_usd.py
FILE"""

import sys

import numpy as np
from pxr import Usd, UsdGeom


def bits(values):
    """In hexadecimal, eight digits each."""
    values = np.ascontiguousarray(np.array(values))
    assert values.dtype in (np.float32, np.int32), values.dtype
    return " ".join(f"{word:08x}" for word in values.ravel().view(np.uint32))


def dump(attribute, interpolation=""):
    if not attribute or not attribute.HasAuthoredValue():
        return
    name = f"{attribute.GetName()} {attribute.GetTypeName()}"
    name += f" {interpolation}" if interpolation else ""
    for time in attribute.GetTimeSamples():
        print(f"{name} @{time:g}: {bits(attribute.Get(time))}")
    if attribute.Get() is not None:
        print(f"{name}: {bits(attribute.Get())}")


stage = Usd.Stage.Open(sys.argv[1])
(prim,) = stage.Traverse()
curves = UsdGeom.BasisCurves(prim)
api = UsdGeom.PrimvarsAPI(prim)
assert curves and prim == stage.GetDefaultPrim() and not prim.GetAllChildren()
assert UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y
print(f"{prim.GetPath()} {curves.GetTypeAttr().Get()} {curves.GetWrapAttr().Get()}")
states_unit = UsdGeom.StageHasAuthoredMetersPerUnit(stage)
print(f"metersPerUnit {repr(UsdGeom.GetStageMetersPerUnit(stage)) if states_unit else 'none'}")
print(f"doc {stage.GetRootLayer().documentation.encode()!r}")
if stage.HasAuthoredTimeCodeRange():
    print(f"time {stage.GetStartTimeCode():g} to {stage.GetEndTimeCode():g},", end=" ")
    print(f"{stage.GetTimeCodesPerSecond()!r}, {stage.GetFramesPerSecond()!r} per second")
dump(curves.GetCurveVertexCountsAttr())
dump(curves.GetWidthsAttr(), curves.GetWidthsInterpolation())
for name in ("displayColor", "displayOpacity", "st", "groom_group_id", "groom_guide"):
    primvar = api.GetPrimvar(name)
    dump(primvar.GetAttr(), primvar.GetInterpolation() if primvar else "")
dump(prim.GetAttribute("hairbench:rootTriangles"))
dump(curves.GetPointsAttr())
dump(curves.GetExtentAttr())
# usd-core's values of the points and the widths.
for time in curves.GetPointsAttr().GetTimeSamples() or [Usd.TimeCode.Default()]:
    extent = UsdGeom.Boundable.ComputeExtentFromPlugins(curves, Usd.TimeCode(time))
    assert bits(extent) == bits(curves.GetExtentAttr().Get(time)), extent

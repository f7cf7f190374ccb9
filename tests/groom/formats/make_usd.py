"""Writes the files that usd_import_test.cpp reads, with usd-core: usage: make_usd.py FOLDER"""

import os
import sys

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdUtils, Vt

os.chdir(sys.argv[1])


def new_stage(name, up="Y", unit=1.0):
    stage = Usd.Stage.CreateNew(name)
    UsdGeom.SetStageUpAxis(stage, up)
    if unit:
        UsdGeom.SetStageMetersPerUnit(stage, unit)
    return stage


def points(count, first=0):
    """Numbers that neither a short decimal nor a shorter type represents."""
    return [((k + 1) / 3, -k / 7, 1e-3 * k * k - 0.1) for k in range(first, first + count)]


def curves(stage, path, kind, sizes, values, basis=None, wrap="nonperiodic"):
    prim = UsdGeom.BasisCurves.Define(stage, path)
    prim.CreateTypeAttr(kind)
    prim.CreateWrapAttr(wrap)
    if basis:
        prim.CreateBasisAttr(basis)
    prim.CreateCurveVertexCountsAttr(sizes)
    if values is not None:
        prim.CreatePointsAttr(values)
    return prim


def widths(prim, interpolation, values):
    prim.CreateWidthsAttr(values)
    prim.SetWidthsInterpolation(interpolation)


def everything(name):
    """Linear curves with different numbers of points, and with all data that strands may have."""
    stage = new_stage(name, unit=0.01)
    stage.GetRootLayer().documentation = 'made by "usd-core": ä\nsecond line'
    hair = curves(stage, "/head/hair", "linear", [3, 1, 4], points(7) + [(-0.0, 1e-40, 3e38)])
    widths(hair, "vertex", [(k + 1) / 30 for k in range(8)])
    hair.CreateDisplayColorPrimvar("uniform").Set([(0.1, 0.2, 0.3), (0.4, 0.5, 0.6), (1, 0, 0.7)])
    hair.CreateDisplayOpacityPrimvar("constant").Set([0.75])
    api = UsdGeom.PrimvarsAPI(hair)
    st = api.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "uniform")
    st.Set([(0.1, 0.9), (0.2, 0.8), (0.3, 0.7)])
    api.CreatePrimvar("id", Sdf.ValueTypeNames.IntArray, "uniform").Set([1, 2, 3])
    hair.CreateNormalsAttr([(0, 1, 0)] * 8)
    return stage


def transforms():
    """Z up; a prim under two Xforms, and a prototype with two instances."""
    stage = new_stage("transforms.usda", up="Z")
    UsdGeom.Xform.Define(stage, "/a").AddTranslateOp().Set(Gf.Vec3d(1, 2, 3))
    inner = UsdGeom.Xform.Define(stage, "/a/b")
    inner.AddRotateZOp().Set(90)
    inner.AddScaleOp().Set(Gf.Vec3f(2, 2, 2))
    hair = curves(stage, "/a/b/hair", "linear", [2], [(1, 2, 3), (4, 5, 6)])
    widths(hair, "constant", [0.5])
    stage.CreateClassPrim("/prototype")
    hair = curves(stage, "/prototype/hair", "linear", [2], [(0, 0, 0), (0, 0, 1)])
    widths(hair, "constant", [1.0])
    for i in range(2):
        instance = UsdGeom.Xform.Define(stage, f"/instance{i}")
        instance.GetPrim().GetReferences().AddInternalReference("/prototype")
        instance.GetPrim().SetInstanceable(True)
        instance.AddTranslateOp().Set(Gf.Vec3d(10 * (i + 1), 0, 0))
    UsdGeom.PointInstancer.Define(stage, "/scattered")
    curves(stage, "/scattered/prototype", "linear", [2], points(2))
    stage.Save()


def z_up():
    stage = new_stage("z_up.usdc", up="Z")
    curves(stage, "/hair", "linear", [3], points(3))
    stage.Save()


def cubic(stage, path, basis, wrap, sizes, interpolation):
    prim = curves(stage, path, "cubic", sizes, points(sum(sizes)), basis, wrap)
    # For pinned curves ComputeVaryingDataSize gives two less than the documentation's table.
    ends = sum(prim.ComputeSegmentCounts(Usd.TimeCode.Default())) + len(sizes)
    count = ends if interpolation == "varying" else sum(sizes)
    widths(prim, interpolation, [k + 1.0 for k in range(count)])


def cubics():
    stage = new_stage("cubics.usda")
    cubic(stage, "/bezier", "bezier", "nonperiodic", [4, 7], "vertex")
    cubic(stage, "/bspline", "bspline", "nonperiodic", [4, 6], "varying")
    cubic(stage, "/bspline_pinned", "bspline", "pinned", [2, 4], "varying")
    cubic(stage, "/catmull_rom", "catmullRom", "nonperiodic", [5, 6], "vertex")
    cubic(stage, "/catmull_rom_pinned", "catmullRom", "pinned", [3, 4], "varying")
    stage.Save()


def nurbs(stage, path, sizes, orders, knots, values=None):
    prim = UsdGeom.NurbsCurves.Define(stage, path)
    prim.CreateCurveVertexCountsAttr(sizes)
    prim.CreateOrderAttr(orders)
    prim.CreateKnotsAttr(knots)
    prim.CreatePointsAttr(points(sum(sizes)) if values is None else values)
    return prim


def curves_with_knots():
    stage = new_stage("nurbs.usda")
    nurbs(stage, "/quadratic", [4], [3], [0, 0, 0, 1, 3, 3, 3])
    mixed = nurbs(
        stage, "/orders", [6, 2, 3], [4, 2, 3],
        [0, 0, 0, 0, 1, 1.5, 4, 4, 4, 4] + [0, 0, 1, 1] + [-1, 0, 2, 3, 7, 9])
    widths(mixed, "vertex", [k + 1.0 for k in range(11)])
    nurbs(stage, "/uniform", [6], [4], list(range(10)))
    curves(stage, "/bspline", "cubic", [6], points(6), "bspline")
    circle = nurbs(
        stage, "/circle", [3], [3], [0, 0, 0, 1, 1, 1], [(1, 0, 0), (1, 1, 0), (0, 1, 0)])
    circle.CreatePointWeightsAttr([1, 2**-0.5, 1])
    part = nurbs(stage, "/part", [4], [3], [0, 0, 0, 1, 3, 3, 3])
    part.CreateRangesAttr([(0.5, 2)])
    widths(part, "varying", [1, 2, 4])
    stage.Save()
    stage = new_stage("nurbs_short.usda")
    flat = [0, 0, 0, 1, 1, 1]
    short = nurbs(stage, "/hair", [1, 3, 0, 3], [3], [0, 0, 0, 1] + flat + [0, 0, 0] + flat)
    widths(short, "varying", [1, 2, 4, 8, 16])
    stage.Save()


def refused_knots():
    """Files named after their fault."""
    flat = [0, 0, 0, 1, 1, 1]
    for name, sizes, orders, knots in (
            ("knots_few", [3], [3], flat[1:]), ("knots_fall", [3], [3], [0, 0, 0, 1, 1, 0]),
            ("knots_equal", [3], [3], [0] * 6), ("order_one", [3], [1], [0, 0, 1, 1]),
            ("order_high", [3], [4], flat + [1]), ("orders_many", [3], [3, 3], flat),
            ("knots_nan", [3], [3], flat[:5] + [float("nan")])):
        stage = new_stage(name + ".usda")
        nurbs(stage, "/hair", sizes, orders, knots)
        stage.Save()
    stage = new_stage("weight_zero.usda")
    nurbs(stage, "/hair", [3], [3], flat).CreatePointWeightsAttr([1, 0, 1])
    stage.Save()


def animated():
    stage = new_stage("animated.usd", unit=None)
    hair = curves(stage, "/hair", "linear", [2], None)
    for time in (5, 6, 8):
        hair.GetPointsAttr().Set([(time, 0, 0), (0, time, 0)], time)
    move = hair.AddTranslateOp()
    move.Set(Gf.Vec3d(0, 0, 100), 5)
    move.Set(Gf.Vec3d(0, 0, 200), 6)
    widths(hair, "constant", None)
    hair.GetWidthsAttr().Set([0.25], 5)
    stage.Save()


def mixed():
    """One prim has a primvar of widths with indices, one has none, and one holds a kind of curve
    that is not read."""
    stage = new_stage("mixed.usdc")
    first = curves(stage, "/first", "linear", [2], points(2))
    first.CreateDisplayColorPrimvar("constant").Set([(1, 0, 0)])
    primvar = UsdGeom.PrimvarsAPI(first).CreatePrimvar(
        "widths", Sdf.ValueTypeNames.FloatArray, "vertex")
    primvar.Set([0.5, 0.25])
    primvar.SetIndices(Vt.IntArray([1, 0]))
    widths(first, "constant", [9.0])  # primvars:widths takes precedence over it
    second = curves(stage, "/second", "linear", [2], points(2, 2))
    widths(second, "constant", [2.0])
    UsdGeom.HermiteCurves.Define(stage, "/third")
    stage.GetPrimAtPath("/second").GetReferences().AddReference("missing.usda")
    stage.Save()


def primvar(prim, name, kind, interpolation, values):
    api = UsdGeom.PrimvarsAPI(prim)
    api.CreatePrimvar(name, getattr(Sdf.ValueTypeNames, kind), interpolation).Set(values)


def groom():
    """Unreal Engine's names: guides as separate curves, and a group from a parent."""
    stage = new_stage("groom.usda")
    primvar(UsdGeom.Xform.Define(stage, "/groom"), "groom_group_id", "IntArray", "constant", [7])
    strands = curves(stage, "/groom/strands", "linear", [2, 3], points(5))
    primvar(strands, "groom_root_uv", "Float2Array", "uniform", [(0.1, 0.2), (0.3, 0.4)])
    primvar(strands, "groom_width", "FloatArray", "vertex", [1, 2, 3, 4, 5])
    primvar(strands, "groom_color", "Color3fArray", "uniform", [(1, 0, 0), (0, 1, 0)])
    primvar(strands, "groom_roughness", "FloatArray", "constant", [0.5])
    guides = curves(stage, "/groom/guides", "linear", [2], points(2, 5))
    primvar(guides, "groom_guide", "Int", "constant", 1)
    primvar(guides, "groom_group_id", "IntArray", "uniform", [-3])
    primvar(guides, "groom_root_uv", "TexCoord2fArray", "uniform", [(0.5, 0.6)])
    primvar(guides, "groom_width", "Float", "constant", 9.0)
    primvar(guides, "groom_color", "Color3fArray", "constant", [(0, 0, 1)])
    stage.Save()


def groups_of_floats():
    stage = new_stage("groups_of_floats.usda")
    prim = curves(stage, "/wig/hair", "linear", [4], points(4))
    primvar(prim, "groom_group_id", "FloatArray", "uniform", [0.5])
    stage.Save()
    stage = new_stage("groups_of_some.usda")
    prim = curves(stage, "/wig/hair", "linear", [2, 2], points(4))
    primvar(prim, "groom_group_id", "IntArray", "uniform", [1])
    stage.Save()


def float_units():
    """Writes the unit as a float, which usd-core itself never does. In the file's bytes, the type
    of its value is then different: a double that a float can represent."""
    for name, unit in ("float_unit", 0.5), ("float_centimetre", 0.5):
        stage = new_stage(f"{name}.usdc", unit=unit)
        curves(stage, "/hair", "linear", [2], points(2))
        stage.Save()
        with open(f"{name}.usdc", "rb") as file:
            content = file.read()
        double, float_type = 9, 8
        value = np.float32(unit).tobytes() + bytes([0, 0, double, 0x40])
        assert content.count(value) == 1
        wanted = np.float32(0.01 if name == "float_centimetre" else unit)
        with open(f"{name}.usdc", "wb") as file:
            file.write(content.replace(
                value, wanted.tobytes() + bytes([0, 0, float_type, 0x40])))


def refused():
    nan = float("nan")
    ok = points(4)
    for name, kind, sizes, values, options in [
        ("periodic", "linear", [4], ok, {"wrap": "periodic"}),
        ("negative_count", "linear", [-4, 8], ok, {}),
        ("huge_count", "linear", [2147483647], ok, {}),
        ("too_few_points", "linear", [5], ok, {}),
        ("no_points", "linear", [4], None, {}),
        ("nan", "linear", [4], ok[:2] + [(0, nan, 0)] + ok[3:], {}),
        ("infinite", "linear", [4], ok[:3] + [(0, 0, float("inf"))], {}),
        ("no_bezier", "cubic", [5], points(5), {"basis": "bezier"}),
        ("short_bspline", "cubic", [4, 3], points(7), {"basis": "bspline"}),
        ("basis", "cubic", [4], ok, {"basis": "hermite"}),
        ("kind", "quintic", [4], ok, {}),
    ]:
        stage = new_stage(f"{name}.usda")
        curves(stage, "/wig/hair", kind, sizes, values, **options)
        stage.Save()
    for name, interpolation, values in [
        ("few_widths", "vertex", [1.0, 2.0]),
        ("two_constants", "constant", [1.0, 2.0]),
        ("negative_width", "vertex", [1.0, 2.0, -3.0, 1.0]),
        ("nan_width", "constant", [nan]),
    ]:
        stage = new_stage(f"{name}.usda")
        widths(curves(stage, "/wig/hair", "linear", [4], ok), interpolation, values)
        stage.Save()
    stage = new_stage("overflow.usda")
    curves(stage, "/wig/hair", "linear", [2], [(1, 0, 0), (3e38, 0, 0)]).AddScaleOp().Set(
        Gf.Vec3f(4, 4, 4))
    stage.Save()
    stage = new_stage("triangles.usda")
    prim = curves(stage, "/wig/hair", "linear", [2, 2], ok).GetPrim()
    prim.CreateAttribute("hairbench:rootTriangles", Sdf.ValueTypeNames.Int3Array).Set([(0, 1, 2)])
    stage.Save()
    new_stage("bald.usda").Save()
    for name, content in [
        ("syntax.usda", '#usda 1.0\ndef X "a" { points = [( }'),
        ("words.usda", "hair"),
        ("short.usdc", "PXR-USDC and no more"),
        ("short.usdz", "PK"),
        ("empty.usd", ""),
    ]:
        with open(name, "w") as file:
            file.write(content)


for extension in ("usda", "usdc", "usd"):
    everything(f"everything.{extension}").Save()
UsdUtils.CreateNewUsdzPackage("everything.usdc", "everything.usdz")
transforms()
z_up()
cubics()
curves_with_knots()
refused_knots()
animated()
mixed()
groom()
groups_of_floats()
float_units()
refused()

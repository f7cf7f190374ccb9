"""Writes the files for usd_meshes_test.cpp with usd-core.

usage: make_usd_meshes.py FOLDER
"""

import os
import sys

from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel

os.chdir(sys.argv[1])

SQUARE = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]


def new_stage(name, up="Y", unit=1.0, per_second=24):
    stage = Usd.Stage.CreateNew(name + ".usda")
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, unit)
    stage.SetTimeCodesPerSecond(per_second)
    return stage


def mesh(stage, path, points=SQUARE, counts=(4,), corners=(0, 1, 2, 3)):
    prim = UsdGeom.Mesh.Define(stage, path)
    prim.CreateFaceVertexCountsAttr(list(counts))
    prim.CreateFaceVertexIndicesAttr(list(corners))
    prim.CreatePointsAttr(points)
    return prim


# Points at time codes 1001, 1013 and 1037, 24 a second, with z up and in cm.
stage = new_stage("cache", "Z", 0.01)
points = mesh(stage, "/head/skin").GetPointsAttr()
points.Clear()
points.Set([(x * 100, y * 100, 0) for x, y, _ in SQUARE], 1001)
points.Set([(x * 100, y * 100, 50 * y) for x, y, _ in SQUARE], 1013)
points.Set([(x * 100 + 20, y * 100, 50 * y) for x, y, _ in SQUARE], 1037)
stage.Save()

# A mesh at rest under a moving transform, and a mesh beside it that does not move.
stage = new_stage("moved")
UsdGeom.Xform.Define(stage, "/moves").AddTranslateOp().Set((0, 0, 0), 0)
UsdGeom.Xform(stage.GetPrimAtPath("/moves")).GetOrderedXformOps()[0].Set((0, 4, 0), 48)
mesh(stage, "/moves/one")
mesh(stage, "/stays", [(x, y, 5) for x, y, _ in SQUARE])
stage.Save()

# A skeleton of two joints. The second, at (0, 1, 0), turns about z from 0 at time code 0 to 90
# degrees at 24. The upper points follow it, the lower points follow the first joint.
stage = new_stage("skeleton")
root = UsdSkel.Root.Define(stage, "/root")
skeleton = UsdSkel.Skeleton.Define(stage, "/root/bones")
skeleton.CreateJointsAttr(["a", "a/b"])
up = Gf.Matrix4d().SetTranslate((0, 1, 0))
skeleton.CreateBindTransformsAttr([Gf.Matrix4d(1), up])
skeleton.CreateRestTransformsAttr([Gf.Matrix4d(1), up])
animation = UsdSkel.Animation.Define(stage, "/root/bones/turns")
animation.CreateJointsAttr(["a", "a/b"])
animation.CreateTranslationsAttr([(0, 0, 0), (0, 1, 0)])
animation.CreateScalesAttr([(1, 1, 1), (1, 1, 1)])
turned = Gf.Quatf(0.5**0.5, 0, 0, 0.5**0.5)
animation.CreateRotationsAttr().Set([Gf.Quatf(1), Gf.Quatf(1)], 0)
animation.GetRotationsAttr().Set([Gf.Quatf(1), turned], 24)
skin = mesh(stage, "/root/skin", [(0, 0, 0), (1, 0, 0), (1, 2, 0), (0, 2, 0)])
binding = UsdSkel.BindingAPI.Apply(skin.GetPrim())
binding.CreateSkeletonRel().SetTargets(["/root/bones"])
binding.CreateJointIndicesPrimvar(False, 1).Set([0, 0, 1, 1])
binding.CreateJointWeightsPrimvar(False, 1).Set([1.0, 1.0, 1.0, 1.0])
binding.CreateGeomBindTransformAttr(Gf.Matrix4d(1))
UsdSkel.BindingAPI.Apply(skeleton.GetPrim()).CreateAnimationSourceRel().SetTargets(
    ["/root/bones/turns"]
)
stage.Save()

# A quad and a triangle with a seam of texture coordinates, a subset of faces and a colour. A
# left-handed mesh. Prims that are not rendered.
stage = new_stage("surface")
skin = mesh(
    stage, "/head", SQUARE + [(2, 0, 0)], (4, 3), (0, 1, 2, 3, 1, 4, 2)
)
st = UsdGeom.PrimvarsAPI(skin).CreatePrimvar(
    "st", Sdf.ValueTypeNames.TexCoord2fArray, "faceVarying"
)
st.Set([(0, 0), (0.5, 0), (0.5, 1), (0, 1), (0.75, 0), (1, 0), (0.75, 1)])
skin.CreateDisplayColorPrimvar("constant").Set([(0.5, 0, 1)])
UsdGeom.Subset.CreateGeomSubset(skin, "scalp", "face", [1])
flipped = mesh(stage, "/flipped", [(x, y, 3) for x, y, _ in SQUARE])
flipped.CreateOrientationAttr("leftHanded")
mesh(stage, "/proxy").CreatePurposeAttr("proxy")
mesh(stage, "/hidden").CreateVisibilityAttr("invisible")
stage.Save()

# Refused meshes.
stage = new_stage("refused_corner")
mesh(stage, "/a", corners=(0, 1, 2, 4))
stage.Save()
stage = new_stage("refused_face")
mesh(stage, "/a", counts=(2, 2))
stage.Save()
stage = new_stage("refused_corners")
mesh(stage, "/a", counts=(4, 3))
stage.Save()
stage = new_stage("refused_topology")
corners = mesh(stage, "/a").GetFaceVertexIndicesAttr()
corners.Set([0, 1, 2, 3], 1)
corners.Set([3, 2, 1, 0], 2)
stage.Save()
stage = new_stage("refused_count")
points = mesh(stage, "/a").GetPointsAttr()
points.Set(SQUARE, 1)
points.Set(SQUARE + [(0, 0, 1)], 2)
stage.Save()
stage = new_stage("refused_number")
mesh(stage, "/a", [(0, 0, 0), (1, float("nan"), 0), (1, 1, 0), (0, 1, 0)])
stage.Save()
stage = new_stage("refused_empty")
UsdGeom.Xform.Define(stage, "/nothing")
stage.Save()

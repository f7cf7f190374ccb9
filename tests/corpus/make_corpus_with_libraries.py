"""Writes the corpus's files that others' programs write: see README.md.

usage: make_corpus_with_libraries.py [FOLDER]    (this folder)
needs: pip install numpy==2.4.6 plyfile==1.1.5 trimesh==5.2.0 vtk==9.7.2 alembic3d==1.8.12.1
"""

import os
import sys

import imath
import numpy as np
import trimesh
import vtk
from alembic3d import Abc, AbcGeom
from plyfile import PlyData, PlyElement
from trimesh.path import Path3D
from trimesh.path.entities import Line

# Three strands, of 4, 2 and 3 points; powers of two, so that every decimal is exact.
POINTS = np.array([
    (0, 0, 0), (0, 0.25, 0), (0, 0.5, 0.125), (0, 0.75, 0.5),
    (1, 0, 0), (1, 0.5, 0.25),
    (-1, 0, 0), (-1.5, 0.25, 0), (-2, 0.25, -0.0625)], "f4")
STRANDS = [range(0, 4), range(4, 6), range(6, 9)]
COLORS = [(255, 0, 51), (0, 255, 102), (10, 20, 30)]  # of the strands


def ply_files(folder):
    vertices = np.array(
        [(*POINTS[k], (1 - k / 16) / 16, *color)
         for strand, color in zip(STRANDS, COLORS) for k in strand],
        dtype=[("x", "f4"), ("y", "f4"), ("z", "f4"), ("radius", "f4"),
               ("red", "u1"), ("green", "u1"), ("blue", "u1")])
    edges = np.array(
        [(k, k + 1, 7) for strand in STRANDS for k in strand[:-1]],
        dtype=[("vertex1", "i4"), ("vertex2", "i4"), ("red", "u1")])
    lists = np.empty(3, dtype=[("vertex_indices", "O"), ("id", "i2")])
    for k, strand in enumerate(STRANDS):
        lists[k] = (np.array(strand[::-1], dtype="i4"), k)
    for name, is_text, order in (("ascii", True, "="), ("little", False, "<"), ("big", False, ">")):
        PlyData(
            [PlyElement.describe(vertices, "vertex"), PlyElement.describe(edges, "edge")],
            text=is_text, byte_order=order, comments=["edges", "by plyfile"],
        ).write(os.path.join(folder, f"plyfile_edges_{name}.ply"))
        PlyData(
            [PlyElement.describe(lists, "strand", len_types={"vertex_indices": "u2"}),
             PlyElement.describe(vertices, "vertex")],
            text=is_text, byte_order=order,
        ).write(os.path.join(folder, f"plyfile_strands_{name}.ply"))


def gltf_files(folder):
    def write(scene, name):
        with open(os.path.join(folder, name), "wb") as out:
            out.write(scene.export(file_type="glb"))

    path = Path3D(
        entities=[Line(list(strand)) for strand in STRANDS], vertices=POINTS.astype(float),
        process=False)
    scene = trimesh.Scene([path])
    scene.units = "m"
    write(scene, "trimesh_lines.glb")
    scene = trimesh.Scene()
    scene.add_geometry(trimesh.creation.box(), geom_name="head")
    scene.add_geometry(path, geom_name="hair")
    write(scene, "trimesh_head_and_lines.glb")


def obj_files(folder):
    points = vtk.vtkPoints()
    points.SetDataTypeToFloat()
    for point in POINTS:
        points.InsertNextPoint(*map(float, point))
    cells = vtk.vtkCellArray()
    for strand in STRANDS:
        cells.InsertNextCell(len(strand), list(strand))
    data = vtk.vtkPolyData()
    data.SetPoints(points)
    data.SetLines(cells)
    writer = vtk.vtkOBJWriter()
    writer.SetFileName(os.path.join(folder, "vtk_lines.obj"))
    writer.SetInputData(data)
    writer.Write()


# alembic3d's samples borrow arrays: one that nobody else holds is overwritten before it is written.
BORROWED = []


def imath_array(kind, values):
    array = kind(len(values))
    for i, value in enumerate(values):
        array[i] = value
    BORROWED.append(array)
    return array


def imath_points(points):
    return imath_array(imath.V3fArray, [imath.V3f(*map(float, point)) for point in points])


def imath_floats(values):
    return imath_array(imath.FloatArray, [float(value) for value in values])


SCOPES = AbcGeom.GeometryScope


def parameter(parent, kind, name, array, scope):
    made = getattr(AbcGeom, f"O{kind}GeomParam")(parent, name, False, scope, 1)
    made.set(getattr(AbcGeom, f"O{kind}GeomParamSample")(array, scope))


def curves_sample(points, sizes, kind=AbcGeom.CurveType.kLinear, basis="kNoBasis", widths=None):
    sample = AbcGeom.OCurvesSchemaSample(
        imath_points(points), imath_array(imath.IntArray, sizes), kind,
        AbcGeom.CurvePeriodicity.kNonPeriodic)
    sample.setBasis(AbcGeom.BasisType.names[basis])
    if widths is not None:
        sample.setWidths(AbcGeom.OFloatGeomParamSample(imath_floats(widths), SCOPES.kVertexScope))
    return sample


def abc_files(folder):
    """Every property of Epic's schema; two objects, moving and turned; cubic curves."""
    def archive(name):
        return Abc.OArchive(os.path.join(folder, f"alembic_{name}.abc"))

    sizes = [len(strand) for strand in STRANDS]
    groom = archive("groom")
    transform = AbcGeom.OXform(groom.getTop(), "hair")
    transform.getSchema().set(AbcGeom.XformSample())
    version = imath_array(imath.ShortArray, [1])
    parameter(
        transform.getSchema().getArbGeomParams(), "Int16", "groom_version_major", version,
        SCOPES.kConstantScope)
    schema = AbcGeom.OCurves(transform, "strands").getSchema()
    schema.set(curves_sample(POINTS, sizes, widths=[(1 - k / 16) / 8 for k in range(9)]))
    own = schema.getArbGeomParams()
    uniform = SCOPES.kUniformScope
    parameter(own, "Int32", "groom_group_id", imath_array(imath.IntArray, [3, 4, 3]), uniform)
    parameter(own, "Int16", "groom_guide", imath_array(imath.ShortArray, [1, 0, 0]), uniform)
    uvs = imath_array(imath.V2fArray, [imath.V2f(k / 4, k / 8) for k in range(3)])
    parameter(own, "V2f", "groom_root_uv", uvs, uniform)
    colors = imath_array(imath.C3fArray, [imath.Color3f(k / 8, 0.5, 0.25) for k in range(9)])
    parameter(own, "C3f", "groom_color", colors, SCOPES.kVertexScope)
    names = imath_array(imath.StringArray, ["top", "sides", "top"])
    parameter(own, "String", "groom_group_name", names, uniform)
    del own, schema, transform, groom

    objects = archive("objects")
    for name, strands in (("a", STRANDS[:1]), ("b", STRANDS[1:])):
        transform = AbcGeom.OXform(objects.getTop(), name)
        turn = AbcGeom.XformSample()
        turn.setTranslation(imath.V3d(1, 2, 3))
        turn.setRotation(imath.V3d(0, 0, 1), 90.0)
        turn.setScale(imath.V3d(2, 2, 2))
        transform.getSchema().set(turn)
        schema = AbcGeom.OCurves(transform, name + "Shape").getSchema()
        points = [POINTS[k] for strand in strands for k in strand]
        for frame in range(2):
            moved = [point + frame for point in points]
            schema.set(curves_sample(moved, [len(strand) for strand in strands]))
    del schema, transform, objects

    cubic = archive("cubic")
    corners = [(0, 0, 0), (0, 1, 0), (1, 1, 0), (1, 0, 0)]
    for name, basis in (
            ("bezier", "kBezierBasis"), ("bspline", "kBsplineBasis"),
            ("catmull_rom", "kCatmullromBasis")):
        schema = AbcGeom.OCurves(cubic.getTop(), name).getSchema()
        schema.set(curves_sample(corners, [4], AbcGeom.CurveType.kCubic, basis))


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    for name, write in (
            ("ply", ply_files), ("gltf", gltf_files), ("obj", obj_files), ("abc", abc_files)):
        folder = os.path.join(root, name)
        os.makedirs(folder, exist_ok=True)
        write(folder)


main()

"""Writes the corpus's files that others' programs write: see README.md.

usage: make_corpus_with_libraries.py [FOLDER]    (this folder)
needs: pip install numpy==2.4.6 plyfile==1.1.5 trimesh==5.2.0 vtk==9.7.2
"""

import os
import sys

import numpy as np
import trimesh
import vtk
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


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    for name, write in (("ply", ply_files), ("gltf", gltf_files), ("obj", obj_files)):
        folder = os.path.join(root, name)
        os.makedirs(folder, exist_ok=True)
        write(folder)


main()

"""Writes the corpus's files that Blender writes: see README.md. They have the date in them.

usage: make_corpus_with_blender.py [FOLDER]    (this folder)
needs: pip install bpy==4.5.15    (Python 3.11)
"""

import os
import sys

import bpy

# Three strands, of 4, 2 and 3 points, as in make_corpus_with_libraries.py. Blender's z is up: it
# writes (x, y, z) as (x, z, -y).
POINTS = [
    (0, 0, 0), (0, 0.25, 0), (0, 0.5, 0.125), (0, 0.75, 0.5),
    (1, 0, 0), (1, 0.5, 0.25),
    (-1, 0, 0), (-1.5, 0.25, 0), (-2, 0.25, -0.0625)]
SIZES = [4, 2, 3]


def hair(kind):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    curves = bpy.data.hair_curves.new("strands")
    curves.add_curves(SIZES)
    curves.set_types(type=kind)
    numbers = [number for x, y, z in POINTS for number in (x, -z, y)]
    curves.attributes["position"].data.foreach_set("vector", numbers)
    radius = curves.attributes.get("radius") or curves.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", [(1 - k / 16) / 16 for k in range(len(POINTS))])
    placed = bpy.data.objects.new("hair", curves)
    placed.location = (1, 2, 3)
    bpy.context.scene.collection.objects.link(placed)
    bpy.context.view_layer.update()


def main():
    root = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    folder = os.path.join(root, "abc")
    os.makedirs(folder, exist_ok=True)
    for kind in ("CATMULL_ROM", "POLY"):
        hair(kind)
        path = os.path.join(folder, f"blender_{kind.lower()}.abc")
        bpy.ops.wm.alembic_export(filepath=path, start=1, end=1)


main()

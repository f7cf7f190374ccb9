"""Writes the corpus's files that Blender writes: see README.md. They have the date in them.

usage: make_corpus_with_blender.py [FOLDER]    (this folder)
       make_corpus_with_blender.py --compare HAIRBENCH
needs: pip install bpy==4.5.15    (Python 3.11)

The second form changes nothing: HAIRBENCH converts Blender's files "for Blender", Blender reads the results,
and differences between them and what Blender wrote at first are printed.
"""

import os
import subprocess
import sys
import tempfile

import bpy

# Three strands, of 4, 2 and 3 points, as in make_corpus_with_libraries.py. Blender's z is up: it
# writes (x, y, z) as (x, z, -y).
POINTS = [
    (0, 0, 0), (0, 0.25, 0), (0, 0.5, 0.125), (0, 0.75, 0.5),
    (1, 0, 0), (1, 0.5, 0.25),
    (-1, 0, 0), (-1.5, 0.25, 0), (-2, 0.25, -0.0625)]
SIZES = [4, 2, 3]
PLACE = (1, 2, 3)
NUMBERS = [number for x, y, z in POINTS for number in (x, -z, y)]
RADII = [(1 - k / 16) / 16 for k in range(len(POINTS))]

# Groups and guides: one object has them as custom properties, the other as attributes of its curves.
GROUP, GROUPS = 3, [7, 8, 9]
GUIDES = [0, 1, 0]

FOLDER = os.path.dirname(os.path.abspath(__file__))


def hair(kind, name="hair"):
    curves = bpy.data.hair_curves.new("strands")
    curves.add_curves(SIZES)
    curves.set_types(type=kind)
    curves.attributes["position"].data.foreach_set("vector", NUMBERS)
    radius = curves.attributes.get("radius") or curves.attributes.new("radius", "FLOAT", "POINT")
    radius.data.foreach_set("value", RADII)
    return place(bpy.data.objects.new(name, curves))


def place(placed):
    placed.location = PLACE
    bpy.context.scene.collection.objects.link(placed)
    bpy.context.view_layer.update()
    return placed


def groups():
    empty()
    hair("POLY", "by_properties")["groom_group_id"] = GROUP
    curves = hair("POLY", "by_attributes").data
    for name, values in (("groom_group_id", GROUPS), ("groom_guide", GUIDES)):
        curves.attributes.new(name, "INT", "CURVE").data.foreach_set("value", values)


def head_and_lines():
    """A ball with texture coordinates, and strands as loose edges, the only lines of glTF's exporter."""
    empty()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=8, ring_count=5, radius=0.5, location=PLACE)
    bpy.context.object.name = "head"
    ends = [sum(SIZES[:i + 1]) for i in range(len(SIZES))]
    edges = [(k, k + 1) for k in range(len(POINTS) - 1) if k + 1 not in ends]
    mesh = bpy.data.meshes.new("strands")
    mesh.from_pydata([NUMBERS[3 * k:3 * k + 3] for k in range(len(POINTS))], edges, [])
    strands = place(bpy.data.objects.new("hair", mesh))
    strands["groom_group_id"], strands["groom_guide"] = GROUP, 1


def empty():
    bpy.ops.wm.read_factory_settings(use_empty=True)


def file(root, *names):
    path = os.path.join(root, *names)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    return path


def write(root):
    for kind in ("CATMULL_ROM", "POLY"):
        empty()
        hair(kind)
        bpy.ops.wm.alembic_export(filepath=file(root, "abc", f"blender_{kind.lower()}.abc"), start=1, end=1)
    groups()
    bpy.ops.wm.alembic_export(
        filepath=file(root, "abc", "blender_groups.abc"), start=1, end=1, export_custom_properties=True)
    for name, unit in (("groups.usda", "METERS"), ("groups.usdc", "METERS"), ("centimetres.usda", "CENTIMETERS")):
        bpy.ops.wm.usd_export(
            filepath=file(root, "usd", f"blender_{name}"), convert_scene_units=unit, export_custom_properties=True)
    head_and_lines()
    for name, compressed in (("draco", True), ("plain", False)):
        bpy.ops.export_scene.gltf(
            filepath=file(root, "gltf", f"blender_{name}.glb"), use_mesh_edges=True, export_extras=True,
            export_materials="NONE", export_draco_mesh_compression_enable=compressed)


def strands_of(path):
    """Reads a file as Blender does: positions, radii, groups and guides of all curves of the scene."""
    empty()
    if path.endswith(".abc"):
        bpy.ops.wm.alembic_import(filepath=path)
    else:
        bpy.ops.wm.usd_import(filepath=path)
    bpy.context.view_layer.update()
    positions, radii, numbers = [], [], {"groom_group_id": [], "groom_guide": []}
    for placed in sorted(bpy.data.objects, key=lambda each: each.name):
        if placed.type != "CURVES":
            continue
        attributes, curves = placed.data.attributes, len(placed.data.curves)
        points = [placed.matrix_world @ point.vector for point in attributes["position"].data]
        positions += [tuple(point) for point in points]
        radii += [each.value for each in attributes["radius"].data] if "radius" in attributes else []
        for name, values in numbers.items():
            if name in attributes and len(attributes[name].data) == curves:
                values += [each.value for each in attributes[name].data]
    return positions, radii, numbers


def compare(program):
    failed = False
    with tempfile.TemporaryDirectory() as folder:
        for source in ("usd/blender_groups.usda", "usd/blender_groups.usdc", "usd/blender_centimetres.usda",
                       "abc/blender_groups.abc"):
            for extension in (".usda", ".abc"):
                to = os.path.join(folder, "strands" + extension)
                # Alembic states no unit.
                stated = ["--scale", "1", "--from-up", "y"] if source.endswith(".abc") else []
                subprocess.run(
                    [program, "groom", "convert", os.path.join(FOLDER, source), to, "--for", "blender",
                     *stated], check=True, stdout=subprocess.DEVNULL)
                positions, radii, numbers = strands_of(to)
                wanted = [tuple(p + t for p, t in zip(NUMBERS[3 * k:3 * k + 3], PLACE)) for k in range(len(POINTS))] * 2
                off = [abs(a - b) for p, q in zip(positions, wanted) for a, b in zip(p, q)]
                wide = [abs(a - b) for a, b in zip(radii, RADII * 2)]
                right = len(positions) == len(wanted) and max(off) < 1e-6 and len(wide) == len(wanted) and max(wide) < 1e-7
                # Blender writes no attributes of curves to Alembic and reads none from it.
                if extension == ".usda" and not source.endswith(".abc"):
                    groups_wanted = [GROUP] * len(SIZES) + GROUPS
                    right &= sorted(numbers["groom_group_id"]) == sorted(groups_wanted)
                    right &= sum(numbers["groom_guide"]) == sum(GUIDES)
                print(f"{source} -> {extension}: {'equal' if right else 'differs'}; {len(positions)} points, "
                      f"off by {max(off, default=0):.1g}, radii by {max(wide, default=0):.1g}, {numbers}")
                failed |= not right
    return failed


if "--compare" in sys.argv:
    sys.exit(compare(sys.argv[-1]))
write(sys.argv[1] if len(sys.argv) > 1 else FOLDER)

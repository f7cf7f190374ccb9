"""Writes the corpus's files that come from the formats' descriptions alone: see README.md.

usage: make_corpus.py [FOLDER]    (this folder; Python's own library is enough)
"""

import base64
import json
import os
import struct
import sys

# Three strands, of 4, 2 and 3 points; powers of two, so that every decimal is exact.
POINTS = [
    (0, 0, 0), (0, 0.25, 0), (0, 0.5, 0.125), (0, 0.75, 0.5),
    (1, 0, 0), (1, 0.5, 0.25),
    (-1, 0, 0), (-1.5, 0.25, 0), (-2, 0.25, -0.0625),
]
SIZES = [4, 2, 3]
# Two strands of four points.
UNIFORM = POINTS[:4] + [(2 - x, y, z) for x, y, z in POINTS[:4]]


def floats(rows):
    numbers = [x for row in rows for x in (row if isinstance(row, tuple) else (row,))]
    return struct.pack(f"<{len(numbers)}f", *numbers)


def hair(hairs, points, arrays, default_segments=0, info=b""):
    """Cem Yuksel's HAIR: header of 128 bytes, then what `arrays` holds by bit."""
    bits = sum(1 << bit for bit in arrays)
    header = struct.pack("<4s4I", b"HAIR", hairs, points, bits, default_segments)
    header += struct.pack("<5f88s", 0.25, 0.125, 0.5, 0.25, 0.125, info)
    return header + b"".join(arrays[bit] for bit in sorted(arrays))


def hair_files():
    segments = struct.pack("<3H", *(size - 1 for size in SIZES))
    widths = floats([0.01 * (9 - k) for k in range(9)])
    transparencies = floats([k / 16 for k in range(9)])
    colors = floats([(k / 16, 0.5, 1 - k / 16) for k in range(9)])
    yield "all_arrays.hair", hair(
        3, 9, {0: segments, 1: floats(POINTS), 2: widths, 3: transparencies, 4: colors},
        info=b"three strands")
    yield "points_only.hair", hair(2, 8, {1: floats(UNIFORM)}, default_segments=3)
    yield "single_points.hair", hair(9, 9, {1: floats(POINTS)}, info=b"i" * 88)
    yield "segments_and_colors.hair", hair(3, 9, {0: segments, 1: floats(POINTS), 4: colors})


def tfx(strands, vertices, arrays):
    """TressFX 4: header of 160 bytes with the offset of each of five arrays, None where absent."""
    offsets, body = [], b""
    for array in arrays:
        offsets.append(160 + len(body) if array is not None else 0)
        body += array or b""
    return struct.pack("<f7I128x", 4.0, strands, vertices, *offsets) + body


def tfx_files():
    positions = floats([(*p, 0 if k % 4 < 2 else 1) for k, p in enumerate(UNIFORM)])
    yield "positions_only.tfx", tfx(2, 4, [positions, None, None, None, None])
    yield "all_arrays.tfx", tfx(2, 4, [
        positions,
        floats([(0.25, 0.75), (0.5, 0.5)]),
        floats([(k / 8, 0.5) for k in range(8)]),
        floats([0.01, 0.02]),
        floats([(k / 8, 0.5, 0.25, 1 - k / 16) for k in range(8)])])


def hgl(strands, segments, points, triangles):
    """The thesis's guides."""
    header = struct.pack("<3i", strands, segments, len(triangles))
    return header + floats(points) + b"".join(struct.pack("<3i", *row) for row in triangles)


def hgl_files():
    third = [(x, y, z + 1) for x, y, z in UNIFORM[:4]]
    yield "three_guides.hgl", hgl(3, 3, UNIFORM + third, [(0, 1, 2)])
    yield "one_guide.hgl", hgl(1, 3, UNIFORM[:4], [(0, 0, 0)])
    yield "no_triangles.hgl", hgl(2, 3, UNIFORM, [])


def gltf(mode, indices=None):
    """glTF 2.0 with its buffer in the file: a line primitive for each strand or one for all."""
    buffer = floats(POINTS)
    views = [{"buffer": 0, "byteOffset": 0, "byteLength": len(buffer)}]
    accessors, primitives, first = [], [], 0
    for size in [9] if indices else SIZES:
        part = POINTS[first:first + size]
        accessors.append({
            "bufferView": 0, "byteOffset": 12 * first, "componentType": 5126, "count": size,
            "type": "VEC3", "min": [min(x) for x in zip(*part)],
            "max": [max(x) for x in zip(*part)]})
        primitives.append({"attributes": {"POSITION": len(accessors) - 1}, "mode": mode})
        first += size
    if indices:
        views.append({
            "buffer": 0, "byteOffset": len(buffer), "byteLength": 2 * len(indices)})
        accessors.append({
            "bufferView": 1, "componentType": 5123, "count": len(indices), "type": "SCALAR"})
        primitives[0]["indices"] = len(accessors) - 1
        buffer += struct.pack(f"<{len(indices)}H", *indices)
    data = base64.b64encode(buffer).decode()
    return json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "translation": [0, 1, 0]}],
        "meshes": [{"primitives": primitives}],
        "accessors": accessors, "bufferViews": views,
        "buffers": [{
            "byteLength": len(buffer), "uri": f"data:application/octet-stream;base64,{data}"}],
    }, indent=1).encode()


def gltf_files():
    lines, line_strip = 1, 3
    yield "strips.gltf", gltf(line_strip)
    yield "lines.gltf", gltf(lines, [0, 1, 1, 2, 2, 3, 4, 5, 6, 7, 7, 8])


def usda(kind, sizes, points, more=""):
    rows = ", ".join(f"({x:g}, {y:g}, {z:g})" for x, y, z in points)
    return f"""#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
)
def BasisCurves "hair"
{{
    uniform token type = "{kind}"
    int[] curveVertexCounts = {sizes}
    point3f[] points = [{rows}]
{more}}}
""".encode()


def usd_files():
    yield "linear.usda", usda("linear", SIZES, POINTS)
    yield "bezier.usda", usda(
        "cubic", [4, 4], UNIFORM,
        '    uniform token basis = "bezier"\n    float[] widths = [0.5] (\n'
        '        interpolation = "constant"\n    )\n')


def obj_files():
    vertices = "".join(f"v {x:g} {y:g} {z:g}\n" for x, y, z in POINTS)
    pairs = "l 1 2\nl 2 3\nl 3 4\nl 5 6\nl 7 8\nl 8 9\n"
    yield "segments.obj", f"# as editors write curves\no hair\n{vertices}{pairs}".encode()


# What a reader must not believe: counts that ask for gigabytes, products that wrap in 32 bits,
# arrays that lie on each other.
def hostile_hair_files():
    yield "four_billion_strands.hair", hair(2**32 - 1, 0, {1: b""}, default_segments=2**32 - 1)
    yield "four_billion_points.hair", hair(1, 2**32 - 1, {1: b""}, default_segments=2**32 - 2)
    yield "segments_past_the_end.hair", hair(
        1, 2, {0: struct.pack("<H", 65535), 1: floats(POINTS[:2])})


def hostile_tfx_files():
    positions = floats([(*p, 1) for p in UNIFORM])
    # 2^16 strands of 2^16 vertices are 2^32, 0 in 32 bits.
    yield "vertices_wrap.tfx", tfx(2**16, 2**16, [positions, None, None, None, None])
    yield "uvs_on_positions.tfx", struct.pack(
        "<f7I128x", 4.0, 2, 4, 160, 176, 0, 0, 0) + positions


def hostile_hgl_files():
    yield "two_billion_strands.hgl", struct.pack("<3i", 2**31 - 1, 255, 2**31 - 1)
    yield "negative_counts.hgl", struct.pack("<3i", -1, -1, -1)


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    families = {
        "hair": hair_files, "tfx": tfx_files, "hgl": hgl_files, "gltf": gltf_files,
        "usd": usd_files, "obj": obj_files,
        "findings/hair": hostile_hair_files, "findings/tfx": hostile_tfx_files,
        "findings/hgl": hostile_hgl_files}
    for name, files in families.items():
        os.makedirs(os.path.join(folder, name), exist_ok=True)
        for file, content in files():
            with open(os.path.join(folder, name, file), "wb") as out:
                out.write(content)


main()

"""Writes the corpus's files that come from the formats' descriptions alone: see README.md.

usage: make_corpus.py [FOLDER]    (this folder; Python's own library is enough)
"""

import base64
import json
import os
import struct
import sys
import zlib

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
    yield "segments_and_colors.hair", hair(3, 9, {0: segments, 1: floats(POINTS), 4: colors})


def monohair(sizes, points, stated=None):
    """MonoHair's strands: two counts, the points of each strand, then all points."""
    stated = sum(sizes) if stated is None else stated
    return struct.pack(f"<2I{len(sizes)}H", len(sizes), stated, *sizes) + floats(points)


def monohair_files():
    yield "monohair.hair", monohair(SIZES, POINTS)


def mitsuba_files():
    """Mitsuba's hair: binary, text of Mitsuba 3's curves, and text of the older plug-in."""
    start = struct.pack("<f", float("inf"))
    strands, first = [], 0
    for size in SIZES:
        strands.append(POINTS[first:first + size])
        first += size
    yield "binary.mitshair", b"BINARY_HAIR" + struct.pack("<I", 9) + b"".join(
        (start if k > 0 else b"") + floats(points) for k, points in enumerate(strands))
    yield "radii.txt", "\n\n".join(
        "\n".join(f"{x:g} {y:g} {z:g} 0.25" for x, y, z in points)
        for points in strands).encode()
    yield "comments.txt", "".join(
        "# a strand\n" + "".join(f"{x:g} {y:g} {z:g}\r\n" for x, y, z in points)
        for points in strands).encode()


def pbrt_files():
    """Curves of pbrt: straight segments, and smooth ones under a transform."""
    def listed(points):
        return " ".join(f"{x:g} {y:g} {z:g}" for x, y, z in points)
    yield "bezier.pbrt", f"""# two curves
WorldBegin
Material "hair" "rgb sigma_a" [0.5 1 1.5]
Shape "curve" "string type" "cylinder" "float width0" 0.5 "float width1" [ 0.25 ] "point3 P" [
    {listed(UNIFORM[:4])} ]
AttributeBegin
    Translate 2 0 0
    Shape "curve" "point P" [ {listed(UNIFORM[4:])} ] "float width" 0.5
AttributeEnd
Shape "sphere" "float radius" 1
""".encode()
    yield "bspline.pbrt", f"""Shape "curve" "string basis" [ "bspline" ] "integer degree" [ 2 ]
    "point3 P" [ {listed(UNIFORM[:4])} ]
Shape "curve" "string basis" "bspline" "point3 P" [ {listed(UNIFORM)} ]
""".encode()


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
    yield from tfx_of_older_versions()


def tfx3(strands, vertices, arrays):
    """TressFX 3.1: header of 296 bytes with the offset of each of six arrays, None where absent."""
    offsets, body = [], b""
    for array in arrays:
        offsets.append(296 + len(body) if array is not None else 0)
        body += array or b""
    return struct.pack("<f4I124x6I128x", 3.0, strands, vertices, 4, 0, *offsets) + body


def tfx_of_older_versions():
    yield "version_3.tfx", tfx3(2, 4, [
        floats(UNIFORM), floats([0.01, 0.02]), floats([(0.25, 0.75), (0.5, 0.5)]), None, None,
        floats([(k / 8, 0.5) for k in range(8)])])
    text = ["version 2.0", "scale 1.0", "rotation 0 0 0", "translation 0 0 0",
            "bothEndsImmovable 0", "maxNumVerticesInStrand 4", "numFollowHairsPerGuideHair 4",
            "maxRadiusAroundGuideHair 0.5", "numStrands 2", "is sorted 1"]
    for strand in range(2):
        text.append(f"strand {strand} numVerts 4 texcoord 0.5 0.000000")
        text += [f"{x:g} {y:g} {z:g}" for x, y, z in UNIFORM[4 * strand:4 * strand + 4]]
    yield "version_2.tfx", ("\n".join(text) + "\n").encode()


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


def zigzag(number):
    return 2 * number if number >= 0 else -2 * number - 1


def meshopt_attributes(elements):
    """EXT_meshopt_compression, mode 0, of elements of up to 32 bytes: each byte of the elements by itself,
    differences to the one before it in groups of 16, each with its number of bits."""
    stride, data, last = len(elements[0]), bytearray(b"\xa0"), elements[0]
    assert len(elements) <= 256 and stride <= 32
    for byte in range(stride):
        column = [row[byte] for row in [last, *elements]]
        steps = [zigzag((b - a + 128) % 256 - 128) for a, b in zip(column, column[1:])]
        steps += [0] * (-len(steps) % 16)
        groups, headers = b"", 0
        for number, group in enumerate(steps[i:i + 16] for i in range(0, len(steps), 16)):
            kind = 0 if not any(group) else 1 if max(group) < 3 else 3
            headers |= kind << 2 * number
            if kind == 1:  # four to a byte, the first in the highest bits
                groups += bytes(a << 6 | b << 4 | c << 2 | d for a, b, c, d in zip(*[iter(group)] * 4))
            elif kind == 3:
                groups += bytes(group)
        data += headers.to_bytes((len(steps) // 16 + 3) // 4, "little") + groups
    return bytes(data) + bytes(32 - stride) + last


def meshopt_indices(indices):
    """EXT_meshopt_compression, mode 2: differences to the index before, in groups of 7 bits."""
    data, last = bytearray(b"\xd1"), 0
    for index in indices:
        step, last = 2 * zigzag(index - last), index
        while step > 127:
            data.append(step % 128 + 128)
            step //= 128
        data.append(step)
    return bytes(data) + bytes(4)


def meshopt_gltf():
    """Lines as in lines.gltf, compressed, with a second buffer that only stands for the result."""
    lines = [0, 1, 1, 2, 2, 3, 4, 5, 6, 7, 7, 8]
    parts = [meshopt_attributes([floats([point]) for point in POINTS]), meshopt_indices(lines)]
    name = "EXT_meshopt_compression"
    views, first, result = [], 0, 0
    for part, (mode, stride, count) in zip(parts, [("ATTRIBUTES", 12, 9), ("INDICES", 2, 12)]):
        views.append({"buffer": 1, "byteOffset": result, "byteLength": stride * count, "extensions": {name: {
            "buffer": 0, "byteOffset": first, "byteLength": len(part), "byteStride": stride, "mode": mode,
            "count": count}}})
        first, result = first + len(part), result + stride * count
    data = base64.b64encode(b"".join(parts)).decode()
    return json.dumps({
        "asset": {"version": "2.0"}, "extensionsUsed": [name], "extensionsRequired": [name],
        "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, "translation": [0, 1, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 9, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 12, "type": "SCALAR"}],
        "bufferViews": views,
        "buffers": [
            {"byteLength": first, "uri": f"data:application/octet-stream;base64,{data}"},
            {"byteLength": result, "extensions": {name: {"fallback": True}}}]}, indent=1).encode()


def gltf_files():
    lines, line_strip = 1, 3
    yield "meshopt.gltf", meshopt_gltf()
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


def listed(sizes, points, beside=()):
    """USC-HairSalon's .data, or CT2Hair's .bin where each point has numbers beside it."""
    body, first = struct.pack("<i", len(sizes)), 0
    for size in sizes:
        rows = [tuple(p) + tuple(beside) for p in points[first:first + size]]
        body += struct.pack("<i", size) + floats(rows)
        first += size
    return body


def data_files():
    yield "three_strands.data", listed(SIZES, POINTS)
    yield "empty_strand.data", listed([4, 0, 5], POINTS)


def bin_files():
    yield "two_strands.bin", listed([5, 5], POINTS + POINTS[:1], (0, 1, 0, 0))
    nan = [(float("nan"), 0, 0)]
    yield "short_and_nan.bin", listed([3, 5, 6], POINTS[:8] + POINTS[:5] + nan, (0, 0, 0, 0))


def npy(kind, shape, numbers, fortran=False):
    """NumPy's array, version 1.0, without the padding that it need not have."""
    header = f"{{'descr': '{kind}', 'fortran_order': {fortran}, 'shape': {shape}}}".encode()
    return b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header + numbers


def npy_files():
    yield "two_strands.npy", npy("<f4", (2, 4, 3), floats(UNIFORM))
    doubles = [c for column in zip(*UNIFORM) for c in column]  # one strand: points run faster
    yield "doubles_fortran.npy", npy(
        "<f8", (1, 8, 3), struct.pack("<24d", *doubles), fortran=True)


def npz(method, members):
    """A zip archive: local headers with contents, the directory, its end."""
    body, directory = b"", b""
    for name, content in members.items():
        packer = zlib.compressobj(9, zlib.DEFLATED, -15)
        packed = content if method == 0 else packer.compress(content) + packer.flush()
        common = struct.pack(
            "<5H3I2H", 20, 0, method, 0, 33, zlib.crc32(content), len(packed), len(content),
            len(name), 0)
        directory += b"PK\1\2" + struct.pack("<H", 20) + common
        directory += struct.pack("<3H2I", 0, 0, 0, 0, len(body)) + name.encode()
        body += b"PK\3\4" + common + name.encode() + packed
    end = struct.pack(
        "<4H2IH", 0, 0, len(members), len(members), len(directory), len(body), 0)
    return body + directory + b"PK\5\6" + end


def npz_files():
    members = {
        "positions.npy": npy("<f4", (2, 4, 3), floats(UNIFORM)),
        "root_uv.npy": npy("<f4", (2, 2), floats([(0.25, 0.75), (0.5, 0.5)])),
        "root_normal.npy": npy("<f4", (2, 3), floats([(0, 1, 0), (0, 1, 0)]))}
    yield "difflocks.npz", npz(0, members)
    yield "difflocks_deflated.npz", npz(8, members)
    yield "groups_and_guides.npz", npz(8, {
        "strands.npy": members["positions.npy"],
        "widths.npy": npy("<f8", (2, 4), struct.pack("<8d", *[0.5] * 8)),
        "groups.npy": npy("<i8", (2,), struct.pack("<2q", 3, -4)),
        "guides.npy": npy("|b1", (2,), b"\1\0")})


def xml_files():
    """Scenes of Embree's tutorials."""
    rows = "\n".join(f"{x:g} {y:g} {z:g} 0.25" for x, y, z in POINTS)
    yield "linear.xml", f"""<?xml version="1.0"?>
<scene>
  <!-- three strands of segments -->
  <Curves basis="linear" type="flat">
    <positions>
{rows}
    </positions>
    <indices>0 1 2 4 6 7</indices>
  </Curves>
  <TriangleMesh/>
</scene>
""".encode()
    rows = " ".join(f"{x:g} {y:g} {z:g} 0.5" for x, y, z in UNIFORM)
    yield "cubic.xml", f"""<scene><Group>
<Transform><AffineSpace>1 0 0 2  0 1 0 0  0 0 1 0</AffineSpace>
<BezierHair><positions>{rows}</positions><indices>0 0 4 1</indices></BezierHair></Transform>
<Curves basis='bspline' type='round'><positions>{rows}</positions><indices>0 1 4</indices>
<curveid>0 0 1</curveid></Curves></Group></scene>
""".encode()


# Contents that a reader must not believe: counts that ask for gigabytes, products that wrap in 32
# bits, arrays that overlap.
def hostile_hair_files():
    yield "single_points.hair", hair(9, 9, {1: floats(POINTS)}, info=b"i" * 88)
    yield "four_billion_strands.hair", hair(2**32 - 1, 0, {1: b""}, default_segments=2**32 - 1)
    yield "four_billion_points.hair", hair(1, 2**32 - 1, {1: b""}, default_segments=2**32 - 2)
    yield "segments_past_the_end.hair", hair(
        1, 2, {0: struct.pack("<H", 65535), 1: floats(POINTS[:2])})


def hostile_monohair_files():
    yield "sizes_past_the_end.hair", monohair([65535, 65535], POINTS[:2])
    yield "four_billion_strands.hair", struct.pack("<2I", 2**32 - 1, 2**32 - 1)


def hostile_mitsuba_files():
    yield "four_billion_vertices.mitshair", b"BINARY_HAIR" + struct.pack("<I", 2**32 - 1)
    yield "only_starts.mitshair", b"BINARY_HAIR" + struct.pack(
        "<I16f", 5, *[float("inf")] * 16)


def hostile_pbrt_files():
    yield "nested.pbrt", b"AttributeBegin " * 2000
    yield "list_without_end.pbrt", b'Shape "curve" "point3 P" [ 0 0 0'
    yield "basis_at_the_end.pbrt", b'Shape "curve" "string basis"'


def hostile_tfx_files():
    positions = floats([(*p, 1) for p in UNIFORM])
    # 2^16 strands of 2^16 vertices are 2^32, 0 in 32 bits.
    yield "vertices_wrap.tfx", tfx(2**16, 2**16, [positions, None, None, None, None])
    yield "uvs_on_positions.tfx", struct.pack(
        "<f7I128x", 4.0, 2, 4, 160, 176, 0, 0, 0) + positions


def hostile_hgl_files():
    yield "two_billion_strands.hgl", struct.pack("<3i", 2**31 - 1, 255, 2**31 - 1)
    yield "negative_counts.hgl", struct.pack("<3i", -1, -1, -1)


def hostile_list_files(extension):
    yield f"two_billion_strands.{extension}", struct.pack("<2i", 2**31 - 1, 2**31 - 1)
    yield f"negative_points.{extension}", struct.pack("<2i", 1, -1)


def hostile_npy_files():
    # 2^22 cubed times 4 is 0 in 64 bits.
    yield "shape_wraps.npy", npy("<f4", (2**22, 2**22, 2**22), b"")
    header = b"{'descr': '<f4', 'fortran_order': False, 'shape': (2"  # libFuzzer's
    yield "shape_without_end.npy", b"\x93NUMPY\1\0" + struct.pack("<H", len(header)) + header
    yield "no_sizes.npy", npy("<f4", (), b"\0\0\0\0")


def hostile_npz_files():
    bomb = npz(8, {"positions.npy": npy("<f4", (2, 4, 3), floats(UNIFORM))})
    size = bomb.index(b"PK\1\2") + 24
    yield "four_billion_bytes.npz", bomb[:size] + b"\xfe\xff\xff\xff" + bomb[size + 4:]
    yield "nothing.npz", npz(0, {})


def hostile_abc_files():
    header = b"Ogawa\xff\0\1" + struct.pack("<Q", 16)
    data = 1 << 63
    # Its 2^61 children have 2^64 bytes, which are 0 in 64 bits.
    yield "children_wrap.abc", header + struct.pack("<Q", 2**61)
    # An archive whose top object is the child of itself, after a version and data with its header.
    version = struct.pack("<Qi", 4, 0)
    library = struct.pack("<Qi", 4, 10803)
    child = struct.pack("<I", 1) + b"a\0" + bytes(32)
    at = 16 + 8 + 6 * 8
    places = [at, at + len(version), at + len(version) + len(library)]
    top = places[2] + 8 + len(child)
    root = struct.pack(
        "<7Q", 6, places[0] | data, places[1] | data, top, data, data, data)
    yield "object_of_itself.abc", (
        header + root + version + library + struct.pack("<Q", len(child)) + child +
        struct.pack("<4Q", 3, 0, top, places[2] | data))


def main():
    folder = sys.argv[1] if len(sys.argv) > 1 else os.path.dirname(os.path.abspath(__file__))
    families = {
        "hair": hair_files, "tfx": tfx_files, "hgl": hgl_files, "gltf": gltf_files,
        "usd": usd_files, "obj": obj_files, "data": data_files, "bin": bin_files,
        "npy": npy_files, "npz": npz_files, "xml": xml_files,
        "other_hair": monohair_files, "findings/other_hair": hostile_monohair_files,
        "mitshair": mitsuba_files, "pbrt": pbrt_files,
        "findings/mitshair": hostile_mitsuba_files, "findings/pbrt": hostile_pbrt_files,
        "findings/hair": hostile_hair_files, "findings/tfx": hostile_tfx_files,
        "findings/hgl": hostile_hgl_files, "findings/abc": hostile_abc_files,
        "findings/npy": hostile_npy_files, "findings/npz": hostile_npz_files,
        "findings/data": lambda: hostile_list_files("data"),
        "findings/bin": lambda: hostile_list_files("bin")}
    for name, files in families.items():
        os.makedirs(os.path.join(folder, name), exist_ok=True)
        for file, content in files():
            with open(os.path.join(folder, name, file), "wb") as out:
                out.write(content)


main()

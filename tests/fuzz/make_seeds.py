#!/usr/bin/env python3
"""Writes the files of tests/fuzz/seeds, with other programs or from descriptions of formats.

Pillow and OpenEXR write pictures; tests/corpus/README.md names their versions. Meshes, animations
and the streams of child processes are written by hand from their descriptions. Reports are those of
results/, cut to a few cases and samples.
"""
import json
import struct
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
SEEDS = ROOT / "tests/fuzz/seeds"
RECORD_SEPARATOR = "\x1e"


def write(target, name, data):
    path = SEEDS / target / name
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data if isinstance(data, bytes) else data.encode())


# ---- Pictures ------------------------------------------------------------------------------------


def pictures():
    from io import BytesIO

    from PIL import Image

    rgb = Image.new("RGB", (19, 11))
    rgb.putdata([(x * 13 % 256, y * 23 % 256, (x * y) % 256) for y in range(11) for x in range(19)])
    rgba = rgb.convert("RGBA")
    rgba.putalpha(rgb.convert("L"))

    def save(name, image, kind, **options):
        data = BytesIO()
        image.save(data, kind, **options)
        write("picture", name, data.getvalue())

    save("baseline.jpg", rgb, "JPEG", quality=90)
    save("progressive.jpg", rgb, "JPEG", quality=60, progressive=True, subsampling=2)
    save("grey.jpg", rgb.convert("L"), "JPEG", restart_marker_blocks=1)
    save("cmyk.jpg", rgb.convert("CMYK"), "JPEG")
    save("rgb.bmp", rgb, "BMP")
    save("palette.bmp", rgb.convert("P"), "BMP")
    save("one_bit.bmp", rgb.convert("1"), "BMP")
    save("rgba.tga", rgba, "TGA")
    save("runs.tga", rgb, "TGA", compression="tga_rle")
    save("palette.tga", rgb.convert("P"), "TGA")
    save("rgba.png", rgba, "PNG")
    save("palette.png", rgb.convert("P"), "PNG")
    save("one_bit.png", rgb.convert("1"), "PNG")
    save("deep_grey.png", Image.new("I;16", (9, 5), 4660), "PNG")


def float_pictures():
    import numpy
    import OpenEXR

    # Radiance: two run-length encoded rows of eight pixels, and a picture of flat pixels.
    row = b"\x02\x02\x00\x08" + b"\x08abcdefgh" + 3 * b"\x88z"
    write(
        "float_picture",
        "runs.hdr",
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 8\n" + 2 * row)
    write(
        "float_picture",
        "flat.hdr",
        b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x20\x81\xc8\x64\x32\x8a")
    light = numpy.arange(24 * 17 * 3, dtype=numpy.float32).reshape(17, 24, 3) / 64
    for name in ["NO", "RLE", "ZIPS", "ZIP", "PIZ", "PXR24", "B44", "DWAA"]:
        compression = getattr(OpenEXR, name + "_COMPRESSION")
        header = {"compression": compression, "type": OpenEXR.scanlineimage}
        pixels = light.astype(numpy.float16) if name in ["B44", "DWAA"] else light
        path = SEEDS / "float_picture" / (name.lower() + ".exr")
        with OpenEXR.File(header, {"RGB": pixels}) as file:
            file.write(str(path))
    header = {"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}
    with OpenEXR.File(header, {"Y": light[:, :, 0].copy()}) as file:
        file.write(str(SEEDS / "float_picture" / "luminance.exr"))
    header = {
        "compression": OpenEXR.ZIP_COMPRESSION,
        "type": OpenEXR.tiledimage,
        "tiles": OpenEXR.TileDescription(),
    }
    with OpenEXR.File(header, {"RGB": light}) as file:
        file.write(str(SEEDS / "float_picture" / "tiled.exr"))


# ---- Meshes --------------------------------------------------------------------------------------


class Gltf:
    """glTF 2.0 of one mesh, with one buffer."""

    def __init__(self):
        self.data = b""
        self.views = []
        self.accessors = []

    def view(self, kind, numbers):
        start = len(self.data)
        packed = struct.pack("<%d%s" % (len(numbers), kind), *numbers)
        self.data += packed + bytes(-len(packed) % 4)
        self.views.append({"buffer": 0, "byteOffset": start, "byteLength": len(packed)})
        return len(self.views) - 1

    def accessor(self, kind, component, width, numbers, **more):
        types = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
        self.accessors.append({
            "bufferView": self.view(kind, numbers),
            "componentType": component,
            "type": types[width],
            "count": len(numbers) // width,
            **more,
        })
        return len(self.accessors) - 1

    def floats(self, width, numbers):
        return self.accessor("f", 5126, width, numbers)

    def binary(self, document):
        document = {
            "asset": {"version": "2.0"},
            "scene": 0,
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.data)}],
            **document,
        }
        text = json.dumps(document, separators=(",", ":")).encode()
        text += b" " * (-len(text) % 4)
        chunks = struct.pack("<I4s", len(text), b"JSON") + text
        chunks += struct.pack("<I4s", len(self.data), b"BIN\0") + self.data
        return struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks


TRIANGLES = [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0]


def skin():
    file = Gltf()
    identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    attributes = {
        "POSITION": file.floats(3, TRIANGLES),
        "NORMAL": file.floats(3, 4 * [0, 0, 1]),
        "TEXCOORD_0": file.floats(2, [0, 0, 1, 0, 1, 1, 0, 1]),
        "JOINTS_0": file.accessor("B", 5121, 4, 2 * [0, 1, 0, 0] + 2 * [1, 0, 0, 0]),
        "WEIGHTS_0": file.floats(4, 2 * [0.5, 0.5, 0, 0] + 2 * [1, 0, 0, 0]),
        "_SCALP": file.floats(1, [0, 0.5, 1, 1]),
    }
    indices = file.accessor("H", 5123, 1, [0, 1, 2, 0, 2, 3])
    binds = file.floats(16, 2 * identity)
    times = file.floats(1, [0, 0.5, 1])
    turned = file.floats(4, [0, 0, 0, 1, 0, 0, 0.70710678, 0.70710678, 0, 0, 1, 0])
    moved = file.floats(3, 3 * [0, 0, 0] + 3 * [0, 1, 0] + 3 * [1, 1, 0])
    scaled = file.floats(3, [1, 1, 1, 2, 1, 1, 1, 1, 1])
    return file.binary({
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [
            {"mesh": 0, "skin": 0, "name": "head"},
            {"children": [2], "translation": [0, 0.5, 0]},
            {"rotation": [0, 0, 0, 1], "scale": [1, 1, 1]},
        ],
        "meshes": [{"primitives": [{"attributes": attributes, "indices": indices}]}],
        "skins": [{"joints": [1, 2], "inverseBindMatrices": binds}],
        "animations": [{
            "name": "nod",
            "samplers": [
                {"input": times, "output": turned},
                {"input": times, "output": moved, "interpolation": "CUBICSPLINE"},
                {"input": times, "output": scaled, "interpolation": "STEP"},
            ],
            "channels": [
                {"sampler": 0, "target": {"node": 1, "path": "rotation"}},
                {"sampler": 1, "target": {"node": 2, "path": "translation"}},
                {"sampler": 2, "target": {"node": 2, "path": "scale"}},
            ],
        }],
    })


def morph():
    file = Gltf()
    attributes = {"POSITION": file.floats(3, TRIANGLES)}
    target = file.floats(3, 3 * [0, 0, 1] + [0, 0, 0])
    file.accessors.append({
        "componentType": 5126,
        "type": "VEC3",
        "count": 4,
        "sparse": {
            "count": 1,
            "indices": {"bufferView": file.view("H", [2]), "componentType": 5123},
            "values": {"bufferView": file.view("f", [0, 2, 0])},
        },
    })
    sparse = len(file.accessors) - 1
    times = file.floats(1, [0, 1])
    weights = file.accessor("B", 5121, 1, [0, 0, 255, 128], normalized=True)
    return file.binary({
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 3, 4, 5, 1]}],
        "meshes": [{
            "primitives": [{
                "attributes": attributes,
                "mode": 5,
                "targets": [{"POSITION": target}, {"POSITION": sparse}],
                "material": 0,
            }],
            "weights": [0.25, 0],
        }],
        "materials": [{
            "name": "skin",
            "pbrMetallicRoughness": {
                "baseColorFactor": [0.5, 0.25, 0.125, 1],
                "roughnessFactor": 0.5,
            },
            "alphaMode": "MASK",
        }],
        "animations": [{
            "samplers": [{"input": times, "output": weights}],
            "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
        }],
    })


def sized(data, size):
    return struct.pack("<Q", len(data) // size) + data


def name(text):
    return sized(text.encode(), 1)


def mesh_stream():
    """Returns the output of hairbench_mesh_reader for a square: hair/groom/mesh/mesh_stream.h."""
    positions = struct.pack("<12f", *TRIANGLES)
    normals = struct.pack("<12f", *(4 * [0, 0, 1]))
    coordinates = struct.pack("<8f", 0, 0, 1, 0, 1, 1, 0, 1)
    triangles = struct.pack("<6I", 0, 1, 2, 0, 2, 3)
    stream = sized(positions, 12) + sized(normals, 12) + sized(coordinates, 8)
    stream += sized(triangles, 12) + sized(struct.pack("<2I", 0, 0), 4)
    stream += sized(struct.pack("<2I", 0, 0), 4)
    stream += struct.pack("<Q", 1) + name("head")
    stream += struct.pack("<Q", 1) + name("bone") + sized(struct.pack("<4f", 0, 0.5, 1, 1), 4)
    stream += struct.pack("<Q", 1) + name("skin") + struct.pack("<3f", 0.5, 0.25, 0.125)
    stream += b"\1" + struct.pack("<Q", 1) + name("1 hidden mesh is left out")
    return stream + struct.pack("<Q", 1) + name("skin.png")


class Ogawa:
    """Writes an Alembic archive as hair/groom/formats/ogawa.h describes it."""

    DATA = 1 << 63

    def __init__(self):
        self.bytes = bytearray(b"Ogawa\xff\0\1" + bytes(8))

    def data(self, content):
        at = len(self.bytes)
        self.bytes += struct.pack("<Q", len(content)) + content
        return at | self.DATA

    def group(self, children):
        at = len(self.bytes)
        self.bytes += struct.pack(f"<{len(children) + 1}Q", len(children), *children)
        return at

    def properties(self, each):
        """A property is its name, its kind (0 compound, 1 scalar, 2 array), its type, its extent,
        and its bytes or its own properties."""
        groups, headers = [], b""
        for label, kind, code, extent, content in each:
            if kind == 0:
                groups.append(self.properties(content))
            else:
                sample = self.data(bytes(16) + content)
                groups.append(self.group([sample, self.DATA][:kind]))
            bits = kind | 2 << 2 | code << 4 | (0x800 if kind else 0) | extent << 12 | 0xff << 20
            headers += struct.pack("<I", bits) + (struct.pack("<I", 1) if kind else b"")
            headers += struct.pack("<I", len(label)) + label.encode() + struct.pack("<I", 0)
        return self.group([*groups, self.data(headers)])

    def object(self, properties, children=()):
        """A child is its name, its schema, and what object() returned for it."""
        headers = b""
        for label, schema, _ in children:
            metadata = f"schema={schema}".encode()
            headers += struct.pack("<I", len(label)) + label.encode() + b"\xff"
            headers += struct.pack("<I", len(metadata)) + metadata
        own = self.properties(properties) if properties else 0
        return self.group([own, *(child for _, _, child in children), self.data(headers + bytes(32))])

    def finish(self, top):
        parts = [self.data(struct.pack("<I", number)) for number in (0, 10703)]
        parts += [top, self.data(b""), self.data(struct.pack("<IdId", 1, 1, 1, 0)), self.DATA]
        self.bytes[8:16] = struct.pack("<Q", self.group(parts))
        return bytes(self.bytes)


def alembic_mesh():
    """Returns an archive with a square of two faces, and one of them in a face set."""
    floats, integers = 10, 6
    archive = Ogawa()
    points = struct.pack("<12f", 0, 0, 0, 1, 0, 0, 1, 0, 1, 0, 0, 1)
    uvs = struct.pack("<12f", 0, 0, 1, 0, 1, 1, 0, 0, 1, 1, 0.5, 1)
    scalp = archive.object(
        [(".faceset", 0, 0, 1, [(".faces", 2, integers, 1, struct.pack("<i", 1))])])
    mesh = archive.object(
        [(".geom", 0, 0, 1, [
            ("P", 2, floats, 3, points), ("uv", 2, floats, 2, uvs),
            (".faceCounts", 2, integers, 1, struct.pack("<2i", 3, 3)),
            (".faceIndices", 2, integers, 1, struct.pack("<6i", 0, 1, 2, 0, 2, 3))])],
        [("scalp", "AbcGeom_FaceSet_v1", scalp)])
    move = archive.object(
        [(".xform", 0, 0, 1, [
            (".ops", 1, 1, 2, b"\x10\0"), (".vals", 1, 11, 6, struct.pack("<6d", 0, 5, 0, 2, -2, 2))])],
        [("head", "AbcGeom_PolyMesh_v1", mesh)])
    return archive.finish(archive.object([], [("move", "AbcGeom_Xform_v3", move)]))


def usd_stream():
    """Returns the output of usd_curves.py for two strands: hair/groom/formats/usd_import.h."""
    sections = [
        (struct.pack("<2I", 3, 2), 4),
        (struct.pack("<15f", *range(15)), 12),
        (struct.pack("<5f", *(5 * [0.001])), 4),
        (struct.pack("<f", 0.5), 4),
        (struct.pack("<15f", *(5 * [0.2, 0.1, 0])), 12),
        (struct.pack("<4f", 0, 0.25, 0.5, 1), 8),
        (struct.pack("<3I", 0, 1, 1), 12),
        (struct.pack("<2i", -1, 7), 4),
        (bytes([1, 0]), 1),
        (b"a comment", 1),
        (b"one warning\nanother", 1),
    ]
    counts = [len(data) // size for data, size in sections]
    header = struct.pack("<8sd12Q", b"HBCURVES", 0.01, *counts, 3)
    return header + b"".join(data for data, _ in sections)


# ---- Shaders -------------------------------------------------------------------------------------


def spirv():
    """Returns a main() that calls a sine within a branch: SPIR-V specification, 2.3 and 3.49."""

    def text(characters):
        data = characters.encode() + b"\0"
        data += bytes(-len(data) % 4)
        return struct.unpack(f"<{len(data) // 4}I", data)

    instructions = [
        (17, 1),  # OpCapability Shader
        (11, 1, *text("GLSL.std.450")),  # OpExtInstImport
        (14, 0, 1),  # OpMemoryModel Logical GLSL450
        (15, 4, 2, *text("main")),  # OpEntryPoint Fragment
        (16, 2, 7),  # OpExecutionMode OriginUpperLeft
        (7, 3, *text("a.glsl")),  # OpString
        (71, 21, 42),  # OpDecorate NoContraction
        (71, 22, 1, 3),  # OpDecorate SpecId 3
        (19, 4),  # OpTypeVoid
        (20, 5),  # OpTypeBool
        (22, 6, 32),  # OpTypeFloat
        (21, 7, 32, 0),  # OpTypeInt
        (43, 7, 8, 1),  # OpConstant
        (28, 9, 6, 8),  # OpTypeArray
        (30, 10, 9, 6),  # OpTypeStruct
        (32, 11, 7, 10),  # OpTypePointer Function
        (32, 12, 7, 6),
        (33, 13, 4),  # OpTypeFunction
        (33, 14, 6, 6),
        (41, 5, 15),  # OpConstantTrue
        (50, 6, 22, 0x3F800000),  # OpSpecConstant
        (54, 6, 16, 0, 14),  # OpFunction
        (55, 6, 17),  # OpFunctionParameter
        (248, 18),  # OpLabel
        (8, 3, 7, 0),  # OpLine
        (12, 6, 19, 1, 13, 17),  # OpExtInst Sin
        (254, 19),  # OpReturnValue
        (56,),  # OpFunctionEnd
        (54, 4, 2, 0, 13),
        (248, 20),
        (59, 11, 23, 7),  # OpVariable Function
        (247, 24, 0),  # OpSelectionMerge
        (250, 15, 25, 24),  # OpBranchConditional
        (248, 25),
        (57, 6, 26, 16, 22),  # OpFunctionCall
        (129, 6, 21, 26, 22),  # OpFAdd
        (65, 12, 27, 23, 8),  # OpAccessChain
        (62, 27, 21),  # OpStore
        (249, 24),  # OpBranch
        (248, 24),
        (253,),  # OpReturn
        (56,),
    ]
    words = [0x07230203, 0x00010600, 0, 28, 0]
    for operation, *operands in instructions:
        words += [(1 + len(operands)) << 16 | operation, *operands]
    return struct.pack(f"<{len(words)}I", *words)


# ---- Reports -------------------------------------------------------------------------------------


def cut(report, cases):
    """Returns the report with some of its cases, each with few metrics and samples."""
    report = dict(report)
    report["scene"] = dict(report["scene"])
    run = report["scene"]["document"].get("run", {})
    report["scene"]["document"] = {"run": run}
    environment = report["environment"] = dict(report["environment"])
    environment["device"] = dict(environment["device"], limits={"timestampPeriod": 1.0})
    report["cases"] = []
    for each in cases:
        each = dict(each)
        metrics = each.get("metrics", {})
        kept = [key for key in metrics if not key.startswith(("memory", "device"))][:7]
        each["metrics"] = {
            key: dict(metrics[key], samples=metrics[key].get("samples", [])[:4]) for key in kept
        }
        report["cases"].append(each)
    return report


def text(value):
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def with_sidecar(report):
    """Returns the report, with its first metric's samples moved to a file beside it."""
    report = json.loads(json.dumps(report))
    case = report["cases"][0]
    metric, value = next(iter(case["metrics"].items()))
    samples = [1.0, 2.0, 4.0]
    value.update(median=2.0, sample_count=3, samples_file="report.samples.jsonl")
    del value["samples"]
    line = {"case": case["name"], "metric": metric, "samples": samples}
    return text(report) + RECORD_SEPARATOR + text(line) + "\n"


def reports():
    for path in sorted((ROOT / "results").glob("*.json")):
        report = json.loads(path.read_text())
        if not str(report.get("schema", "")).startswith("hairbench-report/"):
            continue
        cases = report["cases"]
        stem = path.stem.split("-")[0] + "_" + path.stem.split("-")[-1][:4]
        for count in (1, 2):
            write("report", "%s_%d.json" % (stem, count), text(cut(report, cases[:count])))
        write("report", stem + "_samples.json", with_sidecar(cut(report, cases[:1])))
        report["case_count"] = len(cases)
        parts = []
        for index in range(2):
            part = cut(report, [dict(cases[index], index=index)])
            part["case_count"] = 2
            part["shard"] = {"index": index + 1, "count": 2}
            parts.append(text(part))
        write("merge", stem + ".json", RECORD_SEPARATOR.join(parts))


# ---- Journals ------------------------------------------------------------------------------------


def journal_line(value):
    """Returns a value with the 64-bit FNV-1a of its text: benchmarks/run/record.h."""
    line = text(value)
    sum_ = 0xCBF29CE484222325
    for byte in line.encode():
        sum_ = (sum_ ^ byte) * 0x100000001B3 % 2**64
    return '{"hash":"%016x","line":%s}\n' % (sum_, line)


def journals():
    """Writes journals of the made-up run in tests/fuzz/targets.cpp."""
    head = {
        "schema": "hairbench-journal/2.0.0",
        "header": {
            "schema": "hairbench-report/1.4.0",
            "environment": {
                "device": {"name": "Soft", "type": "cpu", "driver_version": "22.3.6"},
                "host": {"processor": "Some CPU"},
                "build": {"version": "0.1.0", "commit": "abc", "type": "Release"},
                "command": ["hairbench", "run"],
                "seed": 7,
                "validation": False,
            },
            "scene": {"path": "s.json", "hash": "0123456789abcdef", "document": {"seed": 7}},
            "case_count": 8,
            "order_seed": 11,
            "shard": {"index": 2, "count": 2},
        },
        "cases_hash": "0011223344556677",
        "filter": "",
        "planned": 4,
    }
    played = json.loads((SEEDS / "report/thesis_ff65_1.json").read_text())["cases"][0]
    lines = [journal_line(head)]
    write("journal", "begun.journal", lines[0])
    for order, index in enumerate([3, 1, 7]):
        name_ = "s/%d" % index
        failed = {"name": name_, "axes": {}, "index": index, "order": order, "status": "failed"}
        whole = dict(played, name=name_, index=index, order=order)
        lines.append(journal_line(failed if order == 1 else whole))
        if order == 1:
            write("journal", "two_cases.journal", "".join(lines))
    write("journal", "three_cases.journal", "".join(lines))


# ---- PLY ------------------------------------------------------------------------------------------


def ply_header(form, *elements):
    return "\n".join(["ply", f"format {form} 1.0", *elements, "end_header", ""]).encode()


CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]
PLACES = ["element vertex 4", "property float x", "property float y", "property float z"]


def ply_text():
    faces = ["element face 2", "property uchar flags", "property list uchar int vertex_indices"]
    rows = [" ".join(map(str, corner)) for corner in CORNERS] + ["7 3 0 1 2", "7 4 0 1 3 2"]
    return ply_header("ascii", *PLACES, *faces) + "\n".join(rows).encode()


def ply_strip():
    strip = ["element tristrips 1", "property list int int vertex_indices"]
    values = struct.pack(">12f", *(value for corner in CORNERS for value in corner))
    indices = [0, 1, 2, -1, 1, 3, 2]
    return (ply_header("binary_big_endian", *PLACES, *strip) + values
            + struct.pack(">8i", len(indices), *indices))


def main():
    for target, makers in [
        ("alembic_mesh", {"square.abc": alembic_mesh}),
        ("animation", {"skin.glb": skin, "morph.glb": morph}),
        ("mesh_stream", {"square.bin": mesh_stream}),
        ("ply_faces", {"faces.ply": ply_text, "strip.ply": ply_strip}),
        ("spirv", {"sine.spv": spirv}),
        ("usd_stream", {"two_strands.bin": usd_stream}),
    ]:
        for file_name, make in makers.items():
            write(target, file_name, make())
    reports()
    journals()
    if "--pictures" in sys.argv:
        (SEEDS / "float_picture").mkdir(parents=True, exist_ok=True)
        pictures()
        float_pictures()


if __name__ == "__main__":
    main()

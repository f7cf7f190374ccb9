"""Hostile files for crafted_files.py: for each kind of file a function that makes one.

A function gets a random number generator and a Place, writes its files there, and returns the
arguments of the program that read them. KINDS is the table of all kinds.
"""

import base64
import functools
import io
import json
import os
import shutil
import struct
import zipfile
import zlib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
CORPUS = ROOT / "tests/corpus"
SEEDS = ROOT / "tests/fuzz/seeds"

MOST_BYTES = 3_000_000  # of a crafted file, so that 2,000 of them take less than an hour


class Place:
    """The folder `inside` for crafted files and, beside it, the folder `private` for planted ones.
    A Place is used for one crafted file."""

    def __init__(self, folder, planted):
        self.inside = folder / "in"
        self.private = folder / "private"
        self.out = folder / "out"
        self.planted = planted  # names in `private`
        for each in (self.inside, self.out):
            shutil.rmtree(each, ignore_errors=True)
            each.mkdir()

    def write(self, name, content):
        path = self.inside / name
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return str(path)

    def outside(self, random, ending):
        """A name of a planted file with this extension, or of a pipe, as a hostile file may write
        it."""
        name = "planted" + ending
        assert name in self.planted, name
        link = "link" + ending
        ways = [
            "../private/" + name,
            str(self.private / name),
            link,
            "dir/" + name,
            "./pipe" + ending,
            "x/../../private/" + name,
            "../" + self.inside.name + "/../private/" + name,
        ]
        way = random.choice(ways)
        if way == link:
            self._once(link, lambda path: path.symlink_to("../private/" + name))
        elif way.startswith("dir/"):
            self._once("dir", lambda path: path.symlink_to(self.private))
        elif way.startswith("./pipe"):
            self._once("pipe" + ending, os.mkfifo)
        elif way.startswith("x/"):
            self._once("x", lambda path: path.mkdir())
        return way

    def _once(self, name, make):
        path = self.inside / name
        if not os.path.lexists(path):
            make(path)

    def size(self):
        """The size of the crafted files, in bytes."""
        return sum(
            each.lstat().st_size for each in self.inside.rglob("*") if each.is_file() and not each.is_symlink()
        )


# ---- Damage of valid files -----------------------------------------------------------------------

NUMBERS = [
    b"0", b"-1", b"1", b"2147483647", b"2147483648", b"4294967295", b"4294967296", b"-2147483648",
    b"9223372036854775807", b"18446744073709551615", b"1e308", b"1e-320", b"nan", b"inf", b"-0.0",
    b"99999999999999999999999", b"65535", b"65536", b"1000000", b"16777217",
]  # fmt: skip
WORDS = [0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFFE, 0x10000, 0xFFFF, 0x7F, 0xFF, 1 << 28, 1 << 24]


def damaged(random, data):
    """`data` with one to eight changes."""
    data = bytearray(data)
    for _ in range(random.choice([1, 1, 2, 3, 8])):
        if not data:
            break
        at = random.randrange(len(data))
        way = random.randrange(7)
        if way == 0:
            data[at] = random.randrange(256)
        elif way == 1:
            data[at : at + 4] = struct.pack("<I", random.choice(WORDS))
        elif way == 2:
            data[at : at + 8] = struct.pack("<Q", random.choice(WORDS) << random.choice([0, 16, 32]))
        elif way == 3:
            del data[at : at + random.choice([1, 2, 4, 16, len(data)])]
        elif way == 4:
            end = at + random.choice([1, 4, 16, 64, 256])
            data[at:at] = bytes(data[at:end]) * random.choice([1, 2, 100])
        elif way == 5:  # a number in a text
            digits = [i for i in range(at, min(at + 200, len(data))) if 48 <= data[i] < 58]
            if digits:
                end = digits[0]
                while end < len(data) and chr(data[end]) in "0123456789.eE":
                    end += 1
                data[digits[0] : end] = random.choice(NUMBERS)
        else:
            other = random.randrange(len(data))
            length = random.choice([1, 2, 4, 8, 32])
            data[at : at + length], data[other : other + length] = (
                data[other : other + length],
                data[at : at + length],
            )
    return bytes(data[:MOST_BYTES])


VALUES = [
    None, True, 0, -1, 1, 1e308, -1e308, 5e-324, 2**31, 2**32, 2**53, 2**63, 2**64 - 1, "", "\u202e", "a" * 70_000,
    [], {}, [[]], [0, 0, 0], "../private/planted.png", "/dev/zero", "\x00", "1", 0.5, [None], {"": {}},
]  # fmt: skip


def damaged_json(random, document):
    """The text of a document after one to four changes of its values."""
    document = json.loads(json.dumps(document))
    for _ in range(random.choice([1, 1, 2, 4])):
        node, key = [document], 0
        for _ in range(random.randrange(1, 12)):
            value = node[key]
            if isinstance(value, dict) and value:
                node, key = value, random.choice(list(value))
            elif isinstance(value, list) and value:
                node, key = value, random.randrange(len(value))
            else:
                break
        value = node[key]
        way = random.randrange(5)
        if way == 0 and isinstance(value, list) and value:
            node[key] = value * random.choice([2, 50])
        elif way == 1 and isinstance(node, dict):
            del node[key]
        elif way == 2 and isinstance(value, (int, float)):
            node[key] = random.choice([-value, value * 1e9, 0, -1, 2**32, 1e300])
        elif way == 3 and isinstance(node, dict):
            node[random.choice(list(node))] = value
        else:
            node[key] = random.choice(VALUES)
        document = node[0] if key == 0 and isinstance(node, list) and len(node) == 1 else document
    text = json.dumps(document)
    if random.random() < 0.1:
        text = damaged(random, text.encode()).decode("utf-8", "replace")
    return text[:MOST_BYTES]


def corpus(random, *patterns):
    """The bytes of a valid file."""
    files = sorted(path for pattern in patterns for path in ROOT.glob(pattern) if path.is_file())
    return random.choice(files).read_bytes()


# ---- Scenes that name a file ---------------------------------------------------------------------

HAIR = (CORPUS / "hgl/one_guide.hgl").read_bytes()


def scene(place, **members):
    """Arguments that check a scene with these members, which name files of the place. Its hair is
    one guide unless the members say otherwise."""
    document = {"groom": {"file": "hair.hgl"}, "render": {"head": False}}
    for group, values in members.items():
        document[group] = {**document.get(group, {}), **values} if isinstance(values, dict) else values
    place.write("hair.hgl", HAIR)
    return ["validate", place.write("scene.json", json.dumps(document))]


def as_mesh(random, place, name):
    """Arguments that read the file as a mesh, in one of the places that name meshes."""
    way = random.randrange(5)
    if way == 0:
        place.write("hair.hgl", HAIR)
        return ["groom", "info", str(place.inside / "hair.hgl"), "--mesh", str(place.inside / name)]
    if way == 4:
        return scene(place, groom={"file": "hair.hgl", "mesh": name}, render={"head": True})
    if way == 1:
        return scene(place, simulation={"distance_fields": [{"mesh": name}]})
    return scene(place, render={"head": False, "meshes": [{"file": name}]})


def as_strands(random, place, name):
    """Arguments that read the file as strands."""
    way = random.randrange(4)
    if way == 0:
        return ["groom", "info", str(place.inside / name)]
    if way < 3:
        ending = random.choice([".hair", ".hgl", ".tfx", ".obj", ".ply", ".glb", ".usda", ".data", ".npz", ".abc"])
        return ["groom", "convert", str(place.inside / name), str(place.out / ("out" + ending))]
    return scene(place, groom={"file": name})


# ---- glTF ----------------------------------------------------------------------------------------


def glb_of(text, data):
    text = text.encode() + b" " * (-len(text.encode()) % 4)
    data += b"\0" * (-len(data) % 4)
    chunks = struct.pack("<I4s", len(text), b"JSON") + text + struct.pack("<I4s", len(data), b"BIN\0") + data
    return b"glTF" + struct.pack("<II", 2, 12 + len(chunks)) + chunks


def gltf_document(vertices, mode):
    """A document with one mesh, and its data: `vertices` positions and a list of indices."""
    positions = b"".join(struct.pack("<3f", i % 97, i % 89, i % 83) for i in range(vertices))
    indices = b"".join(struct.pack("<I", i % vertices) for i in range(3 * vertices))
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "mode": mode}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": vertices, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5125, "count": 3 * vertices, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": len(positions)},
            {"buffer": 0, "byteOffset": len(positions), "byteLength": len(indices)},
        ],
        "buffers": [{"byteLength": len(positions) + len(indices)}],
    }
    return document, positions + indices


def gltf(random, place):
    as_lines = random.random() < 0.3
    vertices = random.choice([3, 3, 300, 30_000])
    document, data = gltf_document(vertices, random.choice([1, 3]) if as_lines else 4)
    buffer = document["buffers"][0]
    way = random.randrange(15)
    if way == 0:  # primitives with shared accessors, at many nodes
        product = random.choice([10, 1_000, 30_000])
        document["meshes"][0]["primitives"] *= random.choice([1, 100, product])
        document["nodes"] *= random.choice([1, 100, product])
        document["scenes"][0]["nodes"] = list(range(len(document["nodes"])))
    elif way == 1:  # a chain of nodes, or a cycle
        count = random.choice([10, 1_000, 50_000])
        document["nodes"] = [{"children": [i + 1]} for i in range(count)] + [{"mesh": 0}]
        if random.random() < 0.5:
            document["nodes"][-1]["children"] = [random.randrange(count)]
    elif way == 2:  # each node contains the next one twice
        count = random.choice([10, 30, 60])
        document["nodes"] = [{"children": [i + 1, i + 1], "mesh": 0} for i in range(count)] + [{"mesh": 0}]
    elif way in (3, 4):
        buffer["uri"] = place.outside(random, ".bin")
        if random.random() < 0.4:
            buffer["uri"] = random.choice(
                [
                    buffer["uri"].replace("..", "%2e%2e").replace("/", "%2F"),
                    buffer["uri"].replace("planted", "%70lanted"),
                    "file://" + buffer["uri"],
                    buffer["uri"].replace("/", "\\"),
                    "/dev/zero", "/dev/stdin", "/proc/self/mem", ".", "/dev/tty",
                ]
            )  # fmt: skip
    elif way in (5, 6):
        uri = place.outside(random, ".png")
        if random.random() < 0.3:
            uri = random.choice([uri.replace("planted", "%70lanted"), "file://" + uri, "/dev/zero"])
        document["images"] = [{"uri": uri}] * random.choice([1, 3])
        document["textures"] = [{"source": 0}]
        document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
        document["meshes"][0]["primitives"][0]["material"] = 0
    elif way == 7:
        accessor = random.choice(document["accessors"])
        accessor[random.choice(["count", "byteOffset", "bufferView", "componentType"])] = random.choice(WORDS)
    elif way == 8:
        accessor = document["accessors"][0]
        accessor["count"] = random.choice([3, 1_000_000, 100_000_000, 4_000_000_000])
        accessor.pop("bufferView")
        accessor["sparse"] = {
            "count": random.choice([1, 3, 1 << 30]),
            "indices": {"bufferView": 1, "componentType": 5125},
            "values": {"bufferView": 0},
        }
    elif way == 9:
        view = random.choice(document["bufferViews"])
        view[random.choice(["byteStride", "byteLength", "byteOffset", "buffer"])] = random.choice(WORDS)
    elif way == 10:  # many targets with shared accessors
        targets = [{"POSITION": 0}] * random.choice([10, 1_000, 20_000])
        document["meshes"][0]["primitives"][0]["targets"] = targets
        document["meshes"][0]["weights"] = [1] * len(targets)
    elif way == 11:
        buffer["uri"] = "data:application/octet-stream;base64," + random.choice(
            ["", "A" * 400_000, "=" * 1_000, "%" * 1_000, base64.b64encode(data).decode()[:-1]]
        )
    elif way == 12:
        count = random.choice([100, 2_000])
        document["skins"] = [{"joints": list(range(len(document["nodes"]))) * count}] * random.choice([1, count])
        document["nodes"][0]["skin"] = 0
        document["animations"] = [
            {
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}] * count,
                "samplers": [{"input": 1, "output": 0}] * count,
            }
        ]
    elif way == 13:
        depth = random.choice([10, 65, 10_000])
        document["extras"] = json.loads("[" * min(depth, 900) + "]" * min(depth, 900))
    text = damaged_json(random, document) if way == 14 else json.dumps(document)
    if way == 13 and random.random() < 0.5:
        text = text[:-1] + ', "a": ' + '{"a":' * 10_000 + "0" + "}" * 10_000 + "}"
    if "uri" not in buffer and random.random() < 0.7:
        name = "a.glb"
        content = glb_of(text[:MOST_BYTES], data)
    else:
        name = "a.gltf"
        if "uri" not in buffer:
            text = text.replace('"byteLength": %d}]' % len(data), '"byteLength": %d, "uri": "a.bin"}]' % len(data))
            place.write("a.bin", data)
        content = text
    if random.random() < 0.15:
        data = corpus(random, "tests/fuzz/seeds/animation/*", "tests/corpus/gltf/*.glb")
        name, content = "a.glb", damaged(random, data)
    place.write(name, content)
    if as_lines:
        return as_strands(random, place, name)
    if way in (10, 12):
        return scene(
            place,
            groom={"file": "hair.hgl", "mesh": name},
            simulation={"animation": {"clip": random.choice(["0", "turn"])}},
        )
    return as_mesh(random, place, name)


# ---- OBJ -----------------------------------------------------------------------------------------


def obj(random, place):
    rows = ["v %d %d %d" % (i % 7, i % 5, i % 3) for i in range(random.choice([4, 4, 1_000, 20_000]))]
    count = len(rows)
    faces = ["f 1 2 3"]
    way = random.randrange(12)
    if way in (0, 1):
        rows.insert(0, "mtllib " + place.outside(random, ".mtl"))
        faces.insert(0, "usemtl planted")
    elif way in (2, 3):
        option = random.choice(["", "-clamp on ", "-s 1 1 1 ", "-bm 1 "])
        key = random.choice(["map_Kd ", "map_Kd ", "map_Ks ", "bump ", "map_d "])
        place.write("a.mtl", "newmtl m\n" + key + option + place.outside(random, ".png") + "\n")
        rows = ["mtllib a.mtl", "vt 0 0", *rows]
        faces = ["usemtl m", "f 1/1 2/1 3/1"]
    elif way == 4:  # faces with many corners
        corners = random.choice([5, 50, 1_000, 3_000, 9_000])
        face = "f " + " ".join(str(1 + i % count) for i in range(corners))
        faces = [face] * max(1, min(random.choice([1, 10, 1_000]), 400_000 // corners))
    elif way == 5:
        faces = ["f %s %s %s" % tuple(random.choice(NUMBERS).decode() for _ in range(3)) for _ in range(20)]
    elif way == 6:  # strands that share points
        lines = random.choice([10, 1_000, 30_000])
        faces = ["l " + " ".join(str(1 + (i + k) % count) for k in range(random.choice([2, 20])))
                 for i in range(lines)]  # fmt: skip
    elif way == 7:
        faces = [f"{random.choice('og')} part{i}\nf 1 2 3" for i in range(random.choice([10, 1_000, 20_000]))]
    elif way == 8:
        faces = [f"usemtl m{i}\nf 1 2 3" for i in range(random.choice([10, 1_000, 20_000]))]
    elif way == 9:
        rows.append("v " + "9" * random.choice([100, 100_000, 1_000_000]) + " 0 0")
        faces.append("f " + "1 2 3 \\\n" * random.choice([1, 10_000]))
    elif way == 10:
        rows = ["mtllib a.mtl"] * random.choice([10, 3_000]) + rows
        place.write("a.mtl", "newmtl m\nKd 1 0 0\n" * random.choice([1, 1_000]))
    content = "\n".join(rows + faces)[:MOST_BYTES].encode() + b"\n"
    if way == 11:
        content = damaged(random, corpus(random, "tests/corpus/obj/*") if random.random() < 0.5 else content)
    place.write("a.obj", content)
    return as_strands(random, place, "a.obj") if way in (6, 9) else as_mesh(random, place, "a.obj")


# ---- PLY -----------------------------------------------------------------------------------------


def ply(random, place):
    form = random.choice(["ascii", "binary_little_endian", "binary_big_endian"])
    order = ">" if form.endswith("big_endian") else "<"
    vertices = random.choice([3, 3, 1_000])
    stated = random.choice([vertices, vertices, vertices, *WORDS])
    face_count = random.choice([1, 1, 1, 100_000, *WORDS])
    kind, code = random.choice([("uchar", "B"), ("int", "i"), ("uint", "I"), ("float", "f"), ("double", "d")])
    most = random.choice([3, 3, 255, 2**31 - 1, 4_000_000_000, -1])
    header = [
        "ply",
        f"format {form} 1.0",
        *["comment x"] * random.choice([0, 0, 50_000]),
        f"element vertex {stated}",
        *[f"property float {name}" for name in "xyz"],
        *[f"property float p{i}" for i in range(random.choice([0, 0, 0, 2_000]))],
        f"element face {face_count}",
        f"property list {kind} int {random.choice(['vertex_indices', 'vertex_index', 'vertices', 'x'])}",
        *[f"element e{i} 0" for i in range(random.choice([0, 0, 5_000]))],
        "end_header",
    ]
    strands = random.random() < 0.3
    if strands:
        header = [line.replace("element face", "element edge") for line in header]
        if random.random() < 0.5:
            header[-2:-1] = ["property int vertex1", "property int vertex2"]
    data = "\n".join(header).encode() + b"\n"
    if form == "ascii":
        data += b"0 0 1\n" * vertices + f"{most} 0 1 2\n".encode() * random.choice([1, 1, 10_000])
    else:
        data += struct.pack(order + "3f", 0, 0, 1) * vertices
        try:
            row = struct.pack(order + code + "3i", most, 0, 1, 2)
        except struct.error:
            row = b"\xff" * 16
        data += row * random.choice([1, 1, 10_000])
    if random.random() < 0.3:
        patterns = ["tests/corpus/ply/*", "tests/fuzz/seeds/ply_faces/*"]
        data = damaged(random, corpus(random, patterns[not strands]))
    place.write("a.ply", data[:MOST_BYTES])
    return as_strands(random, place, "a.ply") if strands else as_mesh(random, place, "a.ply")


# ---- Other meshes, which assimp reads ------------------------------------------------------------


def dae(geometry, nodes, before="", material=""):
    return (
        f'<?xml version="1.0"?>{before}'
        '<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">'
        f"{material}<library_geometries>{geometry}</library_geometries><library_visual_scenes>"
        f'<visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>'
        '<scene><instance_visual_scene url="#s"/></scene></COLLADA>'
    )


def dae_geometry(vertices, triangles, name="g"):
    return (
        f'<geometry id="{name}"><mesh><source id="p{name}"><float_array id="a{name}" count="{3 * vertices}">'
        + "0 1 2 " * vertices
        + f'</float_array><technique_common><accessor source="#a{name}" count="{vertices}" stride="3">'
        '<param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/>'
        f'</accessor></technique_common></source><vertices id="v{name}"><input semantic="POSITION" '
        f'source="#p{name}"/></vertices><triangles count="{triangles}"><input semantic="VERTEX" '
        f'source="#v{name}" offset="0"/><p>' + "0 1 2 " * triangles + "</p></triangles></mesh></geometry>"
    )


def mesh(random, place):
    way = random.randrange(10)
    node = '<node><instance_geometry url="#g"/></node>'
    name = "a.dae"
    if way == 0:
        size, count = random.choice([(3, 10_000), (1_000, 1_000), (20_000, 10_000), (100, 100)])
        content = dae(dae_geometry(size, size), node * count)
    elif way == 1:
        depth = random.choice([10, 1_000, 30_000])
        content = dae(dae_geometry(3, 1), "<node>" * depth + node + "</node>" * depth)
    elif way == 2:  # entities within entities
        entities = "".join(
            f'<!ENTITY e{i + 1} "{f"&e{i};" * 10}">' for i in range(random.choice([3, 9]))
        )
        before = f'<!DOCTYPE x [<!ENTITY e0 "0 1 2 ">{entities}]>'
        content = dae(dae_geometry(3, 1).replace("0 1 2 ", "&e3;", 1), node, before)
    elif way == 3:  # an entity from a file outside
        before = f'<!DOCTYPE x [<!ENTITY e SYSTEM "{place.outside(random, ".xml")}">]>'
        content = dae(dae_geometry(3, 1).replace("0 1 2 ", "&e;", 1), node, before)
    elif way == 4:
        image = place.outside(random, ".png")
        material = (
            f'<library_images><image id="i"><init_from>{image}</init_from></image></library_images>'
            '<library_effects><effect id="e"><profile_COMMON><technique sid="t"><lambert><diffuse>'
            '<texture texture="i" texcoord="u"/></diffuse></lambert></technique></profile_COMMON></effect>'
            '</library_effects><library_materials><material id="m"><instance_effect url="#e"/></material>'
            "</library_materials>"
        )
        geometry = dae_geometry(3, 1).replace('<triangles count="1">', '<triangles count="1" material="m">')
        bind = (
            '<node><instance_geometry url="#g"><bind_material><technique_common><instance_material symbol="m" '
            'target="#m"/></technique_common></bind_material></instance_geometry></node>'
        )
        content = dae(geometry, bind, material=material)
    elif way == 5:  # nested nodes
        levels = random.choice([3, 8, 20])
        library = "".join(
            f'<node id="n{i + 1}">{f"""<instance_node url="#n{i}"/>""" * 10}</node>' for i in range(levels)
        )
        library = f'<library_nodes><node id="n0"><instance_geometry url="#g"/></node>{library}</library_nodes>'
        content = dae(dae_geometry(3, 1), f'<node><instance_node url="#n{levels}"/></node>', material=library)
    elif way == 6:
        name = "a.off"
        content = f"OFF\n{random.choice(NUMBERS).decode()} {random.choice(NUMBERS).decode()} 0\n" + "0 0 0\n" * 4
        content += random.choice(["3 0 1 2\n", "100000000 0 1 2\n", "3 -1 1 9\n"]) * random.choice([1, 10_000])
    elif way == 7:
        name = "a.stl"
        count = random.choice(WORDS)
        content = b"\0" * 80 + struct.pack("<I", count) + b"\0" * 50 * random.choice([1, 1_000])
        if random.random() < 0.5:
            content = b"solid a\n" + b"facet normal 0 1 0\nouter loop\nvertex 0 0 0\n" * random.choice([1, 20_000])
    elif way == 8:
        name = "a.fbx"
        head = b"Kaydara FBX Binary  \0\x1a\0" + struct.pack("<I", random.choice([7300, 7500, 9999]))
        body = struct.pack("<III", *(random.choice(WORDS) for _ in range(3))) + b"\x04Node"
        array = b"d" + struct.pack("<III", random.choice(WORDS), 1, 100) + zlib.compress(b"\0" * 2_000_000)
        content = head + (body + array) * random.choice([1, 100])
        if random.random() < 0.5:
            content = "; FBX 7.3.0 project file\n" + "a: {\n" * random.choice([100, 50_000])
    else:
        content = damaged(random, dae(dae_geometry(30, 10), node).encode())
    place.write(name, content[:MOST_BYTES])
    return as_mesh(random, place, name)


# ---- USD -----------------------------------------------------------------------------------------

CURVE = (
    'def BasisCurves "%s" {\n uniform token type = "linear"\n int[] curveVertexCounts = [2]\n'
    " point3f[] points = [(0, 0, 0), (0, 1, 0)]\n}\n"
)
FACE = (
    'def Mesh "%s" {\n int[] faceVertexCounts = [3]\n int[] faceVertexIndices = [0, 1, 2]\n'
    " point3f[] points = [(0, 0, 0), (0, 1, 0), (1, 0, 0)]\n}\n"
)


def usd_arc(random, place):
    """A part of a layer that names a layer outside, in one of USD's ways."""
    name = place.outside(random, ".usda")
    if random.random() < 0.3:
        name += random.choice([":SDF_FORMAT_ARGS:a=b", ":SDF_FORMAT_ARGS:target=x", "[a.usda]"])
    if random.random() < 0.15:
        name = random.choice(["file://" + name, "file:" + name, name.replace("../", "..//"), name.upper()])
    if random.random() < 0.1:
        name = random.choice(["/dev/zero", "/dev/stdin", "/proc/self/environ", "/etc/passwd", "."])
    quotes = random.choice(["@%s@", "@%s@", "@@@%s@@@"])
    asset = quotes % name
    expression = '@`"%s"`@' % name
    split = '@`"${A}%s"`@' % name[2:]
    return random.choice(
        [
            ("", 'def "a" (references = %s) {}\n' % asset),
            ("", 'def "a" (prepend references = [%s</c>, %s]) {}\n' % (asset, asset)),
            ("", 'def "a" (payload = %s) {}\n' % asset),
            ("", 'def "a" (append payload = %s</c>) {}\n' % asset),
            ("subLayers = [%s]" % asset, ""),
            ("subLayers = [%s (offset = 1; scale = 2)]" % asset, ""),
            ("", 'def "a" (references = %s) {}\n' % expression),
            ("", 'def "a" (payload = %s) {}\n' % expression),
            ("subLayers = [%s]" % expression, ""),
            ('expressionVariables = {\n string A = "%s"\n}' % name[:2], 'def "a" (references = %s) {}\n' % split),
            ('expressionVariables = {\n string A = "%s"\n}\nsubLayers = [%s]' % (name[:2], split), ""),
            (
                "",
                'def "a" (variants = { string v = "x" }\nprepend variantSets = "v") {\nvariantSet "v" = {\n"x" '
                "(references = %s) { def \"d\" (payload = %s) {} }\n}\n}\n" % (asset, asset),
            ),
            (
                "",
                'def BasisCurves "a" (clips = { dictionary default = {\nasset[] assetPaths = [%s]\nasset '
                'manifestAssetPath = %s\nstring primPath = "/c"\ndouble2[] active = [(0, 0)]\ndouble2[] times = '
                "[(0, 0), (1, 1)]\n} }) {\n point3f[] points.timeSamples = {}\n}\n" % (asset, asset),
            ),
            (
                "",
                'def "a" (clips = { dictionary default = {\nstring templateAssetPath = "%s"\ndouble '
                'templateStartTime = 1\ndouble templateEndTime = 3\ndouble templateStride = 1\nstring primPath = '
                '"/c"\n} }) {}\n' % name.replace("planted", "planted.#"),
            ),
            (
                "",
                'def BasisCurves "a" (variants = { string v = "x" }\nprepend variantSets = "v") {\n'
                'int[] curveVertexCounts = [2]\nvariantSet "v" = {\n"x" (clips = { dictionary default = {\n'
                'asset[] assetPaths = [%s]\nasset manifestAssetPath = %s\nstring primPath = "/c"\ndouble2[] active '
                "= [(0, 0)]\ndouble2[] times = [(0, 0), (1, 1)]\n} }) {}\n}\n}\n" % (asset, asset),
            ),
            ("", 'def "a" (clips = { %s default = %s }) {}\n' % random.choice([("string", '"x"'), ("asset", asset),
                ("dictionary", "{ string[] assetPaths = [\"x\"] }"), ("dictionary", "{ int manifestAssetPath = 1 }")])),
            ("", 'def "a" (assetInfo = { asset identifier = %s }) { asset inputs:file = %s }\n' % (asset, asset)),
            (
                "",
                'def Material "m" { token outputs:surface.connect = </m/s.outputs:out>\n def Shader "s" { uniform '
                'asset info:id = %s\n asset inputs:file = %s\n uniform asset info:glslfx:sourceAsset = %s\n token '
                "outputs:out } }\n" % (asset, asset, asset),
            ),
        ]
    )  # fmt: skip


def usd_nested(random, arc):
    """A chain of prims. Each contains the previous one several times."""
    width, levels = random.choice([(2, 12), (2, 30), (8, 4), (8, 9), (100, 2), (300, 2), (40, 3)])
    text = CURVE % "l0"
    for i in range(1, levels):
        text += 'def "l%d" {\n' % i
        for k in range(width):
            text += ' def "c%d" (%s) {}\n' % (k, arc % ("/l%d" % (i - 1)))
        text += "}\n"
    return text


def usd(random, place):
    metadata = ""
    body = CURVE % "c"
    is_mesh = False
    name = "a.usda"
    way = random.randrange(20)
    if way in (0, 1, 2, 3):
        metadata, arc = usd_arc(random, place)
        body += arc
    elif way == 4:
        body = usd_nested(random, random.choice(
            ["references = <%s>", "payload = <%s>", "instanceable = true\n references = <%s>", "inherits = <%s>",
             "specializes = <%s>", "append references = <%s>", "prepend payload = <%s>"]))  # fmt: skip
    elif way == 5:  # sublayers of each other
        count = random.choice([2, 10, 100])
        for i in range(count):
            others = ", ".join(f"@l{random.randrange(count)}.usda@" for _ in range(random.choice([1, 3, 20])))
            place.write(f"l{i}.usda", f"#usda 1.0\n(subLayers = [{others}])\n{CURVE % f'c{i}'}")
        metadata = "subLayers = [@l0.usda@, @a.usda@]"
    elif way == 6:  # layers that refer to each other
        count, width = random.choice([(10, 2), (20, 2), (6, 8), (3, 60)])
        for i in range(count):
            target = f"@l{i - 1}.usda@" if i else f"@l{count - 1}.usda@" if random.random() < 0.2 else ""
            prims = "".join(
                f' def "c{k}" ({random.choice(["references", "payload"])} = {target}) {{}}\n' for k in range(width)
            )
            text = prims if target else CURVE % "c"
            place.write(f"l{i}.usda", f'#usda 1.0\n(defaultPrim = "r")\ndef "r" {{\n{text}}}\n')
        body = 'def "a" (references = @l%d.usda@) {}\n' % (count - 1)
    elif way == 7:  # nested variant sets
        depth = random.choice([2, 6, 30, 200])
        head = "".join(
            f'def "v{i}" (variants = {{ string v = "x" }}\nprepend variantSets = "v") {{\nvariantSet "v" = {{\n"x" {{\n'
            for i in range(depth)
        )
        body = head + CURVE % "c" + "}\n}\n}\n" * depth
    elif way == 8:
        sets = random.choice([3, 100, 1_000])
        names = ", ".join(f'"s{i}"' for i in range(sets))
        text = "".join(f'variantSet "s{i}" = {{ "x" {{ {CURVE % f"c{i}"} }} }}\n' for i in range(sets))
        choice = " ".join(f'string s{i} = "x"' for i in range(sets)).replace(" string", "\nstring")
        body = f'def "a" (variants = {{ {choice} }}\nprepend variantSets = [{names}]) {{\n{text}}}\n'
    elif way == 9:
        depth = random.choice([10, 200, 2_000])
        body = "".join(f'def "d{i}" {{\n' for i in range(depth)) + CURVE % "c" + "}\n" * depth
    elif way == 10:
        number = random.choice(NUMBERS).decode()
        body = (CURVE % "c").replace("[2]", random.choice(["[%s]", "[2, %s]", "[%s, 2]"]) % number)
    elif way == 11:  # points that many prims share
        points = random.choice([1_000, 30_000, 60_000])
        body = (CURVE % "c").replace("[2]", f"[{points}]")
        body = body.replace("(0, 1, 0)", "(0, 1, 0), " * (points - 2) + "(0, 1, 0)")
        for i in range(random.choice([10, 100, 3_000])):
            body += 'def "i%d" (%sreferences = </c>) {}\n' % (i, random.choice(["", "instanceable = true\n"]))
    elif way == 12:
        is_mesh = True
        count = random.choice([1, 1_000, 100_000])
        body = (FACE % "c").replace("[3]", f"[{3 * count}]").replace("0, 1, 2", ", ".join(["0, 1, 2"] * count), 1)
        for i in range(random.choice([0, 10, 1_000])):
            body += 'def "i%d" (references = </c>) {}\n' % i
    elif way == 13:
        is_mesh = True
        count = random.choice([10, 1_000, 20_000])
        rows = "".join(f"{i}: [(0, {i}, 0), (0, 1, 0), (1, 0, 0)],\n" for i in range(count))
        points = " point3f[] points ="
        body = (FACE % "c").replace(points, " point3f[] points.timeSamples = {\n" + rows + "}\n" + points)
    elif way == 14:
        indices, positions = ", ".join(["0"] * 50_000), ", ".join(["(0, 0, 0)"] * 50_000)
        body += f'def PointInstancer "p" {{ rel prototypes = [</c>]\n int[] protoIndices = [{indices}]\n'
        body += f" point3f[] positions = [{positions}] }}\n"
    elif way == 15:
        segments = random.choice([3, 30_000])
        body = (CURVE % "c").replace('"linear"', '"cubic"').replace("[2]", f"[{segments + 1}]")
        body = body.replace("(0, 1, 0)", "(0, 1, 0), " * (segments - 1) + "(0, 1, 0)")
        body = body.replace("}\n", ' uniform token basis = "%s"\n uniform token wrap = "%s"\n}\n' % (
            random.choice(["bezier", "bspline", "catmullRom"]), random.choice(["nonperiodic", "pinned", "periodic"])))  # fmt: skip
    elif way == 16:
        body += "".join(f'def Xform "x{i}" {{}}\n' for i in range(random.choice([100, 10_000, 40_000])))
        body += CURVE % "e" * random.choice([1, 1, 3])
    elif way == 17:  # a package
        stream = io.BytesIO()
        with zipfile.ZipFile(stream, "w", random.choice([zipfile.ZIP_STORED, zipfile.ZIP_DEFLATED])) as archive:
            arc = usd_arc(random, place)
            archive.writestr("a.usda", f"#usda 1.0\n({arc[0]})\n{body}{arc[1]}")
            archive.writestr("b.usda", "#usda 1.0\n" + " " * random.choice([1, 2_000_000]))
        name = "a.usdz"
        place.write(name, stream.getvalue())
        return as_strands(random, place, name)
    elif way == 18:
        name = random.choice(["a.usdc", "a.usd", "a.usdz"])
        magic = random.choice([b"PXR-USDC\0\x08\0", b"PXR-USDC\0\xff\0", b"PK\x03\x04", b"#usda 1.0\n"])
        place.write(name, magic + bytes(random.randrange(256) for _ in range(random.choice([10, 200, 3_000]))))
        return as_strands(random, place, name)
    text = f"#usda 1.0\n({metadata})\n{body}"[:MOST_BYTES].encode()
    if way == 19:
        text = damaged_usd(random)
    place.write(name, text)
    if is_mesh:
        if random.random() < 0.3:
            return scene(place, groom={"file": "hair.hgl", "mesh": name}, simulation={"animation": {"clip": "0"}})
        return as_mesh(random, place, name)
    return as_strands(random, place, name)


def damaged_usd(random):
    """A valid layer in which other words replace some words."""
    data = corpus(random, "tests/corpus/usd/*").decode()
    data += random.choice([FACE % "m", CURVE % "d", usd_nested(random, "references = <%s>")])
    if random.random() < 0.5:
        return damaged(random, data.encode())
    words = data.replace("(", " ( ").replace(")", " ) ").replace(",", " , ").split(" ")
    for _ in range(random.choice([1, 2, 5])):
        at = random.randrange(len(words))
        words[at] = random.choice([random.choice(words), "", "None", "[]", "{}", "</>", "@@", '"x"', "1e999"])
    return " ".join(words).encode()


# ---- Embree --------------------------------------------------------------------------------------


def embree(random, place):
    curve = (
        '<Curves id="c" basis="linear" type="flat"><positions>0 0 0 1 0 1 0 1</positions>'
        "<indices>0</indices></Curves>"
    )
    name = "a.xml"
    way = random.randrange(11)
    body = curve
    if way in (0, 1):  # each node contains the previous one several times
        width, levels = random.choice([(2, 10), (2, 60), (10, 5), (10, 9), (1_000, 2), (1_000, 3)])
        body = f'<assign id="n0">{curve}</assign>'
        for i in range(1, levels):
            body += f'<assign id="n{i}"><Group>{f"""<ref id="n{i - 1}"/>""" * width}</Group></assign>'
        body += f'<ref id="n{levels - 1}"/>'
    elif way == 2:
        body = f'<Group id="a"><ref id="a"/></Group><assign id="b"><ref id="b"/></assign><ref id="b"/>{curve}'
    elif way in (3, 4):
        target = place.outside(random, ".bin")
        link = place.inside / random.choice(["a.bin", "a.xml.bin"])
        if target.startswith("./pipe"):
            os.mkfifo(link)
        else:
            link.symlink_to(target)
        body = curve.replace(
            "<positions>0 0 0 1 0 1 0 1</positions>",
            f'<positions ofs="0" size="{random.choice([2, 0, 1 << 30, 2**63, -1])}"/>',
        )
    elif way in (5, 6):  # arrays that many curves share
        size = random.choice([100, 10_000, 100_000])
        place.write("a.bin", struct.pack("<4f", 0, 1, 0, 1) * size + struct.pack("<I", 0))
        one = (
            f'<Curves basis="{random.choice(["linear", "bezier", "bspline", "hermite"])}" type="flat">'
            f'<positions ofs="0" size="{size}"/>'
            f'<indices ofs="{random.choice([16 * size, 0])}" size="{random.choice([1, size, 4 * size])}"/></Curves>'
        )
        body = one * random.choice([1, 100, 10_000])
    elif way == 7:
        depth = random.choice([10, 63, 70, 50_000])
        body = "<Group>" * depth + curve + "</Group>" * depth
    elif way == 8:
        transform = "<Transform><AffineSpace>1e30 0 0 0 0 1e30 0 0 0 0 1e30 0</AffineSpace>"
        depth = random.choice([1, 3, 30])
        body = transform * depth + curve + "</Transform>" * depth
    elif way == 9:
        body = curve.replace("0 1 0 1", " ".join(random.choice(NUMBERS).decode() for _ in range(8)))
        body += "<a " + " ".join(f'x{i}="1"' for i in range(random.choice([1, 50_000]))) + "/>"
        body += "<!-- -->" * random.choice([1, 100_000])
    text = f'<?xml version="1.0"?><scene>{body}</scene>'[:MOST_BYTES].encode()
    if way == 10:
        text = damaged(random, corpus(random, "tests/corpus/xml/*"))
    place.write(name, text)
    return as_strands(random, place, name)


# ---- NumPy ---------------------------------------------------------------------------------------


def npy_header(descr, shape, fortran=False):
    text = "{'descr': '%s', 'fortran_order': %s, 'shape': %s, }" % (descr, fortran, shape)
    text += " " * (-(len(text) + 11) % 64) + "\n"
    return b"\x93NUMPY\x01\0" + struct.pack("<H", len(text) & 0xFFFF) + text.encode()


def npz(random, place):
    way = random.randrange(11)
    name = "a.npz"
    strands = random.choice([2, 1_000, 10_000])
    array = npy_header("<f4", f"({strands}, 4, 3)") + b"\0" * (48 * strands)
    members = [("positions.npy", array)]
    method = zipfile.ZIP_DEFLATED
    if way in (0, 1):  # zeros that inflate a thousandfold
        strands = random.choice([100_000, 1_000_000, 4_000_000])
        place.write(name, bomb(strands, random.choice(["positions.npy", "a.npy", "widths.npy"])))
        return as_strands(random, place, name)
    if way == 2:
        members = [(f"a{i}.npy", array) for i in range(random.choice([10, 100, 3_000]))]
    elif way == 3:
        members = [(member, array) for member in random.sample(["positions.npy", "widths.npy", "groups.npy", "x"], 3)]
    elif way == 4:
        method = zipfile.ZIP_STORED
        count = random.choice([1_000, 30_000])
        members += [("n" * random.choice([1, 60]) + str(i), b"") for i in range(count)]
    elif way == 5:
        name = "a.npy"
        shape = random.choice(["(2, 2, 3)", "(4294967296, 4294967296, 3)", "(0, 0, 3)", "(1, 10000000000, 3)",
                               "(" + "1, " * 40 + "3)", "(-1, 2, 3)", "(2, 2, 3" + "1" * 1_000 + ")"])  # fmt: skip
        descr = random.choice(["<f4", "<f8", ">f4", "|O", "<U1000", "<i8"])
        header = npy_header(descr, shape, random.choice([True, False]))
        place.write(name, header + b"\0" * random.choice([24, 48, 5_000]))
        return as_strands(random, place, name)
    elif way == 6:
        name = "a.npy"
        strands = random.choice([10, 20_000])
        content = npy_header("<f8", f"({strands}, 4, 3)", True) + struct.pack("<d", 1.5) * (12 * strands)
        place.write(name, content)
        return as_strands(random, place, name)
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", method) as archive:
        for member, content in members:
            archive.writestr(zipfile.ZipInfo(member), content, method)
    data = bytearray(stream.getvalue())
    if way == 7:  # all members lie at the place of the first
        data = bytearray(shared_headers(bytes(data), random.choice([2, 100, 20_000])))
    elif way == 8:  # wrong sizes
        at = data.rfind(b"PK\x01\x02")
        field = random.choice([20, 24, 28, 30, 42])
        data[at + field : at + field + 4] = struct.pack("<I", random.choice(WORDS))
    elif way == 9:
        at = data.rfind(b"PK\x05\x06")
        field = random.choice([4, 8, 10, 12, 16])
        data[at + field : at + field + 4] = struct.pack("<I", random.choice(WORDS))
    elif way == 10:
        data = damaged(random, corpus(random, "tests/corpus/np[yz]/*"))
        name = "a.npy" if data[1:6] == b"NUMPY" else "a.npz"
    place.write(name, bytes(data[:MOST_BYTES]))
    return as_strands(random, place, name)


@functools.lru_cache(maxsize=None)
def bomb(strands, name):
    """An archive of strands at one point, made without holding their bytes in memory."""
    compress = zlib.compressobj(9, zlib.DEFLATED, -15)
    parts, checksum, size = [], 0, 0
    count, rest = divmod(48 * strands, 1_000_000)
    for part in [npy_header("<f4", f"({strands}, 4, 3)")] + [b"\0" * 1_000_000] * count + [b"\0" * rest]:
        parts.append(compress.compress(part))
        checksum = zlib.crc32(part, checksum)
        size += len(part)
    packed = b"".join(parts) + compress.flush()
    common = struct.pack("<HHHHHIIIHH", 20, 0, 8, 0, 33, checksum, len(packed), size & 0xFFFFFFFF, len(name), 0)
    local = b"PK\x03\x04" + common + name.encode()
    central = b"PK\x01\x02" + struct.pack("<H", 20) + common + struct.pack("<HHHII", 0, 0, 0, 0, 0) + name.encode()
    start = len(local) + len(packed)
    end = b"PK\x05\x06" + struct.pack("<IHHIIH", 0, 1, 1, len(central), start, 0)
    return local + packed + central + end


def shared_headers(data, count):
    """The archive with its first member `count` times in the directory."""
    at = data.rfind(b"PK\x05\x06")
    start = struct.unpack_from("<I", data, at + 16)[0]
    length = 46 + struct.unpack_from("<H", data, start + 28)[0]
    entry = data[start : start + length]
    directory = b"".join(
        entry[:46] + f"a{i:05}.npy".encode().rjust(length - 46, b"_")[: length - 46] for i in range(count)
    )
    end = b"PK\x05\x06" + struct.pack("<IHHIIH", 0, count & 0xFFFF, count & 0xFFFF, len(directory), start, 0)
    return data[:start] + directory + end


# ---- Other formats of strands --------------------------------------------------------------------


def alembic(random, place):
    place.write("a.abc", damaged(random, corpus(random, "tests/corpus/abc/*")))
    return as_strands(random, place, "a.abc")


def strands(random, place):
    folder = random.choice(["hair", "hgl", "tfx", "data", "bin", "mitshair", "pbrt"])
    data = corpus(random, f"tests/corpus/{folder}/*")
    if random.random() < 0.4:  # extreme counts in the header
        data = bytearray(data)
        for _ in range(random.choice([1, 2])):
            at = 4 * random.randrange(min(len(data) // 4, 32))
            data[at : at + 4] = struct.pack("<I", random.choice(WORDS))
        data = bytes(data)
    else:
        data = damaged(random, data)
    place.write("a." + folder, data)
    return as_strands(random, place, "a." + folder)


# ---- Pictures ------------------------------------------------------------------------------------


def png(width, height, depth, color, rows=b"", interlace=0, more=b""):
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, depth, color, 0, 0, interlace)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + more + chunk(b"IDAT", rows) + chunk(b"IEND", b"")


@functools.lru_cache(maxsize=None)
def zeros(size):
    """`size` zeros, deflated, made without holding them in memory."""
    compress = zlib.compressobj(9)
    block = b"\0" * 1_000_000
    parts = [compress.compress(block) for _ in range(size // len(block))]
    return b"".join(parts) + compress.compress(block[: size % len(block)]) + compress.flush()


SIDES = [1, 100, 3_000, 8_000, 20_000, 65_535, 1 << 24, 2**31 - 1]


def picture(random, place):
    way = random.randrange(10)
    name = "a.png"
    if way in (0, 1):
        width, height = random.choice(SIDES[:5]), random.choice(SIDES[:5])
        depth, color = random.choice([(8, 0), (8, 2), (8, 6), (16, 6), (1, 0), (8, 3)])
        row = (width * depth * {0: 1, 2: 3, 6: 4, 3: 1}[color] + 7) // 8 + 1
        data = png(width, height, depth, color, zeros(min(row * height, 100_000_000)), random.choice([0, 1]))
    elif way == 2:
        data = png(random.choice(SIDES), random.choice(SIDES), 8, 6, zlib.compress(b"\0" * 5_000))
    elif way in (3, 4):
        data = damaged(random, corpus(random, "tests/fuzz/seeds/picture/*.png"))
    elif way == 5:
        name = "a.jpg"
        data = bytearray(corpus(random, "tests/fuzz/seeds/picture/*.jpg"))
        at = max(data.find(b"\xff\xc0"), data.find(b"\xff\xc2"))
        if at > 0:
            data[at + 5 : at + 9] = struct.pack(">HH", *(min(random.choice(SIDES), 65_535) for _ in range(2)))
            scan = data.rfind(b"\xff\xda")
            data += bytes(data[scan:]) * random.choice([0, 100, 2_000])
        data = bytes(data)
    elif way == 6:
        name = random.choice(["a.bmp", "a.tga", "a.jpg"])
        data = damaged(random, corpus(random, "tests/fuzz/seeds/picture/*" + name[1:]))
    elif way == 7:
        name = "a.exr"
        data = bytearray(corpus(random, "tests/fuzz/seeds/float_picture/*.exr"))
        for key in (b"dataWindow\0box2i\0", b"displayWindow\0box2i\0"):
            at = data.find(key) + len(key) + 4
            sides = [random.choice(SIDES) for _ in range(2)]
            data[at : at + 16] = struct.pack("<4i", 0, 0, sides[0] - 1, sides[1] - 1)
        data = bytes(data)
    elif way == 8:
        name = "a.hdr"
        width, height = random.choice(SIDES), random.choice(SIDES)
        size = b"-Y %d +X %d\n" % (height, width)
        data = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n" + size + b"\x02\x02\x7f\xff" + b"\xff\0" * 20_000
    else:
        name = random.choice(["a.exr", "a.hdr"])
        data = damaged(random, corpus(random, "tests/fuzz/seeds/float_picture/*" + name[1:]))
    place.write(name, data[:MOST_BYTES])
    if name.endswith((".exr", ".hdr")):
        return scene(place, render={"head": False, "environment": name})
    if random.random() < 0.2:
        place.write("a.mtl", f"newmtl m\nmap_Kd {name}\n")
        place.write("a.obj", "mtllib a.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n")
        return scene(place, render={"head": False, "meshes": [{"file": "a.obj"}]})
    if name == "a.png" and random.random() < 0.1:
        return ["validate", str(place.inside / name)]  # a screenshot with its scene
    return scene(place, strands={"texture": name})


# ---- Scenes --------------------------------------------------------------------------------------

# The fields that name files, and the extensions of those files.
FIELDS = [
    ("/groom/file", ".hgl"),
    ("/groom/file", ".usda"),
    ("/groom/file", ".xml"),
    ("/groom/mesh", ".obj"),
    ("/groom/fixed", ".hgl"),
    ("/groom/grow/mesh", ".obj"),
    ("/groom/grow/mask", ".png"),
    ("/groom/grow/length_map", ".png"),
    ("/simulation/force", ".glsl"),
    ("/simulation/solver", ".glsl"),
    ("/strands/curve", ".glsl"),
    ("/strands/offset_function", ".glsl"),
    ("/strands/offsets", ".hgl"),
    ("/strands/texture", ".png"),
    ("/shading/model", ".glsl"),
    ("/render/environment", ".hdr"),
    ("/render/meshes/0/file", ".obj"),
    ("/simulation/distance_fields/0/mesh", ".obj"),
    ("/run/reference", ".png"),
]


def put(document, pointer, value):
    node = document
    names = pointer[1:].split("/")
    for name, following in zip(names, names[1:] + [None]):
        if following is None:
            node[name] = value
        elif following == "0":
            node[name] = [{}]
        elif name == "0":
            node = node[0]
        else:
            node.setdefault(name, {})
        if name != "0" and following is not None:
            node = node[name]


def scenes(random, place):
    place.write("hair.hgl", HAIR)
    document = {"groom": {"file": "hair.hgl"}, "render": {"head": False}}
    way = random.randrange(13)
    if way in (0, 1, 2):  # a file outside in a field, or in a value of an axis
        pointer, ending = random.choice(FIELDS)
        name = place.outside(random, ending)
        if pointer.startswith("/groom/grow"):
            del document["groom"]["file"]
        if "/0/" not in pointer and random.random() < 0.4:
            document["sweep"] = {pointer: [name, name]} if random.random() < 0.5 else {
                "/strands/density": {"values": [1, 2], "with": {pointer: [name, ""]}}}  # fmt: skip
        else:
            put(document, pointer, name)
    elif way == 3:
        document["base"] = place.outside(random, ".json")
    elif way == 4:  # a chain of bases
        count = random.choice([3, 15, 16, 17, 300])
        for i in range(count):
            place.write(f"b{i}.json", json.dumps({"base": f"b{i + 1}.json"} if i + 1 < count else document))
        document = {"base": "b0.json"}
    elif way == 5:
        member = random.choice(["base", "suite"])
        names = ["scene.json", "./scene.json", str(place.inside / "scene.json"), "a.json"]
        place.write("a.json", json.dumps({member: "scene.json" if member == "base" else ["scene.json"]}))
        document = {member: random.choice(names) if member == "base" else names * random.choice([1, 1_000])}
    elif way == 6:  # many axes, or many values
        axes = random.choice([1, 2, 5, 40])
        count = random.choice([2, 100, 3_000])
        pointers = ["/strands/density", "/strands/tessellation", "/seed", "/render/msaa", "/camera/field_of_view",
                    "/groom/guides", "/strands/root_width", "/simulation/wind/strength", "/camera/position/0"]  # fmt: skip
        document["sweep"] = {
            f"/camera/position/{i}" if i < 3 else random.choice(pointers): list(range(1, count + 1)) for i in range(axes)
        }
        if random.random() < 0.5:
            document["sweep"]["exclude"] = [{"/seed": list(range(1_000))}] * random.choice([1, 500, 5_000])
    elif way == 7:  # many edits
        count = random.choice([10, 2_000, 30_000])
        edits = [{"kind": random.choice(["cut", "comb", "lengthen", "x"]), "strokes": [[0, 0, 0]] * 3}] * count
        put(document, random.choice(["/groom/edits", "/groom/style/edits", "/simulation/colliders",
                                     "/render/lights", "/simulation/motion/keyframes", "/render/meshes"]), edits)  # fmt: skip
    elif way == 8:
        depth = random.choice([10, 200, 5_000, 200_000])
        place.write("scene.json", '{"a":' * depth + "1" + "}" * depth)
        return ["validate", str(place.inside / "scene.json")]
    elif way == 9:
        keys = ", ".join(f'"k{i}": {i}' for i in range(random.choice([10, 100_000])))
        place.write("scene.json", "{" + keys + ', "seed": ' + "9" * random.choice([10, 400, 500_000]) + "}")
        return ["validate", str(place.inside / "scene.json")]
    elif way == 10:
        folders = [ROOT / "scenes", ROOT / "scenes/papers", ROOT / "scenes/truth"]
        names = [each for folder in folders for each in sorted(folder.glob("*.json"))]
        names = [each for each in names if each.name != "scene.schema.json"]
        text = damaged_json(random, json.loads(random.choice(names).read_text()))
        return ["validate", place.write("scene.json", text)]
    elif way == 11:  # a screenshot that inflates
        text = json.dumps({**document, "description": "x" * random.choice([10, 10_000_000])}).encode()
        packed = b"hairbench scene\0\0" + random.choice([zlib.compress(text), zeros(100_000_000)])
        chunk = struct.pack(">I", len(packed)) + b"zTXt" + packed + struct.pack(">I", zlib.crc32(b"zTXt" + packed))
        return ["validate", place.write("a.png", png(1, 1, 8, 0, zlib.compress(b"\0\0"), more=chunk))]
    elif way == 12:
        document["description"] = "\n\x1b[31mhairbench: ok" * random.choice([1, 1_000])
        document[random.choice(["a\nb", "\x1b]0;x\x07", "\u202e", ""])] = 1
    place.write("scene.json", json.dumps(document)[:MOST_BYTES])
    return ["validate", str(place.inside / "scene.json")]


# ---- Functions in GLSL ---------------------------------------------------------------------------


def glsl(random, place):
    way = random.randrange(15)
    head = ""
    body = "return point.color;"
    if way == 0:
        head = f"const float a[{random.choice([1_000, 1_025, 100_000, 2_000_000_000])}] = float[](1.0);\n"
    elif way == 1:  # each function calls the previous one twice
        head = "float f0(float x) { return x; }\n" + "".join(
            f"float f{i}(float x) {{ return f{i - 1}(x) + f{i - 1}(x + 1.0); }}\n"
            for i in range(1, random.choice([5, 14, 60]))
        )
        body = "return vec3(f4(1.0));"
    elif way == 2:
        depth = random.choice([50, 400, 20_000])
        lines = "(\n" * depth + "1.0" + ")\n" * depth
        body = f"float x = {lines};\nreturn vec3(x);"
    elif way == 3:
        depth = random.choice([10, 40, 5_000])
        body = "if (point.along > 0.5) {\n" * depth + "point.color *= 2.0;" + "}\n" * depth + "return point.color;"
    elif way == 4:
        body = random.choice(["while (true) {}", "for (;;) {}", "for (int i = 0; i < 2147483647; ++i) {}",
                              "do { point.color *= 1.1; } while (point.color.x > 0.0);"]) + "return point.color;"  # fmt: skip
    elif way == 5:  # constants that are folded
        count = random.choice([50, 500, 3_000])
        head = "const mat4 a0 = mat4(1.0);\n"
        head += "".join(f"const mat4 a{i} = a{i - 1} * a{i - 1};\n" for i in range(1, count))
        body = f"return vec3(a{count - 1}[0][0]);"
    elif way == 6:
        name = place.outside(random, ".glsl")
        head = random.choice([f'#include "{name}"\n', f"#pragma include {name}\n", "#define X x\n", "#version 460\n",
                              "#extension GL_EXT_buffer_reference : enable\n", "#line 1 2\n", '??=include "x"\n'])  # fmt: skip
    elif way == 7:
        head = "".join(f"// @parameter p{i} 1 [0, 2] 1: x\n" for i in range(random.choice([1, 16, 17, 2_000])))
    elif way == 8:
        count = random.choice([10, 300, 900])
        head = "struct S0 { float x; };\n" + "".join(
            f"struct S{i} {{ S{i - 1} a; S{i - 1} b; }};\n" for i in range(1, count)
        )
        body = f"S{min(count, 12) - 1} s;\nreturn point.color;"
    elif way == 9:
        count = random.choice([100, 2_000, 5_000])
        body = "float x = 0.0;\n" + "x = sin(x) + 1.0;\n" * count + "return vec3(x);"
    elif way == 10:
        body = "switch (int(point.along * 9.0)) {\n" + "".join(f"case {i}: return vec3({i});\n" for i in range(
            random.choice([10, 1_500]))) + "}\nreturn point.color;"  # fmt: skip
    elif way == 11:
        body = f"float a[{random.choice([10, 1_000, 1_025, 70_000])}];\na[int(point.along * 1e9)] = 1.0;\n" * 2
        body = body.replace("float a", "float b", 1).replace("\na[", "\nb[", 1) + "return vec3(a[0]);"
    elif way == 12:
        text = random.choice(sorted((ROOT / "scenes/extended").glob("*.glsl"))).read_bytes()
        text = damaged(random, text)
        field = random.choice(["model", "force", "offset", "solver", "curve"])
        place.write("a.glsl", text)
        return extended(place, field)
    elif way == 13:
        words = ["for", "(", ")", "{", "}", ";", "vec3", "x", "=", "+", "point", ".", "color", "1.0", "if", "return",
                 "struct", "const", "[", "]", ",", "?", ":", "mat4", "int", "inout", "discard", "layout", "precise"]  # fmt: skip
        body = "\n".join(" ".join(random.choice(words) for _ in range(12)) for _ in range(random.choice([2, 300])))
    else:  # nested expressions of vectors
        depth = random.choice([5, 10, 14])
        text = "point.color"
        for _ in range(depth):
            text = f"mix({text},\n{text}, 0.5)" if len(text) < 30_000 else text
        body = f"return {text};"
    place.write("a.glsl", (head + "vec3 shadeHair(HairPoint point) {\n" + body + "\n}\n")[:MOST_BYTES])
    return extended(place, "model")


def extended(place, field):
    if field == "model":
        return scene(place, shading={"model": "a.glsl"})
    if field == "force":
        return scene(place, simulation={"force": "a.glsl"})
    if field == "solver":
        return scene(place, simulation={"solver": "a.glsl"})
    if field == "curve":
        return scene(place, strands={"curve": "a.glsl"})
    return scene(place, strands={"offset_function": "a.glsl"})


# ---- Reports and journals ------------------------------------------------------------------------


def report(random, place):
    patterns = random.choice(["tests/fuzz/seeds/report/*_1.json", "tests/fuzz/seeds/report/*_2.json",
                              "tests/fuzz/seeds/merge/*.json"])  # fmt: skip
    text = corpus(random, patterns).decode().split("\x1e")[0]
    document = json.loads(text)
    way = random.randrange(9)
    page = ["report", "-o", str(place.out / "page.html")]
    if way in (0, 1, 2):  # pictures outside
        for i, case in enumerate(document["cases"]):
            case["picture"] = place.outside(random, ".png")
            if random.random() < 0.3:
                folder = place.inside / "r.pictures"
                if not os.path.lexists(folder):
                    folder.mkdir()
                    (folder / "0.png").symlink_to("../../private/planted.png")
                    os.mkfifo(folder / "1.png")
                    (place.inside / "s.pictures").symlink_to("../private")
                case["picture"] = random.choice(["r.pictures/0.png", "r.pictures/1.png", "s.pictures/1.png"])
        return page + [place.write("r.json", json.dumps(document))]
    if way == 3:
        (place.inside / "r.samples.jsonl").symlink_to("../private/planted.jsonl")
    elif way == 4:
        os.mkfifo(place.inside / "r.samples.jsonl")
    elif way == 5:
        document["cases"] *= random.choice([10, 200])
        for i, case in enumerate(document["cases"]):
            document["cases"][i] = {**case, "name": f"c{i}"}
    elif way == 6:
        depth = random.choice([100, 5_000, 200_000])
        text = json.dumps(document)[:-1] + ', "a": ' + "[" * depth + "]" * depth + "}"
        return page + [place.write("r.json", text)]
    text = json.dumps(document) if way < 7 else damaged_json(random, document)
    path = place.write("r.json", text[:MOST_BYTES])
    other = place.write("s.json", json.dumps(document)[:MOST_BYTES])
    formats = ["csv", "markdown", "gbench", "bmf", "customSmallerIsBetter", "perfetto"]
    return random.choice(
        [
            page + [path, other],
            page + [path],
            ["compare", path, other],
            ["compare", other, path],
            ["convert", path, "-f", random.choice(formats), "-o", str(place.out / "x")],
            ["convert", path, "-f", "perfetto", "-o", str(place.out / "x")],
            ["merge", path, other, "-o", str(place.out / "m.json"), *random.choice([[], ["--force"]])],
            ["doctor", "--rules", path],
            ["doctor", "--reports", path, other],
        ]
    )


def resumed(place):
    """Arguments that resume a run of a scene that takes a moment."""
    path = scene(
        place,
        simulation={"solver": "none"},
        strands={"density": 1, "tessellation": 1},
        render={"head": False, "width": 64, "height": 64},
        run={"frames": 1, "warmup": 2, "max_time": 0},
    )[1]
    return ["run", path, "-o", str(place.inside / "r.json"), "--no-pictures", "--resume", "--no-cache"]


def journal(random, place):
    path = place.inside / "r.json.journal"
    data = corpus(random, "tests/fuzz/seeds/journal/*")
    way = random.randrange(6)
    if way == 0:
        path.symlink_to("../private/planted.json")
    elif way == 1:
        os.mkfifo(path)
    elif way == 2:
        place.write(path.name, data + data[-2_000:] * random.choice([1, 200]))
    elif way == 3:
        place.write(path.name, b'{"hash":' + b"[" * random.choice([100, 100_000]) + b"\n" + data)
    elif way == 4:
        place.write(path.name, b"a" * random.choice([10, MOST_BYTES]))
    else:
        place.write(path.name, damaged(random, data))
    return resumed(place)


KINDS = {
    "scene": scenes,
    "gltf": gltf,
    "obj": obj,
    "ply": ply,
    "mesh": mesh,
    "usd": usd,
    "embree": embree,
    "npz": npz,
    "alembic": alembic,
    "strands": strands,
    "picture": picture,
    "glsl": glsl,
    "report": report,
    "journal": journal,
}

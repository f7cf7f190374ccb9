"""Give the head a skeleton, two expressions and an animation: head_talk.glb.

Run (Python 3.9+, nothing else):

    python3 make_talking_head.py [output_directory]

It reads ``head.glb`` beside this script and writes ``head_talk.glb`` next to it
(or into ``output_directory``).  Positions, normals, triangles, texture coordinates
and the skin's picture are those of ``head.glb`` to the bit, so hair that grows on
one grows on the other.

* Joints: ``bust``, which stands still; ``neck`` and ``head``, which take two
  fifths and three fifths of each nod and turn; ``jaw``, a child of the head.
* Morph targets: ``brows`` raises the forehead and, with it, the front of the
  scalp by up to 5 mm; ``smile`` draws the corners of the mouth 4 mm outward and
  up.
* Animation ``talk``: 4 s that repeat without a jump: the head nods, turns and
  tilts, the jaw opens by up to 9 degrees, the brows go up twice.

Conventions are those of make_head.py: metres, +y up, the face looks toward +z.
"""
import json
import math
import pathlib
import struct
import sys

NECK = (0.0, -0.170, -0.035)
HEAD = (0.0, -0.085, -0.025)
JAW = (0.0, -0.042, -0.004)
JOINTS = [("bust", (0.0, 0.0, 0.0)), ("neck", NECK), ("head", HEAD), ("jaw", JAW)]
# From the bust to the neck and from the neck to the head, along y + LEAN z (m):
# the line runs from below the chin to the nape.
LEAN = 0.45
NECK_BLEND = -0.215, -0.165
HEAD_BLEND = -0.160, -0.110
SECONDS = 4.0


def smoothstep(low, high, x):
    t = min(max((x - low) / (high - low), 0.0), 1.0)
    return t * t * (3 - 2 * t)


# Line between the lips, where make_head.py cuts its slot: x, y (m).
PARTING = [(0.0, -0.0900), (0.0015, -0.08967), (0.0030, -0.08946), (0.0045, -0.08933),
           (0.0060, -0.0893), (0.0075, -0.08932), (0.0090, -0.08941), (0.0105, -0.08953),
           (0.0120, -0.08969), (0.0135, -0.08986), (0.0232, -0.09104), (1.0, -0.09104)]


def parting(x):
    x = abs(x)
    for (x0, y0), (x1, y1) in zip(PARTING, PARTING[1:]):
        if x <= x1:
            return y0 + (y1 - y0) * (x - x0) / (x1 - x0)
    return PARTING[-1][1]


def jaw_weight(x, y, z):
    """Return how much of a point of the head the jaw carries."""
    down = math.degrees(math.atan2(JAW[1] - y, z - JAW[2]))  # 0: forward, 90: down
    # Lips part at the slot between them, the cheeks stretch over many degrees.
    side = smoothstep(0.0215, 0.042, abs(x))
    reach = 0.0002 + 0.020 * side
    lips = smoothstep(-reach, reach + 0.016 * side, parting(x) - y)
    behind = smoothstep(26.0, 56.0, down)
    at_lips = smoothstep(0.044, 0.058, z)
    upper = at_lips * lips + (1 - at_lips) * behind
    throat = 1 - smoothstep(66.0, 112.0, down)
    front = smoothstep(0.0, 0.045, z - JAW[2])
    return upper * throat * front


def joint_weights(point):
    x, y, z = point
    along = y + LEAN * max(z, -0.02)
    neck = smoothstep(*NECK_BLEND, along)
    head = smoothstep(*HEAD_BLEND, along)
    jaw = head * jaw_weight(x, y, z)
    return [1 - neck, neck - head * neck, head * neck - jaw * neck, jaw * neck]


def in_bytes(weights):
    """Round weights to 255ths whose sum is 255, by largest remainders."""
    scaled = [255 * w for w in weights]
    whole = [math.floor(s) for s in scaled]
    for i in sorted(range(4), key=lambda i: whole[i] - scaled[i])[:255 - sum(whole)]:
        whole[i] += 1
    return whole


def bump(point, centre, radius):
    square = sum((p - c) ** 2 for p, c in zip(point, centre)) / radius ** 2
    return (1 - square) ** 2 if square < 1 else 0.0


def brows(point):
    w = bump(point, (0.0, 0.045, 0.072), 0.062)
    # Along the forehead, back over the head: round the middle of the cranium.
    radius = math.hypot(point[1], point[2]) or 1.0
    return [0.0, 0.005 * w * point[2] / radius, -0.005 * w * point[1] / radius]


def smile(point):
    sides = [bump(point, (side * 0.026, -0.088, 0.076), 0.026) for side in (-1, 1)]
    out, up = sides[1] - sides[0], sides[0] + sides[1]
    return [0.003 * out, 0.0028 * up, -0.0012 * up]


def turn(pitch, yaw, roll):
    """Return the quaternion x, y, z, w of yaw after pitch after roll, in degrees."""
    def times(a, b):
        ax, ay, az, aw = a
        bx, by, bz, bw = b
        return (aw * bx + ax * bw + ay * bz - az * by, aw * by - ax * bz + ay * bw + az * bx,
                aw * bz + ax * by - ay * bx + az * bw, aw * bw - ax * bx - ay * by - az * bz)
    x, y, z = (math.radians(angle) / 2 for angle in (pitch, yaw, roll))
    return times(times((0, math.sin(y), 0, math.cos(y)), (math.sin(x), 0, 0, math.cos(x))),
                 (0, 0, math.sin(z), math.cos(z)))


def pose(time, share):
    """Return a joint's turn: `share` of the head's nods, turns and tilts."""
    t = 2 * math.pi * time / SECONDS
    return turn(share * (2 + 11 * math.sin(2 * t) + 4 * math.sin(3 * t + 1)),
                share * (20 * math.sin(t)), share * (5 * math.sin(t + 2)))


def jaw_turn(time):
    # Syllables of different lengths.
    t = 2 * math.pi * time / SECONDS
    opened = max(0.0, 0.45 + 0.4 * math.sin(9 * t) + 0.3 * math.sin(14 * t + 0.7))
    return turn(9.0 * min(opened, 1.0), 0, 0)


def expressions(time):
    return [smoothstep(0.3, 0.55, time) - smoothstep(0.9, 1.2, time)
            + smoothstep(2.4, 2.6, time) - smoothstep(3.0, 3.3, time),
            smoothstep(1.6, 2.1, time) - smoothstep(2.9, 3.6, time)]


def read_glb(path):
    data = path.read_bytes()
    size = struct.unpack_from("<I", data, 12)[0]
    return json.loads(data[20:20 + size]), data[28 + size:]


class Writer:
    def __init__(self):
        self.binary, self.views, self.accessors = b"", [], []

    def view(self, data):
        self.views.append({"buffer": 0, "byteLength": len(data), "byteOffset": len(self.binary)})
        self.binary += data + bytes(-len(data) % 4)
        return len(self.views) - 1

    def accessor(self, data, component, kind, count, **extra):
        self.accessors.append({"bufferView": self.view(data), "componentType": component,
                               "type": kind, "count": count, **extra})
        return len(self.accessors) - 1

    def floats(self, rows, kind):
        flat = [value for row in rows for value in row]
        extra = {"min": [min(flat)], "max": [max(flat)]} if kind == "SCALAR" else {}
        return self.accessor(struct.pack(f"<{len(flat)}f", *flat), 5126, kind, len(rows), **extra)

    def sparse(self, rows):
        """Write displacements, those that are not zero."""
        moved = [i for i, row in enumerate(rows) if max(map(abs, row)) > 1e-6]
        if not moved:
            moved = [0]
        used = [rows[i] for i in moved]
        self.accessors.append({
            "componentType": 5126, "type": "VEC3", "count": len(rows),
            "min": [min(min(r[k] for r in used), 0.0) for k in range(3)],
            "max": [max(max(r[k] for r in used), 0.0) for k in range(3)],
            "sparse": {
                "count": len(moved),
                "indices": {"bufferView": self.view(struct.pack(f"<{len(moved)}H", *moved)),
                            "componentType": 5123},
                "values": {"bufferView": self.view(
                    struct.pack(f"<{3 * len(used)}f", *(v for r in used for v in r)))}}})
        return len(self.accessors) - 1


def main():
    default = pathlib.Path(__file__).resolve().parent
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    document, binary = read_glb(default / "head.glb")
    writer = Writer()

    def data_of(number):
        source = document["accessors"][number]
        view = document["bufferViews"][source["bufferView"]]
        return source, binary[view["byteOffset"]:view["byteOffset"] + view["byteLength"]]

    def picture(image):
        view = document["bufferViews"][image["bufferView"]]
        at = view["byteOffset"]
        return {**image, "bufferView": writer.view(binary[at:at + view["byteLength"]])}

    def copied(number):
        source, data = data_of(number)
        extra = {key: source[key] for key in ("min", "max", "normalized") if key in source}
        return writer.accessor(data, source["componentType"], source["type"], source["count"],
                               **extra)

    primitives = []
    for primitive in document["meshes"][0]["primitives"]:
        source, data = data_of(primitive["attributes"]["POSITION"])
        flat = struct.unpack(f"<{3 * source['count']}f", data)
        points = [flat[i:i + 3] for i in range(0, len(flat), 3)]
        attributes = {name: copied(number) for name, number in primitive["attributes"].items()}
        weights = [in_bytes(joint_weights(p)) for p in points]
        attributes["JOINTS_0"] = writer.accessor(
            bytes((0, 1, 2, 3)) * len(points), 5121, "VEC4", len(points))
        attributes["WEIGHTS_0"] = writer.accessor(
            bytes(w for row in weights for w in row), 5121, "VEC4", len(points), normalized=True)
        primitives.append({
            "attributes": attributes, "indices": copied(primitive["indices"]),
            "material": primitive["material"],
            "targets": [{"POSITION": writer.sparse([shape(p) for p in points])}
                        for shape in (brows, smile)]})

    nodes = [{"name": "head", "mesh": 0, "skin": 0}]
    for i, (name, place) in enumerate(JOINTS):
        parent = JOINTS[i - 1][1] if i else (0.0, 0.0, 0.0)
        nodes.append({"name": name, "translation": [a - b for a, b in zip(place, parent)],
                      **({"children": [i + 2]} if i + 1 < len(JOINTS) else {})})
    inverse = [(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, *(-c for c in place), 1)
               for _, place in JOINTS]

    steady = [SECONDS * i / 64 for i in range(65)]
    spoken = [SECONDS * i / 160 for i in range(161)]
    steady_times = writer.floats([[t] for t in steady], "SCALAR")
    spoken_times = writer.floats([[t] for t in spoken], "SCALAR")
    tracks = [
        (2, "rotation", steady_times, writer.floats([pose(t, 0.4) for t in steady], "VEC4")),
        (3, "rotation", steady_times, writer.floats([pose(t, 0.6) for t in steady], "VEC4")),
        (4, "rotation", spoken_times, writer.floats([jaw_turn(t) for t in spoken], "VEC4")),
        (0, "weights", spoken_times,
         writer.floats([[w] for t in spoken for w in expressions(t)], "SCALAR"))]
    text = json.dumps({
        "asset": {"version": "2.0", "generator": "make_talking_head.py"},
        "scene": 0, "scenes": [{"nodes": [0, 1]}], "nodes": nodes,
        "meshes": [{"name": "head", "primitives": primitives, "weights": [0, 0],
                    "extras": {"targetNames": ["brows", "smile"]}}],
        "skins": [{"joints": list(range(1, len(JOINTS) + 1)), "skeleton": 1,
                   "inverseBindMatrices": writer.floats(inverse, "MAT4")}],
        "animations": [{
            "name": "talk",
            "samplers": [{"input": times, "output": values} for _, _, times, values in tracks],
            "channels": [{"sampler": i, "target": {"node": node, "path": path}}
                         for i, (node, path, _, _) in enumerate(tracks)]}],
        "materials": document["materials"], "textures": document["textures"],
        "samplers": document["samplers"], "images": [picture(i) for i in document["images"]],
        "accessors": writer.accessors,
        "bufferViews": writer.views, "buffers": [{"byteLength": len(writer.binary)}]}).encode()
    text += b" " * (-len(text) % 4)
    (out / "head_talk.glb").write_bytes(
        struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(writer.binary))
        + struct.pack("<I4s", len(text), b"JSON") + text
        + struct.pack("<I4s", len(writer.binary), b"BIN\0") + writer.binary)


if __name__ == "__main__":
    main()

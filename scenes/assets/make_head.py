"""Generate the stylised head-and-bust mesh used by the hair scenes.

Run (Python 3.9+, needs numpy, scipy and scikit-image):

    python3 make_head.py [output_directory]

It writes two files next to this script (or into ``output_directory``):

* ``head.glb``             binary glTF, one mesh with two primitives whose
                           materials are named ``skin`` and ``scalp``, with
                           texture coordinates (see texture_coordinates())
* ``head_colliders.json``  capsules that approximate the head for simulation

Conventions: metres, +y up, the face looks toward +z, mirror symmetric about
x = 0.  The cranium is centred near the origin, the bust is cut at BUST_Y.

How it works: the head is a signed distance function (SDF), smooth unions of
capsules and ellipsoids.  Only the half with x >= 0 is polygonised (marching
cubes), simplified toward a target edge length, relaxed along the surface, cut
along the hairline, and mirrored.  The hairline is an elevation limit given as
a function of azimuth, both seen from STAR, and the scalp is star-shaped from
that point.  The script is deterministic and asserts what hair code relies on.
"""
import heapq
import json
import math
import pathlib
import struct
import sys

import numpy as np
from scipy.interpolate import PchipInterpolator
from skimage.measure import marching_cubes

STAR = np.array([0.0, -0.01, -0.015])
BUST_Y = -0.30
# As shown on a display; glTF stores colours linear.
MATERIALS = {"skin": (0.80, 0.62, 0.52), "scalp": (0.45, 0.34, 0.27)}

# Hairline: azimuth from the face (degrees) -> lowest elevation of the scalp.
HAIRLINE = [
    (0, 31), (15, 32), (30, 35.5), (40, 35), (50, 25), (57, 9), (61, -8),
    (65, -15), (72, -15), (76, -2), (80, 10), (90, 16), (102, 13), (110, 2),
    (117, -16), (126, -30), (140, -39), (160, -43), (180, -43),
]
# Mesh detail: (centre, radius, edge length inside); coarser further away.
DETAIL = [
    ((.0315, -.0225, .072), .016, .0015), ((0, -.06, .100), .014, .0030),
    ((.0100, -.0910, .083), .016, .0026), ((0, .000, -.01), .110, .0065),
    ((.0780, -.0290, -.018), .032, .0025),
]
# Capsules (a, b, radius) for the simulation.  The first five were fitted to
# the scalp by least squares, the two of the face to its skin; write_colliders() reports how well they follow.
COLLIDERS = [
    ((0, .0140, .0120), (0, .0140, .0120), .0661),             # forehead
    ((-.0023, -.0135, -.0330), (.0023, -.0135, -.0330), .0679),  # occiput
    ((-.0070, -.0131, .0018), (.0070, -.0131, .0018), .0666),  # temples
    ((0, .0120, -.0086), (0, .0070, -.0313), .0725),           # vault
    ((0, -.0004, -.0322), (0, .0099, -.0242), .0730),          # back
    ((-.0124, .0004, .0315), (.0124, .0004, .0315), .0498),    # upper face
    ((-.0147, -.0472, .0299), (.0147, -.0472, .0299), .0521),  # cheeks
    ((0, -.065, .040), (0, -.098, .052), .037),                # jaw
    ((0, -.065, -.0295), (0, -.230, -.040), .0512),            # neck
    ((-.140, -.264, -.033), (.140, -.264, -.033), .056),       # shoulders
]


def sphere(p, centre, radius):
    return np.linalg.norm(p - centre, axis=1) - radius


def capsule(p, a, b, radius, radius_b=None):
    """Capsule; with ``radius_b`` its radius varies linearly toward ``b``."""
    a, axis = np.asarray(a), np.subtract(b, a)
    t = np.clip((p - a) @ axis / max(axis @ axis, 1e-12), 0.0, 1.0)
    if radius_b is not None:
        radius = radius + (radius_b - radius) * t
    return np.linalg.norm(p - a - t[:, None] * axis, axis=1) - radius


def ellipsoid(p, centre, radii):
    """Approximate distance to an axis-aligned ellipsoid."""
    k0 = np.linalg.norm((p - centre) / radii, axis=1)
    k1 = np.linalg.norm((p - centre) / np.square(radii), axis=1)
    return k0 * (k0 - 1.0) / np.maximum(k1, 1e-9)


def union(a, b, k):
    """Smooth minimum; the result bulges by at most k / 4."""
    h = np.maximum(k - np.abs(a - b), 0.0)
    return np.minimum(a, b) - h * h / (4.0 * k)


def cut(a, b, k):
    """Smoothly subtract b from a."""
    return -union(-a, b, k)


# Rows (operation, shape, shape arguments, blend distance) for x >= 0.
BODY = [
    # temples, face plane, jaw, chin, cheekbone, brow ridge, muzzle
    (union, capsule, ((0, -.032, .010), (.013, -.032, .010), .051), .025),
    (union, ellipsoid, ((0, -.055, .033), (.055, .075, .051)), .020),
    (union, capsule, ((.044, -.082, .008), (.013, -.117, .064), .016, .015),
     .026),
    (union, ellipsoid, ((0, -.118, .070), (.018, .017, .018)), .016),
    (union, ellipsoid, ((.041, -.046, .052), (.020, .014, .020)), .020),
    (union, capsule, ((.010, -.003, .077), (.042, -.002, .060), .008, .007),
     .018),
    (union, ellipsoid, ((0, -.087, .066), (.026, .022, .022)), .018),
    # neck column, its side muscle, throat
    (union, capsule, ((0, -.06, -.03), (0, -.24, -.04), .045, .053), .022),
    (union, capsule, ((.05, -.065, -.03), (.014, -.212, .006), .009, .008),
     .018),
    (union, sphere, ((0, -.160, -.002), .014), .024),
    # trapezius, shoulder, chest, collarbone
    (union, capsule, ((.02, -.175, -.055), (.14, -.243, -.042), .026, .030),
     .040),
    (union, ellipsoid, ((.148, -.270, -.035), (.052, .054, .052)), .030),
    (union, ellipsoid, ((0, -.320, -.030), (.165, .105, .080)), .040),
    (union, capsule, ((.014, -.224, .012), (.13, -.222, -.014), .009), .020),
    # eye socket
    (cut, ellipsoid, ((.0315, -.021, .087), (.019, .0125, .016)), .014),
]
FEATURES = [
    # nose: bridge, tip, wing, nostril
    (union, capsule, ((0, -.014, .076), (0, -.056, .098), .0065, .0085),
     .012),
    (union, sphere, ((0, -.059, .0995), .0095), .006),
    (union, ellipsoid, ((.0105, -.0625, .0875), (.0065, .0068, .0095)), .006),
    (cut, ellipsoid, ((.0062, -.0705, .0935), (.0032, .0040, .0048)), .003),
    # mouth: philtrum, upper lip, lower lip, parting
    (cut, capsule, ((0, -.073, .097), (0, -.081, .097), .0035), .006),
    (union, capsule, ((.005, -.0860, .0860), (.022, -.0908, .0735),
                      .0066, .0034), .007),
    (union, capsule, ((0, -.0978, .0845), (.019, -.0928, .0755),
                      .0078, .0036), .006),
    (cut, capsule, ((0, -.0912, .0955), (.025, -.0922, .0835),
                    .0024, .0012), .005),
]


def apply_rows(d, p, rows):
    for operation, shape, arguments, blend in rows:
        d = operation(d, shape(p, *arguments), blend)
    return d


def cranium(p):
    """Egg: a superellipsoid that is narrower toward the forehead."""
    q = p - [0.0, 0.0, -0.010]
    width = 0.0745 - 0.10 * q[:, 2] * np.where(q[:, 2] > 0, 1.0, 0.4)
    radii = np.stack([width, np.full_like(width, 0.084),
                      np.full_like(width, 0.095)], axis=1)
    k = np.maximum((np.abs(q / radii) ** 2.2).sum(axis=1) ** (1 / 2.2), 1e-6)
    return np.linalg.norm(q, axis=1) * (1.0 - 1.0 / k)


def add_eye(d, p):
    """Eyeball with a hollowed iris, and lids with an almond opening."""
    eye = np.array([0.0315, -0.0225, 0.0635])
    for sign, angle, radius in ((1.0, 28.0, 0.0159), (-1.0, 24.0, 0.0154)):
        a = np.radians(angle)
        normal = np.array([-0.10 * sign, sign * np.cos(a), -np.sin(a)])
        lid = cut(sphere(p, eye, radius), (p - eye) @ normal, 0.0025)
        d = union(d, lid, 0.0045)
    ball = cut(sphere(p, eye, 0.0140),
               sphere(p, eye + [-0.0005, 0.0008, 0.0160], 0.0045), 0.0006)
    return union(d, ball, 0.0006)


def add_ear(d, p):
    """A plate with a hollow, framed by an elliptical rim (the helix)."""
    q = (p - [0.0745, -0.029, -0.017]) @ EAR_FRAME
    plate = ellipsoid(q, (-0.002, 0, 0), (0.0062, 0.029, 0.0165))
    plate = cut(plate, ellipsoid(q, (0.007, -0.003, 0.003),
                                 (0.0085, 0.014, 0.009)), 0.004)
    flat = q * [0.0, 1.0, 1.0]
    rim = np.hypot(ellipsoid(flat, (0, 0.001, 0), (1.0, 0.0275, 0.0155)),
                   q[:, 0] - 0.0015) - 0.0040
    return union(d, union(plate, rim, 0.003), 0.005)


def rotation(axis, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    m, i, j = np.eye(3), (axis + 1) % 3, (axis + 2) % 3
    m[i, i], m[i, j], m[j, i], m[j, j] = c, -s, s, c
    return m


EAR_FRAME = rotation(1, -24) @ rotation(0, -10) @ rotation(2, -8)


def sdf(points):
    p = np.abs(points * [1.0, 0, 0]) + points * [0, 1.0, 1.0]
    d = add_eye(add_ear(apply_rows(cranium(p), p, BODY), p), p)
    d = apply_rows(d, p, FEATURES)
    return cut(d, p[:, 1] - BUST_Y, 0.020)


def normals_at(points, h=2e-4):
    """Normalised SDF gradient by central differences."""
    g = np.stack([sdf(points + s) - sdf(points - s) for s in np.eye(3) * h],
                 axis=1)
    return unit(g)


def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=1), 1e-15)[:, None]


def polygonise_half():
    """Marching cubes for x >= 0, finer around the face and the ears."""
    axes = [np.r_[0:.05:.0016, .05:.096:.0024, .096:.21:.006],
            np.r_[-.306:-.132:.006, -.132:-.04:.0022, -.04:.008:.0016,
                  .008:.1:.004],
            np.r_[-.1307:-.05:.0049, -.05:.05:.0031, .05:.12:.0018]]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    field = sdf(grid.reshape(-1, 3)).reshape(grid.shape[:3])
    index_points, faces, _, _ = marching_cubes(field, 0.0)
    points = np.stack([np.interp(index_points[:, i], np.arange(len(axes[i])),
                                 axes[i]) for i in range(3)], axis=1)
    return points, faces.astype(np.int64)


def target_edge(p):
    """Wanted edge length near points with x >= 0."""
    limits = [np.full(len(p), 0.012),
              0.0035 + 0.012 * np.abs(hair_side(p)),
              0.007 + 0.2 * np.maximum(p[:, 1] - BUST_Y - 0.012, 0.0)]
    limits += [length + 0.10 * np.maximum(sphere(p, centre, radius), 0.0)
               for centre, radius, length in DETAIL]
    return np.min(limits, axis=0)


def edges_of(faces):
    """Undirected edges and the number of triangles that use each."""
    return np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)),
                     axis=0, return_counts=True)


def simplify(points, faces):
    """Collapse edges, shortest first, until none is well below its target."""
    seam, size = points[:, 0] < 1e-9, target_edge(points)
    edges = edges_of(faces)[0].tolist()
    points, faces = points.copy(), faces.tolist()
    star = [set() for _ in points]
    for i, face in enumerate(faces):
        for v in face:
            star[v].add(i)

    def ring(v):
        return {w for i in star[v] for w in faces[i]} - {v}

    def entry(a, b):
        return math.dist(points[a], points[b]) / min(size[a], size[b]), a, b

    heap = [entry(a, b) for a, b in edges]
    heapq.heapify(heap)
    while heap and heap[0][0] < 0.75:
        old, a, b = heapq.heappop(heap)
        shared = star[a] & star[b]
        if not shared or entry(a, b)[0] != old:
            continue
        if seam[b] and not seam[a]:
            a, b = b, a
        if (len(ring(a) & ring(b)) != len(shared)
                or (seam[a] and seam[b]) != (len(shared) == 1)):
            continue
        spot = points[a] if seam[a] != seam[b] else points[[a, b]].mean(axis=0)
        if flips(points, [faces[i] for i in (star[a] ^ star[b])], a, b, spot):
            continue
        points[a] = spot
        for i in shared:
            for v in faces[i]:
                star[v].discard(i)
        for i in star[b]:
            faces[i] = [a if v == b else v for v in faces[i]]
        star[a] |= star[b]
        star[b] = set()
        for w in ring(a):
            heapq.heappush(heap, entry(a, w))
    alive = sorted(set().union(*star))
    used, faces = np.unique([faces[i] for i in alive], return_inverse=True)
    return points[used], faces.reshape(-1, 3)


def flips(points, faces, a, b, spot):
    """Would moving a and b to the spot turn a triangle over?"""
    faces = np.array(faces)
    before, after = points[faces], points[faces]
    after[(faces == a) | (faces == b)] = spot
    n0, n1 = (unit(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]))
              for t in (before, after))
    return bool(((n0 * n1).sum(axis=1) < 0.3).any())


def project(points, seam, rounds=3):
    """Move points onto the surface; seam points keep x = 0."""
    for _ in range(rounds):
        step = np.clip(sdf(points), -0.002, 0.002)
        points = points - step[:, None] * normals_at(points)
        points[seam, 0] = 0.0
    return points


def relax(points, faces, rounds=8):
    """Even out the triangles by tangential smoothing."""
    seam, edges = points[:, 0] < 1e-9, edges_of(faces)[0]
    valence = np.bincount(edges.ravel(), minlength=len(points))[:, None]
    for _ in range(rounds):
        total = np.zeros_like(points)
        np.add.at(total, edges[:, 0], points[edges[:, 1]])
        np.add.at(total, edges[:, 1], points[edges[:, 0]])
        move, normal = 0.5 * (total / valence - points), normals_at(points)
        move -= (move * normal).sum(axis=1)[:, None] * normal
        points = project(points + move, seam, 1)
    return project(points, seam)


def hairline_limit():
    azimuth, elevation = np.radians(np.array(HAIRLINE, dtype=float)).T
    return PchipInterpolator(
        np.r_[-azimuth[:0:-1], azimuth, 2 * np.pi - azimuth[-2::-1]],
        np.r_[elevation[:0:-1], elevation, elevation[-2::-1]])


LIMIT = hairline_limit()


def hair_side(points):
    """Positive on the scalp, zero on the hairline (radians of elevation)."""
    q = points - STAR
    elevation = np.arctan2(q[:, 1], np.hypot(q[:, 0], q[:, 2]))
    return elevation - LIMIT(np.arctan2(np.abs(q[:, 0]), q[:, 2]))


def hairline_crossings(points, faces, side):
    """Edges that cross the hairline, and where (by bisection)."""
    edges = edges_of(faces)[0]
    edges = edges[side[edges].prod(axis=1) < 0]
    lo, hi = points[edges[:, 0]], points[edges[:, 1]]
    sign = np.sign(hair_side(lo))
    for _ in range(40):
        mid = 0.5 * (lo + hi)
        same = (np.sign(hair_side(mid)) == sign)[:, None]
        lo, hi = np.where(same, mid, lo), np.where(same, hi, mid)
    return edges, 0.5 * (lo + hi)


def snap_to_hairline(points, faces, reach=0.3):
    """Move vertices that nearly lie on the hairline onto it (no slivers)."""
    side, target = hair_side(points), points.copy()
    edges, where = hairline_crossings(points, faces, side)
    best = np.full(len(points), reach)
    for (a, b), spot in zip(edges, where):
        length = math.dist(points[a], points[b])
        for v in (a, b):
            ratio = math.dist(points[v], spot) / length
            if ratio < best[v] and (points[v, 0] > 1e-9 or spot[0] < 1e-9):
                best[v], target[v], side[v] = ratio, spot, 0.0
    return target, side


def cut_hairline(points, faces):
    """Split triangles along the hairline; returns points, skin, scalp."""
    points, side = snap_to_hairline(points, faces)
    edges, where = hairline_crossings(points, faces, side)
    new_id = {tuple(e): len(points) + i for i, e in enumerate(edges)}
    parts = {-1: [], 1: []}
    for face in faces:
        s = side[face]
        if not s.any():
            s = s + hair_side(points[face].mean(axis=0)[None])
        for sign, part in parts.items():
            polygon = []
            for i, j in ((0, 1), (1, 2), (2, 0)):
                if s[i] * sign >= 0:
                    polygon.append(face[i])
                if s[i] * s[j] < 0:
                    polygon.append(new_id[tuple(sorted(face[[i, j]]))])
            part += [[polygon[0], *polygon[t:t + 2]]
                     for t in range(1, len(polygon) - 1)]
    points = np.concatenate([points, where])
    points = project(points, points[:, 0] < 1e-9)
    return points, np.array(parts[-1]), np.array(parts[1])


def mirror(points, *parts):
    """Add the x < 0 half, sharing the vertices on the seam."""
    off = points[:, 0] > 1e-9
    twin = np.where(off, len(points) + np.cumsum(off) - 1,
                    np.arange(len(points)))
    points = np.concatenate([points, points[off] * [-1.0, 1.0, 1.0]])
    return points, *(np.concatenate([f, twin[f][:, ::-1]]) for f in parts)


def boundary_loops(faces):
    """Number of closed loops formed by the edges used by one triangle."""
    directed = set(map(tuple, faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)))
    follow = {a: b for a, b in directed if (b, a) not in directed}
    loops = 0
    while follow:
        start, at = follow.popitem()
        while at != start:
            at = follow.pop(at)
        loops += 1
    return loops


def check(points, skin, scalp):
    """Assert the promises made in the docstring and the README."""
    faces = np.concatenate([skin, scalp])
    edges, uses = edges_of(faces)
    assert (uses == 2).all(), "mesh is not closed"
    euler = len(points) - len(edges) + len(faces)
    assert euler == 2, "mesh is not a sphere"
    a, b, c = (points[faces[:, i]] for i in range(3))
    cross, centre = np.cross(b - a, c - a), (a + b + c) / 3
    longest = np.linalg.norm([b - a, c - b, a - c], axis=2).max(axis=0)
    thin = (np.linalg.norm(cross, axis=1) / longest ** 2).min()
    assert thin > 0.02, "degenerate triangle"
    outward = (unit(cross) * normals_at(centre)).sum(axis=1)
    assert (a * cross).sum() > 0 and outward.min() > 0, "inward triangle"
    scalp_euler = len(np.unique(scalp)) - len(edges_of(scalp)[0]) + len(scalp)
    assert scalp_euler == 1 and boundary_loops(scalp) == 1, "not a disc"
    facing = (unit(cross) * unit(centre - STAR)).sum(axis=1)[len(skin):].min()
    assert facing > 0, "scalp is not star-shaped"
    uv = texture_coordinates(points)[scalp]
    turn = np.linalg.det(np.stack([uv[:, 1] - uv[:, 0],
                                   uv[:, 2] - uv[:, 0]], axis=1))
    assert (turn < 0).all(), "texture folds on the scalp"  # v points down
    print(f"{len(points)} vertices, {len(skin)} skin + {len(scalp)} scalp "
          f"triangles, height / longest edge >= {thin:.3f}, "
          f"facing cosine on the scalp >= {facing:.2f}")


# Direction from STAR that has the middle of the texture: the scalp's middle,
# halfway from the front hairline over the top to the nape.
TEXTURE_POLE = np.array([0.0, np.sin(np.radians(53)), -np.cos(np.radians(53))])
TEXTURE_DOWN = np.array([0.0, np.cos(np.radians(53)), np.sin(np.radians(53))])


def texture_coordinates(points):
    """Azimuthal equidistant projection of the direction from STAR.

    The picture shows the scalp from outside with the face down: its middle is
    TEXTURE_POLE, u grows toward +x and v toward the face.  A distance of 1/360
    from the middle is 1 degree.  Only around the throat, opposite the pole, do
    neighbours get coordinates far apart.
    """
    direction = unit(points - STAR)
    across = np.stack([direction[:, 0], direction @ TEXTURE_DOWN], axis=1)
    sine = np.linalg.norm(across, axis=1)
    angle = np.arctan2(sine, direction @ TEXTURE_POLE)
    scale = angle / (2.0 * np.pi) / np.maximum(sine, 1e-12)
    return 0.5 + across * scale[:, None]


def texture_directions(coordinates):
    """The inverse of texture_coordinates(): unit vectors from STAR."""
    across = coordinates - 0.5
    radius = np.maximum(np.linalg.norm(across, axis=1), 1e-12)[:, None]
    angle = 2.0 * np.pi * radius
    x, down = (across / radius * np.sin(angle)).T
    return (np.cos(angle) * TEXTURE_POLE + down[:, None] * TEXTURE_DOWN
            + x[:, None] * np.array([1.0, 0.0, 0.0]))


def linear(value):
    """Return the linear value of an sRGB channel (IEC 61966-2-1)."""
    if value <= 0.04045:
        return value / 12.92
    return ((value + 0.055) / 1.055) ** 2.4


def write_glb(path, points, normals, parts):
    """Write one mesh with a primitive (and a material) per part."""
    binary, views, accessors, primitives = b"", [], [], []

    def accessor(data, component, kind, target, **extra):
        nonlocal binary
        views.append({"buffer": 0, "byteLength": data.nbytes,
                      "byteOffset": len(binary), "target": target})
        binary += data.tobytes() + bytes(-data.nbytes % 4)
        accessors.append({"bufferView": len(accessors), "type": kind,
                          "componentType": component, "count": len(data),
                          **extra})
        return len(accessors) - 1

    for material, faces in enumerate(parts.values()):
        used, local = np.unique(faces, return_inverse=True)
        xyz, n = points[used].astype("<f4"), normals[used].astype("<f4")
        uv = texture_coordinates(points[used]).astype("<f4")
        primitives.append({"attributes": {
            "POSITION": accessor(xyz, 5126, "VEC3", 34962,
                                 min=xyz.min(axis=0).tolist(),
                                 max=xyz.max(axis=0).tolist()),
            "NORMAL": accessor(n, 5126, "VEC3", 34962),
            "TEXCOORD_0": accessor(uv, 5126, "VEC2", 34962)},
            "indices": accessor(local.astype("<u2").ravel(), 5123, "SCALAR",
                                34963), "material": material})
    text = json.dumps({
        "asset": {"version": "2.0", "generator": "make_head.py"},
        "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "head"}],
        "meshes": [{"name": "head", "primitives": primitives}],
        "materials": [{"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*map(linear, MATERIALS[name]), 1.0],
            "metallicFactor": 0.0, "roughnessFactor": 0.55}}
            for name in parts],
        "accessors": accessors, "bufferViews": views,
        "buffers": [{"byteLength": len(binary)}]}).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(
        struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary))
        + struct.pack("<I4s", len(text), b"JSON") + text
        + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def write_colliders(path, scalp_points):
    rows = [json.dumps({"a": a, "b": b, "radius": r})
            for a, b, r in COLLIDERS]
    path.write_text('{"colliders": [\n  ' + ",\n  ".join(rows) + "\n]}\n")
    gap = 1e3 * np.min([capsule(scalp_points, *s) for s in COLLIDERS], axis=0)
    print(f"scalp outside the colliders by {gap.min():.2f} to "
          f"{gap.max():.2f} mm, mean {gap.mean():.2f} mm, "
          f"mean magnitude {np.abs(gap).mean():.2f} mm")


def main():
    default = pathlib.Path(__file__).resolve().parent
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    points, faces = simplify(*polygonise_half())
    half = cut_hairline(relax(points, faces), faces)
    points, skin, scalp = mirror(*half)
    check(points, skin, scalp)
    write_glb(out / "head.glb", points, normals_at(points),
              {"skin": skin, "scalp": scalp})
    write_colliders(out / "head_colliders.json", points[np.unique(scalp)])


if __name__ == "__main__":
    main()

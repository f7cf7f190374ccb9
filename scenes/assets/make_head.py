"""Generate the stylised head-and-bust mesh used by the hair scenes.

Run (Python 3.9+, needs numpy, scipy and scikit-image):

    python3 make_head.py [output_directory]

It writes two files next to this script (or into ``output_directory``):

* ``head.glb``             binary glTF, one mesh with two primitives whose
                           materials are named ``skin`` and ``scalp``, with
                           texture coordinates (see texture_coordinates() and
                           skin_coordinates()) and a picture of the skin
* ``head_colliders.json``  capsules that approximate the head for simulation

Conventions: metres, +y up, the face looks toward +z, mirror symmetric about
x = 0.  The cranium is centred near the origin, the bust is cut at BUST_Y.

How it works: a head is a signed distance function (SDF), smooth unions of
capsules and ellipsoids.  Only the half with x >= 0 is polygonised (marching
cubes), simplified toward a target edge length, relaxed along the surface, cut
along a line, and mirrored.  There are two heads.  The plain one has neither
eyes nor mouth, and its part above the hairline is the scalp.  The sculpture
is the plain head near the hairline and has a face and ears further away; its
part a little below the hairline is the skin, and a strip of triangles sews it
to the scalp.  So hair never sees a change of the face.  The hairline is an
elevation limit given as a function of azimuth, both seen from STAR, and the
scalp is star-shaped from that point.  The script is deterministic and asserts
what hair code relies on.
"""
import heapq
import io
import json
import math
import pathlib
import struct
import sys
import typing

import numpy as np
from PIL import Image
from scipy.interpolate import CubicSpline, PchipInterpolator
from scipy.ndimage import gaussian_filter, zoom
from scipy.spatial import cKDTree
from skimage.measure import marching_cubes

STAR = np.array([0.0, -0.01, -0.015])
SCALP_RADIUS = 0.095  # of the scalp round STAR, on average (m)
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
# The plain head has no eyes and no mouth, but its triangles spread from theirs.
PLAIN_DETAIL = [
    ((.0315, -.0225, .072), .016, .0015), ((0, -.06, .100), .014, .0030),
    ((.0100, -.0910, .083), .016, .0026), ((0, .000, -.01), .110, .0065),
    ((.0780, -.0290, -.018), .032, .0025),
]
SKIN_DETAIL = [
    ((0, .000, -.01), .110, .0065), ((0, -.060, .075), .060, .0034),
    ((.0250, -.0280, .072), .010, .0009), ((.0400, -.0265, .068), .009, .0009),
    ((.0330, -.0060, .073), .014, .0020), ((.0060, -.0620, .092), .010, .0013),
    ((.0060, -.0905, .090), .009, .0011), ((.0180, -.0905, .079), .007, .0011),
    ((.0100, -.0900, .072), .012, .0014),
    ((.0830, -.0270, -.017), .024, .0015),
]
SEAM = 0.0025  # between the hairline and the sculpture's skin (m)
FADE = 0.0040, 0.0220  # from the hairline: all plain, all sculpture (m)
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


def turned(p, centre, radii, frame):
    """Approximate distance to an ellipsoid whose axes are the frame's."""
    return ellipsoid((p - centre) @ frame, np.zeros(3), np.array(radii))


def spread(p, centre, radii):
    """Distance from a centre in units of the radii."""
    return np.linalg.norm((p - centre) / radii, axis=1)


def tube(p, points, radii, pieces=8, arch=False):
    """Tube along a smooth curve, with a radius at each of its points.

    An arch starts at x = 0 and is smooth with its mirror image there.
    """
    knots = np.column_stack(np.broadcast_arrays(*np.transpose(points), radii))
    if arch:
        knots = np.concatenate([knots[:0:-1] * [-1, 1, 1, 1], knots])
    spans = np.linalg.norm(np.diff(knots[:, :3], axis=0), axis=1)
    t = np.r_[0.0, np.cumsum(spans)]
    curve = CubicSpline(t, knots)
    first = t[len(t) // 2] if arch else 0.0
    ends = np.linspace(first, t[-1], pieces + 1)
    # The nearest point of a polyline, then of the curve by Newton's method.
    at, least = np.zeros(len(p)), np.full(len(p), np.inf)
    for low, high in zip(ends, ends[1:]):
        a, axis = curve(low)[:3], curve(high)[:3] - curve(low)[:3]
        share = np.clip((p - a) @ axis / (axis @ axis), 0.0, 1.0)
        far = np.linalg.norm(p - a - share[:, None] * axis, axis=1)
        at = np.where(far < least, low + share * (high - low), at)
        least = np.minimum(far, least)
    for _ in range(2):
        off, along = curve(at)[:, :3] - p, curve(at, 1)[:, :3]
        square = (along * along).sum(axis=1)
        bend = (off * curve(at, 2)[:, :3]).sum(axis=1)
        at = np.clip(at - (off * along).sum(axis=1)
                     / np.maximum(square + bend, 0.3 * square), first, t[-1])
    nearest = curve(at)
    return np.linalg.norm(nearest[:, :3] - p, axis=1) - nearest[:, 3]


def edge(p, points, above, below, fade):
    """Height, 0 to 1, of a ridge along a curve y(x) of the face.

    ``above`` and ``below`` are its widths; where one is small it is a step.
    It fades over the share ``fade`` of its length at either end.
    """
    x, y = np.transpose(points)
    curve = CubicSpline(x, y)
    u = np.clip(p[:, 0], x[0], x[-1])
    t = (p[:, 1] - curve(u)) / np.hypot(1.0, curve(u, 1))
    end = np.minimum(u - x[0], x[-1] - u) / (fade * (x[-1] - x[0]))
    width = np.where(t > 0, above, below)
    return smoothstep(0.0, 1.0, end) * np.exp(-(t / width) ** 2)


def smoothstep(low, high, x):
    t = np.clip((x - low) / (high - low), 0.0, 1.0)
    return t * t * (3.0 - 2.0 * t)


def union(a, b, k):
    """Smooth minimum; the result bulges by at most k / 4."""
    h = np.maximum(k - np.abs(a - b), 0.0)
    return np.minimum(a, b) - h * h / (4.0 * k)


def cut(a, b, k):
    """Smoothly subtract b from a."""
    return -union(-a, b, k)


def rotation(axis, degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    m, i, j = np.eye(3), (axis + 1) % 3, (axis + 2) % 3
    m[i, i], m[i, j], m[j, i], m[j, j] = c, -s, s, c
    return m


# Rows (operation, shape, shape arguments, blend distance) for x >= 0.
TEMPLES = (union, capsule, ((0, -.032, .010), (.013, -.032, .010), .051), .025)
PLAIN = [
    # temples, face plane, jaw, cheekbone, brow ridge
    TEMPLES,
    (union, ellipsoid, ((0, -.055, .033), (.055, .075, .051)), .020),
    (union, capsule, ((.044, -.082, .008), (.013, -.117, .064), .016, .015),
     .026),
    (union, ellipsoid, ((.041, -.046, .052), (.020, .014, .020)), .020),
    (union, capsule, ((.010, -.003, .077), (.042, -.002, .060), .008, .007),
     .018),
]
MASK = [
    # temples, face plane, jaw and chin, cheek
    TEMPLES,
    (union, ellipsoid, ((0, -.055, .033), (.056, .076, .050)), .020),
    (union, tube, (((0, -.1195, .0690), (.018, -.1160, .060),
                    (.034, -.1010, .034), (.043, -.0810, .006)),
                   (.0140, .0120, .0115, .0150), 8, True), .026),
    (union, ellipsoid, ((.026, -.068, .042), (.026, .032, .030)), .020),
]
BUST = [
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
]
# Clay put on or taken off: rows (shape, shape arguments, width, thickness).
# It is thickest on the shape and thins out like a Gaussian of the distance.
FORMS = [
    # glabella, brow ridge, cheekbone and its front, hollow under it
    (spread, ((0, -.0030, .084), (.012, .0090, .012)), 1, .0008),
    (tube, (((.004, -.004, .082), (.020, .000, .080), (.036, .001, .068),
             (.047, -.006, .054)), 0), .0085, .0012),
    (spread, ((.0500, -.0010, .0640), (.012, .010, .012)), 1, .0014),
    (tube, (((.036, -.046, .062), (.050, -.042, .046), (.060, -.037, .030)),
            0), .013, .0030),
    (spread, ((.0530, -.0440, .0590), (.017, .013, .016)), 1, .0032),
    (spread, ((.050, -.072, .036), (.014, .020, .014)), 1, -.0012),
    # chin, fold above it, muzzle
    (spread, ((0, -.1190, .083), (.015, .0115, .012)), 1, .0030),
    (spread, ((0, -.1065, .088), (.014, .0050, .012)), 1, -.0016),
    (spread, ((0, -.0880, .082), (.020, .016, .016)), 1, .0026),
]
EYES = [
    # socket and its inner corner, closed lid over the eyeball
    (cut, ellipsoid, ((.0325, -.0225, .0930), (.0200, .0115, .0180)), .013),
    (cut, sphere, ((.0165, -.0205, .0830), .0034), .012),
    (union, sphere, ((.0315, -.0250, .0605), .0143), .006),
]
# Rows (curve y(x), width above, below, faded share, thickness).
LASHES = [(.0150, -.0268), (.0190, -.0288), (.0250, -.0312), (.0320, -.0320),
          (.0395, -.0304), (.0445, -.0278), (.0490, -.0248)]
CREASE = [(.0140, -.0235), (.0205, -.0196), (.0275, -.0174), (.0345, -.0172),
          (.0415, -.0190), (.0470, -.0218), (.0540, -.0265)]
BROW = [(-.0060, -.0120), (.0060, -.0085), (.0140, -.0058), (.0240, -.0038),
        (.0340, -.0036), (.0430, -.0072), (.0560, -.0165)]
EDGES = [
    # rim of the upper lid, gap between the lids, rim of the lower lid
    (LASHES, .0060, .0009, .25, .0009), (LASHES, .0010, .0009, .20, -.0010),
    (LASHES, .0008, .0030, .30, .0003),
    # fold of skin over the upper lid, its crease, eyebrow
    (CREASE, .0050, .0016, .45, .0007), (CREASE, .0013, .0020, .45, -.0008),
    (BROW, .0090, .0038, .45, .0017),
]
NOSE = [
    # bridge, side, tip, columella, wing, nostril
    (union, tube, (((0, -.010, .0740), (0, -.022, .0760), (0, -.038, .0845),
                    (0, -.054, .0940)), (.0070, .0056, .0060, .0075)), .011),
    (union, capsule, ((.0065, -.030, .0690), (.0115, -.060, .0795), .0050,
                      .0065), .012),
    (union, sphere, ((0, -.0560, .0967), .0079), .011),
    (union, capsule, ((0, -.0585, .0945), (0, -.0615, .0830), .0046, .0042),
     .010),
    (union, turned, ((.0116, -.0605, .0855), (.0054, .0064, .0092),
                     rotation(1, 22)), .0060),
    (cut, turned, ((.0074, -.0672, .0895), (.0027, .0040, .0052),
                   rotation(1, 25)), .0025),
]
LIP_FORMS = [
    # philtrum between its columns, corner of the mouth, fold to the nose
    (tube, (((.0040, -.0735, .0920), (.0048, -.0815, .0955)), 0, 1), .0022,
     .0011),
    (tube, (((0, -.0735, .0920), (0, -.0810, .0955)), 0, 1), .0026, -.0008),
    (spread, ((.0255, -.0910, .0745), (.0045, .0040, .008)), 1, -.0016),
    (tube, (((.0185, -.0640, .0810), (.0245, -.0740, .0765),
             (.0290, -.0860, .0700)), 0), .0045, -.0009),
]
LIPS = [
    # upper lip with its bow, lower lip, parting
    (union, tube, (((0, -.0858, .0872), (.0045, -.0850, .0868),
                    (.0120, -.0874, .0833), (.0190, -.0899, .0770),
                    (.0230, -.0909, .0724)),
                   (.0038, .0038, .0033, .0022, .0010), 6, True), .004),
    (union, tube, (((0, -.0945, .0856), (.0070, -.0942, .0846),
                    (.0145, -.0930, .0803), (.0220, -.0913, .0732)),
                   (.0047, .0047, .0038, .0016), 6, True), .004),
    (cut, tube, (((0, -.0900, .0920), (.0055, -.0893, .0912),
                  (.0130, -.0898, .0870), (.0205, -.0907, .0792),
                  (.0245, -.0912, .0738)),
                 (.0010, .0010, .0010, .0009, .0006), 6, True), .003),
]
MOUTH_WIDTH = .0232  # of a half (m)
PARTING = CubicSpline((0, .0055, .0130, .0205, .0245),
                      (-.0900, -.0893, -.0898, -.0907, -.0912))


def apply_rows(d, p, rows):
    for operation, shape, arguments, blend in rows:
        d = operation(d, shape(p, *arguments), blend)
    return d


def add_clay(d, p, rows):
    for shape, arguments, width, thickness in rows:
        for side in (p, p * [-1.0, 1.0, 1.0]):  # smooth where x is 0
            far = np.maximum(shape(side, *arguments), 0.0) / width
            d = d - thickness * np.exp(-far * far)
    return d


def cranium(p):
    """Egg: a superellipsoid that is narrower toward the forehead."""
    q = p - [0.0, 0.0, -0.010]
    width = 0.0745 - 0.10 * q[:, 2] * np.where(q[:, 2] > 0, 1.0, 0.4)
    radii = np.stack([width, np.full_like(width, 0.084),
                      np.full_like(width, 0.095)], axis=1)
    k = np.maximum((np.abs(q / radii) ** 2.2).sum(axis=1) ** (1 / 2.2), 1e-6)
    return np.linalg.norm(q, axis=1) * (1.0 - 1.0 / k)


def add_plain_ear(d, p):
    """A plate with a hollow, framed by an elliptical rim (the helix)."""
    q = (p - EAR) @ EAR_FRAME
    plate = ellipsoid(q, (-0.002, 0, 0), (0.0062, 0.029, 0.0165))
    plate = cut(plate, ellipsoid(q, (0.007, -0.003, 0.003),
                                 (0.0085, 0.014, 0.009)), 0.004)
    flat = q * [0.0, 1.0, 1.0]
    rim = np.hypot(ellipsoid(flat, (0, 0.001, 0), (1.0, 0.0275, 0.0155)),
                   q[:, 0] - 0.0015) - 0.0040
    return union(d, union(plate, rim, 0.003), 0.005)


EAR = np.array([0.0745, -0.029, -0.017])
EAR_FRAME = rotation(1, -24) @ rotation(0, -10) @ rotation(2, -8)
# In the ear's frame: x outward, y up, z toward the face.
HELIX = [(-.0010, -.0020, .0080), (.0000, .0060, .0125),
         (.0012, .0160, .0140), (.0022, .0255, .0085), (.0024, .0285, -.0015),
         (.0024, .0230, -.0115), (.0022, .0110, -.0158),
         (.0018, -.0030, -.0150), (.0014, -.0150, -.0105),
         (.0008, -.0215, -.0060)]
ANTIHELIX = [(.0010, .0205, .0045), (.0030, .0140, -.0010),
             (.0040, .0050, -.0070), (.0040, -.0050, -.0080),
             (.0034, -.0120, -.0040), (.0028, -.0150, .0010)]
LOWER_CRUS = [(.0010, .0120, .0095), (.0026, .0100, .0030),
              (.0036, .0060, -.0045)]


def add_ear(d, p):
    """Plate, antihelix with two crura, concha, helix, lobe and tragus."""
    q = (p - EAR) @ EAR_FRAME
    ear = ellipsoid(q, (-.0022, .002, -.0005), (.0054, .0280, .0162))
    ridges = union(
        tube(q, ANTIHELIX, (.0022, .0030, .0032, .0030, .0026, .0022), 8),
        tube(q, LOWER_CRUS, (.0016, .0022, .0026), 4), .002)
    ear = union(ear, ridges, .003)
    ear = cut(ear, ellipsoid(q, (.006, -.004, .002), (.0105, .0095, .0070)),
              .0025)
    ear = union(ear, tube(q, HELIX, (.0016, .0026, .0030, .0031, .0032, .0031,
                                     .0029, .0027, .0024, .0020), 14), .004)
    ear = union(ear, ellipsoid(q, (.0005, -.0235, .0030),
                               (.0042, .0078, .0075)), .005)
    d = union(d, ear, .0045)
    return union(d, ellipsoid(q, (.0016, -.0065, .0118),
                              (.0044, .0056, .0042)), .0035)


def parting(x):
    """Height y of the line between the lips (m)."""
    return PARTING(np.clip(np.abs(x), 0.0, MOUTH_WIDTH))


def mouth(p):
    """A slot between the lips that goes back into the head.

    It is thin where the lips meet and a little higher behind them, and ends at
    the corners of the mouth.  There is nothing in it.
    """
    x, z = np.abs(p[:, 0]), p[:, 2]
    plan = ellipsoid(np.stack([x, 0.0 * x, z - .066], axis=1), np.zeros(3),
                     np.array([MOUTH_WIDTH, 1.0, .036]))
    inside = smoothstep(0.0, .010, -plan)
    height = np.abs(p[:, 1] - parting(x)) - (.00045 + .00055 * inside)
    return np.maximum(np.maximum(height, plan), .058 - z)


def add_face(d, p):
    d = apply_rows(add_clay(d, p, FORMS), p, EYES)
    for *ridge, thickness in EDGES:
        d = d - thickness * edge(p, *ridge)
    d = add_clay(apply_rows(d, p, NOSE), p, LIP_FORMS)
    return cut(apply_rows(d, p, LIPS), mouth(p), .0006)


def folded(points):
    """The points with x >= 0 that stand for these."""
    return np.abs(points * [1.0, 0, 0]) + points * [0, 1.0, 1.0]


def plain_sdf(points):
    p = folded(points)
    d = add_plain_ear(apply_rows(cranium(p), p, PLAIN + BUST), p)
    return cut(d, p[:, 1] - BUST_Y, 0.020)


def sculpture_sdf(points):
    """The plain head near the hairline, the sculpture away from it."""
    p = folded(points)
    d = apply_rows(cranium(p), p, MASK + BUST)
    # Only where they matter, for the time that it takes.
    near = ((np.abs(d) < .035) & (p[:, 0] < .08) & (p[:, 2] > -.005)
            & (np.abs(p[:, 1] + .058) < .092))
    d[near] = add_face(d[near], p[near])
    near = sphere(p, EAR, .05) < 0
    d[near] = add_ear(d[near], p[near])
    d = cut(d, p[:, 1] - BUST_Y, 0.020)
    below = -distance_to_hairline(p, FADE[1])
    plain = below < FADE[1]
    rough = plain_sdf(p[plain])
    d[plain] = rough + smoothstep(*FADE, below[plain]) * (d[plain] - rough)
    return d


def normals_at(points, sdf, h=2e-4):
    """Normalised SDF gradient by central differences."""
    g = np.stack([sdf(points + s) - sdf(points - s) for s in np.eye(3) * h],
                 axis=1)
    return unit(g)


def unit(v):
    return v / np.maximum(np.linalg.norm(v, axis=1), 1e-15)[:, None]


class Form(typing.NamedTuple):
    """The parts that make a half of a mesh."""
    sdf: typing.Callable
    axes: list  # of the grid for marching cubes (m)
    detail: list


PLAIN_HEAD = Form(
    plain_sdf, [np.r_[0:.05:.0016, .05:.096:.0024, .096:.21:.006],
                np.r_[-.306:-.132:.006, -.132:-.04:.0022, -.04:.008:.0016,
                      .008:.1:.004],
                np.r_[-.1307:-.05:.0049, -.05:.05:.0031, .05:.12:.0018]],
    PLAIN_DETAIL)
SCULPTURE = Form(
    sculpture_sdf, [np.r_[0:.05:.0010, .05:.062:.002, .062:.096:.0012,
                          .096:.21:.006],
                    np.r_[-.306:-.138:.006, -.138:-.094:.0010,
                          -.094:-.086:.0004, -.086:-.002:.0010,
                          -.002:.1:.004],
                    np.r_[-.1307:-.045:.0049, -.045:.02:.0013, .02:.05:.003,
                          .05:.115:.0010]],
    SKIN_DETAIL)


def polygonise_half(form):
    """Marching cubes for x >= 0, finer around the face and the ears."""
    grid = np.stack(np.meshgrid(*form.axes, indexing="ij"), axis=-1)
    # Every third node tells which others may be near the surface.  The rest
    # keep its value, whose sign is theirs.
    coarse = grid[::3, ::3, ::3]
    field = form.sdf(coarse.reshape(-1, 3)).reshape(coarse.shape[:3])
    field = field[np.ix_(*(np.minimum((np.arange(len(axis)) + 1) // 3,
                                      (len(axis) - 1) // 3)
                           for axis in form.axes))]
    cell = [np.convolve(np.gradient(axis), np.ones(7) / 7, "same")
            for axis in form.axes]
    near = np.abs(field) < 3.5 * np.linalg.norm(
        np.stack(np.meshgrid(*cell, indexing="ij"), axis=-1), axis=-1)
    field[near] = form.sdf(grid[near])
    index_points, faces, _, _ = marching_cubes(field, 0.0)
    points = np.stack([np.interp(index_points[:, i], np.arange(len(axis)),
                                 axis) for i, axis in enumerate(form.axes)],
                      axis=1)
    return points, faces.astype(np.int64)


def target_edge(p, detail):
    """Wanted edge length near points with x >= 0."""
    limits = [np.full(len(p), 0.012),
              0.0035 + 0.012 * np.abs(hair_side(p)),
              0.007 + 0.2 * np.maximum(p[:, 1] - BUST_Y - 0.012, 0.0)]
    limits += [length + 0.10 * np.maximum(sphere(p, centre, radius), 0.0)
               for centre, radius, length in detail]
    return np.min(limits, axis=0)


def edges_of(faces):
    """Undirected edges and the number of triangles that use each."""
    return np.unique(np.sort(faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)),
                     axis=0, return_counts=True)


def simplify(points, faces, detail):
    """Collapse edges, shortest first, until none is well below its target."""
    seam, size = points[:, 0] < 1e-9, target_edge(points, detail)
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
    # A triangle in the plane of symmetry would be its own mirror image.
    used, faces = np.unique([faces[i] for i in alive
                             if not all(seam[v] for v in faces[i])],
                            return_inverse=True)
    return points[used], faces.reshape(-1, 3)


def flips(points, faces, a, b, spot):
    """Would moving a and b to the spot turn a triangle over?"""
    faces = np.array(faces)
    before, after = points[faces], points[faces]
    after[(faces == a) | (faces == b)] = spot
    n0, n1 = (unit(np.cross(t[:, 1] - t[:, 0], t[:, 2] - t[:, 0]))
              for t in (before, after))
    return bool(((n0 * n1).sum(axis=1) < 0.3).any())


def project(points, seam, sdf, rounds=3):
    """Move points onto the surface; seam points keep x = 0."""
    for _ in range(rounds):
        step = np.clip(sdf(points), -0.002, 0.002)
        points = points - step[:, None] * normals_at(points, sdf)
        points[seam, 0] = 0.0
    return points


def relax(points, faces, sdf, rounds=8):
    """Even out the triangles by tangential smoothing."""
    seam, edges = points[:, 0] < 1e-9, edges_of(faces)[0]
    valence = np.bincount(edges.ravel(), minlength=len(points))[:, None]
    for _ in range(rounds):
        total = np.zeros_like(points)
        np.add.at(total, edges[:, 0], points[edges[:, 1]])
        np.add.at(total, edges[:, 1], points[edges[:, 0]])
        move = 0.5 * (total / valence - points)
        normal = normals_at(points, sdf)
        move -= (move * normal).sum(axis=1)[:, None] * normal
        points = project(points + move, seam, sdf, 1)
    return project(points, seam, sdf)


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


def distance_to_hairline(points, reach=np.inf):
    """Metres along a sphere round STAR, positive on the scalp.

    It is right up to ``reach``, and some greater value further away.
    """
    azimuth = np.linspace(-np.pi, np.pi, 20000, endpoint=False)
    limit = LIMIT(np.abs(azimuth))
    line = np.stack([np.cos(limit) * np.sin(azimuth), np.sin(limit),
                     np.cos(limit) * np.cos(azimuth)], axis=1)
    longest = 2.0 * np.sin(0.5 * min(reach / SCALP_RADIUS, np.pi))
    chord, _ = cKDTree(line).query(unit(points - STAR),
                                   distance_upper_bound=longest)
    angle = 2.0 * np.arcsin(np.minimum(0.5 * chord, 1.0))
    return SCALP_RADIUS * angle * np.sign(hair_side(points))


def skin_side(points):
    """Zero on the line below the hairline where the sculpture is cut."""
    return distance_to_hairline(points) + SEAM


def crossings(points, faces, side, side_of):
    """Edges that cross the line, and where (by bisection)."""
    edges = edges_of(faces)[0]
    edges = edges[side[edges].prod(axis=1) < 0]
    lo, hi = points[edges[:, 0]], points[edges[:, 1]]
    sign = np.sign(side_of(lo))
    for _ in range(40):
        mid = 0.5 * (lo + hi)
        same = (np.sign(side_of(mid)) == sign)[:, None]
        lo, hi = np.where(same, mid, lo), np.where(same, hi, mid)
    return edges, 0.5 * (lo + hi)


def snap_to_line(points, faces, side_of, reach=0.3):
    """Move vertices that nearly lie on the line onto it (no slivers)."""
    side, target = side_of(points), points.copy()
    edges, where = crossings(points, faces, side, side_of)
    best = np.full(len(points), reach)
    for (a, b), spot in zip(edges, where):
        length = math.dist(points[a], points[b])
        for v in (a, b):
            ratio = math.dist(points[v], spot) / length
            if ratio < best[v] and (points[v, 0] > 1e-9 or spot[0] < 1e-9):
                best[v], target[v], side[v] = ratio, spot, 0.0
    return target, side


def cut_along(points, faces, side_of, sdf):
    """Split triangles where side_of is 0; returns points, below, above."""
    points, side = snap_to_line(points, faces, side_of)
    edges, where = crossings(points, faces, side, side_of)
    new_id = {tuple(e): len(points) + i for i, e in enumerate(edges)}
    parts = {-1: [], 1: []}
    for face in faces:
        s = side[face]
        if not s.any():
            s = s + side_of(points[face].mean(axis=0)[None])
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
    points = project(points, points[:, 0] < 1e-9, sdf)
    return points, np.array(parts[-1]), np.array(parts[1])


def half_head(form, side_of):
    points, faces = polygonise_half(form)
    points, faces = simplify(points, faces, form.detail)
    points = relax(points, faces, form.sdf)
    return cut_along(points, faces, side_of, form.sdf)


def take(points, faces):
    """The points that the faces use, and the faces of these."""
    used, local = np.unique(faces, return_inverse=True)
    return points[used], local.reshape(-1, 3)


def rim(points, faces):
    """Vertices of the open rim off the seam, from the front to the back."""
    directed = set(map(tuple, faces[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2)))
    follow = {a: b for a, b in directed if (b, a) not in directed
              and max(points[a, 0], points[b, 0]) > 1e-9}
    path = [*(set(follow) - set(follow.values()))]
    assert len(path) == 1, "rim is not one path"
    while path[-1] in follow:
        path.append(follow[path[-1]])
    assert len(path) == len(follow) + 1, "rim has a loop of its own"
    return path if points[path[0], 2] > points[path[-1], 2] else path[::-1]


def sew(points, upper, lower):
    """Triangles between two paths, of the least total length of edges."""
    cost = np.full((len(upper), len(lower)), np.inf)
    cost[0, 0] = 0.0
    for i, j in list(np.ndindex(cost.shape))[1:]:
        cost[i, j] = math.dist(points[upper[i]], points[lower[j]]) + min(
            cost[i - 1, j] if i else np.inf, cost[i, j - 1] if j else np.inf)
    i, j, faces = len(upper) - 1, len(lower) - 1, []
    while i or j:
        if not j or (i and cost[i - 1, j] < cost[i, j - 1]):
            faces.append([upper[i], upper[i - 1], lower[j]])
            i -= 1
        else:
            faces.append([upper[i], lower[j - 1], lower[j]])
            j -= 1
    return np.array(faces)


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
    normals = np.concatenate([normals_at(centre[:len(skin)], sculpture_sdf),
                              normals_at(centre[len(skin):], plain_sdf)])
    outward = (unit(cross) * normals).sum(axis=1)
    # The slot of the mouth is thinner than its triangles are long.
    outward[np.r_[mouth(centre[:len(skin)]) < .0015,
                  np.zeros(len(scalp), bool)]] = 1.0
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


# ---- the picture of the skin ------------------------------------------------

SKIN_PICTURE = 640, 1024  # px, across and down
SKIN_TOP, SKIN_HEIGHT = 0.10, 0.40  # of the picture (m)
# Outline of a brow's hair, outward: x, lower and upper edge y (m).
BROW_HAIR = [(.0105, -.0098, -.0040), (.0150, -.0085, -.0020),
             (.0210, -.0064, -.0002), (.0290, -.0044, .0008),
             (.0370, -.0040, .0000), (.0440, -.0072, -.0042),
             (.0495, -.0118, -.0098)]
# Shares of light of pigments that are put on the skin, in display RGB.
BLOOD, SUN = (0.93, 0.72, 0.68), (0.90, 0.82, 0.72)
LIP, DARK = (0.85, 0.59, 0.57), (0.30, 0.17, 0.15)
HAIR, LASH = (0.40, 0.29, 0.22), (0.26, 0.18, 0.15)


def skin_coordinates(points):
    """A cylinder's: u is 0 in front and 1 behind on both sides, v is down.

    Left and right share the picture, which therefore has no seam.
    """
    q = points - STAR
    # The walls of the mouth are as dark as the line between the lips.
    hidden = (mouth(folded(points)) < .0006) & (points[:, 2] < .074)
    u = np.where(hidden, 0.0, np.arctan2(np.abs(q[:, 0]), q[:, 2]) / np.pi)
    y = np.where(hidden, parting(0.0), points[:, 1])
    return np.stack([u, (SKIN_TOP - y) / SKIN_HEIGHT], axis=1)


def places_of_picture():
    """[row][column] points of the sculpture that the picture's pixels show."""
    width, height = (size // 2 for size in SKIN_PICTURE)
    v, u = np.meshgrid((np.arange(height) + .5) / height,
                       (np.arange(width) + .5) / width, indexing="ij")
    out = np.stack([np.sin(np.pi * u), 0 * u, np.cos(np.pi * u)], axis=-1)
    foot = np.zeros_like(out) + [0, 0, STAR[2]]
    foot[..., 1] = np.maximum(SKIN_TOP - SKIN_HEIGHT * v, BUST_Y + .001)
    out, foot = out.reshape(-1, 3), foot.reshape(-1, 3)
    far = np.full(len(out), .20)
    for _ in range(40):  # from outside inward
        far = far - .8 * np.clip(sculpture_sdf(foot + far[:, None] * out),
                                 -.02, .02)
    points = (foot + far[:, None] * out).reshape(height, width, 3)
    return zoom(points, (2, 2, 1), order=1, mode="nearest", grid_mode=True)


def paint_skin():
    """The picture: factors of the skin's colour, a JPEG.

    They are blood, sun, lips, lashes and brows; near the hairline they are 1,
    for the scalp has no picture.
    """
    random = np.random.default_rng(4)
    shape = SKIN_PICTURE[::-1]
    p = places_of_picture().reshape(-1, 3)
    x, y = p[:, 0], p[:, 1]
    front = smoothstep(.02, .05, p[:, 2])

    def round_(centre, radii):
        return np.exp(-spread(p, np.array(centre), np.array(radii)) ** 2)

    def along(curve, width):
        cx, cy = np.transpose(curve)
        end = smoothstep(0.0, .004, np.minimum(x - cx[0], cx[-1] - x))
        t = (y - CubicSpline(cx, cy)(np.clip(x, cx[0], cx[-1]))) / width
        return front * end * np.exp(-t * t)

    def noise(mm):
        size = mm / 1000 / (SKIN_HEIGHT / SKIN_PICTURE[1])
        field = gaussian_filter(random.normal(size=shape), size, mode="nearest")
        return (field / field.std()).ravel()

    skin = np.ones((len(p), 3))
    below = smoothstep(.001, .018, -distance_to_hairline(p, .02))

    def put(share, pigment):
        nonlocal skin
        share = (below * np.clip(share, 0.0, 1.0))[:, None]
        skin = skin * (1.0 - share + share * np.array(pigment))

    uneven = noise(9.0)
    put(.12 + .055 * uneven + .02 * noise(2.5)
        + .62 * round_((.046, -.052, .056), (.021, .017, .022))
        + .55 * round_((0, -.057, .100), (.013, .011, .014))
        + .35 * round_((0, -.118, .084), (.018, .010, .016))
        + .55 * smoothstep(.006, -.010, sphere(p, EAR + [.008, 0, 0], .031))
        + .30 * round_((0, -.175, .03), (.05, .03, .06)), BLOOD)
    put(.15 + .045 * noise(14.0) + .35 * round_((0, .03, .08), (.05, .03, .05))
        + .3 * round_((0, -.24, .02), (.1, .05, .1)), SUN)
    # Round the eyes the skin is thin.
    put(.5 * round_((.0310, -.0320, .072), (.016, .008, .02))
        + .4 * along(CREASE, .0035), (.86, .78, .78))
    spots = noise(.55) > 2.75
    put(.35 * spots * round_((.030, -.045, .07), (.032, .022, .03)), (.80, .64, .52))

    # Lips: where the surface is that of their tubes.
    lip = np.minimum(*(tube(p, *arguments) for operation, _, arguments, _ in LIPS
                       if operation is union))
    lip = smoothstep(.0011, .0002, lip) * smoothstep(.0250, .0215, x)
    put(lip * (.85 + .08 * noise(1.0)), LIP)
    gap = np.abs(y - parting(x)) / .0012
    put(.95 * np.exp(-gap ** 4) * front * smoothstep(.0240, .0215, x), DARK)
    nostril = NOSE[-1][2]
    put(smoothstep(.0008, -.0004, turned(p, *nostril)) * .8, DARK)

    put(.9 * along(LASHES, .0006), LASH)
    hair = np.array(BROW_HAIR)
    low, high = (np.interp(x, hair[:, 0], hair[:, i]) for i in (1, 2))
    thick = np.clip(np.minimum(y - low, high - y) / .0022, -.35, 1.0) + .35
    ends = smoothstep(-.001, .005, x - hair[0, 0]) * smoothstep(
        -.001, .006, hair[-1, 0] - x)
    put(.62 * np.sqrt(np.maximum(thick, 0.0) / 1.35) * ends * front
        * np.clip(1 + .12 * noise(.7), 0, 1.3), HAIR)

    picture = np.clip(skin, 0.0, 1.0).reshape(*shape, 3)
    file = io.BytesIO()
    Image.fromarray(np.round(255 * picture).astype(np.uint8)).save(
        file, "JPEG", quality=88, subsampling=0)
    return file.getvalue()


def linear(value):
    """Return the linear value of an sRGB channel (IEC 61966-2-1)."""
    if value <= 0.04045:
        return value / 12.92
    return ((value + 0.055) / 1.055) ** 2.4


def write_glb(path, points, normals, parts, picture):
    """Write one mesh with a primitive (and a material) per part.

    The picture, a JPEG, has factors of the colour of the part "skin".
    """
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

    materials = []
    for material, (name, faces) in enumerate(parts.items()):
        used, local = np.unique(faces, return_inverse=True)
        xyz, n = points[used].astype("<f4"), normals[used].astype("<f4")
        if name == "skin":
            shares = np.round(65535 * skin_coordinates(points[used]))
            uv = accessor(np.clip(shares, 0, 65535).astype("<u2"), 5123, "VEC2",
                          34962, normalized=True)
        else:
            uv = accessor(texture_coordinates(points[used]).astype("<f4"), 5126,
                          "VEC2", 34962)
        materials.append({"name": name, "pbrMetallicRoughness": {
            "baseColorFactor": [*map(linear, MATERIALS[name]), 1.0],
            "metallicFactor": 0.0, "roughnessFactor": 0.55}})
        if name == "skin":
            materials[-1]["pbrMetallicRoughness"]["baseColorTexture"] = {"index": 0}
        primitives.append({"attributes": {
            "POSITION": accessor(xyz, 5126, "VEC3", 34962,
                                 min=xyz.min(axis=0).tolist(),
                                 max=xyz.max(axis=0).tolist()),
            "NORMAL": accessor(n, 5126, "VEC3", 34962),
            "TEXCOORD_0": uv},
            "indices": accessor(local.astype("<u2").ravel(), 5123, "SCALAR",
                                34963), "material": material})
    views.append({"buffer": 0, "byteOffset": len(binary),
                  "byteLength": len(picture)})
    binary += picture + bytes(-len(picture) % 4)
    text = json.dumps({
        "asset": {"version": "2.0", "generator": "make_head.py"},
        "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "head"}],
        "meshes": [{"name": "head", "primitives": primitives}],
        "materials": materials,
        "images": [{"mimeType": "image/jpeg", "bufferView": len(views) - 1}],
        "samplers": [{"wrapS": 33071, "wrapT": 33071}],
        "textures": [{"sampler": 0, "source": 0}],
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
    points, _, scalp = half_head(PLAIN_HEAD, hair_side)
    points, scalp = take(points, scalp)
    below, skin, _ = half_head(SCULPTURE, skin_side)
    below, skin = take(below, skin)
    hairline, cut_line = rim(points, scalp), rim(below, skin)
    skin += len(points)
    plain = np.r_[np.ones(len(points), bool), np.zeros(len(below), bool)]
    cut_line = np.add(cut_line, len(points))
    points = np.concatenate([points, below])
    strip = sew(points, hairline, cut_line)
    plain = np.r_[plain, plain[points[:, 0] > 1e-9]]
    points, skin, scalp = mirror(points, np.concatenate([skin, strip]), scalp)
    normals = np.where(plain[:, None], normals_at(points, plain_sdf),
                       normals_at(points, sculpture_sdf))
    check(points, skin, scalp)
    write_glb(out / "head.glb", points, normals,
              {"skin": skin, "scalp": scalp}, paint_skin())
    write_colliders(out / "head_colliders.json", points[np.unique(scalp)])


if __name__ == "__main__":
    main()

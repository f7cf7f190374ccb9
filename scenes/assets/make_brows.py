"""Grow brows and lashes on the sculpture that make_head.py makes.

Run (needs what make_head.py needs): python3 make_brows.py [output_directory]

It writes ``brows.npz``: strands in metres, ``positions`` (strands, points, 3)
and ``widths`` (strands, points), in the head's coordinates.  Roots lie on the
surface; points are evenly spaced along a strand, root first.
"""
import pathlib
import sys

import numpy as np

import make_head
from make_head import normals_at, sculpture_sdf, unit

POINTS = 8
STEPS = 40  # of a strand while it grows
BROW_HAIRS, BROW_WIDTH = 430, 0.000075
UPPER_LASHES, LOWER_LASHES, LASH_WIDTH = 120, 70, 0.0001
UP = np.array([0.0, 1.0, 0.0])

# Rows (x, lower edge y, upper edge y, length, degrees above the way outward)
# of a brow on the side x > 0, all in metres.
BROW = np.hstack([make_head.BROW_HAIR, [
    (.0070, 78), (.0085, 58), (.0090, 38), (.0090, 22), (.0085, 4),
    (.0072, -18), (.0055, -34)]])


def on_face(x, y):
    """The points of the surface in front of these."""
    p = np.stack([x, y, np.full_like(x, 0.13)], axis=1)
    for _ in range(80):
        p[:, 2] -= 0.7 * np.minimum(sculpture_sdf(p), 0.02)
    return p


def evenly(points):
    """[strand][point], from lines of any number of points."""
    lengths = np.linalg.norm(np.diff(points, axis=1), axis=2)
    arcs = np.concatenate([np.zeros((len(points), 1)),
                           np.cumsum(lengths, axis=1)], axis=1)
    at = np.linspace(0.0, 1.0, POINTS)
    return np.array([[np.interp(at * arc[-1], arc, line[:, axis])
                      for axis in range(3)] for arc, line in
                     zip(arcs, points)]).transpose(0, 2, 1)


def column(x, which):
    return np.interp(x, BROW[:, 0], BROW[:, which])


def brow(random):
    """Hairs that lie on the skin: up at the nose, outward at the temple."""
    # Fewer at both ends, where a brow thins out.
    share = random.beta(1.35, 1.35, 4 * BROW_HAIRS)
    x = BROW[0, 0] + share * (BROW[-1, 0] - BROW[0, 0])
    across = random.beta(1.6, 1.6, len(x))
    thick = column(x, 2) - column(x, 1)
    kept = np.flatnonzero(random.random(len(x)) < thick / thick.max())
    x, across = x[kept[:BROW_HAIRS]], across[kept[:BROW_HAIRS]]
    y = column(x, 1) + across * (column(x, 2) - column(x, 1))
    count = len(x)
    length = column(x, 3) * random.uniform(0.6, 1.1, count)
    # Hairs of the lower edge go up, those of the upper edge down to meet them.
    degrees = (column(x, 4) + 26.0 * (0.5 - across)
               + random.normal(0.0, 9.0, count))
    bend = -random.uniform(8.0, 30.0, count)  # outward along the hair
    height = random.uniform(0.0007, 0.0016, count)
    point = on_face(x, y)
    line = [point]
    for step in range(1, STEPS + 1):
        t = step / STEPS
        angle = np.radians(degrees + bend * t)
        normal = normals_at(point, sculpture_sdf)
        outward = unit(np.cross(np.broadcast_to(UP, normal.shape), normal))
        upward = np.cross(normal, outward)
        way = (np.cos(angle)[:, None] * outward
               + np.sin(angle)[:, None] * upward)
        point = point + (length / STEPS)[:, None] * way
        lift = height * (1.0 - (1.0 - t) ** 2)  # it rises, and lies down
        gap = lift - sculpture_sdf(point)
        point = point + gap[:, None] * normal
        line.append(point)
    return evenly(np.stack(line, axis=1))


def lid(count, random, first, last, below):
    """Roots along the gap between the lids, in two rows."""
    x = np.linspace(first, last, count) + random.normal(0, .0002, count)
    curve = np.array(make_head.LASHES)
    y = np.interp(x, curve[:, 0], curve[:, 1]) + below
    return x, y + random.choice([0.0, -0.0004], count)


def lashes(random, count, first, last, below, length, start, end):
    """Hairs of a lid that bend in the plane of its normal and up.

    ``start`` and ``end`` are their degrees above the normal.
    """
    x, y = lid(count, random, first, last, below)
    middle = (x - 0.5 * (first + last)) / (last - first)  # -0.5 to 0.5
    fan = np.radians(12.0 + 75.0 * middle)  # away from the nose
    # Neighbours stand together in tufts.
    tuft = np.arange(count) // 3
    together = random.normal(0.0, np.radians(7.0), tuft.max() + 1)[tuft]
    fan = fan + together + random.normal(0.0, np.radians(3.0), count)
    size = length * (1.0 - 1.3 * (middle - 0.08) ** 2)
    size = size * random.uniform(0.75, 1.05, count)
    root = on_face(x, y)
    # The eyeball's, for the lid's own edge is sharp.
    normal = unit(root - np.array([.0315, -.0262, .0590]))
    outward = unit(np.cross(np.broadcast_to(UP, normal.shape), normal))
    upward = np.cross(normal, outward)
    turn = random.normal(0.0, 6.0, count)
    point, line = root, [root]
    for step in range(STEPS):
        t = (step + 0.5) / STEPS
        angle = np.radians(start + turn + (end - start) * t)
        way = (np.cos(angle)[:, None] * (
            np.cos(fan)[:, None] * normal + np.sin(fan)[:, None] * outward)
            + np.sin(angle)[:, None] * upward)
        point = point + (size / STEPS)[:, None] * way
        line.append(point)
    return evenly(np.stack(line, axis=1))


def side(seed):
    """Strands on the side x > 0, and their widths."""
    random = np.random.default_rng(seed)
    parts = [
        (brow(random), BROW_WIDTH),
        (lashes(random, UPPER_LASHES, .0168, .0480, 0.0, .0080, -62, 18),
         LASH_WIDTH),
        (lashes(random, LOWER_LASHES, .0200, .0465, -.0013, .0045, -58, -30),
         0.8 * LASH_WIDTH)]
    widths = [np.full(points.shape[:2], width) for points, width in parts]
    return np.concatenate([points for points, _ in parts]), np.concatenate(widths)


def main():
    default = pathlib.Path(__file__).resolve().parent
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    left, left_widths = side(1)
    right, right_widths = side(2)
    right = right * [-1.0, 1.0, 1.0]
    positions = np.concatenate([left, right]).astype("<f4")
    inside = sculpture_sdf(positions.reshape(-1, 3).astype(float))
    print(f"{len(positions)} strands, deepest {1e3 * inside.min():.2f} mm, "
          f"highest {1e3 * inside.max():.2f} mm")
    np.savez_compressed(
        out / "brows.npz", positions=positions,
        widths=np.concatenate([left_widths, right_widths]).astype("<f4"))


if __name__ == "__main__":
    main()

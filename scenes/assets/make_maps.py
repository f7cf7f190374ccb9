"""Draw the pictures over head.glb's texture coordinates, and one for strands.

Run (needs what make_head.py needs): python3 make_maps.py [output_directory]

* ``hairline_mask.png``  density of roots: a natural hairline
* ``taper_lengths.png``  lengths: a short cut, tapered at the sides and nape
* ``fringe_lengths.png`` lengths: a fringe to the brows, longer beside the face
* ``braid_mask.png``     density of roots: the hairline without the sideburns

All four are grey, 8 bits.  See make_head.texture_coordinates() for what is where.

* ``strand_bands.png``   across and along a strand: dark roots, light tips
"""
import pathlib
import struct
import sys
import zlib

import numpy as np

import make_head
from make_head import distance_to_hairline, smoothstep


def directions(size):
    """[row * size + column], of the pixels' centres."""
    centre = (np.arange(size) + 0.5) / size
    v, u = np.meshgrid(centre, centre, indexing="ij")
    return make_head.texture_directions(np.stack([u.ravel(), v.ravel()], 1))


def elevation(direction):
    return np.degrees(np.arcsin(np.clip(direction[:, 1], -1.0, 1.0)))


def noise(direction, per_radian, seed):
    """Smooth, in [0, 1], the same on both sides of the head."""
    p = np.abs(direction * [1, 0, 0]) + direction * [0, 1, 1] + 2.0
    cell = np.floor(p * per_radian).astype(int)
    t = p * per_radian - cell
    t = t * t * (3.0 - 2.0 * t)
    table = np.random.default_rng(seed).random((64, 64, 64))
    total = np.zeros(len(p))
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, t, 1.0 - t), axis=1)
        total += weight * table[tuple(((cell + corner) % 64).T)]
    return total


def hairline_mask(size):
    """From nearly none on the hairline to 1 after 10 to 17 mm; 0 outside."""
    direction = directions(size)
    distance = distance_to_hairline(make_head.STAR + direction)
    wander = (0.004 * noise(direction, 14.0, 1)
              + 0.003 * noise(direction, 60.0, 2))
    return np.where(distance > 0.0,
                    smoothstep(-0.001, 0.010, distance - wander), 0.0)


def braid_mask(size):
    """The hairline's, without roots before and below the ears."""
    direction = directions(size)
    azimuth = np.degrees(np.arctan2(np.abs(direction[:, 0]), direction[:, 2]))
    at_ears = smoothstep(48.0, 58.0, azimuth) * smoothstep(128.0, 112.0, azimuth)
    above = 17.0 + 5.0 * noise(direction, 30.0, 6)
    free = at_ears * smoothstep(above + 5.0, above, elevation(direction))
    return hairline_mask(size) * (1.0 - free)


def taper_lengths(size):
    """1 on top, a tenth at the ears and the nape."""
    height = elevation(directions(size))
    return 0.1 + 0.9 * smoothstep(-32.0, 38.0, height)


FRINGE_LENGTH = 0.27  # where the picture is white (m)


def fringe_lengths(size):
    """From a root in front down to the brows; at the sides and behind 1.

    Locks differ by a tenth, and the middle is shorter than what frames it.
    """
    direction = directions(size)
    azimuth = np.degrees(np.arctan2(np.abs(direction[:, 0]), direction[:, 2]))
    over = np.arctan2(direction[:, 1], direction[:, 2])  # 0 in front, up
    down = 0.105 * (over - np.radians(9.0)) + 0.020
    down = down * (0.90 + 0.14 * noise(direction, 26.0, 3)
                   + 0.07 * noise(direction, 60.0, 5))
    aside = smoothstep(38.0, 66.0, azimuth)
    behind = smoothstep(78.0, 92.0, np.degrees(np.abs(over)))
    share = np.maximum(aside ** 1.5, behind)
    length = np.clip(down, 0.02, FRINGE_LENGTH) / FRINGE_LENGTH
    return length + share * (1.0 - length)


def strand_bands(width, height):
    """[row, column, channel]: factors of a strand's colour, and opacity.

    Rows go from the root to the tip: grown-out bleach, darkest for the first
    eighth, with light and dark bands of a slightly uneven length, and the sun
    in the last quarter.  Columns go across: edges are soft, and a tip thins.
    """
    along = (np.arange(height) + 0.5) / height
    across = 2.0 * (np.arange(width) + 0.5) / width - 1.0
    root = np.array([0.42, 0.33, 0.30])
    middle = np.array([0.86, 0.80, 0.72])
    tip = np.array([1.0, 0.97, 0.90])
    grown_out = smoothstep(0.08, 0.30, along)[:, None]
    bleached = smoothstep(0.55, 1.0, along)[:, None]
    colour = root + grown_out * (middle - root)
    colour = colour + bleached * (tip - colour)
    phase = 2.0 * np.pi * (9.0 * along + 0.35 * np.sin(2.0 * np.pi * 2.3 * along))
    colour = colour * (1.0 + 0.10 * np.sin(phase))[:, None]
    edge = 1.0 - 0.55 * smoothstep(0.80, 1.0, along)  # half width that is opaque
    opacity = 1.0 - smoothstep(0.0, 0.35, (np.abs(across) - edge[:, None]) + 0.35)
    rgb = np.broadcast_to(np.clip(colour, 0, 1)[:, None], (height, width, 3))
    return np.concatenate([rgb, opacity[:, :, None]], axis=2)


def write_png(path, picture):
    """Grey or RGBA, [row, column] or [row, column, channel], 8 bits.

    PNG specification, 2nd edition, sections 5 and 11.
    """
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data
                + struct.pack(">I", zlib.crc32(kind + data)))

    height, width = picture.shape[:2]
    colour_type = 0 if picture.ndim == 2 else 6
    rows = np.round(255.0 * picture).astype(np.uint8).reshape(height, -1)
    filtered = np.concatenate([np.zeros((height, 1), np.uint8), rows], axis=1)
    path.write_bytes(
        b"\x89PNG\r\n\x1a\n"
        + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colour_type, 0, 0, 0))
        + chunk(b"IDAT", zlib.compress(filtered.tobytes(), 9))
        + chunk(b"IEND", b""))


def main():
    default = pathlib.Path(__file__).resolve().parent
    out = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else default
    write_png(out / "hairline_mask.png", hairline_mask(1024).reshape(1024, 1024))
    write_png(out / "braid_mask.png", braid_mask(512).reshape(512, 512))
    write_png(out / "taper_lengths.png", taper_lengths(256).reshape(256, 256))
    write_png(out / "fringe_lengths.png", fringe_lengths(256).reshape(256, 256))
    write_png(out / "strand_bands.png", strand_bands(16, 256))


if __name__ == "__main__":
    main()

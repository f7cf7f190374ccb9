#!/usr/bin/env python3
"""Makes studio.exr: light from all around for pictures of hair, as a latitude-longitude picture.

usage: python3 make_sky.py [output_directory]

A dim room, brighter above than below, with three soft boxes: a large warm key light at the left
front of the head, a cool fill at the right, and a bright narrow rim light behind. Radiance is in
units in which the key light's is 8. Which way the picture lies is in docs/rendering.md: the middle
column is +z, where the face looks, a quarter of the width left of it +x, the top row +y.
The OpenEXR file is written by its published layout ("OpenEXR File Layout"), without its library,
and so is a test of what reads it.
"""

import pathlib
import struct
import sys
import zlib

import numpy as np

WIDTH, HEIGHT = 256, 128

# direction towards the middle, half sizes (rad, along and up), softness of the edge (rad), radiance
BOXES = [
    ((0.75, 0.45, 0.75), (0.40, 0.50), 0.06, (8.0, 7.4, 6.6)),
    ((-0.90, 0.15, 0.55), (0.30, 0.60), 0.08, (1.6, 1.8, 2.1)),
    ((-0.45, 0.60, -0.85), (0.55, 0.12), 0.04, (9.0, 9.3, 10.0)),
]
ABOVE = np.array([0.30, 0.32, 0.36])
BELOW = np.array([0.06, 0.05, 0.045])


def directions():
    """[row][column] unit vectors through the middles of the texels."""
    polar = np.pi * (np.arange(HEIGHT)[:, None] + 0.5) / HEIGHT
    azimuth = 2 * np.pi * (0.5 - (np.arange(WIDTH)[None, :] + 0.5) / WIDTH)  # from +z towards +x
    return np.stack(
        np.broadcast_arrays(
            np.sin(polar) * np.sin(azimuth), np.cos(polar), np.sin(polar) * np.cos(azimuth)),
        axis=-1)


def smooth(x):
    """0 below 0, 1 above 1."""
    x = np.clip(x, 0, 1)
    return x * x * (3 - 2 * x)


def soft_box(d, toward, half_size, softness):
    """1 in the box, 0 outside."""
    middle = np.array(toward) / np.linalg.norm(toward)
    along = np.cross([0, 1, 0], middle)
    along /= np.linalg.norm(along)
    up = np.cross(middle, along)
    front = d @ middle
    inside = (front > 0).astype(float)
    for axis, half in zip((along, up), half_size):
        off = np.abs(np.arctan2(d @ axis, np.maximum(front, 1e-6)))
        inside = inside * smooth((half - off) / softness + 0.5)
    return inside


def studio():
    """[row][column] RGB radiance."""
    d = directions()
    height = smooth(0.5 + 0.8 * d[..., 1])[..., None]
    light = BELOW + height * (ABOVE - BELOW)
    for toward, half_size, softness, radiance in BOXES:
        part = soft_box(d, toward, half_size, softness)[..., None]
        light = light * (1 - part) + part * np.array(radiance)
    return light


def zipped(block):
    """A block of lines by OpenEXR's ZIP: even bytes, odd bytes, their differences, deflated."""
    raw = np.frombuffer(block, np.uint8)
    split = np.concatenate([raw[0::2], raw[1::2]]).astype(int)
    split[1:] = split[1:] - split[:-1] + 128
    packed = zlib.compress((split % 256).astype(np.uint8).tobytes(), 9)
    return packed if len(packed) < len(block) else block


def write_exr(path, light):
    """Half-precision B, G, R in blocks of 16 lines."""
    height, width, _ = light.shape

    def attribute(name, kind, data):
        return b"%s\0%s\0" % (name, kind) + struct.pack("<i", len(data)) + data

    channels = b"".join(
        name + struct.pack("<xi4xii", 1, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2) + b"".join([
        attribute(b"channels", b"chlist", channels),
        attribute(b"compression", b"compression", b"\3"),
        attribute(b"dataWindow", b"box2i", window),
        attribute(b"displayWindow", b"box2i", window),
        attribute(b"lineOrder", b"lineOrder", b"\0"),
        attribute(b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        attribute(b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
        attribute(b"screenWindowWidth", b"float", struct.pack("<f", 1)),
    ]) + b"\0"

    # [line][channel][column]
    lines = np.ascontiguousarray(light[..., ::-1].transpose(0, 2, 1)).astype("<f2")
    chunks = []
    for y in range(0, height, 16):
        data = zipped(lines[y:y + 16].tobytes())
        chunks.append(struct.pack("<ii", y, len(data)) + data)
    starts = len(header) + 8 * len(chunks) + np.cumsum([0] + [len(chunk) for chunk in chunks[:-1]])
    path.write_bytes(header + starts.astype("<u8").tobytes() + b"".join(chunks))


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    write_exr(folder / "studio.exr", studio())


if __name__ == "__main__":
    main()

"""Compares the last time sample in a .usda with other files of the same frame, bit for bit.

usage: compare_frames.py FRAMES USDA HAIR OBJ
"""

import sys

import numpy as np
from pxr import Usd, UsdGeom

frames, usda, hair, obj = sys.argv[1:]
stage = Usd.Stage.Open(usda)
curves = UsdGeom.BasisCurves(stage.GetDefaultPrim())
times = curves.GetPointsAttr().GetTimeSamples()
assert times == list(range(int(frames))), times
assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (0, times[-1])
assert stage.GetTimeCodesPerSecond() == 60
counts = np.array(curves.GetCurveVertexCountsAttr().Get())
points = np.array(curves.GetPointsAttr().Get(times[-1]))
assert not np.array_equal(points, np.array(curves.GetPointsAttr().Get(0))), "nothing moves"
assert counts.sum() == len(points) == len(curves.GetWidthsAttr().Get())

# Yuksel's format: magic, strands, points, arrays, segments of each strand if all have the same,
# defaults and text up to byte 128. The arrays follow: points, then thickness (arrays = 6).
data = open(hair, "rb").read()
strands, count, arrays, segments = np.frombuffer(data, "<u4", 4, 4)
assert arrays == 6 and strands == len(counts) and (counts == segments + 1).all()
assert np.frombuffer(data, "<f4", 3 * count, 128).tobytes() == points.tobytes()
widths = np.frombuffer(data, "<f4", count, 128 + 12 * count)
assert widths.tobytes() == np.array(curves.GetWidthsAttr().Get()).tobytes()

with open(obj) as file:
    vertices = [line.split()[1:4] for line in file if line.startswith("v ")]
assert np.array(vertices, np.float32).tobytes() == points.tobytes()
print(f"{strands} strands, {count} points are equal")

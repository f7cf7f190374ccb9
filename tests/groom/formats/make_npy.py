"""Writes the files that npy_test.cpp reads, with NumPy itself: usage: make_npy.py FOLDER"""

import os
import sys

import numpy as np

os.chdir(sys.argv[1])

# Three strands of four points with coordinates that no short decimal represents: madeFloat() of the
# test.
numbers = np.arange(36, dtype=np.float64)
positions = ((numbers + 1) / 3 - numbers**2 / 7).reshape(3, 4, 3)
floats = positions.astype(np.float32)

np.save("floats.npy", floats)
np.save("doubles.npy", positions)
np.save("fortran.npy", np.asfortranarray(floats))
np.save("big_endian.npy", floats.astype(">f4"))
np.save("half.npy", floats.astype(np.float16))
np.save("flat.npy", floats.reshape(12, 3))
np.save("integers.npy", np.zeros((3, 4, 3), np.int32))
np.save("none.npy", np.zeros((0, 4, 3), np.float32))
for major in (1, 2, 3):
    with open(f"version_{major}.npy", "wb") as out:
        np.lib.format.write_array(out, floats, version=(major, 0))

arrays = {
    "root_uv": np.array([[0.25, 0.75], [0.5, 0.125], [1, 0]], np.float32),
    "root_normal": np.array([[0, 1, 0]] * 3, np.float32),
    "positions": floats,
}
np.savez("difflocks.npz", **arrays)
np.savez_compressed("difflocks_deflated.npz", **arrays)
np.savez_compressed(
    "all.npz", positions=np.asfortranarray(positions), widths=np.full((3, 4), 0.5),
    groups=np.array([7, -1, 7]), guides=np.array([True, False, True]))
np.savez("unnamed.npz", floats)
np.savez("two.npz", floats, floats)
np.savez("other_widths.npz", positions=floats, widths=np.ones(3, np.float32))
np.savez("other_guides.npz", positions=floats, guides=np.array([1, 2, 0], np.uint8))
np.savez("zeros.npz", positions=np.zeros((100, 100, 3), np.float32))
np.savez_compressed("zeros_deflated.npz", positions=np.zeros((100, 100, 3), np.float32))

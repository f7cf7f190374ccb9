"""Prints what NumPy finds in .npy and .npz files: usage: load_npy.py FILE..."""

import sys
import zipfile

import numpy as np

for path in sys.argv[1:]:
    loaded = np.load(path)
    if path.endswith(".npz"):
        assert zipfile.ZipFile(path).testzip() is None
    for name in getattr(loaded, "files", [""]):
        array = loaded[name] if name else loaded
        kind = "F" if array.flags.f_contiguous and not array.flags.c_contiguous else "C"
        numbers = " ".join(float(number).hex() for number in array.ravel())
        print(name, array.dtype.str, array.shape, kind, numbers)

"""Rewrites a file of Universal Scene Description in binary form: usd_binary.py IN.usda OUT.usdc."""

import sys

try:
    from pxr import Sdf, Tf
except ImportError as error:
    sys.exit(f"{error}: this Python lacks a package of requirements.txt")

try:
    Sdf.Layer.FindOrOpen(sys.argv[1]).Export(sys.argv[2])
except Tf.ErrorException as error:
    sys.exit(" ".join(str(error).split()))

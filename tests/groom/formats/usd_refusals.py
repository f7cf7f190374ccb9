"""Prints "refused name: reason" for each file that usd_curves.py refuses: usage: usd_refusals.py
FOLDER"""

import os
import sys

tools = os.path.join(os.path.dirname(__file__), "../../../hair/groom/formats")
sys.path.insert(0, tools)

from usd_curves import read  # noqa: E402
from usd_prim import Refused  # noqa: E402

for name in sorted(os.listdir(sys.argv[1])):
    try:
        read(os.path.join(sys.argv[1], name))
    except Refused as refused:
        print(f"refused {name}: {refused}")

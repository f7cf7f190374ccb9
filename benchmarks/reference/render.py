"""Renders a scene of Mitsuba 3: render.py SCENE.xml OUT.exr|OUT.png SAMPLES

Writes "passes N" to stdout, then "pass SAMPLES_DONE" at the start of each pass. A failure is one
line on stderr.
"""

import signal
import sys

import mitsuba as mi
import numpy as np

MOST_PASSES = 50  # each can be timed; more would only cost time


def render(scene, samples):
    """Returns the mean of all samples, linear RGB, [row][column][channel]."""
    size = -(-samples // MOST_PASSES)
    starts = range(0, samples, size)
    print("passes", len(starts), flush=True)
    total = 0.0
    for seed, start in enumerate(starts):
        print("pass", start, flush=True)
        count = min(size, samples - start)
        image = mi.render(scene, spp=count, seed=seed)
        total = total + count * np.array(image, np.float64)
    return (total / samples).astype(np.float32)


def write(image, path):
    bitmap = mi.Bitmap(image, mi.Bitmap.PixelFormat.RGB)
    kind = mi.Bitmap.FileFormat.OpenEXR
    if path.lower().endswith(".png"):
        bitmap = bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.UInt8, srgb_gamma=True)
        kind = mi.Bitmap.FileFormat.PNG
    bitmap.write(path, kind)


def main():
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # also within a pass
    scene, out, samples = sys.argv[1:]
    mi.set_variant("scalar_rgb")
    mi.set_log_level(mi.LogLevel.Error)
    write(render(mi.load_file(scene), int(samples)), out)


try:
    main()
except Exception as error:
    sys.exit("Mitsuba: " + " ".join(str(error).split()))

"""Prints the mean radiances of scenes by Mitsuba 3, to compare with our own path tracer.

usage: mitsuba_means.py SAMPLES DIR ...

`hairbench export SCENE --mitsuba DIR` writes each DIR. Traces SAMPLES a pixel in 16 parts with
independent seeds, which give the standard error. Takes glossy meshes as matt, as trace_folder does.
"""

import os
import re
import sys

import mitsuba as mi
import numpy as np

PARTS = 16


def matt(scene):
    """Returns the scene's XML with `diffuse` instead of `principled`."""
    scene = re.sub(r'\s*<float name="(metallic|roughness)"[^>]*/>', "", scene)
    return scene.replace('type="principled"', 'type="diffuse"').replace(
        'name="base_color"', 'name="reflectance"'
    )


def main():
    samples = int(sys.argv[1])
    mi.set_variant(os.environ.get("MITSUBA_VARIANT", "scalar_rgb"))
    mi.set_log_level(mi.LogLevel.Error)
    for folder in sys.argv[2:]:
        with open(os.path.join(folder, "scene.xml"), encoding="utf-8") as file:
            xml = matt(file.read())
        path = os.path.join(folder, "matt.xml")  # it names files relative to its folder
        with open(path, "w", encoding="utf-8") as file:
            file.write(xml)
        scene = mi.load_file(path)
        count = max(samples // PARTS, 1)
        parts = [
            np.array(mi.render(scene, spp=count, seed=seed), np.float64).mean((0, 1))
            for seed in range(PARTS)
        ]
        mean = np.mean(parts, 0)
        error = np.std(parts, 0, ddof=1) / np.sqrt(PARTS)
        show = lambda values: " ".join(f"{value:.6f}" for value in values)
        print(f"{folder}: mean {show(mean)}, standard error {show(error)}", flush=True)


main()

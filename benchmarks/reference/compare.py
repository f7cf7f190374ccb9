"""Compares two pictures, PNG or EXR: compare.py REFERENCE PICTURE [DIFFERENCE.png]

Writes figures as JSON to stdout. All except the ratio of mean linear light are of display values
(sRGB, 0 to 1); linear pictures are converted. Alpha is ignored. DIFFERENCE is FLIP's error map. A
failure is one line on stderr.
"""

import json
import math
import sys

import flip_evaluator
import mitsuba as mi
import numpy as np
from skimage.metrics import structural_similarity

SSIM_WINDOW = 11  # px: a Gaussian of sigma 1.5 as in Wang et al. 2004


def read(path):
    """Returns the display values of the picture and its mean linear light."""
    try:
        bitmap = mi.Bitmap(path)
    except Exception:
        raise ValueError(f"{path}: can't be read as a picture") from None
    rgb = bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, srgb_gamma=True)
    linear = bitmap.convert(mi.Bitmap.PixelFormat.RGB, mi.Struct.Type.Float32, srgb_gamma=False)
    return np.clip(np.array(rgb), 0.0, 1.0), float(np.mean(np.array(linear), dtype=np.float64))


def compare(reference, picture):
    """Returns the figures and FLIP's error map in colour."""
    mse = np.mean((reference.astype(np.float64) - picture) ** 2)
    error_map, flip, _ = flip_evaluator.evaluate(reference, picture, "LDR")
    ssim = structural_similarity(
        reference, picture, channel_axis=2, data_range=1.0, gaussian_weights=True, sigma=1.5,
        use_sample_covariance=False)
    height, width = reference.shape[:2]
    return {
        "width": width,
        "height": height,
        "rmse": math.sqrt(mse),
        "psnr_db": -10 * math.log10(mse) if mse > 0 else None,
        "ssim": float(ssim),
        "flip": float(flip),
    }, error_map


def main():
    mi.set_variant("scalar_rgb")
    mi.set_log_level(mi.LogLevel.Error)
    paths = sys.argv[1:3]
    (reference, reference_light), (picture, light) = map(read, paths)
    sizes = [f"{image.shape[1]} x {image.shape[0]} px" for image in (reference, picture)]
    if sizes[0] != sizes[1]:
        raise ValueError(f"{paths[0]} is {sizes[0]}, {paths[1]} is {sizes[1]}")
    if min(reference.shape[:2]) < SSIM_WINDOW:
        raise ValueError(f"{paths[0]}: SSIM needs at least {SSIM_WINDOW} x {SSIM_WINDOW} px")
    figures, error_map = compare(reference, picture)
    figures["light_ratio"] = light / reference_light if reference_light > 0 else None
    for out in sys.argv[3:]:
        colors = mi.Bitmap((255 * error_map + 0.5).astype(np.uint8), mi.Bitmap.PixelFormat.RGB)
        colors.write(out, mi.Bitmap.FileFormat.PNG)
    print(json.dumps(figures))


try:
    main()
except Exception as error:
    sys.exit(" ".join(str(error).split()))

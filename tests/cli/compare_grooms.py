"""Computes the results of `hairbench groom compare` for two grooms by brute force. Follows the
definitions of docs/grooms.md and compares each sample with each segment, in double precision.

usage: compare_grooms.py A B SPACING CURVATURE_STEP CONSISTENCY_SAMPLES directed|undirected

A and B are text files with a strand a line: x y z of its points, in metres. Prints JSON.
"""

import json
import sys

import numpy as np

THRESHOLDS = [(2e-3, 20.0), (3e-3, 30.0), (4e-3, 40.0)]


def read(path):
    with open(path) as file:
        strands = [np.array(line.split(), dtype=float).reshape(-1, 3) for line in file]
    return [s for s in strands if len(s) > 1 and np.ptp(s, axis=0).any()]


def arcs(strand):
    steps = np.linalg.norm(np.diff(strand, axis=0), axis=1)
    return np.concatenate([[0.0], np.cumsum(steps)])


def along(strand, places):
    """Returns the points and unit tangents at these arc lengths."""
    arc = arcs(strand)
    segment = np.searchsorted(arc, places, side="right") - 1
    segment = np.clip(segment, 0, len(strand) - 2)
    steps = np.diff(strand, axis=0)
    lengths = np.diff(arc)
    share = (places - arc[segment]) / lengths[segment]
    tangents = steps[segment] / lengths[segment][:, None]
    return strand[segment] + share[:, None] * steps[segment], tangents


def samples(strands, spacing):
    points, tangents, owners = [], [], []
    for index, strand in enumerate(strands):
        length = arcs(strand)[-1]
        count = max(1, int(np.ceil(length / spacing * (1 - 1e-6))))
        p, t = along(strand, (np.arange(count) + 0.5) * length / count)
        points.append(p)
        tangents.append(t)
        owners.append(np.full(count, index))
    return np.concatenate(points), np.concatenate(tangents), np.concatenate(owners)


def segments(strands):
    starts = np.concatenate([s[:-1] for s in strands])
    steps = np.concatenate([np.diff(s, axis=0) for s in strands])
    owners = np.concatenate([np.full(len(s) - 1, i) for i, s in enumerate(strands)])
    return starts, steps, owners


def search(strands, others, spacing, undirected, consistency_samples):
    points, tangents, owners = samples(strands, spacing)
    starts, steps, other_owners = segments(others)
    lengths = np.linalg.norm(steps, axis=1)
    to_point = points[:, None, :] - starts[None, :, :]
    share = np.einsum("ijk,jk->ij", to_point, steps) / lengths**2
    off = to_point - np.clip(share, 0, 1)[:, :, None] * steps[None, :, :]
    distances = np.linalg.norm(off, axis=2)
    cosines = tangents @ (steps / lengths[:, None]).T
    if undirected:
        cosines = np.abs(cosines)
    angles = np.degrees(np.arccos(np.clip(cosines, -1, 1)))

    shares, consistencies = [], []
    for distance, angle in THRESHOLDS:
        found = (distances <= distance) & (angles <= angle)
        shares.append(found.any(axis=1).mean())
        greatest = []
        for strand in range(len(strands)):
            mine = np.flatnonzero(owners == strand)
            count = min(len(mine), consistency_samples)
            # Splits the samples into `count` runs and takes the middle sample of each.
            mine = mine[[(2 * run + 1) * len(mine) // (2 * count) for run in range(count)]]
            together = [
                found[mine][:, other_owners == other].any(axis=1).sum()
                for other in range(len(others))
            ]
            greatest.append(max(together) / count)
        consistencies.append(np.mean(greatest))
    return distances.min(axis=1), shares, consistencies


def curvatures(strands, wanted):
    values = []
    for strand in strands:
        length = arcs(strand)[-1]
        pieces = max(2, int(np.floor(length / wanted + 0.5)))
        points, _ = along(strand, np.arange(pieces + 1) * length / pieces)
        chords = np.diff(points, axis=0)
        a, b = chords[:-1], chords[1:]
        sine = np.linalg.norm(np.cross(a, b), axis=1)
        cosine = np.einsum("ij,ij->i", a, b)
        values.append(np.arctan2(sine, cosine) / (length / pieces))
    return np.concatenate(values)


def earth_movers(a, b):
    """Integrates the difference of the quantile functions, which are step functions."""
    levels = np.union1d(np.arange(len(a) + 1) / len(a), np.arange(len(b) + 1) / len(b))
    middles = (levels[:-1] + levels[1:]) / 2
    first = np.sort(a)[(middles * len(a)).astype(int)]
    second = np.sort(b)[(middles * len(b)).astype(int)]
    return float(np.sum(np.diff(levels) * np.abs(first - second)))


def spread(distances):
    return {
        "mean": distances.mean(),
        "root_mean_square": np.sqrt((distances**2).mean()),
        "median": np.percentile(distances, 50),
        "percentile90": np.percentile(distances, 90),
        "percentile95": np.percentile(distances, 95),
        "percentile99": np.percentile(distances, 99),
        "maximum": distances.max(),
    }


def main():
    a, b = read(sys.argv[1]), read(sys.argv[2])
    spacing, step = float(sys.argv[3]), float(sys.argv[4])
    counted, undirected = int(sys.argv[5]), sys.argv[6] == "undirected"
    to_b, recalls, consistencies = search(a, b, spacing, undirected, counted)
    to_a, precisions, _ = search(b, a, spacing, undirected, counted)
    result = {
        "precision": precisions,
        "recall": recalls,
        "f1": [2 * p * r / (p + r) if p + r > 0 else 0 for p, r in zip(precisions, recalls)],
        "strand_consistency": consistencies,
        "first_to_second": spread(to_b),
        "second_to_first": spread(to_a),
        "chamfer": (to_b.mean() + to_a.mean()) / 2,
        "chamfer_squared": (to_b**2).mean() + (to_a**2).mean(),
        "hausdorff": max(to_b.max(), to_a.max()),
        "lengths": earth_movers(
            np.array([arcs(s)[-1] for s in a]), np.array([arcs(s)[-1] for s in b])
        ),
        "curvatures": earth_movers(curvatures(a, step), curvatures(b, step)),
        "mean_curvature": curvatures(a, step).mean(),
    }
    json.dump(result, sys.stdout, default=float)


main()

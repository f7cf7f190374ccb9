#!/usr/bin/env python3
"""Writes scipy_values.json, scipy's results for stored data, for the tests beside it.

    python scipy_values.py > scipy_values.json

The committed numbers are from scipy 1.17.1 and the numpy release of that time. Intervals of the
signed-rank test do not use the ranks of Walsh averages. Instead, scipy's test shows which medians it
rejects.
"""

import itertools
import json
import sys

import numpy as np
import scipy
from scipy import stats

random = np.random.Generator(np.random.PCG64(6))


def short(values):
    return [round(float(v), 4) for v in values]


def signed_rank(values, alpha):
    """p-values, and the ends of the interval of medians that are not rejected at alpha."""
    x = np.array(values)
    ties = len(set(np.abs(x))) < len(x) or 0.0 in x
    # With ties the test is exhaustive, so it needs no random numbers.
    method = stats.PermutationMethod(n_resamples=np.inf) if ties else "exact"
    row = {"values": values, "alpha": alpha}
    for side in ("two-sided", "greater", "less"):
        row[side] = stats.wilcoxon(x, alternative=side, method=method).pvalue
    averages = sorted((a + b) / 2 for a, b in itertools.combinations_with_replacement(x, 2))
    row["estimate"] = float(np.median(averages))
    if ties:
        return row
    # The p-value changes only at Walsh averages, so it is computed between and beyond them.
    ends = sorted(set(averages))
    points = [ends[0] - 1] + [(a + b) / 2 for a, b in zip(ends, ends[1:])] + [ends[-1] + 1]
    p = [stats.wilcoxon(x - point, method="exact").pvalue for point in points]
    kept = [i for i in range(len(p)) if p[i] > alpha]
    row["lower"], row["upper"] = ends[kept[0] - 1], ends[kept[-1]]
    # Medians just outside the interval are rejected at their own p-value, the greatest error rate
    # of the interval.
    row["confidence"] = 1 - p[kept[0] - 1]
    return row


def median_interval(values, alpha):
    x = np.array(values)
    interval = stats.quantile_test(x, q=np.median(x), p=0.5).confidence_interval(1 - alpha)
    return {
        "values": values,
        "alpha": alpha,
        "estimate": float(np.median(x)),
        "lower": float(interval.low),
        "upper": float(interval.high),
        # Confidence of the ranks found; both ends are equally deep.
        "confidence": 1 - 2 * stats.binom.cdf(sorted(values).index(interval.low), len(x), 0.5),
    }


def trend(values):
    order = np.arange(len(values))
    slope = stats.theilslopes(values, order).slope
    pairs = itertools.combinations(values, 2)
    score = sum(int(np.sign(b - a)) for a, b in pairs)
    p = stats.kendalltau(order, values, method="auto").pvalue
    return {"values": values, "score": score, "p": p, "slope": slope}


def adjusted(values):
    return {"p": values, "adjusted": list(stats.false_discovery_control(values, method="bh"))}


def main():
    normal = [short(random.normal(0.3, 1.0, n)) for n in (6, 8, 12, 24, 48, 64)]
    skewed = [short(random.exponential(1.0, n) - 0.5) for n in (9, 20, 40)]
    tied = [[1.0, -1.0, 2.0, 2.0, 3.0, -4.0, 4.0, 5.0], [0.0, 0.5, 0.5, -0.5, 1.5, 0.0, 2.5, 3.5, 3.5]]
    long = [short(random.lognormal(2.0, 0.4, n)) for n in (6, 7, 15, 100, 1001)]
    drifts = [short(random.normal(0, 1, n) + slope * np.arange(n))
              for n, slope in ((4, 0), (12, 0.1), (32, 0.0), (33, 0.05), (34, 0.05), (64, 0.0))]
    rounded = [list(np.round(random.normal(0, 1, n) + 0.05 * np.arange(n))) for n in (10, 32, 64)]
    json.dump(
        {
            "scipy": scipy.__version__,
            "signed_rank": [signed_rank(v, a) for v in normal + skewed
                            for a in ((0.05, 0.05 / 3) if len(v) > 7 else (0.05,))]
            + [signed_rank(v, 0.05) for v in tied],
            "median_interval": [median_interval(v, a) for v in long
                                for a in ((0.05, 0.01) if len(v) > 8 else (0.05,))],
            "trend": [trend(v) for v in drifts + rounded],
            "false_discovery": [
                adjusted(short(random.uniform(0, 1, 12))),
                adjusted([0.001, 0.008, 0.039, 0.041, 0.042, 0.06, 0.074, 0.205, 0.212, 0.216]),
                adjusted([0.5]),
                adjusted([0.02, 0.02, 0.02, 1.0, 0.0]),
            ],
        },
        sys.stdout, indent=None, separators=(",", ":"))
    print()


if __name__ == "__main__":
    main()

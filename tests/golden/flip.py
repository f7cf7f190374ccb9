"""Computes mean FLIP errors. Reads lines of REFERENCE<tab>PICTURE from stdin, prints one error each."""

import sys

import flip_evaluator

for line in sys.stdin:
    reference, picture = line.rstrip("\n").split("\t")
    _, error, _ = flip_evaluator.evaluate(reference, picture, "LDR", applyMagma=False)
    print(f"{error:.6f}", flush=True)

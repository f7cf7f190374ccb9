"""Mean FLIP error of pairs of pictures: lines of REFERENCE<tab>PICTURE on stdin, a figure a line on stdout."""

import sys

import flip_evaluator

for line in sys.stdin:
    reference, picture = line.rstrip("\n").split("\t")
    _, error, _ = flip_evaluator.evaluate(reference, picture, "LDR", applyMagma=False)
    print(f"{error:.6f}", flush=True)

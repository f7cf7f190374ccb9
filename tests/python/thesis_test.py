"""Tests that scripts/reproduce-thesis makes every figure and table and reports those that it could
not make. A stand-in draws and measures instead of hairbench, but has hairbench list the cases, so
an unknown option or case fails."""

import importlib.machinery
import importlib.util
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import REPOSITORY, hairbench

SCRIPT = REPOSITORY / "scripts" / "reproduce-thesis"
ONE_PIXEL = bytes.fromhex(
    "89504e470d0a1a0a0000000d49484452000000010000000108060000001f15c489"
    "0000000d49444154789c6360606060000000050001a5f645400000000049454e44ae426082")

STAND_IN = r'''#!{python}
import json, pathlib, subprocess, sys
words = sys.argv[1:]
fails = json.loads(pathlib.Path({fails!r}).read_text())
for pattern, (status, message) in fails.items():
    if pattern in " ".join(words):
        print(message, file=sys.stderr)
        sys.exit(status)
after = lambda name: words[words.index(name) + 1]
axes = [words[i + 1].split("=") for i, word in enumerate(words) if word == "-a"]
sets = [part for i, word in enumerate(words) if word == "--set" for part in (word, words[i + 1])]
out = pathlib.Path(after("-o" if words[0] == "render" else "--out"))
# `render` draws one case, whatever the scene sweeps: so each set field is an axis with one value.
one = ["-a" if part == "--set" else part for part in sets]
asked = ["run", words[1], "--list", *one] if words[0] == "render" else [*words, "--list"]
listed = subprocess.run([{program!r}, *asked], capture_output=True, text=True)
if listed.returncode:
    sys.exit("not known to hairbench: " + listed.stderr)
out.parent.mkdir(parents=True, exist_ok=True)
if words[0] == "render":
    out.write_bytes({pixel!r})
    sys.exit()
def value(text):
    try:
        return json.loads(text)
    except ValueError:
        return text
cases = []
for name in listed.stdout.splitlines()[:-1]:  # the last line counts them
    parts = dict(part.split(":", 1) for part in name.split("/")[1:])
    case = {{"name": name, "axes": {{pointer: value(parts[pointer.split("/")[-1]])
                                    for pointer, _ in axes}}}}
    if parts.get("msaa") == "8":
        cases.append({{**case, "status": "skipped", "reason": "no 8 samples here"}})
        continue
    time = 4.0 if parts.get("taper") == "segment" else 2.0
    metric = lambda unit, median: {{"unit": unit, "median": median}}
    cases.append({{**case, "status": "ok", "image_hash": "1",
        "counts": {{"strands": 136 * int(parts.get("density", 64)), "root_triangles": 136}},
        "backend": {{"name": "tessellation" if parts.get("backend") == "tessellation" else "software"}},
        "metrics": {{"frame.time": metric("ms", time), "fps": metric("1/s", 1000 / time),
                    "pass.strands.time": metric("ms", time / 2),
                    "pass.simulate.time": {{**metric("ms", 0.5),
                                           "interval": {{"lower": 0.25, "upper": 0.75}}}}}}}})
environment = {{"device": {{"name": "Card <7>", "type": "discrete", "driver": "drv", "driver_version":
    "1.2", "api_version": "1.3.0"}}, "host": {{"processor": "Chip"}},
    "build": {{"version": "9", "commit": "abcdef", "type": "Release"}}}}
out.write_text(json.dumps({{"cases": cases, "environment": environment}}))
'''


def load():
    loader = importlib.machinery.SourceFileLoader("reproduce_thesis", str(SCRIPT))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    sys.modules[loader.name] = module  # dataclasses look for it there
    sys.dont_write_bytecode = True
    loader.exec_module(module)
    return module


THESIS = load()


class ReproduceThesis(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        self.out = self.folder / "out"
        self.fails = self.folder / "fails.json"
        self.stand_in = self.folder / "hairbench"
        self.stand_in.write_text(STAND_IN.format(
            python=sys.executable, fails=str(self.fails), program=str(hairbench.program()),
            pixel=ONE_PIXEL))
        self.stand_in.chmod(0o755)

    def reproduce(self, *words, fails=None):
        self.fails.write_text(json.dumps(fails or {}))
        return subprocess.run(
            [sys.executable, SCRIPT, "--program", self.stand_in, "--out", self.out, *words],
            capture_output=True, text=True)

    def page(self):
        return (self.out / "index.html").read_text()

    def test_makes_every_figure_and_table(self):
        done = self.reproduce()
        self.assertEqual(done.returncode, 0, done.stderr)
        page = self.page()
        for figure in THESIS.FIGURES:
            self.assertIn(f"{figure.number} {figure.caption}", page)
        for defect in THESIS.DEFECTS:
            self.assertIn(defect.pointer, page)
            self.assertIn(defect.here, page)
        # Figures, three more that a device without 8 samples can draw, and two for each defect.
        shown = re.findall(r'<img src="([^"]*)" alt="([^"]+)"', page)
        self.assertEqual(len(shown), len(THESIS.FIGURES) + 3 + 2 * len(THESIS.DEFECTS))
        for file, _ in shown:
            self.assertEqual((self.out / file).read_bytes(), ONE_PIXEL)
        self.assertIn("skipped: no 8 samples here", page)
        self.assertIn("1,120 fps on an AMD Radeon RX 590", page)
        for strands in ("5,568", "8,704", "5,576"):
            self.assertIn(strands, page)
        self.assertIn("0.5 ms (0.25 to 0.75)", page)
        # Device, driver and commit are escaped text.
        for fact in ("Card &lt;7&gt; (discrete)", "drv, 1.2, Vulkan 1.3.0", "commit abcdef"):
            self.assertIn(fact, page)

    def test_says_what_an_original_costs(self):
        self.assertEqual(self.reproduce("--only", "defect taper").returncode, 0)
        # The defect's frames take 4 ms instead of 2, and the pass takes half of each.
        self.assertIn("<td>4 ms</td><td>2 ms</td><td>2.00 times</td>", self.page())
        self.assertIn("<td>2 ms</td><td>1 ms</td><td></td>", self.page())

    def test_opens_without_a_network(self):
        self.reproduce("--only", "figure 4")
        page = self.page()
        self.assertIn("default-src 'none'", page)
        for address in re.findall(r'(?:src|href)="([^"]*)"', page):
            self.assertRegex(address, r"^pictures/[a-z0-9_]+\.png$")

    def test_says_where_it_is(self):
        done = self.reproduce("--only", "figure 4.[12]")
        lines = done.stderr.splitlines()
        self.assertRegex(lines[0], r"^\[1/2\] figure 4\.1: Hair at rest: \d+ s$")
        self.assertRegex(lines[1], r"^\[2/2\] figure 4\.2: .*: \d+ s$")

    def test_goes_on_after_what_failed_and_says_so(self):
        done = self.reproduce("--only", "figure 4", fails={"weak_wind": (1, "a fault <here>")})
        self.assertEqual(done.returncode, 1)
        self.assertIn("a fault <here>", done.stderr)
        page = self.page()
        self.assertIn("is missing: hairbench render: a fault &lt;here&gt;", page)
        self.assertIn("4.6 Hair in the simulation of a strong wind", page)

    def test_ends_without_a_device_as_hairbench_does(self):
        done = self.reproduce("--only", "figure 4", fails={"": (77, "no Vulkan device")})
        self.assertEqual(done.returncode, 77)
        self.assertIn("no Vulkan device", done.stderr)
        self.assertFalse((self.out / "index.html").exists())

    def test_names_its_steps_where_none_is_meant(self):
        done = self.reproduce("--only", "figure 9")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("defect taper", done.stderr)


if __name__ == "__main__":
    unittest.main()

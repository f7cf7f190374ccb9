"""Tests that a type checker accepts the module and finds what is wrong in a call, and that the types
of keywords are those of the scene's schema and of the program's options."""

import importlib.util
import json
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from support import REPOSITORY, hairbench, skip_without

MODULE = REPOSITORY / "benchmarks" / "python"

RIGHT = '''
from typing import Any, cast

import numpy

import hairbench

wind: hairbench.Sets = {"/simulation/wind/strength": numpy.float32(3), "/run/frames": 2}
result = hairbench.run(
    "smoke", out="smoke.json", sets=wind, max_time=0.5, no_pictures=True, filter="msaa:1",
    axes={"/strands/density": [4, 8], "/strands/backend": ["lines", "mesh"],
          "/groom/guides": "pow2:6:12", "/simulation/wind/strength": numpy.linspace(0, 20, 5)})
print(result.frame(), result.probes())
played = hairbench.simulate("smoke", out="played", axes=cast(
    hairbench.Axes, {"/shading/lights/0/strength": [1, 2]}))
print(played.positions["smoke"].shape)
height, width, colours = hairbench.render("smoke", frame=3, linear=True).shape
for name, picture in hairbench.render("smoke", axes={"/render/msaa": [1, 4]}).items():
    print(name.upper(), picture.shape)
def darker(picture: numpy.ndarray[Any, Any], reference: numpy.ndarray[Any, Any]) -> float:
    return float((picture < reference).mean())

judged = hairbench.measure_pictures(
    "smoke", {"darker": darker}, reference_sets={"/render/msaa": 8}, axes={"/render/msaa": [1, 4]}, at_most=0.1)
print(judged.passed, judged.frame(), judged.pictures["smoke"].shape)
print(hairbench.physics(solver="rod").frame(), hairbench.gate("a", "b", "smoke", probes=True).passed)
groom = hairbench.read_groom("x.hair", scale=0.01, guides=200)
hairbench.write_groom("x.ply", hairbench.Groom(groom.points * 2, groom.offsets))
'''

# A line with a fault, and what the checker says about it.
WRONG = (
    ('hairbench.run("smoke", axes={"/strands/densty": [4, 8]})', "/strands/densty"),
    ('hairbench.run("smoke", sets={"/simulation/wind/strenght": 3})', "/simulation/wind/strenght"),
    ('hairbench.run("smoke", sets={"/strands/density": "many"})', "/strands/density"),
    ('hairbench.run("smoke", sets={"/simulation/wind/mode": "drug"})', "drug"),
    ('hairbench.run("smoke", axes={"/strands/density": 4})', "/strands/density"),
    ('hairbench.run("smoke", max_tme=0)', "max_tme"),
    ('hairbench.simulate("smoke", out="x", frame=3)', "frame"),
    ('hairbench.render("smoke", fram=3)', "fram"),
    ('hairbench.physics(solvers="rod")', "solvers"),
    ('hairbench.gate("a", "b", "smoke", pair=12)', "pair"),
    ('hairbench.read_groom("x.hair", guide=3)', "guide"),
    ('hairbench.render("smoke").items()', "items"),
    ('hairbench.measure_pictures("smoke", lambda a, b: 1.0, reference_sets={"/render/msa": 8})', "/render/msa"),
    ('hairbench.measure_pictures("smoke", len, reference_sets={"/render/msaa": 8})', "measure_pictures"),
)


class Typing(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def check(self, *arguments):
        """Returns the checker's status and lines."""
        if importlib.util.find_spec("mypy") is None:
            skip_without(self, "module", "there is no mypy: run scripts/setup --module")
        done = subprocess.run(
            [sys.executable, "-m", "mypy", "--strict", "--no-error-summary", "--no-color-output",
             "--cache-dir", str(self.folder / "cache"), *map(str, arguments)],
            capture_output=True, text=True, cwd=self.folder, check=False,
            env={"PATH": "/usr/bin:/bin", "MYPYPATH": str(MODULE)})
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout.splitlines()

    def test_the_module_and_a_right_example_have_no_fault(self):
        example = self.folder / "right.py"
        example.write_text(RIGHT)
        self.assertEqual(self.check(MODULE / "hairbench", example), (0, []))

    def test_each_wrong_call_is_found(self):
        example = self.folder / "wrong.py"
        example.write_text("import hairbench\n" + "".join(line + "\n" for line, _ in WRONG))
        status, said = self.check(example)
        self.assertEqual(status, 1)
        for number, (line, name) in enumerate(WRONG, 2):
            about = [each for each in said if each.startswith(f"wrong.py:{number}: error: ")]
            self.assertTrue(any(name in each for each in about), (line, said))

    def test_the_types_are_those_of_the_program(self):
        done = subprocess.run(
            [sys.executable, "-B", REPOSITORY / "scripts" / "python-keywords", "--check",
             hairbench.program()], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_every_field_is_a_pointer_that_a_checker_knows(self):
        schema = json.loads((REPOSITORY / "scenes" / "scene.schema.json").read_text())
        pointers = {pointer for pointer in schema["properties"]["sweep"]["properties"]
                    if pointer.startswith("/")}
        self.assertGreater(len(pointers), 200)
        for types in (hairbench.Axes, hairbench.Sets):
            self.assertEqual(set(types.__annotations__), pointers)

    def test_the_version_is_that_of_the_program(self):
        said = subprocess.run(
            [hairbench.program(), "--version"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(re.match(r"hairbench (\S+)", said)[1], hairbench.__version__)


if __name__ == "__main__":
    unittest.main()

"""Runs the examples of docs/results.md and of the notebooks in docs in order."""

import contextlib
import io
import json
import os
import re
import sys
import tempfile
import unittest

os.environ["MPLBACKEND"] = "agg"  # pictures without a display

from support import REPOSITORY, need_device  # noqa: E402


def examples(name):
    """Returns the Python code of a page of docs/, one text for each block or cell."""
    path = REPOSITORY / "docs" / name
    if path.suffix == ".md":
        return re.findall(r"^```python\n(.*?)^```$", path.read_text(), re.M | re.S)
    cells = json.loads(path.read_text())["cells"]
    return ["".join(cell["source"]) for cell in cells if cell["cell_type"] == "code"]


class Documents(unittest.TestCase):
    def play(self, name):
        """Runs a page's examples in an empty folder; returns their names and what they printed."""
        need_device(self)
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(holder.name)
        names, printed = {"__name__": "__main__"}, io.StringIO()
        pieces = examples(name)
        self.assertTrue(pieces)
        with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(sys.stdout):
            for number, piece in enumerate(pieces):
                exec(compile(piece, f"{name}[{number}]", "exec"), names)
        return names, printed.getvalue()

    def test_the_page_on_python(self):
        names, printed = self.play("results.md")
        self.assertEqual(names["result"].status, 0)
        self.assertEqual(len(names["times"]), 2)
        self.assertTrue((names["times"]["median"] > 0).all())
        self.assertIn("12 mismatch False", printed)
        self.assertTrue(os.path.getsize("longer.ply") > len(names["groom"].points) * 12)

    def test_notebooks_have_no_outputs(self):
        # They would depend on the machine.
        for path in (REPOSITORY / "docs").glob("*.ipynb"):
            cells = json.loads(path.read_text())["cells"]
            self.assertFalse(any(cell.get("outputs") for cell in cells), path)

    def test_the_notebook(self):
        names, _ = self.play("notebook.ipynb")
        triangles = names["frame"]["counts.root_triangles"].iloc[0]
        strands = [triangles * density for density in names["DENSITIES"]]
        lines = names["axes"].get_lines()
        self.assertEqual([line.get_label() for line in lines], sorted(names["BACKENDS"]))
        for line in lines:
            self.assertEqual(list(line.get_xdata()), strands)
            self.assertTrue(all(time > 0 for time in line.get_ydata()))
        # More strands hide more of the head, so the pictures differ. None is of one colour.
        pictures = [panel.get_images()[0].get_array() for panel in names["panels"]]
        self.assertEqual(len(pictures), len(names["DENSITIES"]))
        for i, picture in enumerate(pictures):
            self.assertGreater(picture.std(), 0.01)
            self.assertFalse(any((picture == other).all() for other in pictures[:i]))

    def test_the_notebook_of_deflection(self):
        lines = [line for cell in examples("deflection.ipynb") for line in cell.splitlines()]
        self.assertLessEqual(sum(bool(line.strip()) for line in lines), 40)  # as its title says
        names, _ = self.play("deflection.ipynb")
        mean = names["spread"]["mean"].unstack(names["WIND"])
        self.assertEqual(mean.shape, (3, 4))
        # Wind bends hair, and stiff hair less.
        self.assertTrue((mean.diff(axis="columns").iloc[:, 1:] > 0).all().all(), mean)
        self.assertTrue((mean.diff().iloc[1:] < 0).all().all(), mean)
        # Hair that grows anew is other hair; no tip moves farther than twice its length, 15 cm.
        self.assertTrue((names["spread"]["sem"] > 0).all())
        self.assertTrue(((mean > 0) & (mean < 30)).all().all(), mean)
        drawn = [list(container[0].get_ydata()) for container in names["axes"].containers]
        self.assertEqual(drawn, mean.to_numpy().tolist())
        self.assertTrue(os.path.getsize("deflection.pdf") > 0 and os.path.getsize("strip.png") > 0)
        pictures = list(names["pictures"].values())
        self.assertEqual(len(pictures), 4)
        for i, picture in enumerate(pictures):
            self.assertGreater(picture.std(), 1.0)
            self.assertFalse(any((picture == other).all() for other in pictures[:i]))


if __name__ == "__main__":
    unittest.main()

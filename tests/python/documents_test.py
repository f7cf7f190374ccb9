"""Runs what docs/python.md and docs/notebook.ipynb show, in their order."""

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
    """The Python of a page of docs/, a piece for each block or cell."""
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
        names, printed = self.play("python.md")
        self.assertEqual(names["result"].status, 0)
        self.assertEqual(len(names["times"]), 2)
        self.assertTrue((names["times"]["median"] > 0).all())
        self.assertIn("12 mismatch False", printed)
        self.assertTrue(os.path.getsize("longer.ply") > len(names["groom"].points) * 12)


if __name__ == "__main__":
    unittest.main()

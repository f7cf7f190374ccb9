"""Compares read_report() with a report made by hand, a measured one's JSON and docs' tables."""

import json
import math
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from support import REPOSITORY, hairbench

# The reports that the README links.
MEASURED_ON_A_GPU, MEASURED = (
    REPOSITORY / name for name in
    re.findall(r"\((results/thesis-(?:h200|llvmpipe)-\w+\.json)\)",
               (REPOSITORY / "README.md").read_text()))


def table(page, beginning):
    """Returns the rows, by headings, of the page's table that has a line with this beginning."""
    lines = (REPOSITORY / page).read_text().splitlines()
    start = next(i for i, line in enumerate(lines) if line.startswith(beginning))
    heads = [each.strip() for each in lines[start].strip("|").split("|")]
    rows = []
    for line in lines[start + 2:]:
        if not line.startswith("|"):
            break
        cells = [each.strip() for each in line.strip("|").split("|")]
        rows.append(dict(zip(heads, cells, strict=True)))
    return rows


def made_report():
    metric = {
        "unit": "ms", "hint": "lower", "mode": "isolated", "median": 3.0, "mad": 0.5,
        "samples": [2.5, 3.0, 3.5], "interval": {"lower": 2.5, "upper": 3.5, "confidence": 0.75}}
    return {
        "schema": "hairbench-report/1.4.0",
        "environment": {"device": {"name": "Made up"}, "seed": 1},
        "scene": {"path": "scenes/made.json", "hash": "0123456789abcdef", "document": {}},
        "cases": [
            {"name": "made/msaa:1", "axes": {"/render/msaa": 1, "/lights/0/color": [1, 0.5, 0]},
             "status": "ok", "counts": {"strands": 40}, "statistics": {},
             "backend": {"name": "lines", "reason": "the scene names it"},
             "trust": {"warnings": ["one", "two"], "verdict": "untrusted",
                       "reasons": ["other load: 73.0 %", "drift: isolated"]},
             "metrics": {
                 "pass.strands.time": metric,
                 "memory.device": {
                     "unit": "B", "hint": "lower", "median": 4096, "sample_count": 3000,
                     "samples_file": "x.samples.jsonl"}}},
            {"name": "made/msaa:8", "axes": {"/render/msaa": 8, "/lights/0/color": [1, 1, 1]},
             "status": "skipped", "reason": "8 samples"}]}


class MadeReport(unittest.TestCase):
    def read(self, document):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "made.json"
            path.write_text(document if isinstance(document, str) else json.dumps(document))
            return hairbench.read_report(path)

    def test_has_a_row_for_each_metric_of_each_case(self):
        frame = self.read(made_report())
        self.assertEqual(len(frame), 3)
        self.assertEqual(list(frame.columns[:3]), ["case", "/render/msaa", "/lights/0/color"])
        strands = frame[frame["metric"] == "pass.strands.time"].iloc[0]
        expected = {
            "case": "made/msaa:1", "/render/msaa": 1, "/lights/0/color": (1, 0.5, 0),
            "status": "ok", "backend": "lines", "warnings": 2, "verdict": "untrusted",
            "reasons": "other load: 73.0 %; drift: isolated", "counts.strands": 40, "unit": "ms",
            "hint": "lower", "mode": "isolated", "median": 3.0, "lower": 2.5, "upper": 3.5,
            "confidence": 0.75, "samples": 3, "mad": 0.5}
        self.assertEqual({name: strands[name] for name in expected}, expected)

    def test_what_is_not_known_is_missing(self):
        frame = self.read(made_report())
        memory = frame[frame["metric"] == "memory.device"].iloc[0]
        self.assertEqual(memory["median"], 4096)
        self.assertEqual(memory["samples"], 3000)
        for name in ("lower", "upper", "confidence", "mad", "mode"):
            self.assertTrue(frame.isna()[name][memory.name], name)

    def test_keeps_cases_that_did_not_run(self):
        skipped = self.read(made_report()).iloc[2]
        self.assertEqual(skipped["status"], "skipped")
        self.assertEqual(skipped["reason"], "8 samples")
        self.assertEqual(skipped["/render/msaa"], 8)
        self.assertTrue(math.isnan(skipped["median"]))

    def test_says_what_it_is_of(self):
        attrs = self.read(made_report()).attrs
        self.assertEqual(attrs["environment"]["device"]["name"], "Made up")
        self.assertEqual(attrs["scene"], "scenes/made.json")
        self.assertFalse(attrs["interrupted"])

    def test_refuses_what_is_no_report(self):
        for document, reason in (
                ("{", "made.json: is not JSON: "),
                ({"schema": "hairbench-gate/1.1.0"}, "/schema: 'hairbench-gate/1.1.0' is not "),
                ({"schema": "hairbench-report/2.0.0"}, "/schema: 'hairbench-report/2.0.0' is not "),
                ([], "/schema: '' is not ")):
            with self.assertRaises(ValueError) as raised:
                self.read(document)
            self.assertIn(reason, str(raised.exception))


class MeasuredReport(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.document = json.loads(MEASURED.read_text())
        cls.frame = hairbench.read_report(MEASURED)

    def test_has_all_that_its_json_has(self):
        rows = self.frame.set_index(["case", "metric"])
        self.assertTrue(rows.index.is_unique)
        count = 0
        for case in self.document["cases"]:
            for name, metric in case["metrics"].items():
                row = rows.loc[(case["name"], name)]
                count += 1
                self.assertEqual(row["median"], metric["median"])
                self.assertEqual(row["unit"], metric["unit"])
                self.assertEqual(row["samples"], len(metric["samples"]))
                if "interval" in metric:
                    self.assertEqual(row["upper"], metric["interval"]["upper"])
                for pointer, value in case["axes"].items():
                    self.assertEqual(row[pointer], value)
        self.assertEqual(count, len(self.frame))
        self.assertGreater(count, 16 * 10)

    # The program printed the tables to three digits.
    def assert_printed(self, printed, value, row):
        self.assertAlmostEqual(value / float(printed), 1, delta=0.0051, msg=str(row))

    def test_agrees_with_the_table_of_a_software_device(self):
        metrics = {"frame ms": "frame.time", "wind ms": "pass.wind.time",
                   "simulate ms": "pass.simulate.time", "scene ms": "pass.scene.time",
                   "strands ms": "pass.strands.time", "points ms": "pass.points.time",
                   "resolve ms": "pass.resolve.time", "fps": "fps"}
        compared = 0
        for row in table("docs/performance.md", "| density | msaa |"):
            case = self.frame[
                (self.frame["/strands/density"] == int(row["density"]))
                & (self.frame["/render/msaa"] == int(row["msaa"]))
                & (self.frame["/lod/level"] == int(row["level"]))
                & (self.frame["backend"] == row["back end"])].set_index("metric")
            self.assertEqual(case["case"].nunique(), 1, row)
            self.assertTrue((case["counts.strands"] == int(row["strands"])).all(), row)
            for head, metric in metrics.items():
                if row[head]:
                    self.assert_printed(row[head], case.loc[metric, "median"], row)
                    compared += 1
                else:
                    self.assertNotIn(metric, case.index)
        self.assertEqual(compared, 16 * 6 + 8 + 8)

    def test_agrees_with_the_line_in_the_readme(self):
        (line,) = [line for line in (REPOSITORY / "README.md").read_text().splitlines()
                   if line.startswith("On lavapipe with two cores ")]
        cases = self.frame[
            (self.frame["/strands/density"] == 64) & (self.frame["/render/msaa"] == 1)
            & (self.frame["/lod/level"] == 0) & (self.frame["metric"] == "frame.time")]
        printed = re.findall(r"([0-9.]+) ms (?:per frame )?with `(\w+)`", line)
        self.assertEqual([backend for _, backend in printed], ["tessellation", "software"])
        for milliseconds, backend in printed:
            (median,) = cases[cases["backend"] == backend]["median"]
            self.assert_printed(milliseconds, median, line)

    def test_agrees_with_the_table_in_the_readme(self):
        frame = hairbench.read_report(MEASURED_ON_A_GPU)
        rows = table("README.md", "| back end |")
        self.assertEqual({row["back end"] for row in rows}, set(frame["backend"]))
        for row in rows:
            for samples, words in ((1, "1 sample"), (4, "4 samples")):
                case = frame[(frame["backend"] == row["back end"])
                             & (frame["/render/msaa"] == samples)].set_index("metric")["median"]
                strands = case["pass.strands.time"] + case.get("pass.points.time", 0)
                self.assert_printed(row[f"fps, {words}"], case["fps"], row)
                self.assert_printed(row[f"frame ms, {words}"], case["frame.time"], row)
                self.assert_printed(row[f"strands ms, {words}"], strands, row)


class Figures(unittest.TestCase):
    PAGES = ("README.md", "docs/performance.md", "docs/paper.md", "docs/work_precision.svg")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = Path(folder.name)
        (work,) = (REPOSITORY / "results").glob("physics-work-llvmpipe-*.json")
        for name in (*self.PAGES, "scripts/figures", "results/shaders-ga102.txt",
                     *(f"results/{each.name}" for each in (MEASURED, MEASURED_ON_A_GPU, work))):
            (self.root / name).parent.mkdir(exist_ok=True)
            shutil.copy(REPOSITORY / name, self.root / name)

    def figures(self, *options):
        return subprocess.run(
            [self.root / "scripts" / "figures", *options], capture_output=True, text=True,
            check=False)

    def test_of_the_pages_are_those_of_the_reports(self):
        done = self.figures("--check")
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_are_found_if_they_differ_and_written(self):
        readme = self.root / "README.md"
        before = readme.read_text()
        row = next(each for each in before.splitlines() if each.startswith("| software |"))
        number = row.split(" | ")[2]
        readme.write_text(before.replace(row, row.replace(number, "0.123")))
        done = self.figures("--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("README.md", done.stdout)
        self.assertEqual(self.figures().returncode, 0)
        self.assertEqual(readme.read_text(), before)


if __name__ == "__main__":
    unittest.main()

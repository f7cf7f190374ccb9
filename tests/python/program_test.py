"""Tests run() and gate() with the program, and with stand-ins that print and do what a test needs."""

import json
import os
import sys
import tempfile
import types
import unittest
import zipfile
from pathlib import Path
from unittest import mock

import numpy

from report_test import made_report
from support import REPOSITORY, hairbench, need_device
from hairbench.program import call, option_arguments, scene_arguments

SMOKE = REPOSITORY / "scenes" / "smoke.json"


class Arguments(unittest.TestCase):
    def test_are_the_options_of_the_command_line(self):
        self.assertEqual(
            option_arguments({
                "max_time": 0.5, "no_pictures": True, "resume": False, "filter": None,
                "set_a": ["/x=1", "/y=2"], "shard": "1/2", "baseline": Path("main")}),
            ["--max-time", "0.5", "--no-pictures", "--set-a", "/x=1", "--set-a", "/y=2",
             "--shard", "1/2", "--baseline", "main"])

    def test_are_the_values_of_a_scene(self):
        self.assertEqual(
            scene_arguments(
                {"/strands/density": [16, 32], "/groom/guides": "pow2:6:12",
                 "/strands/backend": ["lines", "mesh"]},
                {"/simulation/wind/enabled": False, "/simulation/solver": "rod"}),
            ["--axis", "/strands/density=16,32", "--axis", "/groom/guides=pow2:6:12",
             "--axis", "/strands/backend=lines,mesh",
             "--set", "/simulation/wind/enabled=false", "--set", "/simulation/solver=rod"])
        with self.assertRaisesRegex(TypeError, "axes: /strands/density: 16 is not a list"):
            scene_arguments({"/strands/density": 16}, {})


class InFolder(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def stand_in(self, script):
        """Replaces the program by this shell script until the test ends."""
        path = self.folder / "stand_in"
        path.write_text("#!/bin/sh\n" + script)
        path.chmod(0o700)
        changed = mock.patch.dict(os.environ, {"HAIRBENCH_PROGRAM": str(path)})
        changed.start()
        self.addCleanup(changed.stop)


class Program(InFolder):
    def test_is_what_the_variable_names(self):
        self.stand_in("exit 0\n")
        self.assertEqual(hairbench.program(), (self.folder / "stand_in").resolve())
        with mock.patch.dict(os.environ, {"HAIRBENCH_PROGRAM": str(self.folder / "absent")}):
            with self.assertRaisesRegex(FileNotFoundError, "absent is not a program"):
                hairbench.program()

    def test_is_sought_on_the_path(self):
        self.stand_in("exit 0\n")
        (self.folder / "hairbench").symlink_to("stand_in")
        del os.environ["HAIRBENCH_PROGRAM"]
        with mock.patch.dict(os.environ, {"PATH": str(self.folder)}):
            self.assertEqual(hairbench.program(), (self.folder / "stand_in").resolve())
        with mock.patch.dict(os.environ, {"PATH": "/nowhere"}):
            with self.assertRaisesRegex(FileNotFoundError, "no hairbench on the PATH"):
                hairbench.program()

    def test_has_scenes_beside_it(self):
        self.assertTrue((hairbench.scenes() / "smoke.json").is_file())
        self.stand_in("exit 0\n")
        with self.assertRaisesRegex(FileNotFoundError, "no scenes beside it"):
            hairbench.scenes()
        installed = self.folder / "share" / "hairbench" / "scenes"
        installed.mkdir(parents=True)
        (installed / "scene.schema.json").touch()
        self.assertEqual(hairbench.scenes(), installed.resolve())


class Run(InFolder):
    def test_passes_progress_through(self):
        self.stand_in('echo "[1/2] one" >&2; echo "[2/2] two" >&2; echo table; exit 0\n')
        lines = []
        result = hairbench.run("made.json", out=self.folder / "r.json", progress=lines.append)
        self.assertEqual(lines, ["[1/2] one", "[2/2] two"])
        self.assertEqual(result.text, "table\n")
        self.assertEqual((result.status, result.verdict), (0, "ok"))

    def test_shows_a_bar_in_a_notebook(self):
        shown = []  # by the notebook: what each display had at last
        display = types.SimpleNamespace(update=lambda content: shown.append(content))
        ipython = types.SimpleNamespace(
            get_ipython=lambda: types.SimpleNamespace(kernel=True),
            display=types.SimpleNamespace(
                HTML=str, display=lambda content, display_id: shown.append(content) or display))
        self.stand_in('echo "[1/2] one <b>" >&2; echo "[2/2] two" >&2; exit 2\n')
        modules = {"IPython": ipython, "IPython.display": ipython.display}
        with mock.patch.dict(sys.modules, modules), self.assertRaises(hairbench.ProgramError):
            hairbench.run("made.json")
        self.assertEqual(shown, [
            '<progress value="0" max="2"></progress> [1/2] one &lt;b&gt;',
            '<progress value="1" max="2"></progress> [2/2] two', ""])
        self.stand_in("echo $HAIRBENCH_PROGRESS_SECONDS\n")
        with mock.patch.dict(sys.modules, modules):
            self.assertEqual(hairbench.run("made.json").text, "1\n")

    def test_survives_a_program_that_says_a_lot(self):
        # Both outputs are longer than a pipe's buffer.
        self.stand_in("seq 100000; seq 100000 >&2\n")
        result = hairbench.run("made.json", out=self.folder / "r.json", progress=None)
        self.assertTrue(result.text.endswith("100000\n"))

    def test_raises_what_the_program_says(self):
        self.stand_in('echo "hairbench: made.json: /x: no such field" >&2; exit 2\n')
        with self.assertRaises(hairbench.ProgramError) as raised:
            hairbench.run("made.json", progress=None)
        self.assertEqual(raised.exception.status, 2)
        self.assertEqual(str(raised.exception), "made.json: /x: no such field")

    def test_returns_what_a_comparison_finds(self):
        for status, verdict in ((10, "slower"), (11, "inconclusive"), (12, "differs")):
            self.stand_in(f"exit {status}\n")
            result = hairbench.run("made.json", baseline="main", progress=None)
            self.assertEqual((result.status, result.verdict), (status, verdict))
        for status in (1, 13, 14, 77, 130):
            self.stand_in(f"exit {status}\n")
            with self.assertRaises(hairbench.ProgramError) as raised:
                hairbench.run("made.json", progress=None)
            self.assertEqual(raised.exception.status, status)

    def test_an_interrupt_lets_the_program_save_what_is_done(self):
        saved = self.folder / "saved"
        self.stand_in(
            f'trap \'echo done > "{saved}"; exit 130\' INT\necho begun >&2\n'
            'for i in $(seq 600); do sleep 0.1; done\n')

        def interrupt(_):
            raise KeyboardInterrupt

        with self.assertRaises(KeyboardInterrupt):
            hairbench.run("made.json", progress=interrupt)
        self.assertEqual(saved.read_text(), "done\n")

    def test_measures_a_scene(self):
        need_device(self)
        out = self.folder / "smoke.json"
        result = hairbench.run(
            SMOKE, out=out, axes={"/render/msaa": [1], "/strands/density": [2, 4]},
            sets={"/render/width": 64, "/render/height": 36}, max_time=0, frames=2, warmup=2,
            no_pictures=True, progress=None)
        self.assertIn(f"report: {out}", result.text)
        frame = result.frame()
        self.assertEqual(sorted(frame["/strands/density"].unique()), [2, 4])
        triangles = frame["counts.root_triangles"].iloc[0]
        self.assertTrue((frame["counts.strands"] == triangles * frame["/strands/density"]).all())
        times = frame[frame["metric"] == "frame.time"]
        self.assertEqual(set(times["unit"]), {"ms"})
        self.assertTrue((times["median"] > 0).all())
        self.assertEqual(set(times["samples"]), {2})
        self.assertEqual(frame.attrs["scene"], str(SMOKE))

    def test_says_what_is_wrong_with_an_argument(self):
        for arguments, reason in (
                ({"sets": {"/strands/density": 0}}, "/strands/density: 0 is outside"),
                ({"no_such_option": 1}, "no-such-option")):
            with self.assertRaises(hairbench.ProgramError) as raised:
                hairbench.run(SMOKE, out=self.folder / "r.json", progress=None, **arguments)
            self.assertEqual(raised.exception.status, 2)
            self.assertIn(reason, str(raised.exception))


class Simulate(InFolder):
    def test_maps_the_guides_of_each_case(self):
        need_device(self)
        axes = {"/render/msaa": [1], "/simulation/wind/strength": numpy.array([0, 20])}
        played = hairbench.simulate(
            SMOKE, out=self.folder / "played", axes=axes, frames=6, progress=None,
            sets={"/run/probes/speed": True})
        self.assertEqual(
            list(played.positions), ["smoke/msaa:1/strength:0", "smoke/msaa:1/strength:20"])
        still, blown = played.positions.values()
        self.assertEqual(blown.shape, (6, 86, 8, 3))
        self.assertIsInstance(blown, numpy.memmap)
        self.assertTrue((still[:, :, 0] == blown[:, :, 0]).all())  # roots
        self.assertFalse((still[-1] == blown[-1]).all())
        # A probe of the same frames, of which the first follows the start of the hair. The greatest
        # speed of a vertex over a step of 1/60 s, in positions of 32 bits up to 0.3 m.
        run = hairbench.run(
            SMOKE, out=self.folder / "probed.json", axes=axes, no_pictures=True, progress=None,
            sets={"/run/frames": 3, "/run/warmup": 2, "/run/probes/speed": True})
        probes = run.probes()
        self.assertEqual(
            list(probes.columns),
            ["case", "/render/msaa", "/simulation/wind/strength", "frame", "time", "probe", "unit",
             "value"])
        self.assertEqual(len(probes), 2 * 7)
        same = played.probes()  # of the same frames, in nine digits
        known = ["case", "/render/msaa", "/simulation/wind/strength", "frame", "probe", "unit"]
        self.assertEqual(list(same.columns), list(probes.columns))
        self.assertTrue((same[known] == probes[known]).all().all())
        self.assertTrue(numpy.allclose(same["time"], probes["time"], rtol=1e-8, atol=0.0))
        self.assertTrue(numpy.allclose(same["value"], probes["value"], rtol=1e-8, atol=0.0))
        for case, positions in played.positions.items():
            speeds = numpy.linalg.norm(numpy.diff(positions.astype(float), axis=0), axis=-1) * 60
            probed = probes[(probes["case"] == case) & (probes["frame"] > 1)]
            self.assertTrue(numpy.allclose(probed["value"], speeds.max(axis=(1, 2)), atol=5e-6))
            self.assertTrue(numpy.allclose(probed["time"], numpy.arange(2, 7) / 60, atol=1e-6))

    def test_lists_the_probes_that_a_case_has(self):
        need_device(self)
        played = hairbench.simulate(
            SMOKE, out=self.folder / "played", frames=1, progress=None,
            axes={"/render/msaa": [1], "/simulation/solver": ["shape", "rod"]},
            sets={"/run/probes/energy": True})
        found = {solver: set(rows["probe"])
                 for solver, rows in played.probes().groupby("/simulation/solver")}
        self.assertEqual(found["shape"], {"kinetic_energy", "gravitational_energy"})
        self.assertEqual(found["rod"], found["shape"] | {"elastic_energy"})

    def test_says_what_is_wrong(self):
        with self.assertRaises(hairbench.ProgramError) as raised:
            hairbench.simulate(
                SMOKE, out=self.folder, sets={"/simulation/solvers": 1}, progress=None)
        self.assertIn("/simulation/solvers", str(raised.exception))


class Archive(InFolder):
    def test_has_positions_times_and_settings(self):
        need_device(self)
        options = ["--guides", "--frames", "5", "--json", "--axis", "/render/msaa=1",
                   "--axis", "/simulation/wind/strength=20"]
        for kind in ("npy", "npz"):
            pattern = self.folder / f"{{case}}.{kind}"
            finished = call(["simulate", str(SMOKE), "--export", str(pattern), *options], None)
            self.assertEqual(finished.status, 0, finished.errors)
        (case,) = json.loads(finished.text)["cases"]
        self.assertEqual(case["axes"], {"/render/msaa": 1, "/simulation/wind/strength": 20})
        self.assertEqual((case["strands"], case["first_frame"], case["last_frame"]), (86, 0, 4))
        with zipfile.ZipFile(case["file"]) as archive:
            self.assertIsNone(archive.testzip())  # checksums
        with numpy.load(case["file"]) as archive:
            self.assertEqual(list(archive), ["positions", "times", "metadata"])
            alone = numpy.load(self.folder / "msaa-1_strength-20.npy")
            self.assertTrue((archive["positions"] == alone).all())
            self.assertTrue(numpy.allclose(
                archive["times"], numpy.arange(1, 6) / 60, rtol=0, atol=1e-6))  # 32 bits
            metadata = json.loads(bytes(archive["metadata"]))
        self.assertEqual(metadata["name"], "smoke/msaa:1/strength:20")
        self.assertEqual(metadata["settings"]["simulation"]["wind"]["strength"], 20)
        self.assertIn(hairbench.__version__, metadata["version"])


class Render(InFolder):
    SETS = {"/render/width": 64, "/render/height": 36}

    def test_gives_the_picture_that_a_file_holds(self):
        need_device(self)
        picture = hairbench.render(SMOKE, frame=3, sets=self.SETS, progress=None)
        self.assertEqual((picture.shape, picture.dtype), ((36, 64, 4), numpy.uint8))
        self.assertGreater(picture[..., :3].std(), 1.0)  # it is not of one colour
        matplotlib_reads = self.folder / "same.png"
        call(["render", str(SMOKE), "-o", str(matplotlib_reads), "--frame", "3",
              *scene_arguments({}, self.SETS)], None)
        from matplotlib import pyplot
        written = pyplot.imread(matplotlib_reads)  # shares of 255
        self.assertTrue((numpy.rint(written * 255)[..., :3] == picture[..., :3]).all())

    def test_gives_linear_light(self):
        need_device(self)
        sets = {**self.SETS, "/render/tone_map": "srgb"}
        shown = hairbench.render(SMOKE, sets=sets, progress=None)
        linear = hairbench.render(SMOKE, sets=sets, linear=True, progress=None)
        self.assertEqual((linear.shape, linear.dtype), ((36, 64, 3), numpy.float32))
        # IEC 61966-2-1, from radiance to display values.
        light = numpy.clip(linear.astype(float), 0, 1)
        encoded = numpy.where(
            light <= 0.0031308, 12.92 * light, 1.055 * light ** (1 / 2.4) - 0.055)
        # A value is rounded once on the device, and radiance once to 16 bits: 11 of them count.
        self.assertLessEqual(abs(encoded * 255 - shown[..., :3]).max(), 1.0)

    def test_gives_a_picture_of_each_case(self):
        need_device(self)
        axes = {"/render/msaa": [1], "/simulation/wind/strength": [0, 20]}
        pictures = hairbench.render(SMOKE, frame=20, axes=axes, sets=self.SETS, progress=None)
        self.assertEqual(
            list(pictures), ["smoke/msaa:1/strength:0", "smoke/msaa:1/strength:20"])
        still, blown = pictures.values()
        self.assertTrue((still != blown).any())
        alone = hairbench.render(
            SMOKE, frame=20, progress=None,
            sets={**self.SETS, "/render/msaa": 1, "/simulation/wind/strength": 20})
        self.assertTrue((alone == blown).all())
        one = hairbench.render(
            SMOKE, frame=20, axes=axes, sets=self.SETS, progress=None, filter="strength:20")
        self.assertEqual(list(one), ["smoke/msaa:1/strength:20"])

    def test_says_what_is_wrong(self):
        with self.assertRaises(hairbench.ProgramError) as raised:
            hairbench.render(SMOKE, sets={"/render/msaa": 3}, progress=None)
        self.assertEqual(raised.exception.pointer, "/render/msaa")


class Pictures(InFolder):
    SETS = {"/render/width": 64, "/render/height": 36}
    AXES = {"/render/msaa": [1, 4], "/simulation/wind/strength": [0, 20]}

    @staticmethod
    def mean_difference(picture, reference):
        """Returns the mean difference of display values, from 0 to 1."""
        return numpy.abs(picture.astype(float) - reference.astype(float)).mean() / 255

    def test_are_measured_against_the_same_case_with_other_values(self):
        need_device(self)
        result = hairbench.measure_pictures(
            SMOKE, self.mean_difference, reference_sets={"/render/msaa": 4}, axes=self.AXES, frame=20,
            sets=self.SETS, at_most=0.0, progress=None)
        pictures = hairbench.render(
            SMOKE, axes=self.AXES, frame=20, sets=self.SETS, progress=None)
        frame = result.frame()
        self.assertEqual(
            list(frame.columns),
            ["case", "/render/msaa", "/simulation/wind/strength", "metric", "value", "limit",
             "passed"])
        self.assertEqual(list(frame["case"]), list(pictures))
        self.assertEqual(set(frame["metric"]), {"mean_difference"})
        for row in result.rows:
            strength = row["/simulation/wind/strength"]
            expected = self.mean_difference(
                pictures[row["case"]], pictures[f"smoke/msaa:4/strength:{strength}"])
            self.assertEqual(row["value"], expected)
            self.assertEqual(row["passed"], row["/render/msaa"] == 4)
            self.assertEqual(row["value"] > 0, row["/render/msaa"] == 1)
            self.assertTrue((result.pictures[row["case"]] == pictures[row["case"]]).all())
        self.assertFalse(result.passed)

    def test_are_measured_against_a_picture_by_several_metrics(self):
        need_device(self)
        still = hairbench.render(
            SMOKE, linear=True, progress=None, sets={**self.SETS, "/render/msaa": 1})
        metrics = {"largest": lambda picture, reference: abs(picture - reference).max(),
                   "unknown": lambda picture, reference: float("nan")}
        made = {"reference": still, "linear": True, "axes": {"/render/msaa": [1]},
                "sets": self.SETS, "progress": None}
        result = hairbench.measure_pictures(SMOKE, metrics, at_most={"largest": 0.0}, **made)
        self.assertEqual([row["value"] == 0.0 for row in result.rows], [True, False])
        self.assertEqual([row["passed"] for row in result.rows], [True, None])
        self.assertTrue(result.passed)
        self.assertFalse(hairbench.measure_pictures(SMOKE, metrics, at_most=1.0, **made).passed)
        with self.assertRaisesRegex(ValueError, "either reference or reference_sets"):
            hairbench.measure_pictures(SMOKE, metrics, **{**made, "reference": None})
        with self.assertRaisesRegex(ValueError, "smoke/msaa:1: the reference has the shape"):
            hairbench.measure_pictures(SMOKE, metrics, **{**made, "reference": still[1:]})


class Physics(InFolder):
    def test_gives_the_outcomes(self):
        need_device(self)
        result = hairbench.physics(
            solver="shape", check="projectile", out=self.folder / "p.json", progress=None)
        self.assertTrue(result.passed)
        frame = result.frame()
        self.assertEqual(set(frame["check"]), {"projectile"})
        self.assertEqual(set(frame["solver"]), {"shape"})
        self.assertTrue((frame["error"] <= frame["tolerance"]).all())
        self.assertTrue((frame["time_step"] > 0).all())

    def test_a_failed_check_is_a_result(self):
        report = self.folder / "p.json"
        report.write_text(json.dumps({"outcomes": [
            {"check": "pendulum", "solver": "rod", "verdict": "fail", "error": 0.5}]}))
        self.stand_in("exit 3\n")
        result = hairbench.physics(out=report, progress=None)
        self.assertFalse(result.passed)
        self.assertEqual(list(result.frame()["verdict"]), ["fail"])
        self.stand_in("exit 77\n")
        with self.assertRaises(hairbench.ProgramError):
            hairbench.physics(out=report, progress=None)


class Errors(unittest.TestCase):
    def test_have_the_pointer_of_the_field_at_fault(self):
        for message, pointer in (
                ("/strands/density: 0 is outside [1, 64]", "/strands/density"),
                ("scenes/curl.json: /simulation/length/iterations: 0 is outside",
                 "/simulation/length/iterations"),
                (f"{SMOKE}: /render/msaa: 3 is none of 1, 2, 4, 8", "/render/msaa"),
                (f"{SMOKE}: is not JSON: byte 3", None),
                ("no Vulkan device", None)):
            self.assertEqual(hairbench.ProgramError(2, message).pointer, pointer, message)


class Gate(InFolder):
    """Tests gate() on builds that take no measurements and only write a made-up report."""

    def side(self, name, factor):
        report = made_report()
        case = report["cases"][0]
        report["cases"] = [case]
        case["image_hash"] = case["state_hash"] = "00000000000000aa"
        metric = case["metrics"]["pass.strands.time"]
        for key in ("median", "mad"):
            metric[key] *= factor
        metric["samples"] = [sample * factor for sample in metric["samples"]]
        del metric["interval"], case["metrics"]["memory.device"]
        path = self.folder / f"{name}.json"
        path.write_text(json.dumps(report))
        return f"cp '{path}' {{out}}; : {{scene}}"

    def gate(self, factor, **options):
        return hairbench.gate(
            self.side("a", 1), self.side("b", factor), "made.json", out=self.folder / "gate.json",
            progress=None, **options)

    def test_finds_what_is_slower(self):
        result = self.gate(1.25)
        self.assertEqual((result.status, result.verdict, result.passed), (10, "regressed", False))
        row = result.frame().iloc[0]
        self.assertEqual((row["metric"], row["verdict"]), ("pass.strands.time", "regressed"))
        self.assertAlmostEqual(row["change"], 0.25)
        self.assertEqual((row["a"], row["b"]), (3.0, 3.75))

    def test_passes_what_is_equal(self):
        result = self.gate(1, threshold="5%")
        self.assertEqual((result.status, result.verdict, result.passed), (0, "same", True))
        self.assertEqual(result.report["decided_at"], 12)
        self.assertIn("verdict: same", result.text)

    def test_finds_hair_that_moves_otherwise(self):
        need_device(self)
        for stiffness, verdict, status in ((0.2, "mismatch", 12), (None, "same", 0)):
            result = hairbench.gate(
                hairbench.program(), hairbench.program(), SMOKE, out=self.folder / "gate.json",
                probes=True, axes={"/render/msaa": [1]}, threshold="1%", progress=None,
                sets={"/run/probes/tip_displacement": True, "/run/frames": 5},
                set_b=stiffness and f"/simulation/local/stiffness={stiffness}")
            self.assertEqual((result.verdict, result.status), (verdict, status))
            self.assertEqual(result.passed, status == 0)
            frame = result.frame()
            self.assertIn("probe.tip_displacement.mean", set(frame["metric"]))
            if status == 0:
                self.assertTrue((frame["change"] == 0).all())

    def test_raises_where_a_side_fails(self):
        with self.assertRaises(hairbench.ProgramError) as raised:
            hairbench.gate(
                "echo broken >&2; false {out} {scene}", self.side("b", 1), "made.json",
                out=self.folder / "gate.json", progress=None)
        self.assertEqual(raised.exception.status, 1)
        self.assertIn("broken", str(raised.exception))


if __name__ == "__main__":
    unittest.main()

#!/usr/bin/env python3
"""Runs the archive for Windows under Wine, beside the program for this system, on the same Vulkan
device. Both must say, write and draw the same. Then runs test programs for Windows under Wine.
scripts/test --windows calls this.

usage: windows_test.py ARCHIVE PROGRAM FOLDER        (of the test programs)
"""

import json
import os
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

REPOSITORY = Path(__file__).resolve().parents[2]
CORPUS = REPOSITORY / "tests/corpus"
WINE = "/usr/lib/wine/wine64"  # Debian's `wine` also wants the package for programs of 32 bits
MOST_BYTES = 60_000_000
INTERRUPTED = 130
# Wine's own line when its server has ended a thread, mostly while the process ends: server.c of Wine's
# ntdll prints it although all of Wine's messages are off.
WINE_SAYS = re.compile(r"^wine client error:[0-9a-f]+: .*\n?", re.MULTILINE)
# Tests that can't hold under Wine or on Windows, and why.
NOT_THERE = {
    "AlembicAnimation.IsReadByAlembicsLibrary": "it needs the library in a shell",
    "EmbreeXml.AsksBeforeItOpensTheFileBesideIt": "it needs symbolic links",
    "ImportGltfStrands.OpensOtherFilesOnlyBesideItsOwn": "the same",
    "EnergyCounters.AddPackagesUp": "it reads Linux's files",
    "EnvironmentTest.*": "they need the validation layer, and Wine has none",
    "MachineWatchTest.*": "the same",
    "MemoryOfCasesTest.*": "the same",
}
failures = []


def check(right, what):
    print("ok  " if right else "FAIL", what, flush=True)
    if not right:
        failures.append(what)


class Programs:
    """The program for this system and the one for Windows, each with a folder to work in."""

    def __init__(self, folder, archive, program, tests):
        self.program, self.tests = program, tests
        self.wine_failed = False  # in the last run of Windows' program
        # Spaces and letters of several scripts, as users' folders have them.
        self.here = folder / "größe 日本 b"
        self.linux, self.windows = folder / "linux", self.here / "out"
        self.linux.mkdir()
        self.windows.mkdir(parents=True)
        with zipfile.ZipFile(archive) as files:
            files.extractall(self.here)
        self.exe = next(self.here.glob("hairbench-*/hairbench.exe"))
        self.environment = os.environ | {
            "WINEPREFIX": str(folder / "wine"), "WINEDEBUG": "-all", "WINEDLLOVERRIDES": "mscoree,mshtml=",
            "LC_ALL": "C.UTF-8", "XDG_CACHE_HOME": str(folder / "cache")}
        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        subprocess.run([WINE, "wineboot", "--init"], env=self.environment, check=True, **quiet)
        # Wine starts its services with the first program and ends them with the last. One program stays,
        # so that they neither start with each run nor write to its output.
        self.session = subprocess.Popen([WINE, "cmd"], env=self.environment, stdin=subprocess.PIPE, **quiet)

    def command(self, system, *arguments):
        return [WINE, self.exe, *arguments] if system == "windows" else [self.program, *arguments]

    def start(self, system, *arguments):
        folder = self.windows if system == "windows" else self.linux
        environment = dict(self.environment)
        if system == "windows":
            del environment["XDG_CACHE_HOME"]
        return subprocess.Popen(
            list(map(str, self.command(system, *arguments))), cwd=folder, env=environment, text=True,
            errors="replace", stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def run(self, system, *arguments, seconds=300):
        process = self.start(system, *arguments)
        try:
            output, errors = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            process.kill()
            return None, f"no end after {seconds} s"
        if system == "windows":
            errors, lines = WINE_SAYS.subn("", errors)
            self.wine_failed = lines > 0
        return process.returncode, output + errors

    def both(self, *arguments):
        """Status and output of both; paths of Windows are written as this system's."""
        linux = self.run("linux", *arguments)
        status, said = self.run("windows", *arguments)
        return linux, (status, re.sub(r"Z:(?=[\\/])", "", said).replace("\\", "/"))

    def files(self, name):
        return self.linux / name, self.windows / name

    def same_files(self, name):
        a, b = self.files(name)
        return a.is_file() and b.is_file() and a.read_bytes() == b.read_bytes()


def check_icon(programs):
    drawn = programs.linux / "icon.ico"
    subprocess.run([REPOSITORY / "scripts/icon", drawn], check=True)
    icon = drawn.read_bytes()
    check((REPOSITORY / "engine/system/windows.ico").read_bytes() == icon, "the icon is what scripts/icon draws")
    # ICONDIR and its ICONDIRENTRYs: count, and of each picture its length and offset.
    entries = [struct.unpack_from("<II", icon, 6 + 16 * i + 8) for i in range(struct.unpack_from("<H", icon, 4)[0])]
    program = programs.exe.read_bytes()
    check(len(entries) == 5 and all(icon[begin:begin + size] in program for size, begin in entries),
          "the program has the icon")


def hashes(report):
    return [(case["name"], case["status"], case["image_hash"], case["state_hash"])
            for case in json.loads(report.read_text())["cases"]]


def check_runs(programs):
    statuses = [status for status, _ in programs.both("run", "smoke", "--max-time", "0.2", "--out", "run.json")]
    check(statuses == [0, 0], "both run the smoke scene")
    linux, windows = map(hashes, programs.files("run.json"))
    check(len(linux) == 2 and linux == windows, "pictures and states of its cases are equal")
    status, said = programs.run("windows", "report", "run.json", "--out", "page.html")
    check(status == 0 and "plotly" in (programs.windows / "page.html").read_text("utf-8"),
          f"the report becomes a page: {said.strip()}")


# Theory, and fits of what was measured, are computed with each system's own pow(), sin() and exp(), which
# round in other ways: 1.5e-12 was seen in growth rates.
MOST_ROUNDING = 1e-9


def same_number(a, b):
    if a is None or b is None:  # skipped
        return a is b
    return abs(a - b) <= MOST_ROUNDING * max(abs(a), abs(b))


def check_physics(programs):
    """Runs all of the physics suite on both, some minutes each."""
    statuses = [programs.run(system, "physics", "--out", "physics.json", seconds=1800)[0]
                for system in ("linux", "windows")]
    linux, windows = (json.loads(path.read_text())["outcomes"] for path in programs.files("physics.json"))
    names = [[(each["check"], each["solver"], each.get("quantity"), each["verdict"]) for each in outcomes]
             for outcomes in (linux, windows)]
    check(statuses == [0, 0] and len(linux) > 1000 and names[0] == names[1],
          f"{len(linux)} outcomes of the physics suite are the same")
    other = [f"{a['check']} of {a['solver']}: {a['measured']} {b['measured']}" for a, b in zip(linux, windows)
             if not same_number(a.get("measured"), b.get("measured"))]
    check(not other, f"they measure the same, within 1e-9: {other[:3]}")


def check_pictures(programs):
    # The second has functions of a scene, which a child compiles; the third a head that moves, of glTF.
    for scene in ("strong_wind", "extended/toon", "talk"):
        name = scene.replace("/", "_") + ".png"
        programs.both("render", scene, "--out", name, "--frame", "3", "--set", "/render/width=320", "--set",
                      "/render/height=180", "--set", "/strands/density=2")
        check(programs.same_files(name), f"{scene}: pictures are equal, byte by byte")


def check_grooms(programs):
    files = sorted(path for kind in ("abc", "bin", "data", "gltf", "hair", "hgl", "mitshair", "npy", "npz",
                                     "obj", "other_hair", "pbrt", "ply", "tfx", "xml", "findings")
                   for path in (CORPUS / kind).rglob("*")
                   if path.is_file() and path.suffix not in (".exr", ".hdr", ".png", ".jpg", ".json"))
    differ = []
    for path in files:
        linux, windows = programs.both("groom", "info", path)
        if linux != windows and programs.wine_failed:
            linux, windows = programs.both("groom", "info", path)
        if linux != windows:
            differ.append(f"{path.name}: {windows[1].strip()[-200:]}")
    check(len(files) > 40 and not differ, f"groom info says the same of {len(files)} files: {differ}")
    source = CORPUS / "hair/all_arrays.hair"
    for ending in ("hair", "hgl", "tfx", "obj", "ply", "gltf", "glb", "usda", "data", "npy", "npz", "abc",
                   "mitshair", "txt", "pbrt"):
        name = f"strands.{ending}"
        programs.both("groom", "convert", source, name)
        check(programs.same_files(name), f"both write the same {name}")


def check_meshes(programs):
    mesh = programs.linux / "head.obj"
    mesh.write_text("o scalp\n" + "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) +
                    "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n")
    shutil.copy(mesh, programs.windows)
    def scene(name):
        return json.dumps({"groom": {"grow": {"mesh": name}}, "render": {"width": 320, "height": 180}})

    hostile = {"a.stl": b"solid " + b"facet " * 10_000, "b.fbx": b"Kaydara FBX Binary  \0\x1a\0" + b"\xff" * 4096,
               "c.ply": b"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n",
               "d.dae": b"<COLLADA>" + b"<a>" * 20_000}
    for folder in (programs.linux, programs.windows):
        (folder / "mesh.json").write_text(scene("head.obj"))
        for name, data in hostile.items():
            (folder / name).write_bytes(data)
            (folder / f"{name}.json").write_text(scene(name))
    programs.both("render", "mesh.json", "--out", "mesh.png", "--frame", "1")
    check(programs.same_files("mesh.png"), "hair on a mesh that a child reads: pictures are equal")
    for name in hostile:
        linux, windows = programs.both("render", f"{name}.json", "--out", "hostile.png")
        check(linux[0] == windows[0] == 2, f"{name} is refused: {windows[1].strip()[-160:]}")


def check_viewer(programs):
    script = {"steps": [{"frames": 2}, {"set": {"/strands/density": 16}}, {"frames": 1}, {"picture": "seen.png"},
                        {"state": "seen.json"}]}
    for folder in (programs.linux, programs.windows):
        (folder / "script.json").write_text(json.dumps(script))
    linux, windows = programs.both("view", "smoke", "--script", "script.json")
    check(linux[0] == windows[0] == 0, f"the viewer's script ends: {windows[1].strip()[-200:]}")
    check(programs.same_files("seen.png"), "the viewer shows equal pictures")


def pids(programs):
    """Processes of Windows' hairbench under Wine."""
    found = []
    for entry in Path("/proc").iterdir():
        try:
            words = (entry / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if entry.name.isdigit() and words[0].endswith(b"hairbench.exe"):
            found.append(int(entry.name))
    return found


def wait_for(condition, seconds=60):
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if condition():
            return True
        time.sleep(0.05)
    return False


def check_interrupts(programs):
    journal = programs.windows / "long.json.journal"
    arguments = ("run", "smoke", "--set", "/run/precision=0", "--max-time", "4", "--out")

    def has_a_case():
        return journal.is_file() and journal.read_bytes().count(b"\n") >= 2

    process = programs.start("windows", *arguments, "long.json")
    check(wait_for(has_a_case), "a run keeps a journal")
    status, said = programs.run("windows", *arguments, "long.json")
    check(status == 2 and "another run is writing it" in said, "another run can't write the same journal")
    for pid in pids(programs):
        os.kill(pid, signal.SIGINT)  # Wine makes it an event of the console
    output, errors = process.communicate(timeout=60)
    check(process.returncode == INTERRUPTED and "interrupted after 1 of 2 cases" in output + errors,
          f"Ctrl-C ends it with what is done: {errors.strip()[-120:]}")
    first = hashes(programs.windows / "long.json")
    status, _ = programs.run("windows", *arguments, "long.json", "--resume")
    check(status == 0 and first[0] in hashes(programs.windows / "long.json") and not journal.exists(),
          "--resume ends the run")
    process = programs.start("windows", *arguments, "killed.json")
    journal = programs.windows / "killed.json.journal"
    wait_for(has_a_case)
    for pid in pids(programs):
        os.kill(pid, signal.SIGKILL)
    process.communicate(timeout=60)
    time.sleep(5)  # until Wine notices, and closes the journal
    status, said = programs.run("windows", *arguments, "killed.json", "--resume")
    check(status == 0 and len(hashes(programs.windows / "killed.json")) == 2,
          f"a killed run resumes: {said.strip()[-160:]}")


def check_gate(programs):
    exe = programs.exe
    status, said = programs.run("windows", "gate", "--a", exe, "--b", exe, "--scene", "smoke", "--max-time",
                                "0.2", "--pairs", "12", "--filter", "msaa:1", "--out", "gate.json",
                                seconds=500)
    check(status in (0, 11), f"a gate of a build against itself finds no change: {said.strip()[-300:]}")


def check_interrupted_gate(programs):
    """Ctrl-C reaches the gate alone. It ends the program that it measures."""
    exe = programs.exe
    gate = programs.start("windows", "gate", "--a", exe, "--b", exe, "--scene", "smoke", "--max-time", "60",
                          "--out", "interrupted.json")
    check(wait_for(lambda: len(pids(programs)) >= 2), "a gate starts another program")
    first = min(pids(programs), key=lambda pid: Path(f"/proc/{pid}/stat").read_text().rsplit(")")[1].split()[19])
    os.kill(first, signal.SIGINT)
    _, errors = gate.communicate(timeout=60)
    check(gate.returncode == INTERRUPTED, f"Ctrl-C ends a gate: {errors.strip()[-120:]}")
    check(wait_for(lambda: not pids(programs), 10), "nothing that it started is left")


def check_tests(programs):
    skipped = "-" + ":".join(NOT_THERE)
    for test in sorted(programs.tests.glob("test_*.exe")):
        said = subprocess.run([WINE, test, "--gtest_filter=" + skipped], env=programs.environment,
                              cwd=programs.windows, stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              errors="replace", timeout=900)
        text = said.stdout + WINE_SAYS.sub("", said.stderr)
        passed = re.search(r"^\[  PASSED  \] (\d+) tests?", text, re.MULTILINE)
        lacking = re.findall(r"^\[  SKIPPED \] (\S+) \(", text, re.MULTILINE)
        failed = "" if said.returncode == 0 else text[-3000:]
        check(said.returncode == 0 and passed and int(passed[1]) > 10,
              f"{test.stem}: {passed[1] if passed else 0} tests; skipped: {' '.join(lacking) or 'none'}{failed}")


def main():
    archive, program, tests = map(Path, sys.argv[1:])
    check(archive.stat().st_size < MOST_BYTES, f"the archive has {archive.stat().st_size / 1e6:.1f} MB")
    folder = Path(tempfile.mkdtemp(prefix="hairbench-windows-"))
    try:
        programs = Programs(folder, archive, program.resolve(), tests.resolve())
        for each in (check_icon, check_runs, check_physics, check_pictures, check_grooms, check_meshes, check_viewer,
                     check_interrupts, check_gate, check_interrupted_gate, check_tests):
            try:
                each(programs)
            except (OSError, KeyError, ValueError, subprocess.SubprocessError) as error:
                check(False, f"{each.__name__}: {error!r}")
    finally:
        subprocess.run(["wineserver", "-k"], env=programs.environment, check=False)
        programs.session.wait()
        shutil.rmtree(folder, ignore_errors=True)
    if failures:
        sys.exit(f"windows test: {len(failures)} failed")


if __name__ == "__main__":
    main()

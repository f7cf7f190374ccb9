#!/usr/bin/env python3
"""Builds the image of scripts/Containerfile and measures in it, with podman or buildah. Without
either, runs the image's steps in minimal roots of the same release. scripts/test --container calls
this as root."""

import fnmatch
import json
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import root
from root import run

REPOSITORY = Path(__file__).resolve().parents[2]
CONTAINERFILE = REPOSITORY / "scripts" / "Containerfile"
SUITES = {"docker.io/library/debian:12": "bookworm", "docker.io/library/debian:13": "trixie"}
IMAGE = "localhost/hairbench-test"
SMOKE = [
    "run", "smoke", "--out", "/results/smoke.json", "--max-time", "0", "--no-pictures"]


def instructions(text):
    """Returns [(name, rest)] of a Containerfile: joins continued lines, leaves out comments."""
    lines = [line for line in text.splitlines() if not line.lstrip().startswith("#")]
    joined = re.sub(r"\\\n\s*", " ", "\n".join(lines))
    return [tuple(line.split(None, 1)) for line in joined.splitlines() if line.strip()]


class Podman:
    def __init__(self, folder):
        run("podman", "build", "--tag", IMAGE, "--file", CONTAINERFILE, REPOSITORY)

    def start(self, arguments, results):
        return run("podman", "run", "--rm", "--volume", f"{results}:/results", IMAGE, *arguments,
                   stdout=subprocess.PIPE).stdout

    def command(self):
        said = run("podman", "image", "inspect", IMAGE, stdout=subprocess.PIPE).stdout
        return json.loads(said)[0]["Config"]["Cmd"]

    def give_back(self):
        run("podman", "image", "rm", IMAGE, stdout=subprocess.DEVNULL)


class Buildah:
    def __init__(self, folder):
        run("buildah", "bud", "--tag", IMAGE, "--file", CONTAINERFILE, REPOSITORY)
        self.container = run("buildah", "from", IMAGE, stdout=subprocess.PIPE).stdout.strip()

    def start(self, arguments, results):
        return run("buildah", "run", "--volume", f"{results}:/results", self.container, "--",
                   "hairbench", *arguments, stdout=subprocess.PIPE).stdout

    def command(self):
        said = run("buildah", "inspect", self.container, stdout=subprocess.PIPE).stdout
        return json.loads(said)["OCIv1"]["config"]["Cmd"]

    def give_back(self):
        run("buildah", "rm", self.container, stdout=subprocess.DEVNULL)


class Roots:
    """Makes a Debian root for each stage. Follows the instructions that our file uses; any other
    instruction is an error."""

    def __init__(self, folder):
        self.folder = folder
        self.stages = {}
        self.root = None
        for name, rest in instructions(CONTAINERFILE.read_text()):
            getattr(self, f"do_{name.lower()}", self.unknown(name))(rest)

    def unknown(self, name):
        def fail(rest):
            sys.exit(f"container test: {CONTAINERFILE}: {name} {rest}: not followed here")
        return fail

    def do_from(self, rest):
        image, _, stage = rest.partition(" AS ")
        self.workdir = "/"
        self.root = self.folder / f"root{len(self.stages)}"
        self.stages[stage or str(len(self.stages))] = self.root
        root.make(self.root, SUITES[image])

    def place(self, path):
        return self.root / os.path.join(self.workdir, path).lstrip("/")

    def do_workdir(self, rest):
        self.workdir = os.path.join(self.workdir, rest)
        self.place(".").mkdir(parents=True, exist_ok=True)

    def do_copy(self, rest):
        source, target = (word for word in rest.split() if not word.startswith("--from="))
        stage = re.match(r"--from=(\S+)", rest)
        origin = self.stages[stage[1]] / source.lstrip("/") if stage else REPOSITORY / source
        ignored = [] if stage else (REPOSITORY / ".containerignore").read_text().split()

        def leave_out(folder, names):
            inside = [os.path.relpath(Path(folder, name), REPOSITORY) for name in names]
            return [name for name, path in zip(names, inside, strict=True)
                    if any(fnmatch.fnmatch(path, pattern) for pattern in ignored)]

        shutil.copytree(
            origin, self.place(target), symlinks=True, dirs_exist_ok=True, ignore=leave_out)

    def do_run(self, rest):
        root.inside(self.root, ["/bin/sh", "-c", f"cd {shlex.quote(self.workdir)} && {rest}"])

    def do_entrypoint(self, rest):
        self.entrypoint = json.loads(rest)

    def do_cmd(self, rest):
        self.arguments = json.loads(rest)

    def start(self, arguments, results):
        command = shlex.join([*self.entrypoint, *arguments])
        said = root.inside(
            self.root, ["/bin/sh", "-c", f"cd {shlex.quote(self.workdir)} && {command}"],
            stdout=subprocess.PIPE).stdout
        shutil.copytree(self.root / "results", results, dirs_exist_ok=True)
        return said

    def command(self):
        return self.arguments

    def give_back(self):
        pass  # the folder is temporary


def main():
    engine = Podman if shutil.which("podman") else Buildah if shutil.which("buildah") else Roots
    folder = Path(tempfile.mkdtemp(prefix="hairbench-container-"))
    try:
        begun = time.monotonic()
        image = engine(folder)
        made = time.monotonic()
        results = folder / "results"
        results.mkdir()
        image.start(SMOKE, results)
        measured = time.monotonic()
        report = json.loads((results / "smoke.json").read_text())
        statuses = [case["status"] for case in report["cases"]]
        if statuses != ["ok", "ok"]:
            sys.exit(f"container test: the cases of smoke.json are {statuses}, not two that are ok")
        # Only lists the cases of the image's own command, which takes minutes.
        listed = image.start([*image.command(), "--list"], results)
        cases = [line for line in listed.splitlines() if line.startswith("thesis/")]
        if len(cases) != 16:
            sys.exit(f"container test: the image's own command has {len(cases)} cases, not 16")
        image.give_back()
        print(f"container test: made in {made - begun:.0f} s ({engine.__name__.lower()}), measured "
              f"two cases in {measured - made:.0f} s on {report['environment']['device']['name']}")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()

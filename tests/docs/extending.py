"""Applies the patches of docs/extending/ to a copy of the project, builds it and runs the page's
commands.

extending.py PROJECT FOLDER

FOLDER keeps the copy and its build for the next run. The script applies all patches one after
another and builds once. Then it runs the boxes of docs/extending.md that begin with ```sh patched,
one for each patch, in the copy and checks their results.
"""

import csv
import filecmp
import json
import math
import os
import pathlib
import re
import shutil
import statistics
import struct
import subprocess
import sys
import tempfile
import zlib

from run_commands import copy_project, run_box

BOX = re.compile(r"^```sh patched\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def expect(holds: bool, what: str) -> None:
    if not holds:
        raise AssertionError(what)


def median(result: dict, name: str) -> float:
    return result["metrics"][name]["median"]


def check_metric(folder: pathlib.Path) -> None:
    (case,) = json.loads((folder / "metric.json").read_text())["cases"]
    times = case["metrics"]["frame.time"]["samples"]
    jitter = case["metrics"]["frame.jitter"]
    wanted = [abs(b - a) for a, b in zip(times, times[1:])]
    expect(len(wanted) > 2, f"{len(times)} samples")
    expect(jitter["unit"] == "ms" and jitter["hint"] == "lower", f"{jitter}")
    # The report rounds samples to five digits after the point.
    expect(
        len(jitter["samples"]) == len(wanted)
        and all(abs(a - b) < 1e-5 for a, b in zip(jitter["samples"], wanted)),
        f"{jitter['samples']} is not {wanted}",
    )
    expect(abs(jitter["median"] - statistics.median(wanted)) < 1e-5, f"{jitter['median']}")
    expect("frame.jitter" in (folder / "metric.csv").read_text(), "metric.csv has no frame.jitter")


def obj_strands(path: pathlib.Path) -> list[list[tuple[float, ...]]]:
    points, strands = [], []
    for line in path.read_text().splitlines():
        keyword, *words = line.split()
        if keyword == "v":
            points.append(tuple(float(word) for word in words[:3]))
        elif keyword == "l":
            strands.append([points[int(word) - 1] for word in words])
    return strands


def check_format(folder: pathlib.Path) -> None:
    chain = obj_strands(folder / "chain.obj")
    expect(chain == obj_strands(folder / "straight.obj") and len(chain) > 0, "points differ")
    with open(folder / "guides.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    expect({row["strand"] for row in rows} == {str(i) for i in range(86)}, "not the 86 guides")
    expect(all(math.isfinite(float(row[axis])) for row in rows for axis in "xyz"), "not finite")
    said = (folder / "gap.txt").read_text()
    expect("gap.csv: line 3: strand '2', the next one is 1" in said, said)


def read_png(path: pathlib.Path) -> list[list[tuple[int, ...]]]:
    """Returns the rows of pixels of a picture with 8 bits a channel."""
    data = path.read_bytes()
    place, packed = 8, b""
    while place < len(data):
        (size,), kind = struct.unpack(">I", data[place : place + 4]), data[place + 4 : place + 8]
        body = data[place + 8 : place + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour = struct.unpack(">IIBB", body[:10])
        elif kind == b"IDAT":
            packed += body
        place += size + 12
    channels = {2: 3, 6: 4}[colour]
    expect(depth == 8, f"{path}: {depth} bits")
    raw, stride, rows = zlib.decompress(packed), width * channels, []
    above = bytes(stride)
    for y in range(height):
        kind, *line = raw[y * (stride + 1) : (y + 1) * (stride + 1)]
        for i in range(stride):  # filters of the PNG specification, section 9.2
            left = line[i - channels] if i >= channels else 0
            corner = above[i - channels] if i >= channels else 0
            guess = left + above[i] - corner
            nearest = min((left, above[i], corner), key=lambda each: abs(guess - each))
            line[i] = (line[i] + [0, left, above[i], (left + above[i]) // 2, nearest][kind]) % 256
        rows.append([tuple(line[i : i + channels]) for i in range(0, stride, channels)])
        above = bytes(line)
    return rows


def check_shading_model(folder: pathlib.Path) -> None:
    phi = math.radians(60)
    wanted = 255 * (math.sin(phi) + (math.pi - phi) * math.cos(phi)) / 4
    matt = [pixel[0] for pixel in read_png(folder / "matt_cylinder.png")[160] if pixel[0] > 0]
    phong = [pixel[0] for pixel in read_png(folder / "phong.png")[160]]
    expect(len(matt) > 80, f"the strand is {len(matt)} pixels wide")
    # The view is in perspective: the strand reaches 1.4 degrees to each side of its middle.
    expect(all(abs(value - wanted) < 0.03 * wanted for value in matt), f"{matt} is not {wanted}")
    expect(max(phong) > 230, f"phong is {max(phong)} at most")
    mean = sum(phong) / len(matt)
    expect(abs(mean - wanted) < 0.02 * wanted, f"phong is {mean} on average, not {wanted}")


def check_backend(folder: pathlib.Path) -> None:
    cases = json.loads((folder / "backend.json").read_text())["cases"]
    of = {(case["axes"]["/strands/backend"], case["axes"]["/render/msaa"]): case for case in cases}
    expect(len(of) == 4 and all(case["status"] == "ok" for case in cases), f"{list(of)}")
    for samples in (1, 4):
        strips, pulling = of["strips", samples], of["pulling", samples]
        expect(strips["backend"]["name"] == "strips", f"{strips['backend']}")
        expect(strips["counts"] == pulling["counts"], "it draws other strands")
        far = median(strips, "image.flip.tessellation")
        # The limit allows two roundings of one colour. The error of a picture of other strands is
        # 0.05 or more.
        expect(
            far <= median(pulling, "image.flip.tessellation") + 1e-4 and far < 1e-3,
            f"{samples} samples: {far} from tessellation",
        )


def greatest_reach(folder: pathlib.Path, name: str) -> float:
    """Returns the greatest ratio of a vertex's distance from the root to the rest length up to it."""
    greatest = 0.0
    rests, strands = obj_strands(folder / "rest.obj"), obj_strands(folder / name)
    expect(len(rests) == len(strands) > 0, f"{len(strands)} of {len(rests)} strands")
    for rest, strand in zip(rests, strands):
        along = 0.0
        for i in range(1, len(rest)):
            along += math.dist(rest[i], rest[i - 1])
            greatest = max(greatest, math.dist(strand[i], strand[0]) / along)
    return greatest


def check_constraint(folder: pathlib.Path) -> None:
    free, held = (greatest_reach(folder, f"reach_{reach}.obj") for reach in (0, 1))
    expect(free > 1.05, f"free hair reaches {free}")
    expect(held < 1 + 1e-5, f"held hair reaches {held}")  # roundings of floats


CHECKS = {
    "metric": check_metric,
    "format": check_format,
    "shading_model": check_shading_model,
    "backend": check_backend,
    "constraint": check_constraint,
}


def sync(source: pathlib.Path, target: pathlib.Path) -> None:
    """Makes target's files equal to source's. Files that are already equal keep their times, which
    saves builds."""
    files = {each.relative_to(source) for each in source.rglob("*") if each.is_file()}
    kept = target / "build"
    for each in list(target.rglob("*")):
        if each.is_relative_to(kept) or each.is_symlink() or not each.is_file():
            continue
        if each.relative_to(target) not in files:
            each.unlink()
    for each in files:
        copy = target / each
        if copy.is_file() and filecmp.cmp(source / each, copy, shallow=False):
            continue
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source / each, copy)


def patched_copy(project: pathlib.Path, tree: pathlib.Path) -> None:
    with tempfile.TemporaryDirectory(prefix="hairbench-extending-") as fresh:
        copy_project(project, pathlib.Path(fresh))
        # If a folder above were a repository, git would take paths as relative to it and skip them.
        alone = {**os.environ, "GIT_CEILING_DIRECTORIES": str(pathlib.Path(fresh).parent)}
        for name in CHECKS:
            patch = project / "docs/extending" / f"{name}.patch"
            subprocess.run(["git", "apply", str(patch)], cwd=fresh, check=True, env=alone)
        tree.mkdir(parents=True, exist_ok=True)
        sync(pathlib.Path(fresh), tree)
    libraries = tree / ".deps"
    if not libraries.exists():
        libraries.symlink_to(project / ".deps")


def build(tree: pathlib.Path) -> pathlib.Path:
    for command in (["--preset", "release"], ["--build", "--preset", "release", "--target", "hairbench"]):
        subprocess.run(["cmake", *command], cwd=tree, check=True, stdout=sys.stderr)
    return tree / "build/release/benchmarks"


def main() -> int:
    project, folder = (pathlib.Path(each).resolve() for each in sys.argv[1:])
    patches = {each.stem for each in (project / "docs/extending").glob("*.patch")}
    boxes = BOX.findall((project / "docs/extending.md").read_text(encoding="utf-8"))
    if patches != set(CHECKS) or len(boxes) != len(CHECKS):
        print(f"extending.py: {sorted(patches)} and {len(boxes)} boxes, but checks of {sorted(CHECKS)}")
        return 1
    tree = folder / "source"
    patched_copy(project, tree)
    programs = build(tree)
    failed = 0
    for (name, check), box in zip(CHECKS.items(), boxes):
        made = tempfile.mkdtemp(prefix=f"hairbench-{name}-")
        (pathlib.Path(made) / "scenes").symlink_to(tree / "scenes")
        ended = run_box(box, pathlib.Path(made), programs)
        try:
            expect(ended.returncode == 0, f"status {ended.returncode} of\n{box}{ended.stdout}")
            check(pathlib.Path(made))
            print(f"{name}: holds", flush=True)
        except (AssertionError, KeyError, OSError, ValueError) as error:
            print(f"extending.py: {name}: {error!r}", file=sys.stderr)
            failed += 1
        shutil.rmtree(made)
    print(f"{len(CHECKS) - failed} passed, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

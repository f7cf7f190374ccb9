#!/usr/bin/env python3
"""Installs a wheel into a root of Debian 12 with only Python, Debian's Jupyter and a Vulkan driver, and
measures there. The first result must be there 60 s after pip install began. Then Jupyter executes the
notebooks of docs. scripts/test --wheel calls this as root.

usage: wheel_test.py WHEEL
"""

import json
import re
import shutil
import subprocess
import sys
import tempfile
import time
import zipfile
from pathlib import Path

import root

REPOSITORY = Path(__file__).resolve().parents[2]
MOST_SECONDS = 60
NOTEBOOKS = ("notebook.ipynb", "deflection.ipynb")
JUPYTER = ("jupyter-nbconvert", "python3-ipykernel", "python3-matplotlib", "python3-pandas")
# Libraries that every desktop has (the list of PEP 600), or that come with the Vulkan driver.
SYSTEM_LIBRARIES = re.compile(
    r"lib(c|m|dl|rt|pthread|stdc\+\+|gcc_s|X11|z)\.so\.\d+|ld-linux-x86-64\.so\.2")


def fail(reason):
    sys.exit(f"wheel test: {reason}")


def check_files(wheel):
    """Refuses paths of the build machine, and libraries that are neither the wheel's own nor the system's."""
    with zipfile.ZipFile(wheel) as archive, tempfile.TemporaryDirectory() as folder:
        archive.extractall(folder)
        names = archive.namelist()
        own = {Path(name).name for name in names if ".libs/" in name}
        for name in names:
            data = archive.read(name)
            if str(REPOSITORY).encode() in data:
                fail(f"{name} names {REPOSITORY}")
            if not data.startswith(b"\x7fELF"):
                continue
            said = subprocess.run(["objdump", "-p", Path(folder, name)], check=True, text=True,
                                  stdout=subprocess.PIPE).stdout
            for library in re.findall(r"^\s+NEEDED\s+(\S+)$", said, re.M):
                if library not in own and not SYSTEM_LIBRARIES.fullmatch(library):
                    fail(f"{name} needs {library}, which the wheel has not")
        return len(own)


def check_notebooks(place, wheel):
    """Executes them as their readers do: with the wheel, and with Debian's packages for the rest."""
    python = "/root/jupyter/bin/python"
    root.inside(place, ["python3", "-m", "venv", "--system-site-packages", "/root/jupyter"])
    root.inside(place, [python, "-m", "pip", "install", "--quiet", "--no-index", "--no-deps", f"/root/{wheel.name}"])
    # Debian's Jupyter starts Debian's Python unless it is told of another one.
    root.inside(place, [python, "-m", "ipykernel", "install", "--sys-prefix", "--name", "hairbench"])
    for name in NOTEBOOKS:
        shutil.copy(REPOSITORY / "docs" / name, place / "root")
        root.inside(place, [python, "-m", "nbconvert", "--to", "notebook", "--execute",
                            "--ExecutePreprocessor.kernel_name=hairbench", "--output", f"done-{name}", f"/root/{name}"])
        cells = json.loads((place / "root" / f"done-{name}").read_text())["cells"]
        outputs = [output for cell in cells for output in cell.get("outputs", [])]
        if not any("image/png" in output.get("data", {}) for output in outputs):
            fail(f"{name} shows no figure")
        if any("<progress" in str(output) for output in outputs):
            fail(f"{name} keeps bars of progress")


def main():
    wheel = Path(sys.argv[1])
    libraries = check_files(wheel)
    folder = Path(tempfile.mkdtemp(prefix="hairbench-wheel-"))
    try:
        place = folder / "root"
        root.make(place, "bookworm", "python3-venv", "mesa-vulkan-drivers", *JUPYTER)
        shutil.copy(wheel, place / "root")
        root.inside(place, ["python3", "-m", "venv", "/root/venv"])
        begun = time.monotonic()
        root.inside(place, ["/root/venv/bin/pip", "install", "--quiet", "--no-index",
                            f"/root/{wheel.name}"])
        installed = time.monotonic()
        program = "/root/venv/bin/hairbench"
        root.inside(
            place, [program, "run", "smoke", "--max-time", "0", "--out", "/root/smoke.json"])
        measured = time.monotonic()
        report = json.loads((place / "root" / "smoke.json").read_text())
        statuses = [case["status"] for case in report["cases"]]
        if statuses != ["ok", "ok"]:
            fail(f"the cases of smoke.json are {statuses}, not two that are ok")
        root.inside(place, [program, "report", "/root/smoke.json", "-o", "/root/smoke.html"])
        # Reading a mesh by assimp runs another program. The module finds all of them.
        said = root.inside(
            place, ["/root/venv/bin/python", "-c",
                    "import hairbench; print(hairbench.program()); print(hairbench.scenes());"
                    "r = hairbench.run('smoke', out='/root/again.json', max_time=0, frames=2,"
                    " axes={'/render/msaa': [1]}, progress=None); print(r.status)"],
            stdout=subprocess.PIPE).stdout.split()
        package = re.fullmatch(
            r"(/root/venv/lib/python3\.\d+/site-packages/hairbench)/bin/hairbench", said[0])
        if not package or said[1:] != [f"{package[1]}/share/hairbench/scenes", "0"]:
            fail(f"the module says {said}")
        (place / "root" / "body.obj").write_text(
            "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n")
        (place / "root" / "hair.obj").write_text("v 0.2 0.2 0\nv 0.2 0.2 -0.1\nl 1 2\n")
        root.inside(
            place, [program, "groom", "info", "/root/hair.obj", "--mesh", "/root/body.obj"])
        check_notebooks(place, wheel)
        took = measured - begun
        print(f"wheel test: {wheel.stat().st_size / 1e6:.1f} MB, {libraries} libraries of its own; "
              f"installed in {installed - begun:.1f} s, first result after {took:.1f} s on "
              f"{report['environment']['device']['name']}")
        if took > MOST_SECONDS:
            fail(f"the first result took {took:.0f} s, more than {MOST_SECONDS}")
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()

"""Runs the commands of README.md and docs/*.md that are marked to run, in a copy of the project.

run_commands.py PROJECT PROGRAM

A box that begins with ```sh run is a script for sh. The boxes of one page run one after another in
one folder. Each page gets a new copy of the files that git knows. A failed command ends its page.
"""

import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

BOX = re.compile(r"^```sh run\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def project_files(project: pathlib.Path) -> list[str]:
    """Returns the files that git tracks or would add, relative to the project."""
    listed = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=project,
        check=True,
        capture_output=True,
        text=True,
    ).stdout
    return [each for each in listed.split("\0") if each and (project / each).is_file()]


def copy_project(project: pathlib.Path, folder: pathlib.Path) -> None:
    for each in project_files(project):
        copy = folder / each
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy2(project / each, copy)


def run_box(box: str, folder: pathlib.Path, programs: pathlib.Path) -> "subprocess.CompletedProcess[str]":
    """Runs a box's commands in folder, with programs in PATH. stdout of the result has all output."""
    return subprocess.run(
        ["sh", "-eu", "-c", f'PATH="{programs}:$PATH"\n{box}'],
        cwd=folder,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
    )


def main() -> int:
    project, program = (pathlib.Path(each).resolve() for each in sys.argv[1:])
    files = project_files(project)
    count, failures = 0, []
    for page in ["README.md", *sorted(each for each in files if re.fullmatch(r"docs/.*\.md", each))]:
        boxes = BOX.findall((project / page).read_text(encoding="utf-8"))
        if not boxes:
            continue
        with tempfile.TemporaryDirectory(prefix="hairbench-docs-") as folder:
            copy_project(project, pathlib.Path(folder))
            for box in boxes:
                start = time.monotonic()
                ended = run_box(box, pathlib.Path(folder), program.parent)
                count += 1
                print(f"{page}, box {boxes.index(box) + 1}: {time.monotonic() - start:.1f} s", flush=True)
                if ended.returncode != 0:
                    failures.append(f"{page}: status {ended.returncode} of\n{box}{ended.stdout}")
                    break
    for failure in failures:
        print(f"run_commands.py: {failure}", file=sys.stderr)
    if count == 0:
        print("run_commands.py: no page has a box that is marked to run", file=sys.stderr)
    return 1 if failures or count == 0 else 0


if __name__ == "__main__":
    sys.exit(main())

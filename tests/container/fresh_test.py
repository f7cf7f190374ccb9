#!/usr/bin/env python3
"""Runs the two commands of the README as a new user would: in a fresh minimal root of a release
with only git and no cache. Only the distribution's mirror and Python's index can be reached there.
Checks that scripts/bench leaves a table, a report and its page, and that scripts/test passes.
Writes the results into the table of docs/install.md. scripts/test --fresh calls this as root."""

import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from urllib.parse import urlsplit

import root
from root import run

REPOSITORY = Path(__file__).resolve().parents[2]
INSTALL = REPOSITORY / "docs" / "install.md"
NAMES = {"bookworm": "Debian 12", "trixie": "Debian 13", "noble": "Ubuntu 24.04"}
HEAD = "| release | run on | commit | Mesa | `scripts/bench` | `scripts/test` |"

# A Python script that asks its own pip for its package indices.
INDEX_HOSTS = """
from pip._internal.configuration import Configuration
from pip._internal.models.index import PyPI
settings = Configuration(isolated=False)
settings.load()
print(dict(settings.items()).get("global.index-url", PyPI.simple_url))
print("https://" + PyPI.file_storage_domain)
"""


def output(*command):
    return run(*command, stdout=subprocess.PIPE).stdout.strip()


def index_hosts(folder):
    """Returns the hosts that pip on this machine takes packages from."""
    run(output(REPOSITORY / "scripts" / "python-environment", "--base"), "-m", "venv", folder)
    said = output(folder / "bin" / "python", "-c", INDEX_HOSTS)
    return [urlsplit(line).hostname for line in said.splitlines()]


def mirror_hosts(place):
    """Returns the hosts that the root's apt takes packages from."""
    files = [place / "etc/apt/sources.list", *(place / "etc/apt/sources.list.d").iterdir()]
    said = "\n".join(each.read_text() for each in files if each.is_file())
    said = re.sub(r"#.*", "", said)
    return sorted({urlsplit(uri).hostname for uri in re.findall(r"https?://\S+", said)})


def allow_only(place, hosts):
    """Writes these hosts' addresses into the root, which has no resolver and so finds no other host."""
    lines = ["127.0.0.1 localhost"]
    for host in hosts:
        address = output("getent", "ahostsv4", host).split()[0]
        lines.append(f"{address} {host}")
    (place / "etc/hosts").write_text("\n".join(lines) + "\n")
    (place / "etc/resolv.conf").unlink(missing_ok=True)
    (place / "etc/resolv.conf").touch()


def measured(place, command):
    """Runs a command in the clone. Returns its wall-clock and processor seconds and its output."""
    print(f"fresh test: {command}", file=sys.stderr, flush=True)
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    start = time.monotonic()
    log = place / "root" / "log"
    with log.open("wb") as out:
        status = subprocess.run(
            root.command_inside(place, ["bash", "-c", f"cd /root/hairbench && {command}"]),
            stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.STDOUT).returncode
    wall = time.monotonic() - start
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    said = log.read_text(errors="replace")
    if status != 0:
        sys.exit(f"{said[-8000:]}\nfresh test: {command}: status {status}; all of it is in {keep(log)}")
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return {"wall": wall, "cpu": cpu, "said": said}


def keep(log):
    """Copies the log to a place that outlives the root, and returns that path."""
    kept = Path(tempfile.gettempdir()) / "hairbench-fresh.log"
    shutil.copyfile(log, kept)
    return kept


def hold(condition, what):
    if not condition:
        sys.exit(f"fresh test: {what}")


def seconds(part):
    return f"{part['cpu']:.0f} CPU s, {part['wall']:.0f} s"


def write_row(release, cells):
    """Replaces the release's row in docs/install.md."""
    row = f"| {NAMES[release]} | " + " | ".join(cells) + " |"
    before, head, after = INSTALL.read_text().partition(HEAD + "\n")
    hold(head, f"{INSTALL} has no table that begins with {HEAD}")
    rule, *lines = after.split("\n")
    end = next(i for i, line in enumerate(lines) if not line.startswith("|"))
    rows, rest = lines[:end], lines[end:]
    rows = sorted([line for line in rows if not line.startswith(f"| {NAMES[release]} ")] + [row])
    INSTALL.write_text(before + head + "\n".join([rule, *rows, *rest]))


def main(release):
    hold(release in NAMES, f"{release}: not one of {', '.join(NAMES)}")
    hold(not output("git", "-C", REPOSITORY, "status", "--porcelain"),
         "the working tree has changes: what a new user clones is a commit")
    commit = output("git", "-C", REPOSITORY, "rev-parse", "--short=12", "HEAD")
    with tempfile.TemporaryDirectory(prefix="hairbench-fresh-", dir="/var/tmp") as scratch:
        scratch = Path(scratch)
        place = scratch / "root"
        root.make(place, release, "git", "ca-certificates")
        # The network may use certificates of its own.
        shutil.copyfile("/etc/ssl/certs/ca-certificates.crt", place / "etc/ssl/certs/ca-certificates.crt")
        allow_only(place, [*mirror_hosts(place), *index_hosts(scratch / "venv")])
        run("git", "clone", "--quiet", "--no-hardlinks", REPOSITORY, place / "root/hairbench")

        bench = measured(place, "scripts/bench")
        clone = place / "root/hairbench"
        hold(re.search(r"^\W*density\W.*\bfps\b", bench["said"], re.MULTILINE), "scripts/bench printed no table")
        for file, part in {"thesis.json": '"schema": "hairbench-report/', "thesis.html": 'id="plotly"'}.items():
            path = clone / "results/local" / file
            hold(path.is_file() and part in path.read_text(), f"scripts/bench left no {file}")
        print(bench["said"], file=sys.stderr)
        test = measured(place, "scripts/test")
        mesa = output("chroot", place, "dpkg-query", "--show", "--showformat=${Version}", "mesa-vulkan-drivers")
        passed = re.findall(r"^(\d+ passed, 0 failed)$", test["said"], re.MULTILINE)
        hold(passed, "scripts/test did not say how many passed")
    day = time.strftime("%Y-%m-%d", time.gmtime())
    write_row(release, [day, commit, mesa, seconds(bench), f"{passed[-1]}; {seconds(test)}"])
    print(f"fresh test: both commands pass on {NAMES[release]}: scripts/bench {seconds(bench)}; scripts/test"
          f" {seconds(test)}; docs/install.md has it")


if __name__ == "__main__":
    main(sys.argv[1])

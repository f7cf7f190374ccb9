"""Minimal roots of Debian, and what runs in them."""

import shlex
import subprocess
import sys
from pathlib import Path


def run(*command, **options):
    print("container test:", shlex.join(map(str, command))[:200], file=sys.stderr, flush=True)
    return subprocess.run(command, check=True, text=True, **options)


def make(root, suite, *packages):
    """A root of the suite with what is essential, apt, and these packages alone, from where this
    machine's own apt gets packages."""
    sources = [
        path for path in (Path("/etc/apt/sources.list"), *Path("/etc/apt").glob(
            "sources.list.d/*.sources")) if path.is_file() and suite in path.read_text()]
    include = [f"--include={','.join(packages)}"] if packages else []
    run("mmdebstrap", "--quiet", "--variant=minbase", *include, suite, root, *sources)


def inside(root, command, **options):
    """Runs a command there, with processes and an environment of its own."""
    path = "/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin"
    return run("unshare", "--mount", "--pid", "--fork", f"--mount-proc={root}/proc", "chroot", root,
               "/usr/bin/env", "-i", f"PATH={path}", "HOME=/root", "LC_ALL=C.UTF-8", *command,
               **options)

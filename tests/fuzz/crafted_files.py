#!/usr/bin/env python3
"""Gives crafted hostile files to the program and observes it from outside.

crafted_files.py PROGRAM [--count N | --seconds T] [--seed S] [--kind NAME ...]

crafts.py makes the files. These rules hold for each file:

* The program ends with status 0, or refuses the file with status 2 and one line on stderr; some
  commands have more statuses of their own (STATUSES). It never ends by a signal, with an internal
  error or with a traceback of a Python program.
* The program and its children together use at most 2 s of processor time. Each of them uses at most
  300 MB for each started 10 MB of the file, in addition to the memory for the smallest file of the
  kind (Python's start for USD, glslang's for GLSL, the device's for journals).
* No child of it remains.
* Nothing opens a planted file, which lies in a folder beside the crafted ones. The kernel reports
  opened files (inotify), so the script need not trust the program. A pipe does not block.

Every second file is read without Landlock, which a filter of system calls hides. This shows the
checks of the program itself. First the script checks itself: that it detects a violation of each
rule, that files with names of planted ones do open them with --allow-outside, and that children end
with a killed program. A file that breaks a rule is kept, and the exit status is 1.
"""

import argparse
import collections
import ctypes
import itertools
import os
import random
import re
import resource
import select
import shlex
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import crafts

MOST_SECONDS = 2.0  # s of processor time
MOST_MEGABYTES = 300  # for each started 10 MB of the file
MOST_WALL_CLOCK = 60.0  # s; only a blocked program takes so long
MOST_LINE = 700  # bytes of the line that refuses a file: its path, and 480 bytes (shortMessage)
MOST_UNTIL_GONE = 1.0  # s between the kill of the program and the end of its children

# Statuses besides 0 and 2: the verdict of a comparison, findings of doctor, no Vulkan device, and
# merged reports with missing cases.
STATUSES = {"compare": {10, 11, 12, 13}, "doctor": {3}, "run": {77}, "merge": {130}}

# Lines that are not errors: the first line of `run`, and the progress of a command after 10 s.
NO_ERROR = re.compile(
    r"hairbench \d+\.\d+\.\d+ \(.* on |\[\d+/\d+\] \d+:\d\d|reads [^:]+$|[a-z ]+(, \d+ of \d+)?$"
)
# Words of programmers, which tell a user nothing.
UNCLEAR = re.compile(r"internal error|Traceback|terminate called|Sanitizer|std::|\b\w+(Error|Exception)\b")

libc = ctypes.CDLL(None, use_errno=True)


def call(name, *arguments):
    result = getattr(libc, name)(*arguments)
    if result < 0:
        raise OSError(ctypes.get_errno(), name)
    return result


# ---- What the kernel reports ---------------------------------------------------------------------

IN_ACCESS, IN_OPEN = 0x1, 0x20


class Watch:
    """Detects which files of a folder are opened or read."""

    def __init__(self, folder):
        self.file = call("inotify_init1", os.O_NONBLOCK | os.O_CLOEXEC)
        call("inotify_add_watch", self.file, os.fsencode(folder), IN_ACCESS | IN_OPEN)

    def seen(self):
        """Returns the names that were opened since the last call."""
        names = set()
        while True:
            try:
                data = os.read(self.file, 1 << 16)
            except BlockingIOError:
                return sorted(names)
            while data:
                length = struct.unpack_from("<iIII", data)[3]
                names.add(os.fsdecode(data[16 : 16 + length].rstrip(b"\0")) or ".")
                data = data[16 + length :]


PR_SET_SECCOMP, PR_SET_CHILD_SUBREAPER, PR_SET_NO_NEW_PRIVS = 22, 36, 38
LANDLOCK_CREATE_RULESET = 444  # on all architectures


def hide_landlock():
    """Lets this process and its children see a kernel without Landlock (seccomp(2))."""
    load_number, jump_equal, give = 0x20, 0x15, 0x06
    steps = [
        (load_number, 0, 0, 0),
        (jump_equal, 0, 1, LANDLOCK_CREATE_RULESET),
        (give, 0, 0, 0x00050000 | 38),  # the error ENOSYS
        (give, 0, 0, 0x7FFF0000),  # allowed
    ]
    code = ctypes.create_string_buffer(b"".join(struct.pack("<HBBI", *step) for step in steps))
    program = ctypes.create_string_buffer(struct.pack("<HxxxxxxQ", len(steps), ctypes.addressof(code)))
    call("prctl", PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
    call("prctl", PR_SET_SECCOMP, 2, program, 0, 0)


def children():
    """Returns this process's children, including orphans of its children."""
    return [
        int(number)
        for task in Path("/proc/self/task").iterdir()
        for number in (task / "children").read_text().split()
    ]


def end_children():
    """Ends all children of this process and returns how many there were."""
    count = 0
    for child in children():
        os.kill(child, signal.SIGKILL)
        os.waitpid(child, 0)
        count += 1
    return count


# ---- One run -------------------------------------------------------------------------------------

Outcome = collections.namedtuple("Outcome", "status seconds megabytes errors left opened")


class Runner:
    def __init__(self, folder, watch):
        self.folder = folder
        self.watch = watch
        self.environment = {**os.environ, "XDG_CACHE_HOME": str(folder / "cache"), "TMPDIR": str(folder / "tmp")}
        (folder / "tmp").mkdir()

    def start(self, command, with_landlock=True):
        with open(self.folder / "stdout", "wb") as out, open(self.folder / "stderr", "wb") as errors:
            return subprocess.Popen(
                command,
                stdin=subprocess.DEVNULL,
                stdout=out,
                stderr=errors,
                env=self.environment,
                cwd=self.folder / "in",
                preexec_fn=None if with_landlock else hide_landlock,
            )

    def run(self, command, with_landlock=True):
        self.watch.seen()
        process = self.start(command, with_landlock)
        end = os.pidfd_open(process.pid)
        in_time = select.select([end], [], [], MOST_WALL_CLOCK)[0]
        os.close(end)
        if not in_time:
            process.kill()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = status
        left = end_children()
        errors = (self.folder / "stderr").read_bytes()
        return Outcome(
            os.waitstatus_to_exitcode(status) if in_time else None,
            usage.ru_utime + usage.ru_stime,
            usage.ru_maxrss / 1024,
            errors,
            left if in_time else 0,  # a killed program cannot wait for its children
            self.watch.seen(),
        )


Limits = collections.namedtuple("Limits", "seconds megabytes")


def broken_rules(outcome, limits, statuses=frozenset()):
    """Returns the rules that the run broke."""
    found = []
    lines = outcome.errors.decode("utf-8", "replace").splitlines()
    lines = [line for line in lines if not NO_ERROR.match(line)]
    last = lines[-1] if lines else "nothing"
    if outcome.status is None:
        found.append(f"was not done after {MOST_WALL_CLOCK:g} s")
    elif outcome.status not in {0, 2, *statuses}:
        found.append(f"ended with status {outcome.status}: {last}")
    elif outcome.status == 2 and len(lines) != 1:
        found.append(f"refused with {len(lines)} lines")
    for word in {match.group() for line in lines for match in UNCLEAR.finditer(line)}:
        found.append(f"said '{word}'")
    if outcome.status == 2 and len(last.encode()) > MOST_LINE:
        found.append(f"said {len(last)} letters")
    if outcome.status == 2 and len(last.strip()) < 10:
        found.append("gave no reason")
    if any(code < 32 for line in outcome.errors.split(b"\n") for code in line):
        found.append("printed control characters")
    if outcome.seconds > limits.seconds:
        found.append(f"took {outcome.seconds:.2f} s of the processor, {limits.seconds:.2f} s are allowed")
    if outcome.megabytes > limits.megabytes:
        found.append(f"took {outcome.megabytes:.0f} MB, {limits.megabytes:.0f} MB are allowed")
    if outcome.left:
        found.append(f"left {outcome.left} children")
    if outcome.opened:
        found.append("opened " + ", ".join(outcome.opened))
    return found


# ---- The planted files ---------------------------------------------------------------------------


def plant(folder):
    """Writes valid files of each extension and returns their names."""
    folder.mkdir()
    triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    data = struct.pack("<9f", *range(9)) + struct.pack("<9I", *range(3), *range(3), *range(3))
    contents = {
        ".png": crafts.png(2, 2, 8, 0, crafts.zlib.compress(b"\0\1\2" * 2)),
        ".hdr": (crafts.SEEDS / "float_picture/flat.hdr").read_bytes(),
        ".obj": triangle,
        ".mtl": "newmtl planted\nKd 1 0 0\n",
        ".usda": '#usda 1.0\n(defaultPrim = "c")\n' + crafts.CURVE % "c",
        ".bin": data,
        ".json": "{}",
        ".jsonl": '{"secret": 1}\n',
        ".glsl": "vec3 shadeHair(HairPoint point) { return point.color; }\n",
        ".hgl": crafts.HAIR,
        ".xml": (crafts.CORPUS / "xml/linear.xml").read_bytes(),
    }
    for ending, content in contents.items():
        (folder / ("planted" + ending)).write_bytes(content if isinstance(content, bytes) else content.encode())
    return {"planted" + ending for ending in contents}


# ---- Checks of the script itself -----------------------------------------------------------------


def check_self(runner):
    """Returns the rules for which this script would not detect a violation."""
    planted = runner.folder / "private/planted.png"
    limits = Limits(MOST_SECONDS, MOST_MEGABYTES)
    python = [sys.executable, "-c"]
    breaking = {
        "opened planted.png": ["cat", str(planted)],
        "left 1 children": ["sh", "-c", "sleep 30 &"],
        "s of the processor": ["sh", "-c", f"{shlex.quote(sys.executable)} -c \"{BUSY}\""],
        "MB are allowed": python + ["import os; os.wait() if os.fork() else bytearray(400 << 20)"],
        "ended with status -11": python + ["import os, signal; os.kill(os.getpid(), signal.SIGSEGV)"],
        "ended with status 1": ["sh", "-c", "exit 1"],
        "refused with 2 lines": ["sh", "-c", "echo one: reason >&2; echo another: reason >&2; exit 2"],
        "refused with 0 lines": ["sh", "-c", "exit 2"],
        "Traceback": python + ["raise ValueError"],
    }
    missed = []
    for rule, command in breaking.items():
        for with_landlock in (True, False)[: 2 if "opened" in rule else 1]:
            found = broken_rules(runner.run(command, with_landlock), limits)
            if not any(rule in each for each in found):
                missed.append(f"the script does not see what {rule}: {found}")
    good = runner.run(["sh", "-c", "echo file: the reason why >&2; exit 2"])
    if broken_rules(good, limits):
        missed.append(f"the script refuses a good refusal: {broken_rules(good, limits)}")
    return missed


BUSY = f"import time\nwhile time.process_time() < {MOST_SECONDS + 0.2}: pass"


def check_allowed(runner, program, place):
    """Returns names that do not lead to planted files even if the user allows them, because a
    misspelt name would look like a refused one. Also returns fields that do not refuse the
    names."""
    files = {
        ".usda": ("a.usda", '#usda 1.0\ndef "a" (references = @../private/planted.usda@) {}\n'),
        ".mtl": ("a.obj", "mtllib ../private/planted.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
        ".png": ("a.gltf", gltf_with_picture()),
        ".bin": ("a.gltf", gltf_with_buffer()),
    }
    missed = []
    for ending, (name, content) in files.items():
        here = place()
        here.write(name, content)
        if ending == ".usda":
            arguments = crafts.scene(here, groom={"file": name})
        else:
            arguments = crafts.scene(here, groom={"file": "hair.hgl", "mesh": name}, render={"head": True})
        for with_landlock in (True, False):
            opened = runner.run([program, *arguments, "--allow-outside"], with_landlock).opened
            if opened != ["planted" + ending]:
                missed.append(f"with --allow-outside {name} opens {opened}, not planted{ending}")
    for pointer, ending in crafts.FIELDS:
        here = place()
        here.write("hair.hgl", crafts.HAIR)
        document = {"render": {"head": False}}
        if not pointer.startswith("/groom/grow"):
            document["groom"] = {"file": "hair.hgl"}
        crafts.put(document, pointer, "../private/planted" + ending)
        path = here.write("scene.json", crafts.json.dumps(document))
        outcome = runner.run([program, "validate", path])
        if outcome.status != 2 or b"is outside" not in outcome.errors or outcome.opened:
            missed.append(f"{pointer}: {outcome.errors.decode()} {outcome.opened}")
    return missed


def gltf_with_picture():
    document, data = crafts.gltf_document(3, 4)
    document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + crafts.base64.b64encode(data).decode()
    document["images"] = [{"uri": "../private/planted.png"}]
    document["textures"] = [{"source": 0}]
    document["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]
    primitive = document["meshes"][0]["primitives"][0]
    primitive["material"] = 0
    document["bufferViews"].append({"buffer": 0, "byteLength": 24})
    document["accessors"].append({"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC2"})
    primitive["attributes"]["TEXCOORD_0"] = 2
    return crafts.json.dumps(document)


def gltf_with_buffer():
    document, _ = crafts.gltf_document(3, 4)
    document["buffers"][0]["uri"] = "../private/planted.bin"
    return crafts.json.dumps(document)


def check_killed(runner, program, place):
    """Kills the program while one of its children works, and returns the children that survive."""
    here = place()
    rows = "".join(f"v {i % 7} {i % 5} {i}\n" for i in range(30_000)) + "f 1 2 3\n" * 100_000
    here.write("a.obj", rows)
    mesh = crafts.scene(here, render={"head": False, "meshes": [{"file": "a.obj"}]})
    working = {
        "assimp": (mesh, "hairbench_mesh_"),
        "USD": (["groom", "info", here.write("a.usda", "#usda 1.0\n" + crafts.CURVE % "c")], "python"),
    }  # the beginnings of the children's names
    left = []
    for name, (arguments, child_name) in working.items():
        process = runner.start([program, *arguments])
        child = None
        tasks = Path(f"/proc/{process.pid}/task/{process.pid}/children")
        until = time.monotonic() + MOST_WALL_CLOCK
        while not child and process.poll() is None and time.monotonic() < until:
            for number in tasks.read_text().split():
                # Before a child runs its program, it has its parent's name.
                if command_of(number).startswith(child_name):
                    child = int(number)
        process.kill()
        process.wait()
        if not child:
            left.append(f"{name}: no child was seen that could be left")
            continue
        until = time.monotonic() + MOST_UNTIL_GONE
        while is_alive(child) and time.monotonic() < until:
            time.sleep(0.01)
        if is_alive(child):
            left.append(f"{name}: the child lives on {MOST_UNTIL_GONE:g} s after kill -9 of the program")
        end_children()
    return left


def command_of(process):
    try:
        return Path(f"/proc/{process}/comm").read_text().strip()
    except OSError:
        return ""


def is_alive(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(") ")[2][0] not in "XZ"
    except OSError:
        return False


# ---- All files -----------------------------------------------------------------------------------


def smallest(kind, place):
    """Arguments that read the smallest valid file of a kind that takes longer than others to
    start."""
    here = place()
    if kind == "usd":
        here.write("a.usda", "#usda 1.0\n" + crafts.CURVE % "c")
        return crafts.scene(here, groom={"file": "a.usda"})
    if kind == "glsl":
        here.write("a.glsl", "vec3 shadeHair(HairPoint point) { return point.color; }\n")
        return crafts.extended(here, "model")
    if kind == "journal":
        return crafts.resumed(here)
    return crafts.scene(here)


class Tally:
    def __init__(self, base):
        self.base = base
        self.count = self.refused = self.outside = self.broken = 0
        self.seconds = self.megabytes = 0.0
        self.slowest = None  # number of the file

    def add(self, outcome, number):
        self.count += 1
        self.refused += outcome.status == 2
        self.outside += outcome.status == 2 and b"is outside" in outcome.errors
        if outcome.seconds > self.seconds:
            self.seconds, self.slowest = outcome.seconds, number
        self.megabytes = max(self.megabytes, outcome.megabytes)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="hairbench")
    parser.add_argument("--count", type=int, help="number of files (default 100)")
    parser.add_argument("--seconds", type=float, help="go on for so long instead")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0, help="number of the first file, to repeat one")
    parser.add_argument("--kind", action="append", choices=crafts.KINDS, help="only this kind of file; repeatable")
    parser.add_argument("--without", action="append", choices=crafts.KINDS, default=[], help="no such; repeatable")
    parser.add_argument("--keep", type=Path, help="folder for files that break a rule")
    parser.add_argument("--slack", type=float, default=1.0, help="factor of limits, for sanitizers")
    parser.add_argument("--no-self-check", action="store_true")
    return parser.parse_args()


def main():
    options = parse_arguments()
    program = str(Path(options.program).resolve())
    kinds = [each for each in options.kind or crafts.KINDS if each not in options.without]
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    call("prctl", PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    faults = 0
    with tempfile.TemporaryDirectory(prefix="hairbench-crafted-") as scratch:
        folder = Path(os.path.realpath(scratch))
        planted = plant(folder / "private")
        (folder / "in").mkdir()
        runner = Runner(folder, Watch(folder / "private"))

        def place():
            return crafts.Place(folder, planted)

        place()
        if not options.no_self_check:
            checks = (
                check_self(runner) + check_allowed(runner, program, place) + check_killed(runner, program, place)
            )
            for fault in checks:
                print(f"self-check: {fault}")
            faults += len(checks)
        tallies = {kind: Tally(runner.run([program, *smallest(kind, place)])) for kind in kinds}
        for kind, tally in tallies.items():
            if tally.base.status != 0:
                print(f"{kind}: the smallest file: {tally.base.errors.decode()}")
                faults += 1
        count = options.count or 100
        begin = time.monotonic()
        for number in itertools.count(options.first):
            if options.seconds and time.monotonic() - begin > options.seconds:
                break
            if not options.seconds and number >= options.first + count:
                break
            kind = kinds[number % len(kinds)]
            here = place()
            arguments = crafts.KINDS[kind](random.Random(f"{options.seed} {kind} {number}"), here)
            size = here.size()
            outcome = runner.run([program, *arguments], with_landlock=number // len(kinds) % 2 == 0)
            tally = tallies[kind]
            tally.add(outcome, number)
            limits = Limits(
                options.slack * MOST_SECONDS + tally.base.seconds,
                options.slack * MOST_MEGABYTES * (1 + size // 10_000_000) + tally.base.megabytes,
            )
            broken = broken_rules(outcome, limits, STATUSES.get(arguments[0], ()))
            if broken:
                faults += 1
                tally.broken += 1
                options.keep = options.keep or Path(tempfile.mkdtemp(prefix="hairbench-kept-"))
                options.keep.mkdir(parents=True, exist_ok=True)
                kept = options.keep / f"{kind}-{options.seed}-{number}"
                shutil.rmtree(kept, ignore_errors=True)
                shutil.move(folder / "in", kept)
                (kept / "COMMAND").write_text(shlex.join(arguments) + "\n" + "\n".join(broken) + "\n")
                print(f"{kind} {number}: {'; '.join(broken)}\n  kept in {kept}: {shlex.join(arguments)}", flush=True)
    print(f"{'kind':8} {'files':>6} {'refused':>7} {'outside':>7} {'accepted':>8} {'most CPU s':>10} {'in file':>7} {'most MB':>7}"
          f" {'broken':>6}   smallest file: CPU s, MB")  # fmt: skip
    for kind, tally in tallies.items():
        print(
            f"{kind:8} {tally.count:6} {tally.refused:7} {tally.outside:7} {tally.count - tally.refused:8} "
            f"{tally.seconds:10.2f} {tally.slowest or 0:7} {tally.megabytes:7.0f} {tally.broken:6}   "
            f"{tally.base.seconds:.2f}, {tally.base.megabytes:.0f}"
        )
    print(f"{sum(each.count for each in tallies.values())} files, {faults} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())

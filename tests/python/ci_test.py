"""Tests CI for other repositories: runs the shell steps of the action and of docs/comparing.md in
repositories made here.

cmake and scripts/setup are stand-ins, and both builds are the program under test.
"""

import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import yaml

from support import REPOSITORY, hairbench, need_device

ACTION = REPOSITORY / ".github" / "actions" / "gate"
SMOKE = str(REPOSITORY / "scenes" / "smoke.json")
# One case of 64 x 36 px. The time is up after both builds have warmed up, which already shows any
# difference of pictures and counts.
TINY = ("--axis /render/msaa=1 --set /render/width=64 --set /render/height=36 --max-time 0"
        " --max-minutes 0.001 --fail-on regressed")

CMAKE = """#!/bin/sh
echo "cmake $*" >>"$STAND_IN_LOG"
while [ $# -gt 0 ]; do
    case $1 in
        -S) git -C "$2" log -1 --format='source %s' >>"$STAND_IN_LOG" ;;
        --build)
            mkdir -p "$2/benchmarks"
            ln -sf "$STAND_IN_PROGRAM" "$2/benchmarks/hairbench" ;;
    esac
    shift
done
"""


def evaluated(text, names):
    """Evaluates GitHub's expressions in ${{ }}: names with dots, and a || b, the first not empty."""
    def value(match):
        for name in match[1].split("||"):
            if names.get(name.strip(), ""):
                return names[name.strip()]
        return ""
    return re.sub(r"\$\{\{(.*?)\}\}", value, str(text))


class Repository(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory()
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)
        self.work = self.folder / "work"
        self.tools = self.folder / "tools"
        self.tools.mkdir()
        self.log = self.folder / "log"
        self.log.touch()
        self.environment = os.environ | {
            "PATH": f"{self.tools}:{os.environ['PATH']}", "STAND_IN_LOG": str(self.log),
            "STAND_IN_PROGRAM": str(hairbench.program()), "GIT_CONFIG_GLOBAL": os.devnull,
            "GITHUB_ACTION_PATH": str(ACTION)}
        self.tool("cmake", CMAKE)

    def tool(self, name, script):
        path = self.tools / name
        path.write_text(script)
        path.chmod(0o755)

    def shell(self, script, **variables):
        # GitHub and GitLab run steps in this way.
        return subprocess.run(
            ["bash", "--noprofile", "--norc", "-eo", "pipefail", "-c", script], cwd=self.work,
            env=self.environment | variables, text=True, stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT, timeout=500)

    def make_branches(self):
        """Makes a branch and then another commit on main, so that the branch's base is the commit
        'old'."""
        scripts = self.work / "scripts"
        scripts.mkdir(parents=True)
        for name in ("ci-gate", "gate-table"):
            (scripts / name).symlink_to(REPOSITORY / "scripts" / name)
        (scripts / "setup").write_text('#!/bin/sh\necho "setup" >>"$STAND_IN_LOG"\n')
        (scripts / "setup").chmod(0o755)
        git = ("git -c user.name=Test -c user.email=test@example.org -c commit.gpgsign=false"
               " -c init.defaultBranch=main ")
        done = self.shell(
            f"{git} init -q; echo build/ >.gitignore; {git} add -A; {git} commit -qm old\n"
            f"git checkout -qb branch; {git} commit -qm new --allow-empty\n"
            f"git checkout -q main; {git} commit -qm later --allow-empty; git checkout -q branch")
        self.assertEqual(done.returncode, 0, done.stdout)

    def check_builds(self):
        self.assertEqual(
            re.findall(r"^(?:setup|source .*)$", self.log.read_text(), re.M),
            ["setup", "source old", "setup", "source new"])
        self.assertEqual(list((self.work / "build").glob("gate-base*")), [])


class Action(Repository):
    def setUp(self):
        super().setUp()
        self.action = yaml.safe_load((ACTION / "action.yml").read_text())
        self.assertEqual(self.action["runs"]["using"], "composite")
        for name in ("summary", "output"):
            path = self.folder / name
            path.touch()
            self.environment[f"GITHUB_{name.upper()}"] = str(path)
        self.environment["GITHUB_STEP_SUMMARY"] = str(self.folder / "summary")

    def play(self, inputs, names):
        """Runs the steps as a pull request would; returns the last one's status."""
        known = {f"inputs.{name}": each["default"] for name, each in self.action["inputs"].items()}
        for name in inputs:
            self.assertIn(f"inputs.{name}", known)
        known |= {f"inputs.{name}": value for name, value in inputs.items()} | names
        said = ""
        for step in self.action["runs"]["steps"]:
            self.assertEqual(step["shell"], "bash")
            if "if" in step:
                self.assertEqual(
                    step["if"],
                    "inputs.comment == 'true' && github.event_name == 'pull_request'")
                if known["inputs.comment"] != "true":
                    continue
            variables = {name: evaluated(text, known) for name, text in step["env"].items()}
            done = self.shell(step["run"], **variables)
            said += done.stdout
            for line in (self.folder / "output").read_text().splitlines():
                name, _, value = line.partition("=")
                known[f"steps.gate.outputs.{name}"] = value
            if step is self.action["runs"]["steps"][-1]:
                return done.returncode, said
            self.assertEqual(done.returncode, 0, said)
        raise AssertionError("no last step")

    def summary(self):
        return (self.folder / "summary").read_text()

    def made_builds(self, slower):
        """Returns command lines that only write a report with a made-up strands pass."""
        sides = []
        for name, time in (("a", 3.0), ("b", 3.0 * slower)):
            metric = {"unit": "ms", "hint": "lower", "mode": "isolated", "median": time, "mad": 0.0,
                      "samples": [time] * 3}
            path = self.folder / f"{name}.json"
            path.write_text(json.dumps({
                "schema": "hairbench-report/1.4.0",
                "environment": {"device": {"name": "Made up", "type": "discrete"}, "host": {},
                                "build": {}, "command": ["x"], "seed": 1},
                "scene": {"path": "made.json", "hash": "0123456789abcdef", "document": {}},
                "cases": [{"name": "made|up", "axes": {}, "status": "ok",
                           "image_hash": "aa", "state_hash": "bb",
                           "metrics": {"pass.strands.time": metric}}]}))
            sides.append(f"cp '{path}' {{out}}; : {{scene}}")
        self.work.mkdir()
        return {"a": sides[0], "b": sides[1], "program": str(hairbench.program()),
                "scene": "made.json", "options": ""}

    def test_builds_the_base_and_the_branch(self):
        need_device(self)
        self.make_branches()
        status, said = self.play(
            {"scene": SMOKE, "options": TINY}, {"github.event.pull_request.base.sha": "main"})
        self.check_builds()
        self.assertEqual(status, 0, said)  # stopped before it could decide, and set to pass in that
                                           # case
        report = json.loads((self.work / "build" / "gate" / "gate.json").read_text())
        self.assertEqual(report["end"], "out_of_time")
        self.assertEqual((report["a"]["given"], report["b"]["given"]),
                         ("build/gate-a", "build/gate-b"))
        self.assertIn("### ? B is not known to be slower", self.summary())
        self.assertIn("out of time", self.summary())

    def test_fails_where_something_is_slower_and_says_so(self):
        self.tool("gh", '#!/bin/sh\necho "gh $*" >>"$STAND_IN_LOG"; cp "$5" "$STAND_IN_LOG.body"\n')
        status, said = self.play(
            self.made_builds(slower=1.25) | {"comment": "true"},
            {"github.event.pull_request.html_url": "https://example.org/pull/1"})
        self.assertEqual(status, 10, said)
        summary = self.summary()
        self.assertIn("B is slower: made.json", summary)
        self.assertIn("| made\\|up | pass.strands.time | 3 ms | 3.75 ms | +25.0 % |", summary)
        self.assertIn(
            "gh pr comment https://example.org/pull/1 --body-file build/gate/gate.md"
            " --edit-last --create-if-none", self.log.read_text())
        self.assertEqual((self.folder / "log.body").read_text(), summary)

    def test_passes_where_nothing_is(self):
        status, said = self.play(self.made_builds(slower=1), {})
        self.assertEqual(status, 0, said)
        self.assertIn("### = B is not slower: made.json", self.summary())
        self.assertIn("the same, or deciding nothing: 1<", self.summary())
        self.assertNotIn("gh", self.log.read_text())

    def test_says_that_a_side_failed(self):
        inputs = self.made_builds(slower=1) | {"a": "echo broken; false {out} {scene}"}
        status, said = self.play(inputs, {})
        self.assertEqual(status, 1, said)
        self.assertIn("Failed: ", self.summary())
        self.assertIn("broken", self.summary())

    def test_fails_without_a_base(self):
        self.work.mkdir()
        status, said = self.play({}, {})
        self.assertEqual(status, 2)
        self.assertIn("either --base or --a", said)


class GitLab(Repository):
    def test_gates_a_merge_request(self):
        need_device(self)
        page = (REPOSITORY / "docs" / "comparing.md").read_text().partition("### GitLab")[2]
        job = yaml.safe_load(re.search(r"^```yaml\n(.*?)^```$", page, re.M | re.S)[1])["gate"]
        self.make_branches()
        self.tool("apt-get", '#!/bin/sh\necho "apt-get $*" >>"$STAND_IN_LOG"\n')
        variables = job["variables"] | {
            "SCENE": SMOKE, "CI_MERGE_REQUEST_DIFF_BASE_SHA": "main",
            # Another density changes the pictures, which the warm-up shows.
            "OPTIONS": TINY + " --set-b /strands/density=2"}
        self.assertEqual(set(variables) - set(job["variables"]),
                         {"CI_MERGE_REQUEST_DIFF_BASE_SHA"})
        done = self.shell("\n".join(job["script"]), **variables)
        self.check_builds()
        self.assertEqual(done.returncode, 12, done.stdout)
        for path in job["artifacts"]["paths"]:
            self.assertEqual(sorted(each.name for each in (self.work / path).iterdir()),
                             ["gate.json", "gate.md", "gate.txt"])
        self.assertIn("Pictures or states differ", (self.work / "gate" / "gate.md").read_text())
        packages = self.log.read_text()
        for name in ("git", "python3"):
            self.assertRegex(packages, rf"apt-get install .*\b{name}\b")


class Workflow(unittest.TestCase):
    def test_runs_the_two_commands_of_the_readme(self):
        readme = (REPOSITORY / "README.md").read_text().partition("## Two commands")[2]
        block = re.search(r"^```\n(.*?)^```$", readme, re.M | re.S)[1]
        commands = [line.split()[0] for line in block.splitlines()]
        self.assertEqual(len(commands), 2)
        workflow = yaml.safe_load((REPOSITORY / ".github/workflows/ci.yml").read_text())
        steps = [step for job in workflow["jobs"].values() for step in job["steps"]]
        self.assertEqual([step["run"] for step in steps if "run" in step], commands)
        own = [step for step in steps if step.get("uses", "").startswith("./")]
        self.assertEqual([step["uses"] for step in own], ["./.github/actions/gate"])
        inputs = yaml.safe_load((ACTION / "action.yml").read_text())["inputs"]
        for step in own:
            self.assertLessEqual(set(step["with"]), set(inputs))

    def test_keeps_compiled_objects_between_runs(self):
        workflow = yaml.safe_load((REPOSITORY / ".github/workflows/ci.yml").read_text())
        for name, job in workflow["jobs"].items():
            caches = [step["with"] for step in job["steps"] if step.get("uses", "").startswith("actions/cache@")]
            self.assertEqual([cache["path"] for cache in caches], ["${{ env.CCACHE_DIR }}"], name)
            for line in caches[0]["restore-keys"].splitlines():
                self.assertTrue(caches[0]["key"].startswith(line), name)

    def test_the_page_names_every_input(self):
        page = (REPOSITORY / "docs" / "comparing.md").read_text()
        for name, each in yaml.safe_load((ACTION / "action.yml").read_text())["inputs"].items():
            self.assertRegex(page, rf"(?m)^\|.*`{name}`.*\|")
            if name in ("scene", "options", "out", "comment"):
                self.assertRegex(page, rf"(?m)^\| `{name}` \| `{re.escape(each['default'])}` \|")


class Release(Repository):
    FILES = {"CMakeLists.txt": "project(hairbench VERSION 1.2.3 LANGUAGES C)\n",
             "docs/CITATION.cff": "title: x\nversion: 1.2.3\n",
             "docs/CHANGELOG.md": "# Changes\n\n## 1.2.3\n\n* One\n"}

    def refusal(self, arguments, **changed):
        """Returns what scripts/release says of a commit of these files, which no build is made of."""
        scripts = self.work / "scripts"
        scripts.mkdir(parents=True, exist_ok=True)
        shutil.copy(REPOSITORY / "scripts" / "release", scripts)
        for path, text in (self.FILES | changed).items():
            (self.work / path).parent.mkdir(exist_ok=True)
            (self.work / path).write_text(text)
        git = "git -c user.name=Test -c user.email=test@example.org -c commit.gpgsign=false"
        done = self.shell(f"git init -q; git add -A; {git} commit -qm x --allow-empty\n"
                          f"touch changed; exec scripts/release {arguments}")
        self.assertEqual(done.returncode, 2, done.stdout)
        return done.stdout

    def test_refuses_what_is_not_one_version(self):
        self.assertIn("CMakeLists.txt: has version 1.2.3, not 1.2.4", self.refusal("1.2.4"))
        self.assertIn("CITATION.cff: has version 1.2.4, not 1.2.3",
                      self.refusal("1.2.3", **{"docs/CITATION.cff": "version: 1.2.4\n"}))
        for heading, said in {"1.2.4": "has no section 1.2.3", "1.2.3, in the making": "1.2.3 is in the making"}.items():
            self.assertIn(f"docs/CHANGELOG.md: {said}",
                          self.refusal("1.2.3", **{"docs/CHANGELOG.md": f"## {heading}\n\n* One\n"}))

    def test_refuses_changes_and_unknown_arguments(self):
        self.assertIn("the working tree has changes", self.refusal("1.2.3"))
        self.assertIn("unrecognized arguments: --fast", self.refusal("1.2.3 --fast"))
        self.assertIn("scripts: is not a release", self.refusal("1.2.3 scripts --ignore-changes"))


if __name__ == "__main__":
    unittest.main()

"""Builds the documentation's site and opens pages of it in headless Chromium.

Exits with status 77 without Chromium.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
BROWSER = os.environ.get("HAIRBENCH_BROWSER") or next(
    filter(shutil.which, ("chromium", "chromium-browser", "google-chrome")), None
)

# Describes a page as a reader sees it. Controls have the names that a screen reader says.
LOOK = """
const named = (each) => (each.getAttribute("aria-label") || each.title || each.textContent ||
    each.labels?.[0]?.textContent || "").trim();
const said = {
    complaints,
    resources: performance.getEntriesByType("resource").map((each) => each.name),
    language: document.documentElement.lang,
    unnamed: [...document.querySelectorAll("button, a[href], input:not([type=hidden])")]
        .filter((each) => !named(each) && !each.querySelector("img"))
        .map((each) => each.outerHTML.slice(0, 200)),
    pictures: [...document.images].filter((each) => !each.alt).map((each) => each.src),
    missing: [...document.images].filter((each) => !each.naturalWidth).map((each) => each.src),
    width: [document.documentElement.scrollWidth, innerWidth],
    panels: ["__navigation", "__toc"].filter((each) => {
        document.getElementById(each).focus();
        return document.activeElement.id === each;
    }),
    landmark: document.querySelectorAll("main, [role=main]").length,
    background: getComputedStyle(document.body).backgroundColor,
    found: document.querySelectorAll("#search-results li").length,
    excerpts: [...document.querySelectorAll("#search-results li p.context")].map((each) => each.textContent),
};
const text = JSON.stringify(said).replace(/[<>&]/g, (each) =>
    "\\\\u" + each.charCodeAt(0).toString(16).padStart(4, "0"));
if (parent === window) show(text); else parent.postMessage(text, "*");
"""

SHOW = """
const show = (text) => {
    const result = document.createElement("pre");
    result.id = "test-result";
    result.textContent = text;
    document.body.append(result);
};
"""

# Windows are at least 500 pixels wide; frames can be narrower.
FRAME = """<!doctype html><html style="color-scheme: light dark"><body>
<script>SHOW; addEventListener("message", (event) => show(event.data));</script>
<iframe src="watched.html" width="WIDTH" height="900" style="border: 0"></iframe></body></html>
"""


class Site(unittest.TestCase):
    @classmethod
    def setUpClass(cls) -> None:
        cls.folder = tempfile.TemporaryDirectory(prefix="hairbench-site-")
        cls.addClassCleanup(cls.folder.cleanup)
        cls.site = pathlib.Path(cls.folder.name).resolve() / "site"
        made = subprocess.run(
            ["scripts/docs", str(cls.site)], cwd=PROJECT, capture_output=True, text=True
        )
        if made.returncode != 0:
            raise RuntimeError(made.stderr)

    def look(
        self, page: str, *options: str, query: str = "", width: int = 1280, more: str = ""
    ) -> dict:
        """Returns the state of the page after four seconds of virtual time. The page is watched
        from its head on."""
        file = self.site / page
        watch = (PROJECT / "tests/report_page/watch.js").read_text()
        text = file.read_text().replace("<head>", f"<head><script>{watch}</script>{more}", 1)
        watched = file.with_name("watched.html")
        watched.write_text(text + f"<script>{SHOW} setTimeout(() => {{{LOOK}}}, 4000)</script>")
        opened = watched
        if width < 500:
            opened = file.with_name("frame.html")
            opened.write_text(FRAME.replace("SHOW;", SHOW).replace("WIDTH", str(width)))
        dom = subprocess.run(
            ["timeout", "120", BROWSER, "--headless=new", "--no-sandbox", "--disable-gpu"]
            + ["--disable-dev-shm-usage", "--host-resolver-rules=MAP * ~NOTFOUND"]
            + [f"--user-data-dir={self.folder.name}/profile", f"--window-size={width},900", *options]
            + ["--virtual-time-budget=8000", "--dump-dom", opened.as_uri() + query],
            check=True,
            capture_output=True,
            text=True,
        ).stdout
        watched.unlink()
        opened.unlink(missing_ok=True)
        return json.loads(re.search(r'<pre id="test-result">(.*?)</pre>', dom, re.DOTALL)[1])

    def expect_whole(self, said: dict) -> None:
        for nothing in ("complaints", "unnamed", "pictures", "missing"):
            self.assertEqual(said[nothing], [], nothing)
        # The browser's list leaves out files on the disk.
        self.assertEqual([each for each in said["resources"] if not each.startswith("data:")], [])
        self.assertTrue(said["language"])
        self.assertEqual(said["landmark"], 1)

    def test_opens_from_the_disk(self) -> None:
        said = self.look("index.html", width=1400)
        self.expect_whole(said)
        self.assertEqual(said["background"], "rgb(255, 255, 255)")
        self.assertEqual(said["panels"], [])  # the panels are there

    def test_fits_a_narrow_dark_screen(self) -> None:
        # This page has tables that are wider than the window.
        said = self.look(
            "docs/performance.html", "--blink-settings=preferredColorScheme=0", width=360
        )
        self.expect_whole(said)
        self.assertLessEqual(said["width"][0], said["width"][1])
        self.assertEqual(said["width"][1], 360)
        self.assertEqual(said["panels"], ["__navigation", "__toc"])
        self.assertLess(max(map(int, re.findall(r"\d+", said["background"])[:3])), 40)

    def test_searches_without_a_server(self) -> None:
        said = self.look("search.html", query="?q=tessellation")
        self.expect_whole(said)
        self.assertGreater(said["found"], 3)
        self.assertGreater(len(said["excerpts"]), 3)
        self.assertIn("tessellation", " ".join(said["excerpts"]).lower())

    def test_sees_what_comes_from_elsewhere(self) -> None:
        outside = "https://outside.invalid/"
        said = self.look(
            "docs/faq.html",
            more=f'<script src="{outside}a.js"></script><link rel="stylesheet" href="{outside}b.css">'
            + f"<style>@font-face {{ font-family: x; src: url({outside}c.woff) }} * "
            + "{ font-family: x }</style>",
        )
        self.assertEqual(
            {each for each in said["resources"] if each.startswith(outside)},
            {outside + "a.js", outside + "b.css", outside + "c.woff"},
        )
        self.assertGreater(len(said["complaints"]), 0)

    def test_knows_every_page(self) -> None:
        """Sphinx warns of a page outside every contents list and of a broken link."""
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder) / "source"
            (source / "docs").mkdir(parents=True)
            (source / "README.md").write_text("# Top\n\n[a](docs/stray.md#no) [b](nowhere.md)\n")
            (source / "docs/stray.md").write_text("# Stray\n")
            said = subprocess.run(
                [sys.executable, "-B", "-m", "sphinx", "-q", "-b", "html", "-c"]
                + [str(PROJECT / "docs/site"), str(source), f"{folder}/site"],
                capture_output=True,
                text=True,
            ).stderr
        self.assertIn("stray.md: WARNING: document isn't included in any toctree", said)
        self.assertIn("nowhere.md", said)
        self.assertRegex(said, "README.md:3: WARNING: .*'no'")


if __name__ == "__main__":
    if BROWSER is None:
        sys.exit(77)
    unittest.main()

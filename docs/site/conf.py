"""Makes a site from README.md and docs/, with Sphinx. scripts/docs runs it."""

import json
import pathlib
import re

project = "hairbench"
root_doc = "README"
extensions = ["myst_parser"]
html_theme = "furo"

# The order of the pages. Sphinx warns of a page that is missing here and of broken links, and
# scripts/docs treats warnings as errors.
PAGES = {
    "Start": ["docs/index", "docs/install", "docs/tutorial", "docs/viewer", "docs/gallery", "docs/faq"],
    "Measure": [
        "docs/scenes",
        "docs/fields",
        "docs/sweeps",
        "docs/measuring",
        "docs/comparing",
        "docs/results",
        "results/README",
    ],
    "Hair": [
        "docs/grooms",
        "scenes/assets/README",
        "docs/physics",
        "docs/rendering",
        "scenes/references/README",
    ],
    "Extend": ["docs/extending"],
    "Inside": [
        "docs/design",
        "docs/devices",
        "docs/performance",
        "docs/dependencies",
        "docs/thesis",
        "docs/paper",
        "tests/corpus/README",
        "tests/golden/README",
        "docs/CONTRIBUTING",
        "docs/CHANGELOG",
    ],
}
include_patterns = ["README.md", "docs/*.md", "*/*/README.md", "results/README.md"]
exclude_patterns = [".*", "build", "results/local"]

# Headings get GitHub's anchors, and quotes stay as written.
myst_heading_anchors = 6
smartquotes = False
highlight_language = "text"  # of boxes that name none

html_title = "hairbench"
html_show_sphinx = False
html_show_copyright = False
html_show_sourcelink = False
html_copy_source = False
html_theme_options = {"navigation_with_keys": False}
html_static_path = ["site.css"]
html_css_files = ["site.css"]


def add_navigation(_app, page: str, text: list[str]) -> None:
    """Adds the order of the pages to README.md, where GitHub would show it as text."""
    if page != root_doc:
        return
    for caption, pages in PAGES.items():
        lines = ["```{toctree}", ":hidden:", f":caption: {caption}", "", *pages, "```"]
        text[0] += "\n".join(["", *lines, ""])


# A page on the disk may not fetch another page, so the search has all pages in one script.
PAGES_SCRIPT = """
{
    const pages = %s;
    const ask = window.fetch;
    window.fetch = (url, ...rest) => {
        const page = pages[String(url).replace(/^\\.\\//, "")];
        return page === undefined ? ask(url, ...rest) : Promise.resolve(new Response(page));
    };
}
"""


def add_pages_to_search(app, page: str, *_others) -> None:
    if page == "search":
        app.add_js_file("pages.js")


def write_pages(app, error: "Exception | None") -> None:
    """Writes the text of every page for the excerpts that the search shows."""
    if error is not None or app.builder.format != "html":
        return
    pages, site = {}, pathlib.Path(app.outdir)
    for name in sorted(app.env.found_docs):
        text = (site / f"{name}.html").read_text(encoding="utf-8")
        main = re.search(r'<article role="main".*?</article>', text, re.DOTALL)
        pages[f"{name}.html"] = re.sub(r"<(script|style|img|svg)\b.*?>", "", main[0])
    script = PAGES_SCRIPT % json.dumps(pages).replace("</", "<\\/")
    (site / "_static" / "pages.js").write_text(script, encoding="utf-8")


def setup(app) -> dict:
    app.connect("source-read", add_navigation)
    app.connect("html-page-context", add_pages_to_search)
    app.connect("build-finished", write_pages)
    return {"parallel_read_safe": True}

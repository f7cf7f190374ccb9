"""The documentation as a site, of README.md and docs/ as they are. scripts/docs makes it."""

project = "hairbench"
root_doc = "README"
extensions = ["myst_parser"]
html_theme = "furo"

# Pages are read where they lie, and all of them have their place here: Sphinx warns of one that has
# not, and of links that lead nowhere, and scripts/docs takes warnings for errors.
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

# Headings have GitHub's anchors, and text stays as it was written.
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
    """The pages' order, which GitHub would show as text if README.md had it."""
    if page != root_doc:
        return
    for caption, pages in PAGES.items():
        lines = ["```{toctree}", ":hidden:", f":caption: {caption}", "", *pages, "```"]
        text[0] += "\n".join(["", *lines, ""])


def setup(app) -> dict:
    app.connect("source-read", add_navigation)
    return {"parallel_read_safe": True}

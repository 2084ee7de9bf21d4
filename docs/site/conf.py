"""Sphinx configuration of the site; bie/cmake/site.cmake runs it on a copy of the pages, laid out as the project is."""

import pathlib
import re

project = "vehd"
html_title = "vehd"
extensions = ["myst_parser", "sphinx.ext.mathjax"]
root_doc = "docs/index"
exclude_patterns = ["docs/site"]
notebooks = pathlib.Path(__file__).resolve().parents[2] / "notebooks_html"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

html_theme = "furo"
html_static_path = ["mathjax"]
html_show_copyright = False
# Formulas need no network: MathJax lies beside the pages.
mathjax_path = "MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"tex2jax": {"processClass": "math"}, "SVG": {"linebreaks": {"automatic": True}}, "messageStyle": "none"}


def complete_index(app, docname, source):
    """What only the site has; and a page that the index does not name still has its place, at the end."""
    if docname != root_doc:
        return
    source[0] += '\n<p><a href="../interfaces/files.html">Interfaces of all headers</a></p>\n'
    named = set(re.findall(r"^/(\S+)$", source[0], re.MULTILINE))
    others = sorted(app.env.found_docs - named - {root_doc})
    if others:
        entries = "\n".join("/" + name for name in others)
        source[0] += "\n```{toctree}\n:hidden:\n:caption: More\n\n" + entries + "\n```\n"


def link_notebooks(app, docname, source):
    """Links to notebooks lead to their executed form, where there is one."""
    if notebooks.is_dir():
        link = r"\[([^\]]*)\]\(((?:\.\./)*(?:docs/)?notebooks/\w+)\.ipynb\)"
        source[0] = re.sub(link, r'<a href="\2.html">\1</a>', source[0])


def setup(app):
    app.connect("source-read", complete_index)
    app.connect("source-read", link_notebooks)

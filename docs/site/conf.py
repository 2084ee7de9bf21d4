"""Sphinx configuration of the site; bie/cmake/site.cmake runs it on a copy of the pages, laid out as the project is."""

import pathlib
import re
import sys

project = "vehd"
html_title = "vehd"
extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax"]
root_doc = "docs/index"
exclude_patterns = ["docs/site/mathjax"]
pages = pathlib.Path(__file__).resolve().parents[2]
notebooks = pages / "notebooks_html"
# Docstrings and signatures stand in the sources of the module: neither its compiled part nor numpy is needed.
sys.path.insert(0, str(pages / "python_module"))
autodoc_mock_imports = ["numpy", "vehd._core"]
autodoc_member_order = "bysource"
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4

html_theme = "furo"
html_static_path = ["mathjax"]
html_show_copyright = False
# Formulas need no network: MathJax lies beside the pages.
mathjax_path = "MathJax.js?config=TeX-AMS_SVG"
mathjax2_config = {"tex2jax": {"processClass": "math"}, "SVG": {"linebreaks": {"automatic": True}}, "messageStyle": "none"}


def complete_index(app, docname, source):
    """Adds the pages that only the site has, and at the end those that the index does not name."""
    if docname != root_doc:
        return
    source[0] = source[0].replace("\n/docs/command_line\n", "\n/docs/command_line\n/docs/site/python_api\n")
    source[0] += ('\n<p><a href="site/python_api.html">Python API</a>, '
                  '<a href="../interfaces/files.html">interfaces of all headers</a></p>\n')
    named = set(re.findall(r"^/(\S+)$", source[0], re.MULTILINE))
    others = sorted(app.env.found_docs - named - {root_doc})
    if others:
        entries = "\n".join("/" + name for name in others)
        source[0] += "\n```{toctree}\n:hidden:\n:caption: More\n\n" + entries + "\n```\n"


def head_with_title(app, docname, source):
    """A page with a title in its front matter gets it as a heading above all others."""
    page = re.fullmatch(r"(---\n.*?\n---\n)(.*)", source[0], re.DOTALL)
    title = page and re.search(r"^title: *['\"]?(.*?)['\"]?$", page[1], re.MULTILINE)
    if title:
        source[0] = f"{page[1]}\n# {title[1]}\n" + re.sub(r"^#", "##", page[2], flags=re.MULTILINE)


def link_notebooks(app, docname, source):
    """Links to notebooks lead to their executed form, where there is one."""
    if notebooks.is_dir():
        link = r"\[([^\]]*)\]\(((?:\.\./)*(?:docs/)?notebooks/\w+)\.ipynb\)"
        source[0] = re.sub(link, r'<a href="\2.html">\1</a>', source[0])


def format_docstring(app, what, name, obj, options, lines):
    """Makes reStructuredText of a docstring in plain words: parameters and exceptions as a list, code as it is."""
    blocks = [block.split("\n") for block in re.split(r"\n\n+", "\n".join(lines).strip("\n"))]
    lines.clear()
    for block in blocks:
        if all(line.startswith("    ") for line in block):
            lines += ["::", "", *block, ""]
            continue
        indent = ""
        for line in block:
            item = re.match(r"([a-z]\w*(?:, [a-z]\w*)*|[A-Z]\w+Error(?:, [A-Z]\w+Error)*): ", line)
            if item:
                lines += ["", f"* ``{item[1]}``:"]
                indent = "  "
            # Names in backquotes are code; all else is text, whatever marks it has.
            parts = re.split(r"`([^`]*)`", line[item.end() if item else 0:].strip())
            lines.append(indent + "".join(f"``{part}``" if i % 2 else re.sub(r"([\\*_|])", r"\\\1", part)
                                          for i, part in enumerate(parts)))
        lines.append("")


def setup(app):
    app.connect("autodoc-process-docstring", format_docstring)
    app.connect("source-read", complete_index)
    app.connect("source-read", head_with_title)
    app.connect("source-read", link_notebooks)

"""Writes a student's and a teacher's edition of every notebook: python3 docs/notebooks/editions.py [-o FOLDER]

The student's edition ends before the answers. Links to pages lead to the pages beside the notebooks. With --html FOLDER
the notebooks are executed instead, and FOLDER has them as HTML with their figures, for the site; the exit code is 77 if
a module for that is missing.
"""

import argparse
import json
import os
import pathlib
import re
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
ANSWERS = "\n## Answers\n"


def without_answers(cells: list) -> list:
    """The cells before the heading of the answers, which may stand within a cell."""
    kept = []
    for cell in cells:
        before, heading, _ = "".join(cell["source"]).partition(ANSWERS)
        kept.append({**cell, "source": before.rstrip("\n").splitlines(keepends=True)} if heading else cell)
        if heading:
            return kept
    raise ValueError("a notebook without answers")


def with_links(cells: list, folder: pathlib.Path) -> list:
    """Cells whose links to pages lead there from another folder."""
    pages = os.path.relpath(HERE.parent, folder)
    return [{**cell, "source": [re.sub(r"\]\(\.\./", f"]({pages}/", line) for line in cell["source"]]}
            if cell["cell_type"] == "markdown" else cell for cell in cells]


def write_html(output: pathlib.Path) -> int:
    """Executes every notebook that this machine can execute. Formulas take the MathJax of the site, without network."""
    try:
        import matplotlib  # noqa: F401
        import nbformat
        import scipy  # noqa: F401
        import vehd
        from nbconvert import HTMLExporter
        from nbconvert.preprocessors import ExecutePreprocessor
    except ImportError as missing:
        print(f"notebooks are not executed: {missing}")
        return 77
    exporter = HTMLExporter(mathjax_url="../../_static/MathJax.js?config=TeX-AMS_SVG", require_js_url="")
    output.mkdir(parents=True, exist_ok=True)
    os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    for file in sorted(HERE.glob("*.ipynb")):
        book = nbformat.read(file, as_version=4)
        # Pages of the site are beside the notebooks.
        for cell in book.cells:
            if cell.cell_type == "markdown":
                cell.source = re.sub(r"\]\(([^):]+)\.(?:md|ipynb)(#[^)]*)?\)", r"](\1.html\2)", cell.source)
        if vehd.has_finite_elements() or "has_finite_elements" not in file.read_text():
            with tempfile.TemporaryDirectory() as folder:
                ExecutePreprocessor(timeout=300).preprocess(book, {"metadata": {"path": folder}})
        (output / f"{file.stem}.html").write_text(exporter.from_notebook_node(book)[0])
    return 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("out/notebooks"))
    parser.add_argument("--html", type=pathlib.Path)
    options = parser.parse_args()
    if options.html:
        return write_html(options.html.resolve())
    output = options.output.resolve()
    for file in sorted(HERE.glob("*.ipynb")):
        book = json.loads(file.read_text())
        for edition, cells in (("student", without_answers(book["cells"])), ("teacher", book["cells"])):
            folder = output / edition
            folder.mkdir(parents=True, exist_ok=True)
            text = json.dumps({**book, "cells": with_links(cells, folder)}, indent=1, ensure_ascii=False)
            (folder / file.name).write_text(text + "\n")
            print(folder / file.name)
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Writes a student's and a teacher's edition of every notebook: python3 docs/notebooks/editions.py [-o FOLDER]

The student's edition ends before the answers. Links to pages lead to the pages beside the notebooks.
"""

import argparse
import json
import os
import pathlib
import re

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


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=pathlib.Path, default=pathlib.Path("out/notebooks"))
    output = parser.parse_args().output.resolve()
    for file in sorted(HERE.glob("*.ipynb")):
        book = json.loads(file.read_text())
        for edition, cells in (("student", without_answers(book["cells"])), ("teacher", book["cells"])):
            folder = output / edition
            folder.mkdir(parents=True, exist_ok=True)
            text = json.dumps({**book, "cells": with_links(cells, folder)}, indent=1, ensure_ascii=False)
            (folder / file.name).write_text(text + "\n")
            print(folder / file.name)


if __name__ == "__main__":
    main()

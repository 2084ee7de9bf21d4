"""Executes the notebooks that are named, or all, one after the other in one kernel: python3 notebooks.py [NAME…]

Starting Jupyter takes longer than most of them. Each begins with nothing but what Python has loaded.
"""

import json
import os
import pathlib
import sys
import tempfile
from datetime import datetime

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "docs/notebooks"
NEEDS_ELEMENTS = "vehd.has_finite_elements()"


def problem_of(book: dict) -> str:
    """What a stored notebook must not be; empty if it is none of it."""
    for cell in book["cells"]:
        # A reader sees what the solver gives today; the history of the project shows changes of the text alone.
        if cell["cell_type"] == "code" and (cell["outputs"] or cell["execution_count"]):
            return "stored with outputs"
    headings = "".join("".join(cell["source"]) + "\n" for cell in book["cells"] if cell["cell_type"] == "markdown")
    if not ("\n## Exercises\n" in headings and "\n## Answers\n" in headings):
        return "without exercises or answers"
    for part in ("**Goals.**", "**Time.**", "**Read.**"):
        if part not in headings:
            return f"without {part}"
    return ""


def main() -> int:
    """0 if every cell of every one runs; 77 where nbconvert or what the notebooks need is missing."""
    try:
        import ipykernel  # noqa: F401
        import matplotlib  # noqa: F401
        import nbformat
        import scipy  # noqa: F401
        from nbconvert.preprocessors import ExecutePreprocessor
    except ImportError as missing:
        print(f"skipped: {missing} (Debian packages python3-nbconvert, python3-ipykernel, python3-matplotlib, "
              "python3-scipy)")
        return 77
    import vehd

    files = [FOLDER / (name + ".ipynb") for name in sys.argv[1:]] or sorted(FOLDER.glob("*.ipynb"))
    cells, starts, names = [], [], []
    for file in files:
        book = json.loads(file.read_text())
        if problem := problem_of(book):
            print(f"{file}: {problem}")
            return 1
        if any(NEEDS_ELEMENTS in "".join(cell["source"]) for cell in book["cells"]) and not vehd.has_finite_elements():
            print(f"{file.name}: skipped, the finite elements are not built (VEHD_FEM_CHECK)")
            continue
        starts.append(len(cells))
        names.append(file.name)
        cells.append(nbformat.v4.new_code_cell("%reset -f\n" + f"# {file.name}"))
        cells += nbformat.reads(file.read_text(), as_version=4).cells
    if not names:
        return 77
    for i, cell in enumerate(cells):
        cell["id"] = f"cell-{i}"
    together = nbformat.v4.new_notebook(cells=cells)
    # The kernel has modules without files; its debugger, which nobody asked for, warns of them.
    os.environ.setdefault("PYDEVD_DISABLE_FILE_VALIDATION", "1")
    with tempfile.TemporaryDirectory() as folder:
        ExecutePreprocessor(timeout=120).preprocess(together, {"metadata": {"path": folder}})
    for name, first, last in zip(names, starts, starts[1:] + [len(cells)]):
        print(f"{name}: every cell runs, {seconds_of(together.cells[first:last]):.0f} s")
    return 0


def seconds_of(cells: list) -> float:
    """From the first that was executed to the last."""
    times = [datetime.fromisoformat(time.replace("Z", "+00:00")) for cell in cells
             for time in cell.metadata.get("execution", {}).values()]
    return (max(times) - min(times)).total_seconds()


if __name__ == "__main__":
    sys.exit(main())

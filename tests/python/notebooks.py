"""Executes the notebooks that are named, or all: python3 notebooks.py [NAME…]"""

import json
import pathlib
import sys
import tempfile

FOLDER = pathlib.Path(__file__).resolve().parents[2] / "docs/notebooks"


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
    files = [FOLDER / (name + ".ipynb") for name in sys.argv[1:]] or sorted(FOLDER.glob("*.ipynb"))
    for file in files:
        book = json.loads(file.read_text())
        for cell in book["cells"]:
            # A reader sees what the solver gives today; the history of the project shows changes of the text alone.
            if cell["cell_type"] == "code" and (cell["outputs"] or cell["execution_count"]):
                print(f"{file}: stored with outputs")
                return 1
        with tempfile.TemporaryDirectory() as folder:
            ExecutePreprocessor(timeout=120).preprocess(nbformat.read(file, as_version=4), {"metadata": {"path": folder}})
        print(f"{file.name}: every cell runs")
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""Whether vehd check agrees with runs of shipped scenes and hard cases at some tolerances:

    python3 docs/examples/check_verdicts.py build/vehd --tolerance 1e-2,1e-4 relaxation figure5_two
    python3 docs/examples/check_verdicts.py build/vehd --tolerance 1e-2,1e-4            # all of docs/scenes
    python3 docs/examples/check_verdicts.py build/vehd --as-they-are hard               # all of tests/hard/scenes

Each scene runs to its end, to --until of it or, with --short, to its short_end_time, with degree and order of the
tolerance, and its last snapshot is checked. Printed are the verdict, the degree that was judged, the number of rows and
those that are not judged to agree, with the error that leaves them undecided. A run that stops before its end and a
scene that vehd check refuses are named and count for nothing. Exit code 1 if a row disagrees or is undecided without
such an error, or if a command fails; the last line names the scenes.
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
FOLDERS = {"shipped": ROOT / "docs/scenes", "hard": ROOT / "tests/hard/scenes"}
WHOLE_RUN = 1e9  # short_end_time of a scene without a short form
STOPPED, REFUSED = 3, 1  # exit codes of vehd run and vehd check


def scenes_of(names: list[str]) -> list[pathlib.Path]:
    """Names of scenes, of folders or paths."""
    found = []
    for name in names:
        if name in FOLDERS:
            found += sorted(FOLDERS[name].glob("*.toml"))
        elif name.endswith(".toml"):
            found.append(pathlib.Path(name))
        else:
            found.append(next(path for folder in FOLDERS.values() if (path := folder / f"{name}.toml").exists()))
    return found


def with_tolerance(text: str, tolerance: str | None) -> str:
    """The scene with degree and order of the tolerance; as it is without one."""
    if tolerance is None:
        return text
    text = re.sub(r"\n(degree|order|dt|tolerance|time_order) = .*", "", text)
    return text.replace("[numerics]", f"[numerics]\ntolerance = {tolerance}")


def shortened(text: str, share: float) -> str:
    """The scene to a share of its end, where that is a number with or without a unit."""
    def shorter(found: re.Match) -> str:
        return f"\nend_time = {found[1]}{share * float(found[2])!r}{found[3]}"
    return re.sub(r'\nend_time = ("?)([0-9.e+-]+)([^\n]*)', shorter, text) if share < 1.0 else text


def short_form(text: str) -> str:
    """The scene to its short_end_time, in reference units, if it has one."""
    found = re.search(r"^#: short_end_time = (.*)", text, re.MULTILINE)
    if found is None or float(found[1]) >= WHOLE_RUN:
        return text
    return re.sub(r"\nend_time = .*", f"\nend_time = {found[1]}", text)


def rows_of(result: dict) -> list[tuple[str, dict]]:
    """Of all vesicles, with their names."""
    rows = []
    for vesicle in result.get("vesicles", [result]):
        prefix = f"{vesicle['name']}: " if "name" in vesicle else ""
        for group in ("fields", "from_shape", "stored"):
            rows += [(f"{prefix}{group} {name}", row) for name, row in vesicle[group].items()]
    return rows


def reason(row: dict, required: float) -> str:
    large = [name for name, key in (("FEM", "fem_error"), ("run", "bie_error")) if not row[key] <= required]
    return " ".join(f"{name} {row['fem_error' if name == 'FEM' else 'bie_error']:.1e}" for name in large)


def check(program: str, scene: pathlib.Path, text: str, further: list[str], folder: pathlib.Path) -> tuple[str, bool]:
    """A line about it, and whether the verdict is false."""
    folder.mkdir(parents=True)
    given = folder / scene.name
    given.write_text(text)
    run = subprocess.run([program, "run", given, "-o", folder / "run", "--no-plot", "--quiet"],
                         capture_output=True, text=True)
    if run.returncode != 0:
        line = (run.stderr.strip() or run.stdout.strip() or f"exit {run.returncode}").splitlines()[-1]
        return f"no run: {line[:160]}", run.returncode != STOPPED
    report = folder / "check.json"
    checked = subprocess.run([program, "check", folder / "run/run.h5", "--no-plot", "--json", report, *further],
                             capture_output=True, text=True)
    if not report.exists():
        line = (checked.stderr.strip() or f"exit {checked.returncode}").splitlines()[-1]
        return f"no check: {line[:160]}", checked.returncode != REFUSED
    result = json.loads(report.read_text())
    rows, required = rows_of(result), result["required"]
    vesicles = result.get("vesicles", [result])
    degrees = " and ".join(str(vesicle["order"]) for vesicle in vesicles)
    line = f"{result['verdict']}, degree {degrees}, {len(rows)} rows"
    for verdict in ("disagree", "undecided"):
        named = [f"{name} ({row['l2']:.1e}; {reason(row, required)})" for name, row in rows
                 if row["counts"] and row["verdict"] == verdict]
        line += f"; {verdict}: {', '.join(named)}" if named else ""
    unexplained = [name for name, row in rows
                   if row["counts"] and row["verdict"] == "undecided" and not reason(row, required)]
    return line, result["verdict"] == "disagree" or len(unexplained) > 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("scenes", nargs="*", default=["shipped"], help="names, paths, shipped or hard")
    parser.add_argument("--tolerance", default="1e-2,1e-4", help="separated by commas")
    parser.add_argument("--as-they-are", action="store_true", help="with the numerics of the scene")
    parser.add_argument("--except", dest="left_out", default="", metavar="NAMES", help="separated by commas")
    parser.add_argument("--short", action="store_true", help="scenes to their short_end_time, if they have one")
    parser.add_argument("--until", type=float, default=1.0, metavar="SHARE", help="of the end of each scene")
    parser.add_argument("--check", default="--quick --ranks 1", help="further arguments of vehd check")
    arguments = parser.parse_intermixed_args()
    program = str(pathlib.Path(arguments.program).resolve())
    wrong = []
    for scene in scenes_of(arguments.scenes):
        if scene.stem in arguments.left_out.split(","):
            continue
        for tolerance in [None] if arguments.as_they_are else arguments.tolerance.split(","):
            text = scene.read_text()
            text = shortened(with_tolerance(short_form(text) if arguments.short else text, tolerance), arguments.until)
            with tempfile.TemporaryDirectory() as folder:
                line, is_false = check(program, scene, text, arguments.check.split(), pathlib.Path(folder) / "work")
            name = f"{scene.stem} {tolerance or 'as it is'}"
            print(f"{name}: {line}", flush=True)
            wrong += [name] if is_false else []
    print(f"false: {', '.join(wrong) or 'none'}")
    return int(len(wrong) > 0)


if __name__ == "__main__":
    sys.exit(main())

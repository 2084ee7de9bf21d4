"""Renews the printed output that pages show: python3 docs/examples/printed_output.py [--check] [PAGE…]

In a page a block ```text is the output of the block ```sh before it, a block ```console shows a command after "$ " and its
output, and a comment <!-- sh: … --> runs a command without showing it. "…" stands for any number of lines, at the end of a
line for its rest. All commands of a page run in one temporary folder, in their order. With --check nothing is written, and
the exit code is 1 if a page shows something else.

Numbers are compared to four digits. Seconds, megabytes, numbers of steps, and numbers below 1e-6, which rounding decides,
are not compared.
"""

import argparse
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PAGES = ("docs/first_steps.md", "docs/tutorial.md", "docs/fit.md", "docs/experiments/poration.md")
# The set-up ends with this run.
INSTEAD = {"cmake -P bie/setup.cmake": "build/vehd run docs/scenes/figure2.toml -o out/figure2"}
BLOCK = re.compile(r"^```(?P<kind>sh|text|console)\n(?P<body>.*?)^```$|^<!-- sh: (?P<hidden>[^\n]*) -->$", re.M | re.S)
MASKED = re.compile(r"[\d.]+(?= (?:s|MB)\b)|\d+(?= steps| rejected)|[\d.]+e-(?:0[7-9]|[1-9]\d)")
NUMBER = re.compile(r"(?<![\w.])[-+−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def words_of(line: str) -> list:
    """The line between its numbers."""
    return NUMBER.sub("#", MASKED.sub("#", line)).split()


def numbers_of(line: str) -> list:
    return [float(number.replace("−", "-")) for number in NUMBER.findall(MASKED.sub("#", line))]


def same(shown: str, printed: str) -> bool:
    pairs = zip(numbers_of(shown), numbers_of(printed))
    return all(abs(a - b) <= 1e-4 * max(abs(a), abs(b)) for a, b in pairs)


def like(shown: str, printed: str) -> bool:
    """Whether both lines have the same words."""
    if shown.endswith("…"):
        words = words_of(shown[:-1])
        return words_of(printed)[:len(words)] == words
    return words_of(shown) == words_of(printed)


def renewed(shown: str, printed: list, where: str) -> str:
    """The block with the numbers that were printed.

    ValueError: a line of the block is not printed any more; the block has to be edited.
    """
    lines, at = [], 0
    skipping = False
    for line in shown.splitlines():
        if line == "…":
            skipping = True
        else:
            last = len(printed) if skipping else at + 1
            found = next((i for i in range(at, min(last, len(printed))) if like(line, printed[i])), None)
            if found is None:
                near = printed[at] if at < len(printed) else "the end"
                raise ValueError(f"{where}: shown but not printed: {line!r}; printed: {near!r}")
            if not same(line, printed[found]):
                shown_words = len(line.rstrip("…").split())
                rest = " …" if line.endswith("…") else ""
                line = re.match(rf"(\s*\S+){{{shown_words}}}", printed[found])[0] + rest
            at, skipping = found + 1, False
        lines.append(line)
    return "\n".join(lines) + "\n"


def output_of(command: str, folder: str) -> list:
    """Lines on standard output; of a command that fails its message."""
    done = subprocess.run(["sh", "-c", INSTEAD.get(command.strip(), command)], cwd=folder, capture_output=True, text=True,
                          check=False)
    return [line.rstrip() for line in (done.stderr if done.returncode else done.stdout).splitlines()]


def renewed_page(page: pathlib.Path, program: pathlib.Path) -> str:
    text = page.read_text()
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "build").mkdir()
        (pathlib.Path(folder) / "build/vehd").symlink_to(program)
        shutil.copytree(ROOT / "docs", pathlib.Path(folder) / "docs", ignore=shutil.ignore_patterns("*.png"))
        printed: list = []

        def block(match: re.Match) -> str:
            nonlocal printed
            if match["hidden"]:
                output_of(match["hidden"], folder)
                return match[0]
            kind, body = match["kind"], match["body"]
            where = f"{page.name}:{text.count(chr(10), 0, match.start()) + 1}"
            if kind == "sh":
                printed = output_of(body, folder)
            elif kind == "text":
                body = renewed(body, printed, where)
            elif body.startswith("$ "):
                command, _, shown = body.partition("\n")
                body = command + "\n" + renewed(shown, output_of(command[2:], folder), where)
            return f"```{kind}\n{body}```"

        return BLOCK.sub(block, text)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", nargs="*", default=PAGES)
    parser.add_argument("--check", action="store_true", help="compare only")
    parser.add_argument("--program", type=pathlib.Path, default=ROOT / "build/vehd")
    options = parser.parse_args()
    different = False
    for name in options.pages:
        page = ROOT / name
        try:
            new = renewed_page(page, options.program.resolve())
        except ValueError as problem:
            print(problem)
            different = True
            continue
        old = page.read_text()
        different |= new != old and options.check
        for before, after in zip(old.splitlines(), new.splitlines()):
            if before != after:
                print(f"{name}: {before}\n{' ' * len(name)}  {after}")
        if not options.check:
            page.write_text(new)
    return int(different)


if __name__ == "__main__":
    sys.exit(main())

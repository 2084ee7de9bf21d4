"""The most memory that a command and all processes that it starts take together, and its seconds:

    python3 docs/examples/memory_of_processes.py build/vehd check docs/checks/shape33.toml --set numerics.degree=40

Pages that several processes share are counted once (Pss of /proc/PID/smaps_rollup), five times a second.
"""

import pathlib
import subprocess
import sys
import time

PROCESSES = pathlib.Path("/proc")


def family(root: int) -> set:
    """The process and all that descend from it."""
    parents = {}
    for stat in PROCESSES.glob("[0-9]*/stat"):
        try:
            parents[int(stat.parent.name)] = int(stat.read_text().rpartition(")")[2].split()[1])
        except OSError:
            continue  # ended meanwhile
    members = {root}
    while more := {child for child, parent in parents.items() if parent in members} - members:
        members |= more
    return members


def kilobytes(process: int) -> int:
    """Its share of the pages that it uses; 0 once it has ended."""
    try:
        lines = (PROCESSES / str(process) / "smaps_rollup").read_text().splitlines()
    except OSError:
        return 0
    return sum(int(line.split()[1]) for line in lines if line.startswith("Pss:"))


def main() -> int:
    start, most = time.monotonic(), 0
    with subprocess.Popen(sys.argv[1:]) as command:
        while command.poll() is None:
            most = max(most, sum(map(kilobytes, family(command.pid))))
            time.sleep(0.2)
    print(f"{most / 1e6:.2f} GB, {time.monotonic() - start:.1f} s")
    return command.returncode


if __name__ == "__main__":
    sys.exit(main())

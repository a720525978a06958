#!/usr/bin/env python3
"""What a second core brings `creepage sweep`: one thread and two, in turn.

    python3 benches/second_core.py target/release/creepage [SPEC.toml]

prints the load of the machine, and the median over neighbours of the ratio of wall times. Where others use the cores the
wall tells about them; then look at the second line: processor time of one thread alone, by that of the busier of two,
which is what the wall would show were both cores free (caches and memory shared as they are). Linux.
"""

import os
import pathlib
import statistics
import subprocess
import sys
import tempfile
import time

ROUNDS = 9


def spent_by_threads(pid):
    """Nanoseconds of processor time of every thread."""
    found = {}
    try:
        for task in os.listdir(f"/proc/{pid}/task"):
            found[task] = int(pathlib.Path(f"/proc/{pid}/task/{task}/schedstat").read_text().split()[0])
    except (OSError, ValueError, IndexError):
        pass
    return found


def run(program, spec, threads, folder):
    """Wall time, and processor time of the busiest thread."""
    out = pathlib.Path(folder) / f"{threads}.csv"
    out.unlink(missing_ok=True)
    start, spent = time.perf_counter(), {}
    process = subprocess.Popen([program, "sweep", spec, "--out", out, "--threads", str(threads), "--quiet"])
    while process.poll() is None:
        spent.update(spent_by_threads(process.pid))
        time.sleep(2e-3)
    assert process.returncode == 0
    return time.perf_counter() - start, max(spent.values()) * 1e-9, out.read_bytes()


def main():
    program = sys.argv[1]
    spec = sys.argv[2] if len(sys.argv) > 2 else pathlib.Path(__file__).parent / "wheels.toml"
    with tempfile.TemporaryDirectory(prefix="creepage-cores-") as folder:
        run(program, spec, 2, folder)
        pairs = [(run(program, spec, 1, folder), run(program, spec, 2, folder)) for _ in range(ROUNDS)]
    assert all(one[2] == two[2] for one, two in pairs), "the tables differ"
    wall, busy = ([one[i] / two[i] for one, two in pairs] for i in range(2))
    one, two = (statistics.median(pair[i][0] for pair in pairs) for i in range(2))
    print(f"load {os.getloadavg()[0]:.2f}; one thread {one:.2f} s, two {two:.2f} s")
    low, _, high = statistics.quantiles(wall)
    print(f"wall: {statistics.median(wall):.2f} times faster (quartiles {low:.2f} to {high:.2f})")
    low, _, high = statistics.quantiles(busy)
    print(f"busiest thread: {statistics.median(busy):.2f} times less (quartiles {low:.2f} to {high:.2f})")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""creepage beside SciPy, JAX with diffrax, and CasADi, on one core: the same work, timed in turn.

    python3 benches/peers/run.py

makes a virtual environment in target/peers with the pinned requirements, builds the benchmark, times every pair in turn
(creepage, peer, creepage, peer ...), then creepage beside code by hand (criterion, in one process), and writes
benches/TABLE.md, which book/src/guide/speed.md shows between its markers. Needs gcc for the code that CasADi generates.
"""

import json
import os
import pathlib
import platform
import re
import shutil
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
HOME = ROOT / "target" / "peers"
ROUNDS = 7


def in_environment():
    """Starts this script again in the environment, which is made when missing."""
    python = HOME / "bin" / "python"
    wanted = (HERE / "requirements.txt").read_bytes()
    stamp = HOME / "requirements.txt"
    if not stamp.exists() or stamp.read_bytes() != wanted:
        subprocess.run([sys.executable, "-m", "venv", HOME], check=True)
        subprocess.run([python, "-m", "pip", "install", "--quiet", "-r", HERE / "requirements.txt"], check=True)
        stamp.write_bytes(wanted)
    core = {"OMP_NUM_THREADS": "1", "RAYON_NUM_THREADS": "1", "CREEPAGE_PEERS": "1"}
    core["XLA_FLAGS"] = "--xla_cpu_multi_thread_eigen=false intra_op_parallelism_threads=1"
    os.execve(python, [str(python), str(pathlib.Path(__file__).resolve()), *sys.argv[1:]], {**os.environ, **core})


def built():
    """The benchmark as a program."""
    command = ["cargo", "bench", "--manifest-path", "benches/Cargo.toml", "--no-run", "--message-format=json"]
    out = subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.PIPE, text=True).stdout
    found = [json.loads(line) for line in out.splitlines() if line.startswith("{")]
    return next(m["executable"] for m in found if m.get("executable") and m["target"]["name"] == "speed")


class Creepage:
    """The benchmark, which does a batch of the work it is told and answers with seconds a unit."""

    def __init__(self, program):
        pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE}
        self.process = subprocess.Popen([program, "serve"], text=True, **pipes)

    def __call__(self, work):
        print(work, file=self.process.stdin, flush=True)
        return float(self.process.stdout.readline())


def compare(ours, theirs):
    """Medians of both, and of the ratios of neighbours."""
    theirs(), ours()
    pairs = [(ours(), theirs()) for _ in range(ROUNDS)]
    a, b = zip(*pairs)
    return statistics.median(a), statistics.median(b), statistics.median(y / x for x, y in pairs)


def time_of(seconds):
    for size, unit in [(1.0, "s"), (1e-3, "ms"), (1e-6, "µs")]:
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


def machine():
    try:
        cpu = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text()).group(1)
    except (OSError, AttributeError):
        cpu = platform.processor() or platform.machine()
    return f"{cpu.strip()}, {os.cpu_count()} processors, {platform.system()} {platform.machine()}"


class Measured:
    """What criterion left: seconds an element and ratios, each a median with its interval of 95 %."""

    def __init__(self, program):
        home = HOME / "criterion"
        shutil.rmtree(home, ignore_errors=True)
        subprocess.run([program, "--bench"], cwd=ROOT, check=True, env={**os.environ, "CRITERION_HOME": str(home)})
        self.found = {}
        for path in home.glob("**/new/benchmark.json"):
            what = json.loads(path.read_text())
            median = json.loads(path.with_name("estimates.json").read_text())["median"]
            bounds = median["confidence_interval"]
            values = [median["point_estimate"], bounds["lower_bound"], bounds["upper_bound"]]
            units = (what["throughput"] or {}).get("Elements", 1)
            name = what["function_id"] or what["value_str"]
            self.found.setdefault(what["group_id"], {})[name] = [v / units for v in values]

    def compared(self):
        """Works that have a yardstick, the largest first, with what was measured and the yardstick's name."""
        works = {work: by for work, by in self.found.items() if "ratio" in by}
        for work, by in sorted(works.items(), key=lambda item: -item[1]["creepage"][0]):
            yield work, by, next(name for name in by if name not in ("creepage", "ratio"))

    def by_hand(self):
        """Rows of the works that have a yardstick."""
        for work, by, yardstick in self.compared():
            ratio, low, high = by["ratio"]
            times = f"{time_of(by['creepage'][0])} | {time_of(by[yardstick][0])}"
            yield f"| {work} | {yardstick} | {times} | {ratio:.2f} ({low:.2f}–{high:.2f}) |"

    def apart(self):
        """Quotients of the times over the ratios, which are measured apart from them: the least and the largest."""
        quotients = [by["creepage"][0] / by[yardstick][0] / by["ratio"][0] for _, by, yardstick in self.compared()]
        return min(quotients), max(quotients)

    def growth(self):
        """Rows of trailers, columns of works."""
        for size in sorted(self.found[GROWTH[0]], key=int):
            yield f"| {size} | " + " | ".join(time_of(self.found[work][size][0]) for work in GROWTH) + " |"


GROWTH = ["rows of a train", "J v of a train", "rows by one length", "Jacobian of a train"]
BY_HAND_IS = """\
By hand, in the same process. Each time is a median of samples of that work alone, one work after the other; the ratio is measured
by itself, both in turn within every sample, so that a drift of the machine's speed drops out. By the times alone the ratios would
be {:.2f} to {:.2f} times as large: where they differ, the ratio holds."""
BY_HAND = ["| work | yardstick | creepage | yardstick | ratio (95 %) |", "|---|---|---|---|---|"]
GROWS = ["| trailers | rows | J·v | by one length | Jacobian, an entry |", "|---|---|---|---|---|"]


def table():
    import works

    program = built()
    creepage = Creepage(program)
    rows = ["| work | creepage | peer | | times faster |", "|---|---|---|---|---|"]
    for title, work, peer, run in works.all_of_them():
        ours, theirs, ratio = compare(lambda: creepage(work), run)
        rows.append(f"| {title} | {time_of(ours)} | {peer} | {time_of(theirs)} | {ratio:.3g} |")
        print(rows[-1], flush=True)
    measured = Measured(program)
    note = (
        f"One core of: {machine()}. Written by `python3 benches/peers/run.py`; times are medians, ratios medians of\n"
        f"neighbouring batches. SciPy {works.version('scipy')}, JAX {works.version('jax')}, diffrax "
        f"{works.version('diffrax')}, CasADi {works.version('casadi')}.\n"
    )
    hand = ["", BY_HAND_IS.format(*measured.apart()), "", *BY_HAND, *measured.by_hand()]
    costs = ["", "How costs grow: a lane, a trailer; of the Jacobian, an entry that is not zero.", "", *GROWS]
    return "\n".join([note, *rows, *hand, *costs, *measured.growth(), ""])


def show(text):
    (ROOT / "benches" / "TABLE.md").write_text(text)
    page = ROOT / "book" / "src" / "guide" / "speed.md"
    old = page.read_text()
    new = re.sub(r"(<!-- speed -->\n).*?(<!-- /speed -->)", lambda m: m[1] + text + m[2], old, flags=re.S)
    page.write_text(new)


if __name__ == "__main__":
    if "CREEPAGE_PEERS" not in os.environ:
        in_environment()
    sys.path.insert(0, str(HERE))
    show(table())

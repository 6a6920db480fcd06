"""Runs one scene through Conik, pink, mink and placo, and prints what each makes of it as a table.

    pip install . pin-pink==4.4.0 mink==1.3.0 placo==0.10.2 daqp==0.11.0
    python examples/compare/run.py [--quick] [--page docs/compare.md]

A library that is not installed is left out, and said so. `docs/compare.md` says how the scene is given to each.
"""

import argparse
import importlib
import json
import os
import platform
import statistics
import subprocess
import sys
import time
from importlib.metadata import version
from pathlib import Path

import numpy as np
import scene

LIBRARIES = ["conik", "pink", "mink", "placo"]
# The table of the page stands between these two lines.
BEGIN, END = "<!-- figures: examples/compare/run.py -->\n", "<!-- end of figures -->\n"
QUICK_S = 14.0


def run(library, duration_s):
    """What one library makes of the scene."""
    solver_of = importlib.import_module(f"with_{library}")
    solver = solver_of.Solver()
    solver.set_target(scene.WAYPOINTS_M[0])
    q = scene.START
    times, reached = [], []
    entered, worst = {}, {}
    for tick in range(int(duration_s * scene.RATE_HZ)):
        t = tick / scene.RATE_HZ
        tool, values = scene.values(q)
        for name, value in values.items():
            outside = scene.outside(name, value)
            if outside <= 0.0:
                entered.setdefault(name, t)
            if name in entered:
                worst[name] = max(worst.get(name, -np.inf), outside)
        if len(reached) < len(scene.WAYPOINTS_M):
            if np.linalg.norm(tool - scene.WAYPOINTS_M[len(reached)]) < scene.ACCEPTANCE_M:
                reached.append(t)
                if len(reached) < len(scene.WAYPOINTS_M):
                    solver.set_target(scene.WAYPOINTS_M[len(reached)])
        begin = time.perf_counter()
        q = solver.step(q)
        times.append(time.perf_counter() - begin)
    return {
        "library": library,
        "version": version(solver_of.PACKAGE),
        "step_us": 1e6 * statistics.median(times),
        "reached_s": reached,
        "view_entered_s": entered.get("view"),
        "worst": worst,
    }


def run_apart(library, duration_s):
    """The same in a process of its own: libraries that load the same things in other versions do not meet."""
    command = [sys.executable, __file__, "--only", library, "--seconds", str(duration_s)]
    # One thread each, so that no library is faster for having more of them.
    environment = {**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(command, capture_output=True, text=True, env=environment)
    if done.returncode != 0:
        lines = done.stderr.strip().splitlines() or ["no message"]
        return {"library": library, "error": lines[-1]}
    return json.loads(done.stdout.splitlines()[-1])


def distance(outside_m):
    """A violation for people: 0 if there is none."""
    return "0" if outside_m <= 0.0 else f"{1e6 * outside_m:.0f} µm"


def table(rows):
    """Rows of figures as a table in markdown."""
    lines = [
        "| | version | median step | waypoint 1, 2 reached | view entered | outside obstacle a, b | outside view, then |",
        "|---|---|---:|---:|---:|---:|---:|",
    ]
    for row in rows:
        if "error" in row:
            lines.append(f"| {row['library']} | | not run: {row['error']} | | | | |")
            continue
        times = " / ".join(f"{reached:.2f}" for reached in row["reached_s"])
        entered, worst = row["view_entered_s"], row["worst"]
        view = "" if entered is None else "0" if worst["view"] <= 0.0 else f"{worst['view']:.0e}"
        cells = [
            row["library"],
            row["version"],
            f"{row['step_us']:.0f} µs",
            f"{times} s",
            "never" if entered is None else f"{entered:.2f} s",
            f"{distance(worst['obstacle_a'])} / {distance(worst['obstacle_b'])}",
            view,
        ]
        lines.append(f"| {' | '.join(cells)} |")
    return "\n".join(lines) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--quick", action="store_true", help=f"{QUICK_S} s of the scene instead of {scene.DURATION_S}")
    parser.add_argument("--page", type=Path, help="write the table into this page")
    parser.add_argument("--json", action="store_true", help="print the figures as JSON too, in one line")
    parser.add_argument("--only", choices=LIBRARIES, help=argparse.SUPPRESS)
    parser.add_argument("--seconds", type=float, help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.only:
        print(json.dumps(run(arguments.only, arguments.seconds)))
        return

    duration_s = QUICK_S if arguments.quick else scene.DURATION_S
    rows = [run_apart(library, duration_s) for library in LIBRARIES]
    figures = table(rows)
    print(figures)
    if arguments.json:
        print(json.dumps(rows))
    if arguments.page:
        text = arguments.page.read_text()
        before, rest = text.split(BEGIN)
        _, after = rest.split(END)
        where = f"Python {platform.python_version()}, {platform.machine()}, one thread; all steps are called from Python."
        arguments.page.write_text(f"{before}{BEGIN}\n{figures}\n{where}\n\n{END}{after}")


if __name__ == "__main__":
    main()

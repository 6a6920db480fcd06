"""Runs the examples in Python as their first lines say, and looks at what they did.

    python3 tests/examples/run.py [--conik PATH]

What they need is installed into an environment of their own. Exit status 1 if one of them fails.
"""
import argparse
import json
import subprocess
import sys
import urllib.request
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from environment import ROOT, TARGET, provide_conik, provide_packages  # noqa: E402

PACKAGES = ["websockets==15.0.1"]
# Seconds after which an example counts as hung.
PATIENCE = 120


def check_live(conik, python):
    """examples/live.py moves a bound and a target, and takes both back."""
    scenario = "scenarios/paper/example2.toml"
    command = [conik, "view", scenario, "--quiet", "--mode-rule", "cone", "--border", "land"]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as process:
        try:
            page = process.stdout.readline().strip()
            example = [python, "examples/live.py", page, "--seconds", "15"]
            done = subprocess.run(example, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE)
            print(done.stdout + done.stderr)
            if done.returncode != 0 or "all changes taken back" not in done.stdout:
                return "examples/live.py did not come to its end"
            with urllib.request.urlopen(page + "recording.json", timeout=PATIENCE) as answer:
                run = json.load(answer)["runs"][0]
        finally:
            process.terminate()
    columns, times = run["ticks"]["columns"], run["ticks"]["t_s"]
    # The bound goes from 18 to 22 cm and back; where the arm is held at it, it goes along.
    if max(columns["obstacle_a"]) < 0.21 or times[-1] < 15.0:
        return "the bound did not move the arm"
    (task,) = [task for task in run["scene"]["tasks"] if task["name"] == "obstacle_a"]
    if task["min"] != 0.18:
        return f"the bound was not taken back: {task['min']}"
    return None


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--conik", type=Path, help="the command [default: built here]")
    parser.add_argument("--environment", type=Path, default=TARGET / "examples-python")
    arguments = parser.parse_args()

    conik = Path(provide_conik(arguments.conik)).resolve()
    python = provide_packages(arguments.environment, PACKAGES)
    checks = [check_live]
    failed = [error for check in checks if (error := check(conik, python))]
    for error in failed:
        print(f"FAILED: {error}")
    print(f"{len(checks) - len(failed)} passed, {len(failed)} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())

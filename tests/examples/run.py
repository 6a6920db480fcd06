"""Runs the examples as their first lines say, and looks at what they did.

    python3 tests/examples/run.py [--conik PATH] [--wheel PATH] [--only NAME]

An example prints figures. Those of a pair in Rust and in Python are the same, to the last digit; and all are as
`claims.py` says. What the examples need is installed into an environment of their own. Exit status 1 if one of
them fails.
"""
import argparse
import json
import os
import re
import subprocess
import sys
import tempfile
import time
import urllib.request
import xml.etree.ElementTree as xml
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from claims import PAIRS, PYTHON, broken, figures  # noqa: E402
from environment import ROOT, TARGET, provide_conik, provide_packages, provide_wheel  # noqa: E402

PACKAGES = [
    "daqp==0.11.0",
    "ipykernel==7.4.0",
    "matplotlib==3.11.2",
    "maturin==1.13.1",
    "mink==1.3.0",
    "mujoco==4.0.0",
    "nbclient==0.11.0",
    "nbformat==5.11.1",
    "numpy==2.3.5",
    "pin-pink==4.4.0",
    "pin==3.8.0",
    "placo==0.10.2",
    "rerun-sdk==0.41.0",
    "websockets==15.0.1",
]
# Seconds after which an example counts as hung.
PATIENCE = 120
EXAMPLES = ROOT / "examples"
# What a comparison may be off for a library to be said to solve the scene: the sets to a millimetre.
SETS_M = 1e-3


class Failed(Exception):
    """What an example did not do."""


def output_of(command, **more):
    """What a command prints."""
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE, **more)
    if done.returncode != 0:
        raise Failed(f"exit status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


def output_of_python(python, name, folder):
    """What an example in Python prints; with a picture, if there is one beside it."""
    command = [python, EXAMPLES / f"{name}.py"]
    if (EXAMPLES / f"{name}.svg").exists():
        picture = folder / f"{name}.svg"
        output = output_of([*command, "--picture", picture])
        if not list(xml.parse(picture).getroot()):
            raise Failed("its picture is empty")
        return output
    return output_of(command)


def check_claims(output, claims):
    wrong = broken(figures(output), claims)
    if wrong:
        raise Failed("\n".join(wrong))


def check_pair(name, claims, python, folder):
    """The same figures in both languages, and what is claimed of them."""
    in_python = output_of_python(python, name, folder)
    # Of the whole workspace, which the Rust tests have built.
    output_of(["cargo", "build", "--quiet", "--workspace", "--example", name])
    in_rust = output_of([TARGET / "debug" / "examples" / name])
    # The runs are the same to the bit, so the figures are to the last digit.
    if in_python != in_rust:
        raise Failed(f"in Python\n{in_python}and in Rust\n{in_rust}")
    check_claims(in_python, claims)


def check_rerun(python, folder):
    """A recording that Rerun itself can read."""
    recording = folder / "run.rrd"
    check_claims(output_of([python, EXAMPLES / "12_rerun.py", recording]), PYTHON["12_rerun"])
    # As in the example, nothing is to be collected of this.
    silent = {**os.environ, "CI": "true", "TELEMETRY_ENABLED": "false"}
    output_of([python.parent / "rerun", "rrd", "verify", recording], env=silent)
    printed = output_of([python.parent / "rerun", "rrd", "print", recording], env=silent)
    for entity in ("/world/arm", "/tasks/view/value", "/tasks/obstacle_a/held", "/joints/elbow_joint"):
        if entity not in printed:
            raise Failed(f"{entity} is not in the recording")


def check_comparison(python):
    """Every library gets to the first waypoint, and Conik leaves no set."""
    output = output_of([python, EXAMPLES / "compare" / "run.py", "--quick", "--json"])
    rows = {row["library"]: row for row in json.loads(output.splitlines()[-1])}
    for library in ("conik", "pink", "mink", "placo"):
        row = rows[library]
        if "error" in row:
            raise Failed(f"{library}: {row['error']}")
        if not row["reached_s"] or row["reached_s"][0] > 12.5:
            raise Failed(f"{library} does not get to the first waypoint: {row['reached_s']}")
        if max(row["worst"].values()) > (0.0 if library == "conik" else SETS_M):
            raise Failed(f"{library} leaves a set: {row['worst']}")


def check_page_of_comparison():
    """The page names the versions that are tested here."""
    page = (ROOT / "docs" / "compare.md").read_text()
    for package in PACKAGES:
        name, version = package.split("==")
        if f"{name}==" in page and package not in page:
            raise Failed(f"docs/compare.md has another version of {name} than {version}")


def check_readme():
    """Every example stands in the table, and every link there leads somewhere."""
    text = (EXAMPLES / "README.md").read_text()
    for link in re.findall(r"\]\(([^)#]+)[^)]*\)", text):
        if "://" not in link and not (EXAMPLES / link).exists():
            raise Failed(f"its link {link} leads nowhere")
    for example in EXAMPLES.glob("[0-9]*"):
        if f"({example.name})" not in text:
            raise Failed(f"{example.name} is not in it")


def check_live(conik, python):
    """examples/live.py moves a bound and a target, and takes both back."""
    scenario = "scenarios/paper/example2.toml"
    command = [conik, "view", scenario, "--quiet", "--mode-rule", "cone", "--border", "land"]
    with subprocess.Popen(command, cwd=ROOT, stdout=subprocess.PIPE, text=True) as process:
        try:
            page = process.stdout.readline().strip()
            example = [python, "examples/live.py", page, "--seconds", "15"]
            done = subprocess.run(example, cwd=ROOT, capture_output=True, text=True, timeout=PATIENCE)
            if done.returncode != 0 or "all changes taken back" not in done.stdout:
                raise Failed(f"it did not come to its end\n{done.stdout}{done.stderr}")
            with urllib.request.urlopen(page + "recording.json", timeout=PATIENCE) as answer:
                run = json.load(answer)["runs"][0]
        finally:
            process.terminate()
    columns, times = run["ticks"]["columns"], run["ticks"]["t_s"]
    # The bound goes from 18 to 22 cm and back; where the arm is held at it, it goes along.
    if max(columns["obstacle_a"]) < 0.21 or times[-1] < 15.0:
        raise Failed("the bound did not move the arm")
    (task,) = [task for task in run["scene"]["tasks"] if task["name"] == "obstacle_a"]
    if task["min"] != 0.18:
        raise Failed(f"the bound was not taken back: {task['min']}")


def checks(arguments, python, folder):
    """Name and check of each example, in order."""
    for name, claims in PAIRS.items():
        yield name, lambda name=name, claims=claims: check_pair(name, claims, python, folder)
    for name, claims in PYTHON.items():
        if name != "12_rerun":
            yield name, lambda name=name, claims=claims: check_claims(output_of_python(python, name, folder), claims)
    yield "12_rerun", lambda: check_rerun(python, folder)
    notebook = [python, HERE / "notebook.py", EXAMPLES / "13_notebook.ipynb"]
    yield "13_notebook", lambda: output_of(notebook)
    yield "compare", lambda: check_comparison(python)
    yield "docs/compare.md", check_page_of_comparison
    yield "README.md", check_readme
    yield "live", lambda: check_live(Path(provide_conik(arguments.conik)).resolve(), python)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--conik", type=Path, help="the command [default: built here]")
    parser.add_argument("--wheel", type=Path, help="the Python package [default: built here]")
    parser.add_argument("--only", help="the name of one example")
    parser.add_argument("--environment", type=Path, default=TARGET / "examples-python")
    arguments = parser.parse_args()

    python = provide_packages(arguments.environment.absolute(), PACKAGES)
    provide_wheel(python, arguments.wheel and arguments.wheel.resolve())
    passed, failed = 0, 0
    with tempfile.TemporaryDirectory() as folder:
        for name, check in checks(arguments, python, Path(folder)):
            if arguments.only not in (None, name):
                continue
            begin = time.monotonic()
            try:
                check()
            except (Failed, subprocess.TimeoutExpired, OSError, ValueError) as error:
                failed += 1
                print(f"{name}: FAILED: {error}")
            else:
                passed += 1
                print(f"{name}: as claimed ({time.monotonic() - begin:.1f} s)")
    print(f"{passed} passed, {failed} failed")
    # A name that is not there has passed nothing.
    return 1 if failed or not passed else 0


if __name__ == "__main__":
    sys.exit(main())

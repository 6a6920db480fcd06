"""Runs scenarios, exports them, and has the formats' own readers check what is in the files.

    python3 tests/exports/run.py [--conik PATH]

The readers are installed into an environment of their own. Exit status 1 if one of them, or a
comparison with log.csv, finds something wrong.
"""
import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from environment import ROOT, TARGET, provide_conik, provide_packages  # noqa: E402

PACKAGES = [
    "mcap==1.6.0",
    "mcap-protobuf-support==0.6.0",
    "foxglove-schemas-protobuf==0.4.0",
    "pyarrow==26.0.1",
]
# What is run: spheres in the way; link shapes, boxes and half-spaces; something that moves; a robot
# from a file on a rail; two arms; and an arm that is measured.
RUNS = [
    ("paper/example2", ["--robot", "ideal"]),
    ("gallery/shelf", ["--robot", "ideal"]),
    ("gallery/crossing", ["--robot", "ideal"]),
    ("gallery/urdf-rail-arm", ["--robot", "ideal", "--duration-s", "12"]),
    ("gallery/dual-arm-carry", ["--robot", "ideal", "--duration-s", "12"]),
    ("paper/example1", ["--fast", "--duration-s", "30"]),
]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--conik", type=Path, help="the command [default: built here]")
    parser.add_argument("--environment", type=Path, default=TARGET / "exports")
    arguments = parser.parse_args()

    conik = provide_conik(arguments.conik).resolve()
    python = provide_packages(arguments.environment, PACKAGES)
    failed = []
    with tempfile.TemporaryDirectory() as folder:
        for scenario, options in RUNS:
            out = Path(folder) / scenario.replace("/", "-")
            run = [conik, "run", f"scenarios/{scenario}.toml", "--quiet", "--out", out, *options]
            # A promise that a scenario breaks on purpose is no matter here.
            if subprocess.run(run, cwd=ROOT).returncode not in (0, 1):
                sys.exit(f"{scenario} does not run")
            subprocess.run([conik, "export", out, "--quiet"], check=True)
            for check in ["check_mcap.py", "check_parquet.py"]:
                print(f"{scenario}: {check}", flush=True)
                if subprocess.run([python, HERE / check, out]).returncode != 0:
                    failed.append(f"{scenario}: {check}")
    print(f"{2 * len(RUNS) - len(failed)} passed, {len(failed)} failed", *failed, sep="\n")
    sys.exit(bool(failed))


if __name__ == "__main__":
    main()

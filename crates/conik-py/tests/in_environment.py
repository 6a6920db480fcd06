"""Builds the wheel, installs it into an environment of its own, checks the stubs and runs the tests there.

    python3 tests/in_environment.py [ARGUMENTS OF PYTEST]
"""
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent.parent.parent
sys.path.append(str(ROOT / "tests"))
from environment import TARGET, provide_packages, provide_wheel  # noqa: E402

PACKAGES = [
    "maturin==1.13.1",
    "mypy==1.19.0",
    "numpy==2.2.6",
    "pandas==2.3.3",
    "pandas-stubs==2.3.2.250926",
    "polars==1.35.2",
    "pyarrow==22.0.0",
    "pytest==9.0.1",
    "ray==2.60.0",
]


def main():
    python = provide_packages(TARGET / "conik-py-python", PACKAGES)
    # What is tested is built from these sources, whatever was before.
    os.environ.pop("CONIK_WHEEL", None)
    provide_wheel(python)
    steps = [
        # The installed package, not the folder of its sources.
        [python, "-m", "mypy", "--strict", "--package", "conik"],
        [python, "-m", "mypy.stubtest", "conik._conik", "--ignore-disjoint-bases"],
        [python, "-m", "pytest", "-q", HERE, *sys.argv[1:]],
    ]
    for step in steps:
        done = subprocess.run(step, cwd=ROOT)
        if done.returncode != 0:
            return done.returncode
    return 0


if __name__ == "__main__":
    sys.exit(main())

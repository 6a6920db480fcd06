"""What the tests in Python need: an environment with packages, and the command `conik`."""
import os
import subprocess
import sys
import venv
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target"))


def provide_packages(folder, packages):
    """The Python of an environment with the packages; installs them if need be."""
    python = folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
    stamp = folder / "installed"
    if not stamp.exists() or stamp.read_text().split() != packages:
        venv.create(folder, with_pip=True, clear=True)
        install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-compile"]
        if subprocess.run([*install, *packages]).returncode != 0:
            sys.exit(f"packages cannot be installed; check that pip can: {' '.join(packages)}")
        stamp.write_text("\n".join(packages))
    return python


def provide_conik(path):
    """The command, built if its path was not given, nor stands in the environment."""
    path = path or os.environ.get("CONIK")
    if path is None:
        subprocess.run(["cargo", "build", "--quiet", "--package", "conik-cli"], cwd=ROOT, check=True)
        path = TARGET / "debug" / ("conik.exe" if os.name == "nt" else "conik")
    return Path(path)


def provide_wheel(python, wheel=None):
    """Installs the Python package into an environment that has maturin; builds it if no wheel is given, nor stands
    in the environment."""
    wheel = wheel or os.environ.get("CONIK_WHEEL")
    install = [python, "-m", "pip", "install", "--quiet", "--disable-pip-version-check", "--no-index", "--no-deps"]
    if wheel is not None:
        subprocess.run([*install, "--force-reinstall", wheel], check=True)
        return
    programs = python.parent
    environment = {**os.environ, "VIRTUAL_ENV": str(programs.parent), "CARGO_TARGET_DIR": str(TARGET)}
    environment["PATH"] = f"{programs}{os.pathsep}{environment['PATH']}"
    wheels = TARGET / "wheels"
    build = [python, "-m", "maturin", "build", "--profile", "dev", "--quiet", "--out", wheels]
    subprocess.run(build, cwd=ROOT, env=environment, check=True)
    subprocess.run([*install, "--force-reinstall", "--find-links", wheels, "conik"], check=True)

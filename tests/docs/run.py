"""Runs what the documentation shows, builds the site, and follows its links.

    python3 tests/docs/run.py [--conik PATH] [--wheel PATH]
    python3 tests/docs/run.py --build FOLDER      # builds the site there, and no more

Snippets of README.md and docs/ are run against the Python package and the command, as the comments above them
say (tests/docs/snippets.py). What is needed is installed into an environment of its own. Exit status 1 if
anything is wrong. The site is left in target/site.
"""
import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent)]
import built  # noqa: E402
import snippets  # noqa: E402
from environment import ROOT, TARGET, provide_conik, provide_packages, provide_wheel  # noqa: E402

PACKAGES = [
    "griffelib==2.4.1",
    "markdown==3.11.3",
    "maturin==1.13.1",
    "mkdocs==1.6.1",
    "mkdocs-material==9.8.2",
    "mkdocstrings==1.0.8",
    "mkdocstrings-python==2.0.11",
    "numpy==2.2.6",
    "pandas==2.3.3",
    "pygments==2.21.0",
    "pymdown-extensions==13.1.2",
    "ruff==0.17.6",
    "tomli==2.5.0",
    "websockets==17.4",
]
# Pages on which every snippet is run, or says why not. On the others those that are marked.
COMPLETE = ["index", "tutorial", "how-to", "python", "rust", "coming-from", "method-in-pictures"]
# What a clone has and snippets name.
NAMED = ["examples", "robots", "scenarios"]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--build", type=Path, metavar="FOLDER", help="build the site there, and no more")
    parser.add_argument("--conik", type=Path, help="the command [default: built here]")
    parser.add_argument("--wheel", type=Path, help="the Python package [default: built here]")
    parser.add_argument("--environment", type=Path, default=TARGET / "docs")
    arguments = parser.parse_args()

    python = provide_packages(arguments.environment, PACKAGES)
    provide_wheel(python, arguments.wheel)
    if arguments.build:
        return build(python, arguments.build)

    begin = time.monotonic()
    conik = Path(provide_conik(arguments.conik)).resolve()
    pages = [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]
    wrong, run = [], 0
    for page in pages:
        found = snippets.read(page)
        if page.parent.name == "docs" and page.stem in COMPLETE:
            wrong += snippets.missing_marks(found)
        wrong += filter(None, (snippets.stands_in(one, ROOT) for one in found if one.mark == "from"))
        if any(snippet.mark == "run" for snippet in found):
            run += sum(snippet.mark == "run" for snippet in found)
            if execute(python, conik, page) != 0:
                wrong.append(f"{page.relative_to(ROOT)}: a snippet does not do what the page says")
    print(f"{run} snippets run in {time.monotonic() - begin:.0f} s", flush=True)
    site = TARGET / "site"
    if build(python, site) != 0:
        wrong.append("the site cannot be built")
    else:
        wrong += built.mistakes(site)
        print(f"the site is in {site}")
    print(*[f"FAILED: {sentence}" for sentence in wrong], sep="\n")
    print(f"{len(wrong)} mistakes, in {time.monotonic() - begin:.0f} s")
    return 1 if wrong else 0


def execute(python, conik, page):
    """Runs the snippets of a page in an empty folder that looks like a clone to them."""
    with tempfile.TemporaryDirectory() as folder:
        for name in NAMED:
            (Path(folder) / name).symlink_to(ROOT / name)
        path = os.pathsep.join([str(conik.parent), str(python.parent), os.environ["PATH"]])
        environment = {**os.environ, "PATH": path, "PYTHONPATH": str(HERE), "NO_COLOR": "1"}
        return subprocess.run([python, HERE / "execute.py", page], cwd=folder, env=environment).returncode


def build(python, folder):
    """Builds the site; a warning is a mistake."""
    # With --quiet it would count none.
    command = [python, "-m", "mkdocs", "build", "--strict", "--site-dir", folder.resolve()]
    # The theme tells of itself where this is not set.
    environment = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}
    done = subprocess.run(command, cwd=ROOT, env=environment, stderr=subprocess.PIPE, text=True)
    for line in done.stderr.splitlines():
        if line.strip() and not line.startswith("INFO"):
            print(line)
    return done.returncode


if __name__ == "__main__":
    sys.exit(main())

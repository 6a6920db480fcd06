"""Draws the pictures of docs/tutorial.md: each scenario of the page is run, and its arm drawn.

    python docs/pictures/tutorial.py COMMAND        # the path of `conik`
"""
import subprocess
import sys
import tempfile
from pathlib import Path

PICTURES = Path(__file__).resolve().parent
sys.path.append(str(PICTURES.parent.parent / "tests" / "docs"))
import snippets  # noqa: E402


def main():
    conik = Path(sys.argv[1]).resolve()
    number = 0
    with tempfile.TemporaryDirectory() as folder:
        for snippet in snippets.read(PICTURES.parent / "tutorial.md"):
            if snippet.language != "toml" or snippet.mark != "run":
                continue
            number += 1
            snippets.scenario(snippet, Path(folder))
            run = [conik, "run", "cell.toml", "--robot", "ideal", "--quiet", "--out", "cell"]
            subprocess.run(run, cwd=folder, check=True)
            plot = [conik, "plot", "cell", "--quiet", "--format", "svg"]
            subprocess.run(plot, cwd=folder, check=True)
            picture = PICTURES / f"tutorial-{number}.svg"
            picture.write_bytes((Path(folder) / "cell" / "arm.svg").read_bytes())
            print(picture)


if __name__ == "__main__":
    main()

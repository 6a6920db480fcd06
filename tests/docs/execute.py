"""Runs the snippets of one page, in the environment that has the package: `execute.py PAGE`.

The working folder is that of the run; `conik` is on the path. What fails is printed with its place.
"""
import contextlib
import io
import shlex
import subprocess
import sys
import traceback
from pathlib import Path

import tomli

import conik
import snippets

#: What a list of tasks is run with, where a snippet has nothing else.
ROBOT = {"model": "ur5-paper", "q0_deg": [-48, -158, -108, -90, -85, 0]}
POSITION = {"name": "goal", "type": "position", "target_m": [0.32, 0.37, -0.25], "gain_per_s": 0.5}
#: Seconds of the time of a run.
LONGEST_S = 5
#: Seconds after which a command counts as hung.
PATIENCE_S = 60


class Wrong(Exception):
    """What a snippet should have done."""


def main():
    page = Path(sys.argv[1])
    failed, namespace, printed = 0, {"__name__": "__main__"}, ""
    for snippet in snippets.read(page):
        try:
            if snippet.mark == "prints":
                compare(snippet.text.splitlines(), printed.splitlines())
            elif snippet.mark == "run" and snippet.language == "python":
                if snippet.detail == "new":
                    namespace = {"__name__": "__main__"}
                printed = run_python(snippet, namespace)
            elif snippet.mark == "run" and snippet.language == "toml":
                run_toml(snippet)
            elif snippet.mark == "run" and snippet.language == "console":
                run_console(snippet)
        except Exception as error:
            failed += 1
            print(f"FAILED: {snippet.place}: {type(error).__name__}: {error}")
            if not isinstance(error, Wrong):
                traceback.print_exc(file=sys.stdout)
    return 1 if failed else 0


def run_python(snippet, namespace):
    """Runs it, and returns what it printed."""
    code = compile("\n" * (snippet.line - 1) + snippet.text, snippet.page, "exec")
    out = io.StringIO()
    with contextlib.ExitStack() as at_end:
        if snippet.detail.startswith("beside "):
            words = shlex.split(snippet.detail)[1:]
            process = at_end.enter_context(subprocess.Popen(words, stdout=subprocess.PIPE, text=True))
            at_end.callback(process.terminate)
            namespace["page"] = process.stdout.readline().strip()
        at_end.enter_context(contextlib.redirect_stdout(out))
        exec(code, namespace)
    return out.getvalue()


def run_toml(snippet):
    """Runs it for a few seconds: every set that was entered is kept."""
    text = snippets.scenario(snippet, Path.cwd())
    tables = tomli.loads(text)
    tables.setdefault("robot", ROBOT)
    tables.setdefault("task", [POSITION])
    control = tables.setdefault("control", {})
    control["duration_s"] = min(control.get("duration_s", LONGEST_S), LONGEST_S)
    done = conik.run(tables)
    if done.summary["outcome"]["kind"] != "completed":
        raise Wrong(f"it did not come to its end: {done.summary['outcome']}")
    if control.get("border", "land") == "land" and not done.summary["properties"]["entered_stays"]["holds"]:
        raise Wrong(f"a set was left: {done.summary['properties']['entered_stays']}")


def run_console(snippet):
    """Runs its commands; lines below a command are such that it prints, in this order, `...` for any."""
    commands = []
    for line in snippet.text.splitlines():
        if line.startswith("$ "):
            commands.append((line[2:], []))
        else:
            commands[-1][1].append(line)
    for command, shown in commands:
        done = subprocess.run(
            command, shell=True, capture_output=True, text=True, timeout=PATIENCE_S, stdin=subprocess.DEVNULL
        )
        if done.returncode != 0:
            raise Wrong(f"`{command}` ends with status {done.returncode}: {done.stdout}{done.stderr}")
        lines = iter((done.stdout + done.stderr).splitlines())
        for wanted in shown:
            # Columns are as wide as their widest entry.
            words = wanted.split()
            if words != ["..."] and all(line.split() != words for line in lines):
                raise Wrong(f"`{command}` does not print, or not there: {wanted}\n{done.stdout}{done.stderr}")


def compare(wanted, printed):
    if [line.rstrip() for line in wanted] != [line.rstrip() for line in printed]:
        raise Wrong("what is printed is\n" + "\n".join(printed))


if __name__ == "__main__":
    sys.exit(main())

"""Runs a notebook again and compares what it prints with what it has. Run by tests/examples/run.py."""
import sys

import nbformat
from nbclient import NotebookClient


def printed(notebook):
    """What its cells print, without pictures."""
    outputs = [output for cell in notebook.cells for output in cell.get("outputs", [])]
    return [output.get("text") or output.get("data", {}).get("text/plain", "") for output in outputs]


before = nbformat.read(sys.argv[1], as_version=4)
after = nbformat.read(sys.argv[1], as_version=4)
NotebookClient(after, timeout=100, kernel_name="python3").execute()
for old, new in zip(printed(before), printed(after), strict=True):
    if old != new:
        sys.exit(f"it prints\n{new}\nand has\n{old}")

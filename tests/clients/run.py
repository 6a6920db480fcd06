"""Runs real clients of UR controllers, unmodified, against `conik emulate`, and prints one table.

    python3 tests/clients/run.py [--python-rtde CHECKOUT] [--cpp CHECKOUT BUILD]

Clients that a registry has are installed from it into an environment of their own; the others take
the path of a checkout and are skipped without it. Exit status 1 if a client failed.
"""
import argparse
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from environment import TARGET, provide_conik, provide_packages  # noqa: E402

PACKAGES = ["ur-rtde==1.6.5", "urx==0.11.0"]
# Seconds after which a client counts as hung.
PATIENCE = 120


def own_address():
    """An address of this computer that no other run of this program uses; Linux has 2^24 of them."""
    number = os.getpid() & 0xFFFF
    for address in [f"127.77.{number >> 8}.{number & 0xFF or 1}", "127.0.0.1"]:
        with socket.socket() as probe:
            try:
                probe.bind((address, 0))
                return address
            except OSError:
                pass
    sys.exit("no address of this computer can be listened on")


class Emulator:
    """`conik emulate` at an address of its own, for as long as the block lasts."""

    def __init__(self, conik, address, series):
        self.command = [conik, "emulate", "--listen", address, "--series", series]
        self.address = address

    def __enter__(self):
        # A file, since nobody reads along: a full pipe would stop the emulator.
        self.file = tempfile.TemporaryFile()
        self.process = subprocess.Popen(self.command, stdout=self.file, stderr=subprocess.STDOUT)
        for _ in range(600):
            if self.process.poll() is not None:
                sys.exit(f"the emulator did not start: {self.log()}")
            try:
                socket.create_connection((self.address, 29999), timeout=1).close()
                return self
            except OSError:
                time.sleep(0.1)
        self.process.kill()
        sys.exit("the emulator does not answer")

    def __exit__(self, *_):
        self.process.send_signal(signal.SIGINT)
        self.status = self.process.wait(timeout=30)

    def log(self):
        self.file.seek(0)
        return self.file.read().decode(errors="replace")


def run(conik, address, series, command):
    """Whether the client believed everything, and what to say if it did not."""
    with Emulator(conik, address, series) as emulator:
        try:
            client = subprocess.run(
                [str(word) for word in command],
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                text=True,
                errors="replace",
                timeout=PATIENCE,
            )
            output, why = client.stdout, f"exit status {client.returncode}"
            passed = client.returncode == 0
        except subprocess.TimeoutExpired as hung:
            output, why = (hung.stdout or b"").decode(errors="replace"), f"hung for {PATIENCE} s"
            passed = False
    if passed and emulator.status != 0:
        passed, why = False, f"the emulator ended with status {emulator.status}"
    if not passed:
        print(output, "\nThe emulator's log:\n", emulator.log(), sep="")
        return "failed", why
    return "passed", ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--conik", type=Path, help="the command [default: built here]")
    parser.add_argument("--environment", type=Path, default=TARGET / "clients")
    parser.add_argument("--python-rtde", type=Path, help="checkout of RTDE_Python_Client_Library")
    parser.add_argument(
        "--cpp", type=Path, nargs=2, metavar=("CHECKOUT", "BUILD"),
        help="checkout of Universal_Robots_Client_Library and the folder it was built in",
    )  # fmt: skip
    arguments = parser.parse_args()

    conik = provide_conik(arguments.conik)
    python = provide_packages(arguments.environment, PACKAGES)
    address = own_address()
    # Name, series, command after the address; none where a checkout is missing.
    checkout = arguments.python_rtde
    cpp = arguments.cpp
    clients = [
        ("ur-rtde", "e", [python, HERE / "ur_rtde.py", address]),
        ("ur-rtde", "cb3", [python, HERE / "ur_rtde.py", address]),
        ("urx", "cb3", [python, HERE / "urx_joints.py", address]),
        *[
            ("RTDE_Python_Client_Library", series,
             checkout and [python, HERE / "ur_python_rtde.py", address, checkout])
            for series in ["e", "cb3"]
        ],
        *[
            ("Universal_Robots_Client_Library", series,
             cpp and [python, HERE / "ur_cpp.py", address, *cpp])
            for series in ["e", "cb3"]
        ],
    ]  # fmt: skip
    rows = []
    for name, series, command in clients:
        if command is None:
            rows.append((name, series, "skipped", "", "no checkout was given"))
            continue
        print(f"{name} against a controller of series {series} at {address}", flush=True)
        begin = time.monotonic()
        result, why = run(conik, address, series, command)
        rows.append((name, series, result, f"{time.monotonic() - begin:.0f} s", why))

    print()
    rows.insert(0, ("client", "series", "result", "time", "why"))
    widths = [max(len(row[column]) for row in rows) for column in range(5)]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())
    sys.exit(any(row[2] == "failed" for row in rows))


if __name__ == "__main__":
    main()

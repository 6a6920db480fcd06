"""Watches a run of Conik and feeds a moving target and a moving bound into it.

    conik view scenarios/paper/example2.toml        # prints http://127.0.0.1:PORT/
    pip install websockets
    python examples/live.py http://127.0.0.1:PORT/

The messages are those of docs/page.md, section "Live": JSON texts over a WebSocket.
"""

import argparse
import itertools
import json
import math
from urllib.parse import urlsplit

from websockets.sync.client import connect


def live_address(page: str) -> str:
    """The address of the WebSocket that belongs to a page; a token in it is kept."""
    parts = urlsplit(page)
    query = f"?{parts.query}" if parts.query else ""
    return f"ws://{parts.netloc}/live{query}"


class Run:
    """A run that goes on: what it tells, and what is asked of it."""

    def __init__(self, socket):
        self.socket = socket
        self.ids = itertools.count(1)
        self.scene = None
        self.t_s = 0.0
        self.columns = {}

    def take(self) -> dict:
        """The next message, after taking in what it says."""
        message = json.loads(self.socket.recv(timeout=30))
        match message["kind"]:
            case "scene":
                # The robot is only in the first one.
                known = self.scene or {}
                self.scene = {**known, **{key: value for key, value in message.items() if value is not None}}
            case "ticks" if message["t_s"]:
                self.t_s = message["t_s"][-1]
                self.columns = {name: values[-1] for name, values in message["columns"].items()}
        return message

    def ask(self, kind: str, **more) -> dict:
        """Asks, takes in what comes meanwhile, and returns the answer; an error is an exception."""
        number = next(self.ids)
        self.socket.send(json.dumps({"kind": kind, "id": number, **more}))
        while True:
            message = self.take()
            if message.get("id") == number:
                if "error" in message:
                    raise ValueError(message["error"])
                return message

    def task(self, kind: str) -> dict | None:
        """The first task of that type."""
        return next((task for task in self.scene["tasks"] if task["type"] == kind), None)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", help="the address that `conik view` or `conik run --view` printed")
    parser.add_argument("--seconds", type=float, default=20.0, help="how long, in the time of the run [s]")
    arguments = parser.parse_args()

    with connect(live_address(arguments.page), max_size=None) as socket:
        run = Run(socket)
        while run.take()["kind"] != "state":
            pass
        position, distance = run.task("position"), run.task("distance")
        print(f"{run.scene['title'] or run.scene['name']}: {len(run.scene['tasks'])} tasks, {run.scene['rate_hz']} Hz")
        begin_s, told_s = run.t_s, -1.0
        middle = position["waypoints_m"][0] if position else None
        while run.t_s < begin_s + arguments.seconds:
            phase = run.t_s - begin_s
            changes = []
            if position:
                # A target on a circle of 5 cm: the task goes after it as fast as its gain lets it.
                target = [
                    middle[0],
                    middle[1] + 0.05 * math.cos(0.5 * phase),
                    middle[2] + 0.05 * math.sin(0.5 * phase),
                ]
                waypoints = [target] * len(position["waypoints_m"])
                changes.append({"task": position["name"], "key": "waypoints_m", "value": waypoints})
            if distance:
                # A bound that breathes: it glides at no more than 2 cm/s, and the arm with it.
                bound = distance["min"] + 0.02 * (1.0 - math.cos(0.5 * phase))
                changes.append({"task": distance["name"], "key": "min", "value": bound, "speed": 0.02})
            run.ask("change", changes=changes)
            # As often as there is anything new to see is often enough.
            while run.take()["kind"] != "ticks":
                pass
            if run.t_s - told_s > 1.0:
                told_s = run.t_s
                error = run.columns.get(f"{position['name']}_error", math.nan) if position else math.nan
                value = run.columns.get(distance["name"], math.nan) if distance else math.nan
                print(f"t = {run.t_s:6.2f} s   error {1e3 * error:6.1f} mm   distance {1e3 * value:6.1f} mm")
        run.ask("reset")
        print("all changes taken back")


if __name__ == "__main__":
    main()

"""Campaigns: one scenario many times, on one machine or on a Ray cluster.

    python -m conik.campaign DIR --ray ADDRESS

goes on with a campaign that `conik campaign` or `conik.campaign` has begun in that folder.
"""

from __future__ import annotations

import argparse
import logging
import os
import sys
import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from . import _conik
from ._numbers import floats

#: Tasks that are given to a cluster at a time, for each of its cores: enough that none waits.
TASKS_PER_CORE = 3
#: Cores may come and go; how often it is looked [s].
LOOK_EVERY_S = 1.0


class Campaign:
    """What a campaign comes to; the rest is in its folder: `runs.parquet`, `report.html`, `worst/`."""

    out: Path
    """The folder."""
    runs: int
    """How many runs there were."""
    properties: dict[str, dict[str, Any]]
    """For each of the five properties: in how many runs it could show (`shown`) and was `kept`, the `worst`
    deviation [task's unit], and the share of broken ones that is not exceeded with 95 % confidence (`bound`)."""
    classes: dict[str, int]
    """How many runs there were of each class of failures; "none": everything was kept."""

    def __init__(self, out: Path, done: Mapping[str, Any]) -> None:
        self.out = out
        self.runs = done["runs"]
        self.properties = done["properties"]
        self.classes = done["classes"]

    def __repr__(self) -> str:
        classes = ", ".join(f"{count} {name}" for name, count in self.classes.items())
        return f"<conik.Campaign of {self.runs} runs in {self.out}: {classes}>"


def campaign(
    scenario: str | os.PathLike[str] | Mapping[str, Any],
    runs: int = 1000,
    *,
    out: str | os.PathLike[str],
    seed: int = 1,
    jobs: int | None = None,
    ray: str | None = None,
    starts: str | float = "anywhere",
    obstacles: float = 0.0,
    targets: float = 0.0,
    rates_hz: Sequence[float] = (),
    servo_lag: tuple[float, float] | None = None,
    progress: bool = True,
    **control: Any,
) -> Campaign:
    """Runs a scenario many times, and says how often each of the five properties was kept, and why not.

    The same arguments give the same bytes in `runs.parquet`, whatever the number of jobs and machines. Begun again
    with the same arguments, it goes on where it was stopped.

    Args:
        scenario: the path of a scenario file, or its tables, as of `conik.run`.
        runs: how many.
        out: the folder for the results.
        seed: of the random numbers.
        jobs: runs at a time; by default as many as there are cores.
        ray: instead of `jobs`, the address of a Ray cluster ("auto": the one that this machine is in, "local": a
            new one on this machine). Needs `pip install ray`; `conik` must be installed on its machines.
        starts: "anywhere" (each joint between its limits, at most half a turn from zero), "same", or how far from
            the scenario's start [rad or m].
        obstacles: points that are kept away from, and obstacles, are shifted by up to this [m].
        targets: targets and waypoints are shifted by up to this [m].
        rates_hz: control rates of which each run has one [Hz]; by default the scenario's.
        servo_lag: simulates an arm that lags behind its reference by a time between these two [s].
        progress: whether to show how far it is, on standard error.
        control: settings that override the scenario's: `mode_rule`, `border`, `recursion`, `duration_s`, `rate_hz`.

    Raises:
        ScenarioError: what is wrong with the scenario, or with what varies.
        ConikError: the folder has another campaign, or this one and it is done, or cannot be written.
        KeyboardInterrupt: on Ctrl-C; the runs that are done stay.
    """
    if isinstance(scenario, Mapping):
        path, tables = None, dict(scenario)
    else:
        path, tables = os.fspath(scenario), None
    plan = _conik.campaign_plan(
        path=path,
        tables=tables,
        runs=runs,
        seed=seed,
        starts=starts if isinstance(starts, str) else "near",
        near=0.0 if isinstance(starts, str) else float(starts),
        obstacles=obstacles,
        targets=targets,
        rates_hz=floats(rates_hz),
        servo_lag=servo_lag,
        control=control,
    )
    folder = Path(out)
    missing, _, _ = _conik.campaign_missing(folder, plan)
    if not missing and not (folder / "shards").exists():
        raise _conik.ConikError(f"it is done already: {folder / 'report.html'}; remove the folder to run it again")
    show = _Progress(runs, progress)
    if ray is not None:
        _on_ray(folder, plan, ray, show)
    else:
        _conik.campaign_work(folder, plan, jobs, show)
    show.end()
    return Campaign(folder, _conik.campaign_finish(folder, plan))


class _Progress:
    """A line on standard error: how many runs are done, how fast, and for how long it still takes."""

    def __init__(self, runs: int, is_shown: bool) -> None:
        self._runs = runs
        self._is_shown = is_shown
        self._is_terminal = sys.stderr.isatty()
        self._begin: tuple[float, int] | None = None
        self._last = 0.0

    def __call__(self, done: int) -> None:
        now = time.monotonic()
        self._begin = self._begin or (now, done)
        if not self._is_shown or now - self._last < (0.2 if self._is_terminal else 5.0):
            return
        self._last = now
        rate = (done - self._begin[1]) / max(now - self._begin[0], 1e-3)
        left = f", {(self._runs - done) / rate:.0f} s left" if rate > 0 else ""
        line = f"{done} of {self._runs} runs, {rate:.0f} a second{left}"
        print(f"\r\033[K{line}" if self._is_terminal else line, end="" if self._is_terminal else "\n", file=sys.stderr)
        sys.stderr.flush()

    def end(self) -> None:
        if self._is_shown and self._is_terminal:
            print("\r\033[K", end="", file=sys.stderr, flush=True)


def _on_ray(folder: Path, plan: str, address: str, show: _Progress) -> None:
    """Spreads the shards that are missing over a cluster. What a worker or a machine that is gone was doing, another
    one does."""
    try:
        import ray
    except ImportError as error:
        raise _conik.ConikError(f"a campaign on a cluster needs Ray: `pip install ray` ({error})") from error
    missing, _, done = _conik.campaign_missing(folder, plan)
    show(done)
    if not missing:
        return
    is_mine = not ray.is_initialized()
    if is_mine:
        ray.init(address=None if address == "local" else address, log_to_driver=False, logging_level=logging.WARNING)
    try:
        # Ray itself repeats tasks whose worker or machine is gone, without end.
        run = ray.remote(num_cpus=1, max_retries=-1)(_shard)
        plan_there = ray.put(plan)
        waiting = iter(missing)
        at_work: dict[Any, int] = {}
        most, looked = 0, -LOOK_EVERY_S
        while True:
            if (now := time.monotonic()) - looked >= LOOK_EVERY_S:
                cores = int(ray.cluster_resources().get("CPU", 1))  # type: ignore[no-untyped-call]
                most, looked = TASKS_PER_CORE * max(1, cores), now
            while len(at_work) < most and (shard := next(waiting, None)) is not None:
                at_work[run.remote(plan_there, shard)] = shard
            if not at_work:
                break
            ready, others = ray.wait(list(at_work), num_returns=1, timeout=0.5)
            if ready and others:
                # Whatever else is ready by now: with many cores, asking for each alone takes longer than they do.
                ready += ray.wait(others, num_returns=len(others), timeout=0)[0]
            for task in ready:
                shard = at_work.pop(task)
                _conik.campaign_keep(folder, plan, shard, ray.get(task))
                done += _conik.campaign_runs(plan, shard)
            show(done)
    finally:
        if is_mine:
            ray.shutdown()


def _shard(plan: str, shard: int) -> str:
    """What a worker does."""
    return _conik.campaign_shard(plan, shard)


def main() -> int:
    """Goes on with the campaign in a folder; `conik campaign` writes what is made of its runs."""
    parser = argparse.ArgumentParser(prog="python -m conik.campaign", description="Spreads a campaign over a cluster.")
    parser.add_argument("dir", type=Path, help="the folder of a campaign that was begun")
    parser.add_argument("--ray", metavar="ADDRESS", required=True, help="`auto`, `local`, or the address of the head")
    parser.add_argument("--quiet", action="store_true", help="no progress line")
    arguments = parser.parse_args()
    try:
        plan = (arguments.dir / "plan.json").read_text()
        runs = sum(_conik.campaign_runs(plan, shard) for shard in range(_conik.campaign_missing(arguments.dir, plan)[1]))
        show = _Progress(runs, not arguments.quiet)
        _on_ray(arguments.dir, plan, arguments.ray, show)
        show.end()
    except KeyboardInterrupt:
        return 130
    except (OSError, ConnectionError, _conik.ConikError) as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())

"""What a campaign on a cluster costs whoever hands out its shards, and up to how many cores it gets faster.

    pip install . ray && python crates/conik-py/benches/cluster.py

The time of a shard is measured on one core. What it costs to hand out a shard and to take in its rows is the
processor time of this process, of all its threads, in a campaign of very short runs on a cluster of this machine:
that work is done in one place, however many machines there are.
"""
import importlib
import sys
import tempfile
import time
from pathlib import Path

from conik import _conik

#: The package calls the function like the module.
module = importlib.import_module("conik.campaign")
ROOT = Path(__file__).resolve().parents[3]
EXAMPLE = ROOT / "scenarios" / "paper" / "example2.toml"
OURS = {"mode_rule": "cone", "border": "land", "recursion": "siciliano-slotine"}
MILLION = 1_000_000
SHARDS = 6
SHORT_SHARDS = 400


def main():
    plan = plan_of(MILLION, OURS)
    begin = time.perf_counter()
    answers = [_conik.campaign_shard(plan, shard) for shard in range(SHARDS)]
    shard_s = (time.perf_counter() - begin) / SHARDS
    a_shard = _conik.campaign_runs(plan, 0)
    shards = -(-MILLION // a_shard)
    print(f"a shard: {a_shard} runs, {shard_s:.2f} s on a core; its rows have {len(answers[0]) // 1024} kB")
    with tempfile.TemporaryDirectory() as folder:
        handed_s = handed_out(Path(folder) / "short", a_shard)
        finished_s = finished(Path(folder) / "many", answers, a_shard)
    print(f"handing it out and taking it in: {1e3 * handed_s:.2f} ms; finishing: {1e6 * finished_s:.1f} µs a run")
    cores = shard_s / handed_s
    print(f"a million runs: {shards} shards, {shards * shard_s / 3600:.1f} hours of a core, then {MILLION * finished_s:.0f} s to finish")
    for machines in [1, 2, 4, 8, 16, 32, 64]:
        n = 32 * machines
        print(f"  {machines:3} machines of 32 cores: {max(shards * shard_s / n, shards * handed_s) + shard_s + MILLION * finished_s:7.0f} s")
    print(f"faster up to {cores:.0f} cores, where handing out takes as long as running")


def plan_of(runs, control):
    return _conik.campaign_plan(
        path=EXAMPLE, tables=None, runs=runs, seed=1, starts="anywhere", near=0.0, obstacles=0.0, targets=0.0,
        rates_hz=[], servo_lag=None, control=control,
    )


def handed_out(folder, a_shard):
    """Processor time of this process for a shard [s]."""
    import ray

    ray.init(log_to_driver=False, logging_level="warning", include_dashboard=False)
    try:
        silent = module._Progress(1, False)
        # Workers start when they are first needed.
        module._on_ray(folder / "first", plan_of(8 * a_shard, {"duration_s": 0.008}), "auto", silent)
        plan = plan_of(SHORT_SHARDS * a_shard, {"duration_s": 0.008})
        before = time.process_time()
        module._on_ray(folder / "then", plan, "auto", silent)
        return (time.process_time() - before) / SHORT_SHARDS
    finally:
        ray.shutdown()


def finished(folder, answers, a_shard):
    """Time to write the table and the report, for a run [s]."""
    plan = plan_of(SHARDS * a_shard, OURS)
    _conik.campaign_missing(folder, plan)
    for shard, lines in enumerate(answers):
        _conik.campaign_keep(folder, plan, shard, lines)
    begin = time.perf_counter()
    _conik.campaign_finish(folder, plan)
    return (time.perf_counter() - begin) / (SHARDS * a_shard)


if __name__ == "__main__":
    sys.exit(main())

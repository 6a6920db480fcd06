import os
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pandas
import pytest

import conik
from conik import _conik

ROOT = Path(__file__).resolve().parents[3]
sys.path.append(str(ROOT / "tests"))
from environment import provide_conik  # noqa: E402

SCENARIOS = ROOT / "scenarios"
EXAMPLE = SCENARIOS / "paper" / "example2.toml"


def bytes_of(folder):
    return (folder / "runs.parquet").read_bytes()


def test_rows_say_what_became_of_each_run(tmp_path):
    done = conik.campaign(EXAMPLE, 40, out=tmp_path / "a", seed=3, progress=False, duration_s=5, border="land")
    assert done.runs == sum(done.classes.values()) == 40
    assert done.properties["inside_stays"]["kept"] == done.properties["inside_stays"]["shown"] > 0
    assert 0 < done.properties["inside_stays"]["bound"] < 1
    assert (tmp_path / "a" / "report.html").read_text().startswith("<!doctype html>")
    rows = pandas.read_parquet(tmp_path / "a" / "runs.parquet")
    assert list(rows["run"]) == list(range(40)) and set(rows["seed"]) == {3}
    assert set(rows["border"]) == {"land"} and set(rows["rate_hz"]) == {125.0}
    assert rows["q1_start_rad"].between(-np.pi, np.pi).all() and rows["q1_start_rad"].nunique() == 40
    assert dict(rows["class"].value_counts()) == done.classes
    # What the table says of a run is what comes of its start.
    row = rows.iloc[7]
    run = conik.run(
        {
            "robot": {"model": "ur5-paper", "q0_rad": [row[f"q{joint}_start_rad"] for joint in range(1, 7)]},
            "control": {**CONTROL, "duration_s": 5, "border": "land"},
            "task": TASKS,
        }
    )
    assert run.summary["tasks"]["obstacle_a"]["worst_violation"] == row["obstacle_a_worst"]
    assert run.summary["tasks"]["position"]["final_error"] == row["position_error"]
    assert len(run.summary["modes"]) - 1 == row["mode_changes"]


CONTROL = {
    "rate_hz": 125,
    "mode_rule": "paper",
    "recursion": "chiaverini",
    "exclusive": [["obstacle_a", "obstacle_b"]],
}
TASKS = [
    {"name": "obstacle_a", "type": "distance", "point_m": [0.40, -0.25, -0.33], "min": 0.18},
    {"name": "obstacle_b", "type": "distance", "point_m": [0.40, 0.15, -0.33], "min": 0.15},
    {"name": "view", "type": "field_of_view", "direction": [1, 0, 0], "max": 0.2622},
    {
        "name": "position",
        "type": "position",
        "waypoints_m": [[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]],
        "acceptance_m": 0.02,
        "gain_per_s": 0.3,
    },
]


def test_bytes_are_the_same_whatever_the_jobs_and_the_way_of_asking(tmp_path):
    arguments = {"runs": 600, "seed": 5, "progress": False, "duration_s": 0.5, "targets": 0.05, "rates_hz": [50, 125]}
    conik.campaign(EXAMPLE, out=tmp_path / "one", jobs=1, **arguments)
    conik.campaign(str(EXAMPLE), out=tmp_path / "two", jobs=2, **arguments)
    assert bytes_of(tmp_path / "one") == bytes_of(tmp_path / "two")
    with pytest.raises(conik.ConikError, match="it is done already"):
        conik.campaign(EXAMPLE, out=tmp_path / "one", jobs=1, **arguments)


def test_what_was_stopped_goes_on(tmp_path, monkeypatch):
    arguments = {"runs": 1000, "seed": 5, "duration_s": 2}
    conik.campaign(EXAMPLE, out=tmp_path / "whole", progress=False, **arguments)

    def stop(self, done):
        if done > 300:
            raise KeyboardInterrupt

    module = sys.modules["conik.campaign"]
    with monkeypatch.context() as patch:
        patch.setattr(module._Progress, "__call__", stop)
        with pytest.raises(KeyboardInterrupt):
            conik.campaign(EXAMPLE, out=tmp_path / "stopped", **arguments)
    assert not (tmp_path / "stopped" / "runs.parquet").exists()
    conik.campaign(EXAMPLE, out=tmp_path / "stopped", progress=False, **arguments)
    assert bytes_of(tmp_path / "stopped") == bytes_of(tmp_path / "whole")
    with pytest.raises(conik.ConikError, match="another campaign was begun here: its seed differs"):
        conik.campaign(EXAMPLE, out=tmp_path / "stopped", **{**arguments, "seed": 6})


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ({"runs": 0}, "no runs"),
        ({"starts": "same"}, "nothing varies"),
        ({"starts": float("nan")}, "spread of the starts"),
        ({"rates_hz": [0.1]}, "a rate"),
        ({"servo_lag": (0.2, 0.1)}, "a servo lag"),
        ({"border": "lands"}, 'did you mean "land"'),
        ({"duration": 3}, 'unknown key "duration"'),
    ],
)
def test_plan_that_makes_no_sense_is_refused(tmp_path, arguments, said):
    with pytest.raises(conik.ScenarioError) as error:
        conik.campaign(EXAMPLE, out=tmp_path / "a", **arguments)
    assert said in str(error.value)
    assert not (tmp_path / "a").exists()


@pytest.fixture
def cluster(monkeypatch):
    """Two machines of a cluster, each with one core; as far as one can tell on one."""
    monkeypatch.setenv("RAY_USAGE_STATS_ENABLED", "0")
    from ray.cluster_utils import Cluster

    cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 1, "include_dashboard": False})
    cluster.second = cluster.add_node(num_cpus=1)
    cluster.wait_for_nodes()
    yield cluster
    cluster.shutdown()


def test_cluster_that_loses_a_machine_gives_the_same_bytes(tmp_path, cluster):
    arguments = {"runs": 5000, "seed": 8, "progress": False, "duration_s": 10}
    conik.campaign(EXAMPLE, out=tmp_path / "here", **arguments)

    def kill_half_way():
        shards = tmp_path / "there" / "shards"
        while (kept := len(list(shards.glob("*.jsonl")))) < 8:
            time.sleep(0.05)
        cluster.remove_node(cluster.second, allow_graceful=False)
        killed.append(kept)

    killed = []
    killer = threading.Thread(target=kill_half_way)
    killer.start()
    conik.campaign(EXAMPLE, out=tmp_path / "there", ray=cluster.address, **arguments)
    killer.join()
    assert killed[0] < 20, "it was killed before the end"
    assert bytes_of(tmp_path / "here") == bytes_of(tmp_path / "there")


def test_command_spreads_its_runs_over_a_cluster(tmp_path, cluster):
    command = [provide_conik(None), "campaign", EXAMPLE, "--runs", "600", "--duration-s", "0.5", "--quiet"]
    environment = {**os.environ, "PYTHON": sys.executable}
    there = subprocess.run([*command, "--out", tmp_path / "there", "--ray", cluster.address], env=environment)
    here = subprocess.run([*command, "--out", tmp_path / "here", "--jobs", "1"])
    assert (there.returncode, here.returncode) == (0, 0)
    assert bytes_of(tmp_path / "here") == bytes_of(tmp_path / "there")


def test_command_of_the_module_goes_on_with_a_folder(tmp_path, monkeypatch):
    monkeypatch.setenv("RAY_USAGE_STATS_ENABLED", "0")
    plan = _conik.campaign_plan(
        path=EXAMPLE, tables=None, runs=300, seed=2, starts="near", near=0.1, obstacles=0.0, targets=0.0,
        rates_hz=[], servo_lag=None, control={"duration_s": 0.5},
    )
    folder = tmp_path / "begun"
    missing, shards, done = _conik.campaign_missing(folder, plan)
    assert (missing, shards, done) == ([0, 1], 2, 0)
    command = [sys.executable, "-m", "conik.campaign", folder, "--ray", "local", "--quiet"]
    assert subprocess.run(command).returncode == 0
    assert _conik.campaign_missing(folder, plan) == ([], 2, 300)
    assert _conik.campaign_finish(folder, plan)["runs"] == 300
    command[3] = tmp_path / "none"
    failed = subprocess.run(command, capture_output=True, text=True)
    assert failed.returncode == 2 and "plan.json" in failed.stderr

import threading
import time
from pathlib import Path

import numpy as np
import pytest

import conik

SCENARIOS = Path(__file__).resolve().parents[3] / "scenarios"


@pytest.fixture(scope="module")
def example2():
    return conik.run(SCENARIOS / "paper" / "example2.toml")


def test_run_has_columns_and_a_summary(example2):
    assert len(example2) == 7501 and example2.q.shape == (7501, 6) and example2.tool.shape == (7501, 3)
    assert example2.t_s[-1] == 60 and "obstacle_a" in example2.names
    assert example2.summary["outcome"]["kind"] == "completed"
    assert example2.is_active("obstacle_a").sum() > 100
    assert () in example2.active_sets
    assert any("hold:obstacle_a" in reasons for reasons in example2.reasons)
    assert "60.000 s, completed" in repr(example2)
    with pytest.raises(KeyError, match="there are: t_s"):
        example2["nothing"]


def test_frames_have_the_same_rows(example2):
    pandas, polars = example2.to_pandas(), example2.to_polars()
    assert list(pandas.columns) == polars.columns
    assert pandas.shape == polars.shape == (7501, len(example2.names) + 2)
    np.testing.assert_array_equal(pandas["q3_rad"], example2["q3_rad"])
    np.testing.assert_array_equal(polars["tool_z_m"].to_numpy(), example2["tool_z_m"])
    assert set(pandas["active"]) == {"+".join(active) for active in example2.active_sets}


def test_scenario_reads_back(example2, tmp_path):
    path = tmp_path / "again.toml"
    path.write_text(example2.scenario)
    again = conik.run(str(path))
    np.testing.assert_array_equal(again.q, example2.q)


def test_tables_are_a_scenario_too():
    tables = {
        "robot": {"model": "ur5-paper", "q0_deg": np.array([-48, -158, -108, -90, -85, 0])},
        "control": {"duration_s": np.float32(2), "rate_hz": np.int64(250)},
        "task": [{"name": "position", "type": "position", "target_m": (0.4, 0, 0), "gain_per_s": 1}],
    }
    run = conik.run(tables)
    assert len(run) == 501
    tables["task"][0]["gain"] = 1
    with pytest.raises(conik.ScenarioError, match='unknown key "gain"; did you mean `gain_per_s`'):
        conik.run(tables)
    with pytest.raises(TypeError, match="no place in a scenario"):
        conik.run({"robot": object()})


def test_mistakes_of_a_file_have_their_places(tmp_path):
    path = tmp_path / "bad.toml"
    path.write_text('[robot]\nmodel = "ur5"\nq0_deg = [1]\n[control]\nrate = 3\n')
    with pytest.raises(conik.ScenarioError) as error:
        conik.run(path)
    assert f"{path}:5:1: control.rate: unknown key" in str(error.value)
    with pytest.raises(conik.ScenarioError, match="cannot be read"):
        conik.run(tmp_path / "none.toml")


def test_interpreter_is_let_go_while_a_run_goes_on():
    counted = []

    def count():
        while not done.is_set():
            counted.append(time.monotonic())
            time.sleep(0.001)

    done = threading.Event()
    counter = threading.Thread(target=count)
    counter.start()
    before = time.monotonic()
    conik.run(SCENARIOS / "paper" / "example3.toml")
    after = time.monotonic()
    done.set()
    counter.join()
    # Held, it would let nobody count between the two.
    assert sum(before < at < after for at in counted) >= 2

"""Logs a run for the Rerun viewer: the arm in space, joints, values of tasks, what is held.

    python examples/12_rerun.py out.rrd
    rerun out.rrd

The scene is that of 03_field_of_view.
"""

import argparse
import os
import tomllib
from pathlib import Path

# Rerun collects usage data unless its own configuration says otherwise, or it believes to be in a test. An example
# must not: this has to be said before the import.
os.environ["CI"] = "true"
os.environ["TELEMETRY_ENABLED"] = "false"
os.environ.pop("FORCE_RERUN_ANALYTICS", None)

import numpy as np  # noqa: E402
import rerun as rr  # noqa: E402
import rerun.blueprint as rrb  # noqa: E402

import conik  # noqa: E402

SCENARIO = Path(__file__).resolve().parent.parent / "scenarios" / "paper" / "example2.toml"
# Ticks between two drawings of the arm; its numbers are logged at every tick.
STRIDE = 5
BLUE, ORANGE, VERMILION, PURPLE = [0, 114, 178], [230, 159, 0], [213, 94, 0], [204, 121, 167]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("recording", help="the file to write, *.rrd")
    arguments = parser.parse_args()

    tables = tomllib.loads(SCENARIO.read_text())
    # The settings of this library, not those of the paper.
    tables["control"] = {"rate_hz": 125, "duration_s": 60}
    run = conik.run(tables)
    robot = conik.Robot.builtin(tables["robot"]["model"])

    rr.init("conik", spawn=False)
    rr.save(arguments.recording, default_blueprint=blueprint(tables))
    log_scene(tables)
    log_arm(run, robot)
    log_numbers(run, robot, tables)
    # Everything is on the disk when the stream is gone.
    rr.disconnect()

    print(f"ticks: {len(run)}")
    print(f"drawings of the arm: {len(run.t_s[::STRIDE])}")
    print(f"size: {os.path.getsize(arguments.recording) / 1e6:.1f} MB")


def blueprint(tables):
    """What the viewer shows where."""
    values = [
        rrb.TimeSeriesView(name=task["name"], origin=f"/tasks/{task['name']}") for task in tables["task"]
    ]
    joints = rrb.TimeSeriesView(name="joints [rad]", origin="/joints")
    return rrb.Horizontal(
        rrb.Spatial3DView(name="arm", origin="/world"), rrb.Vertical(*values, joints), column_shares=[1, 1]
    )


def log_scene(tables):
    """What does not move: obstacles and waypoints."""
    rr.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    for task in tables["task"]:
        place = f"world/{task['name']}"
        if task["type"] == "distance":
            half_sizes = [[task["min"]] * 3]
            sphere = rr.Ellipsoids3D(centers=[task["point_m"]], half_sizes=half_sizes, colors=VERMILION)
            rr.log(place, sphere, static=True)
        if task["type"] == "position":
            points = rr.Points3D(task["waypoints_m"], radii=0.01, colors=ORANGE, labels=["1", "2"])
            rr.log(place, points, static=True)


def time_of(t_s):
    return [rr.TimeColumn("time", duration=t_s)]


def log_arm(run, robot):
    """The arm as a line through its links, and the way of its tool so far."""
    t_s, configurations = run.t_s[::STRIDE], run.q[::STRIDE]
    arms = []
    for q in configurations:
        kinematics = robot.kinematics(q)
        arms.append([kinematics.world_from(link)[:3, 3] for link in robot.link_names])
    rr.send_columns("world/arm", time_of(t_s), rr.LineStrips3D.columns(strips=arms))
    rr.log("world/arm", rr.LineStrips3D.from_fields(colors=BLUE, radii=0.02), static=True)
    rr.send_columns("world/tool", time_of(t_s), rr.Points3D.columns(positions=run.tool[::STRIDE]))
    rr.log("world/tool", rr.Points3D.from_fields(colors=PURPLE, radii=0.025), static=True)
    rr.log("world/way", rr.LineStrips3D([run.tool], colors=PURPLE, radii=0.003), static=True)


def log_numbers(run, robot, tables):
    """Joints, values with their bounds, and 1 where a set is held."""
    for number, name in enumerate(robot.joint_names):
        rr.send_columns(f"joints/{name}", time_of(run.t_s), rr.Scalars.columns(scalars=run.q[:, number]))
    for task in tables["task"]:
        name = task["name"]
        place = f"tasks/{name}"
        if name in run.names:
            rr.send_columns(f"{place}/value", time_of(run.t_s), rr.Scalars.columns(scalars=run[name]))
            held = run.is_active(name).astype(float)
            rr.send_columns(f"{place}/held", time_of(run.t_s), rr.Scalars.columns(scalars=held))
        for bound in {"min", "max"} & task.keys():
            ends = [run.t_s[0], run.t_s[-1]]
            line = rr.Scalars.columns(scalars=[task[bound]] * 2)
            rr.send_columns(f"{place}/{bound}", time_of(ends), line)
        if f"{name}_error" in run.names:
            error = np.asarray(run[f"{name}_error"])
            rr.send_columns(f"{place}/error", time_of(run.t_s), rr.Scalars.columns(scalars=error))


if __name__ == "__main__":
    main()

"""A UR5 follows a target to and fro, its tool kept between two walls: pink's example `examples/barriers/arm_ur5.py`.

    python examples/14_from_pink.py [--picture 14_from_pink.svg]

Written anew for Conik, with the numbers of that example. There:                    here:

- a barrier keeps the tool between y = -0.4 m and 0.6 m, with a gain               a set above all
- a frame task with costs of 10 per metre and 1 per radian                         position above orientation
- a posture task with a cost of 0.001                                              posture, the last task

The target swings by 0.65 m to both sides, so it is beyond a wall on each of its ways. Other than there, it swings
40 cm in front of the arm: straight above the arm's base, where it passes there, the orientation cannot be kept.
"""

import argparse

import numpy as np

import conik

RATE_HZ = 200.0
DURATION_S = 8.0 * np.pi
START = np.array([1.27153374, -0.87988708, 1.89104795, 1.73996951, -0.24610945, -0.74979019])
WALLS_M = (-0.4, 0.6)


def target(t):
    """Where the tool is to be [m], and how fast that moves [m/s]."""
    position = np.array([-0.4, 0.65 * np.sin(t / 4.0), 0.5])
    return position, np.array([0.0, 0.65 / 4.0 * np.cos(t / 4.0), 0.0])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--picture", help="where to draw the run")
    arguments = parser.parse_args()

    # The URDF of that example counts from `base_link`, which is turned by half a turn against the controller's
    # base, from which Conik counts.
    robot = conik.Robot.builtin("ur5").standing_at(rpy=[0.0, 0.0, np.pi])
    start = robot.forward_kinematics(START)
    stack = conik.Stack(robot)
    stack.set("walls", conik.Coordinate("y"), min=WALLS_M[0], max=WALLS_M[1])
    stack.equality("position", conik.Position(target(0.0)[0]), gain=5.0)
    stack.equality("orientation", conik.Orientation(start[:3, :3]), gain=5.0)
    stack.equality("posture", conik.Posture(START), gain=1.0)
    controller = conik.Controller(robot, stack, RATE_HZ)

    q = START
    steps, targets = [], []
    for tick in range(round(RATE_HZ * DURATION_S)):
        point, velocity = target(tick / RATE_HZ)
        controller.change("position", target=point, velocity=velocity)
        step = controller.step(q)
        steps.append(step)
        targets.append(point)
        q = step.q_ref

    sides = np.array([step.values["walls"] for step in steps])
    errors = np.array([np.linalg.norm(step.errors["position"]) for step in steps])
    is_free = np.array(["walls" not in step.active for step in steps])
    # The way from the start to the target is over by then.
    is_free[: round(3.0 * RATE_HZ)] = False
    turned = [np.linalg.norm(step.errors["orientation"]) for step in steps]
    print(f"least y: {sides.min():.5f} m")
    print(f"greatest y: {sides.max():.5f} m")
    print(f"samples outside the walls: {((sides < WALLS_M[0]) | (sides > WALLS_M[1])).sum()}")
    print(f"time at a wall: {sum('walls' in step.active for step in steps) / RATE_HZ:.2f} s")
    print(f"median error while no wall is in the way: {np.median(errors[is_free]) * 1e3:.4f} mm")
    print(f"greatest error of the orientation: {np.degrees(max(turned)):.4f} deg")

    if arguments.picture:
        draw(arguments.picture, steps, np.array(targets))


def draw(path, steps, targets):
    import drawing

    t = np.arange(len(steps)) / RATE_HZ
    figure, way, (side, error) = drawing.figure_of_run("A target beyond two walls, after an example of pink")
    way.line(targets, "way of the target", drawing.GREY, linestyle=":")
    way.line([step.values["position"] for step in steps], "way of the tool")
    way.marks(steps[0].values["position"], "start", "o")
    for wall in WALLS_M:
        for axes in (way.above, way.side):
            axes.axvline(wall, color=drawing.VERMILION, linestyle="--", linewidth=1.0)
    way.finish(columns=2)
    drawing.value_over_time(side, t, targets[:, 1], "target", drawing.GREY, linestyle=":")
    drawing.value_over_time(side, t, [step.values["walls"] for step in steps], "tool")
    drawing.active(side, t, ["walls" in step.active for step in steps], "at a wall")
    drawing.bound(side, WALLS_M[0], "walls", drawing.VERMILION)
    drawing.bound(side, WALLS_M[1], color=drawing.VERMILION)
    side.set(ylabel="y [m]")
    drawing.legend_above(side)
    errors = [np.linalg.norm(step.errors["position"]) * 1e3 for step in steps]
    drawing.value_over_time(error, t, errors, "distance to the target")
    error.set(ylabel="distance [mm]")
    drawing.legend_above(error)
    drawing.save(figure, path)


if __name__ == "__main__":
    main()

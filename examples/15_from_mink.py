"""A UR5e keeps a camera on a target that flies loops: mink's example `examples/arm_ur5e_wrist_cam_lookat.py`.

    python examples/15_from_mink.py [--picture 15_from_mink.svg]

Written anew for Conik, with the target and the camera of that example. There:      here:

- a look-at task with a cost of 1                                                  a set: within 3 degrees
- a posture task with a cost of 0.01                                               the one equality task
- limits of position and speed                                                     the robot has them

As a set, looking costs the posture nothing while the target is within 3 degrees of the middle of the picture; and
the target does not leave them. The controller is told where the target will be in the next period.
"""

import argparse

import numpy as np

import conik

RATE_HZ = 200.0
DURATION_S = 2.0 * np.pi
HOME = np.array([-1.5708, -1.5708, 1.5708, -1.5708, -1.5708, 0.0])
# The camera looks along the tool's z axis, so far beyond the flange [m].
CAMERA_M = 0.145
GREATEST_RAD = np.radians(3.0)


def target(t):
    """Where the target is on its loops [m]."""
    return np.array([0.7 + 0.3 * np.cos(t), 0.6 * np.sin(t), 0.55 + 0.25 * np.sin(2.0 * t)])


def controller_of(robot, point, posture, recovery):
    stack = conik.Stack(robot)
    stack.set("look", conik.LookAt(point), max=GREATEST_RAD, recovery=recovery)
    stack.equality("posture", conik.Posture(posture), gain=1.0)
    return conik.Controller(robot, stack, RATE_HZ)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--picture", help="where to draw the run")
    arguments = parser.parse_args()

    # That example counts from `base_link`, turned by half a turn against the controller's base.
    robot = conik.Robot.builtin("ur5e").standing_at(rpy=[0.0, 0.0, np.pi])
    robot = robot.with_tool_offset(position=[0.0, 0.0, CAMERA_M])

    # First it turns to where the loops begin; that pose is the posture from then on.
    q = HOME
    controller = controller_of(robot, target(0.0), HOME, recovery=1.0)
    for _ in range(round(4.0 * RATE_HZ)):
        q = controller.step(q).q_ref
    print(f"looks off the target before it moves by: {np.degrees(controller.step(q).values['look']):.3f} deg")

    controller = controller_of(robot, target(0.0), q, recovery=None)
    steps, targets, cameras = [], [], []
    for tick in range(round(RATE_HZ * DURATION_S)):
        t = tick / RATE_HZ
        point, next_point = target(t), target(t + 1.0 / RATE_HZ)
        controller.change("look", point=point, velocity=(next_point - point) * RATE_HZ)
        step = controller.step(q)
        steps.append(step)
        targets.append(point)
        cameras.append(robot.forward_kinematics(q)[:3, 3])
        q = step.q_ref

    looks = np.array([step.values["look"] for step in steps])
    speeds = np.array([step.qd for step in steps])
    away = [np.linalg.norm(step.errors["posture"]) for step in steps]
    print(f"furthest off the target: {np.degrees(looks.max()):.4f} deg")
    # The place of the target is rounded, in the last of its digits.
    print(f"samples more than 3 deg off: {(looks > GREATEST_RAD + 1e-12).sum()}")
    print(f"time in which the view is held: {sum('look' in step.active for step in steps) / RATE_HZ:.2f} s")
    print(f"greatest speed of a joint: {np.degrees(np.abs(speeds).max()):.1f} deg/s")
    print(f"furthest from the posture: {np.degrees(max(away)):.1f} deg")

    if arguments.picture:
        draw(arguments.picture, steps, targets, cameras)


def draw(path, steps, targets, cameras):
    import drawing

    t = np.arange(len(steps)) / RATE_HZ
    figure, way, (look, speed) = drawing.figure_of_run("A camera on a target that flies loops, after an example of mink")
    way.line(targets, "way of the target", drawing.GREY, linestyle=":")
    way.line(cameras, "way of the camera")
    for number in range(0, len(steps), len(steps) // 12):
        ends = [cameras[number], targets[number]]
        label = "line of sight" if number == 0 else None
        way.above.plot(*np.transpose(ends)[[1, 0]], color=drawing.ORANGE, linewidth=0.8, label=label)
        way.side.plot(*np.transpose(ends)[[1, 2]], color=drawing.ORANGE, linewidth=0.8)
    way.finish(columns=2)
    drawing.value_over_time(look, t, np.degrees([step.values["look"] for step in steps]), "off the target")
    drawing.bound(look, np.degrees(GREATEST_RAD), "bound")
    drawing.active(look, t, ["look" in step.active for step in steps], "held")
    look.set(ylabel="angle [deg]", ylim=(0.0, 3.4))
    drawing.legend_above(look)
    speeds = np.degrees(np.abs([step.qd for step in steps]).max(axis=1))
    drawing.value_over_time(speed, t, speeds, "fastest joint")
    speed.set(ylabel="speed [deg/s]")
    drawing.legend_above(speed)
    drawing.save(figure, path)


if __name__ == "__main__":
    main()

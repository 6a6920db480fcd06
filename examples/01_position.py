"""One equality task: the tool goes to a point.

    python examples/01_position.py [--picture 01_position.svg]

The task asks for the velocity `gain * error`. So the error falls as exp(-gain t), and the tool goes there on a
straight line: no set is in its way.
"""

import argparse

import numpy as np

import conik

RATE_HZ = 125.0
DURATION_S = 20.0
GAIN_PER_S = 0.5
TARGET_M = np.array([0.320, 0.370, -0.250])
START = np.radians([-48.0, -158.0, -108.0, -90.0, -85.0, 0.0])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--picture", help="where to draw the run")
    arguments = parser.parse_args()

    robot = conik.Robot.builtin("ur5-paper")
    stack = conik.Stack(robot)
    stack.equality("position", conik.Position(TARGET_M), gain=GAIN_PER_S)
    controller = conik.Controller(robot, stack, RATE_HZ)

    q = START
    tools, errors = [], []
    for _ in range(int(RATE_HZ * DURATION_S)):
        step = controller.step(q)
        tools.append(step.values["position"])
        errors.append(np.linalg.norm(step.errors["position"]))
        q = step.q_ref
    tools, errors = np.array(tools), np.array(errors)

    second = int(RATE_HZ)
    way = (TARGET_M - tools[0]) / errors[0]
    off = tools - tools[0]
    aside = np.linalg.norm(off - np.outer(off @ way, way), axis=1)
    print(f"distance at the start: {errors[0]:.4f} m")
    print(f"distance after 4 s: {errors[4 * second]:.4f} m")
    print(f"distance by exp(-gain t) after 4 s: {errors[0] * np.exp(-GAIN_PER_S * 4.0):.4f} m")
    print(f"nearer than 1 mm after: {np.argmax(errors < 1e-3) / RATE_HZ:.3f} s")
    print(f"furthest from the straight line: {aside.max() * 1e3:.2f} mm")

    if arguments.picture:
        draw(arguments.picture, np.arange(len(errors)) / RATE_HZ, tools, errors)


def draw(path, t, tools, errors):
    import drawing

    figure, way, (over_time,) = drawing.figure_of_run("One equality task: the tool goes to a point", values=1)
    way.line(tools, "way of the tool")
    way.marks(tools[0], "start", "o")
    way.marks(TARGET_M, "target")
    way.finish()
    drawing.value_over_time(over_time, t, errors, "distance to the target")
    exponential = errors[0] * np.exp(-GAIN_PER_S * t)
    dots = {"linestyle": (0, (2, 3)), "linewidth": 2.5}
    drawing.value_over_time(over_time, t, exponential, "start · exp(−gain t)", drawing.ORANGE, **dots)
    over_time.set(ylabel="distance [m]", yscale="log")
    over_time.legend()
    drawing.save(figure, path)


if __name__ == "__main__":
    main()

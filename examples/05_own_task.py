"""A task of one's own: how far the forearm leans, as a set, while the tool goes to a point.

    python examples/05_own_task.py [--picture 05_own_task.svg]

A task is a class with a value and its Jacobian. This one is the sum of two joints, which on this arm is how far
the forearm leans. Added to the stack it is kept like any other set.
"""

import argparse

import numpy as np

import conik

RATE_HZ = 125.0
DURATION_S = 10.0
START = np.radians([-48.0, -158.0, -108.0, -90.0, -85.0, 0.0])
TARGET_M = [0.3, 0.4, 0.1]
LEAST_RAD, GREATEST_RAD = -4.8, -4.3


class Lean(conik.OwnTask):
    """The sum of some joints [rad]."""

    unit = "rad"

    def __init__(self, joints):
        super().__init__()
        self.joints = joints

    def value(self, kinematics):
        return sum(kinematics.q[joint] for joint in self.joints)

    def jacobian(self, kinematics):
        row = np.zeros(kinematics.dof)
        row[self.joints] = 1.0
        return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--picture", help="where to draw the run")
    arguments = parser.parse_args()

    robot = conik.Robot.builtin("ur5-paper")
    stack = conik.Stack(robot)
    stack.set("lean", Lean(joints=[1, 2]), min=LEAST_RAD, max=GREATEST_RAD)
    stack.equality("position", conik.Position(TARGET_M), gain=1.0)
    controller = conik.Controller(robot, stack, RATE_HZ)

    q = START
    steps = []
    for _ in range(int(RATE_HZ * DURATION_S)):
        steps.append(controller.step(q))
        q = steps[-1].q_ref

    leans = [step.values["lean"] for step in steps]
    outside = sum(not LEAST_RAD <= lean <= GREATEST_RAD for lean in leans)
    print(f"lean at the start: {leans[0]:.4f} rad")
    print(f"least lean: {min(leans):.5f} rad")
    print(f"greatest lean: {max(leans):.5f} rad")
    print(f"samples outside: {outside}")
    print(f"time in which the lean is held: {sum('lean' in step.active for step in steps) / RATE_HZ:.3f} s")
    print(f"left to the target: {np.linalg.norm(steps[-1].errors['position']) * 1e3:.4f} mm")

    if arguments.picture:
        draw(arguments.picture, steps)


def draw(path, steps):
    import drawing

    t = np.arange(len(steps)) / RATE_HZ
    figure, way, (lean, left) = drawing.figure_of_run("A task of one's own, the lean of the forearm, above a position")
    way.line([step.values["position"] for step in steps], "way of the tool")
    way.marks(steps[0].values["position"], "start", "o")
    way.marks(TARGET_M, "target")
    way.finish()
    drawing.value_over_time(lean, t, [step.values["lean"] for step in steps], "lean")
    drawing.bound(lean, LEAST_RAD, "bounds")
    drawing.bound(lean, GREATEST_RAD)
    drawing.active(lean, t, ["lean" in step.active for step in steps], "held")
    lean.set(ylabel="lean [rad]")
    drawing.legend_above(lean)
    distance = [np.linalg.norm(step.errors["position"]) for step in steps]
    drawing.value_over_time(left, t, distance, "distance to the target")
    left.set(ylabel="distance [m]", yscale="log")
    drawing.legend_above(left)
    drawing.save(figure, path)


if __name__ == "__main__":
    main()

"""Sets above an equality task: the tool goes past two obstacles. Example 1 of the paper.

    python examples/02_obstacle.py [--picture 02_obstacle.svg]

Each obstacle is a set, "at least so far away". While the tool is further away the sets cost nothing; where
the way to the next waypoint would enter one, the tool is held at its border and slides along it. Below the
position, the view is to be straight along x, with what freedom is left.
"""

import argparse

import numpy as np

import conik

RATE_HZ = 125.0
DURATION_S = 60.0
START = np.radians([-48.0, -158.0, -108.0, -90.0, -85.0, 0.0])
# Each obstacle: where it is [m], and how far away the tool is to stay [m].
OBSTACLES = {
    "obstacle_a": ([0.40, -0.25, -0.33], 0.18),
    "obstacle_b": ([0.40, 0.15, -0.33], 0.15),
}
WAYPOINTS_M = np.array([[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]])
ACCEPTANCE_M = 0.02


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--picture", help="where to draw the run")
    arguments = parser.parse_args()

    robot = conik.Robot.builtin("ur5-paper")
    stack = conik.Stack(robot)
    for name, (point, least) in OBSTACLES.items():
        stack.set(name, conik.Distance(point), min=least)
    stack.equality("position", conik.Position(WAYPOINTS_M[0]), gain=0.3)
    stack.equality("view", conik.FieldOfView([1.0, 0.0, 0.0], desired=0.0), gain=1.0)
    controller = conik.Controller(robot, stack, RATE_HZ)

    q = START
    steps, reached = [], []
    for tick in range(int(RATE_HZ * DURATION_S)):
        step = controller.step(q)
        steps.append(step)
        q = step.q_ref
        # A waypoint is reached inside a circle about it; then the next one is the target.
        if len(reached) < len(WAYPOINTS_M) and np.linalg.norm(step.errors["position"]) < ACCEPTANCE_M:
            reached.append(tick / RATE_HZ)
            if len(reached) < len(WAYPOINTS_M):
                controller.change("position", target=WAYPOINTS_M[len(reached)])

    for number, time in enumerate(reached, 1):
        print(f"waypoint {number} reached after: {time:.3f} s")
    for name, (_, least) in OBSTACLES.items():
        distances = [step.values[name] for step in steps]
        outside = sum(distance < least for distance in distances)
        print(f"least distance to {name}: {min(distances):.5f} m")
        print(f"samples nearer than {least} m to {name}: {outside}")
    changes = sum(before.active != after.active for before, after in zip(steps, steps[1:]))
    print(f"changes of what is held: {changes}")
    print(f"left to the last waypoint: {np.linalg.norm(step.errors['position']) * 1e3:.3f} mm")
    print(f"left of the view: {step.values['view']:.6f}")

    if arguments.picture:
        draw(arguments.picture, steps)


def draw(path, steps):
    import drawing

    t = np.arange(len(steps)) / RATE_HZ
    figure, way, (distances, view) = drawing.figure_of_run("Two obstacles above a position above a view (Example 1 of the paper)")
    colors = [drawing.VERMILION, drawing.PURPLE]
    for (name, (point, least)), color in zip(OBSTACLES.items(), colors):
        letter = name[-1]
        way.sphere(point, least, f"obstacle {letter}", color)
        drawing.value_over_time(distances, t, [step.values[name] for step in steps], f"to {letter}", color)
        drawing.bound(distances, least, color=color)
        drawing.active(distances, t, [name in step.active for step in steps], f"{letter} held", color)
    way.line([step.values["position"] for step in steps], "way of the tool")
    way.marks(steps[0].values["position"], "start", "o")
    way.marks(WAYPOINTS_M, "waypoints", numbered=True)
    way.finish()
    distances.set(ylabel="distance [m]")
    drawing.legend_above(distances)
    drawing.value_over_time(view, t, [step.values["view"] for step in steps], "view, to be 0")
    view.set(ylabel="view: 2 sin(angle / 2) [–]")
    drawing.legend_above(view)
    drawing.save(figure, path)


if __name__ == "__main__":
    main()

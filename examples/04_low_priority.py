"""A set below an equality task: the tool looks within a cone where the position allows. Example 3 of the paper.

    python examples/04_low_priority.py [--picture 04_low_priority.svg]

The view stands below the position, so it has low priority, and needs a gain: it is driven back to its border
as well as the obstacles and the position allow. Unlike in 03_field_of_view, samples may lie outside of it.
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
# The value is 2 sin(angle / 2): 0.2622 is 15.07 degrees.
VIEW_MAX = 0.2622
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
    stack.set("view", conik.FieldOfView([1.0, 0.0, 0.0]), max=VIEW_MAX, gain=1.0)
    controller = conik.Controller(robot, stack, RATE_HZ)

    q = START
    steps, reached = [], []
    for tick in range(int(RATE_HZ * DURATION_S)):
        step = controller.step(q)
        steps.append(step)
        q = step.q_ref
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
    views = [step.values["view"] for step in steps]
    entered = next(tick for tick, view in enumerate(views) if view <= VIEW_MAX)
    print(f"view at the start: {views[0]:.4f}")
    print(f"view entered after: {entered / RATE_HZ:.3f} s")
    print(f"greatest view from then on: {max(views[entered:]):.5f}")
    print(f"samples outside the view from then on: {sum(view > VIEW_MAX for view in views[entered:])}")
    print(f"view at the end: {views[-1]:.6f}")
    print(f"time in which the view is active: {sum('view' in step.active for step in steps) / RATE_HZ:.3f} s")
    changes = sum(before.active != after.active for before, after in zip(steps, steps[1:]))
    print(f"changes of what is active: {changes}")

    if arguments.picture:
        draw(arguments.picture, steps)


def draw(path, steps):
    import drawing

    t = np.arange(len(steps)) / RATE_HZ
    figure, way, (distances, view) = drawing.figure_of_run("Two obstacles above a position above a view (Example 3 of the paper)")
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
    drawing.value_over_time(view, t, [step.values["view"] for step in steps], "view")
    drawing.bound(view, VIEW_MAX, "bound")
    drawing.active(view, t, ["view" in step.active for step in steps], "active")
    view.set(ylabel="view: 2 sin(angle / 2) [–]")
    drawing.legend_above(view)
    drawing.save(figure, path)


if __name__ == "__main__":
    main()

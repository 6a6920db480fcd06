"""A ball that crosses the tool's way. The controller is told where it is, and how it moves.

    python examples/06_moving_obstacle.py [--picture 06_moving_obstacle.svg]

The ball moves at 0.2 m/s for 5.5 s and then stays. Before every tick the controller is told where it is now and
with what velocity it moves, so the next sample is computed for where the ball will be then: the tool gives way
in time. A second run tells only where the ball is: there the tool is late, and inside the ball for a while.
"""

import argparse

import numpy as np

import conik

RATE_HZ = 125.0
DURATION_S = 30.0
START = np.radians([-48.0, -158.0, -108.0, -90.0, -85.0, 0.0])
BALL_M = np.array([0.75, 0.30, -0.25])
BALL_M_PER_S = np.array([-0.1132, -0.1649, 0.0])
BALL_STOPS_S = 5.5
LEAST_M = 0.12
WAYPOINTS_M = np.array([[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]])
ACCEPTANCE_M = 0.02


def ball(t):
    """Where the ball is [m], and its velocity [m/s]."""
    if t < BALL_STOPS_S:
        return BALL_M + BALL_M_PER_S * t, BALL_M_PER_S
    return BALL_M + BALL_M_PER_S * BALL_STOPS_S, np.zeros(3)


def run(tells_velocity):
    """All steps, and when the waypoints were reached [s]."""
    robot = conik.Robot.builtin("ur5-paper")
    stack = conik.Stack(robot)
    stack.set("ball", conik.Distance(BALL_M), min=LEAST_M)
    stack.equality("position", conik.Position(WAYPOINTS_M[0]), gain=0.3)
    controller = conik.Controller(robot, stack, RATE_HZ)

    q = START
    steps, reached = [], []
    for tick in range(int(RATE_HZ * DURATION_S)):
        point, velocity = ball(tick / RATE_HZ)
        controller.change("ball", point=point, velocity=velocity if tells_velocity else None)
        step = controller.step(q)
        steps.append(step)
        q = step.q_ref
        if len(reached) < len(WAYPOINTS_M) and np.linalg.norm(step.errors["position"]) < ACCEPTANCE_M:
            reached.append(tick / RATE_HZ)
            if len(reached) < len(WAYPOINTS_M):
                controller.change("position", target=WAYPOINTS_M[len(reached)])
    return steps, reached


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--picture", help="where to draw the run")
    arguments = parser.parse_args()

    runs = {}
    for name, tells_velocity in (("velocity told", True), ("velocity not told", False)):
        steps, reached = run(tells_velocity)
        runs[name] = steps
        inside = [LEAST_M - step.values["ball"] for step in steps]
        for number, time in enumerate(reached, 1):
            print(f"{name}, waypoint {number} reached after: {time:.3f} s")
        # A rounding of the ball's place, in the last of its digits, is no entry.
        print(f"{name}, samples inside the ball: {sum(depth > 1e-12 for depth in inside)}")
        print(f"{name}, deepest inside the ball: {max(0.0, max(inside)) * 1e3:.3f} mm")
        held = sum("ball" in step.active for step in steps)
        print(f"{name}, time in which the ball is held off: {held / RATE_HZ:.3f} s")

    if arguments.picture:
        draw(arguments.picture, runs)


def draw(path, runs):
    import drawing

    told, untold = runs["velocity told"], runs["velocity not told"]
    t = np.arange(len(told)) / RATE_HZ
    figure, way, (distance, depth) = drawing.figure_of_run("A ball that moves at 0.2 m/s crosses the tool's way")
    for number, time in enumerate((0.0, 2.75, 5.5)):
        way.sphere(ball(time)[0], LEAST_M, "ball at 0, 2.75 and 5.5 s" if number == 0 else None)
    way.line([step.values["position"] for step in told], "way of the tool")
    way.marks(told[0].values["position"], "start", "o")
    way.marks(WAYPOINTS_M, "waypoints", numbered=True)
    way.finish()
    drawing.value_over_time(distance, t, [step.values["ball"] for step in told], "to the ball")
    drawing.bound(distance, LEAST_M, "bound")
    drawing.active(distance, t, ["ball" in step.active for step in told], "held off")
    distance.set(ylabel="distance [m]")
    drawing.legend_above(distance)
    for name, steps, color, line in (
        ("velocity told", told, drawing.BLUE, "-"),
        ("not told", untold, drawing.VERMILION, "--"),
    ):
        inside = [max(0.0, LEAST_M - step.values["ball"]) * 1e3 for step in steps]
        drawing.value_over_time(depth, t, inside, name, color, linestyle=line)
    depth.set(ylabel="inside the ball [mm]")
    drawing.legend_above(depth)
    drawing.save(figure, path)


if __name__ == "__main__":
    main()

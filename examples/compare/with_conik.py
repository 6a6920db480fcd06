"""The scene for Conik: three sets above a position."""

import conik
import scene

PACKAGE = "conik"


class Solver:
    def __init__(self):
        robot = conik.Robot.from_urdf(scene.urdf(), tool="tool")
        stack = conik.Stack(robot)
        for name, (point, least) in scene.OBSTACLES.items():
            stack.set(name, conik.Distance(point), min=least)
        stack.set("view", conik.FieldOfView(scene.VIEW_DIRECTION), max=scene.VIEW_MAX)
        stack.equality("position", conik.Position(scene.WAYPOINTS_M[0]), gain=scene.GAIN_PER_S)
        self.controller = conik.Controller(robot, stack, scene.RATE_HZ)

    def set_target(self, target):
        self.controller.change("position", target=target)

    def step(self, q):
        return self.controller.step(q).q_ref

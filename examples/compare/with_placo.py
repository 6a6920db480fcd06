"""The scene for placo: a position as a soft task, the sets as constraints, in one quadratic program.

All three are placo's own: collision avoidance between balls, and a cone for the direction. A cone that is hard has
no solution while the arm is further outside than the joints can turn in one period, as it is at the start; so it
is soft until it is entered, and hard from then on.
"""

import json
import tempfile
from pathlib import Path

import numpy as np
import placo
import scene

PACKAGE = "placo"
MARGIN_M = 0.005
# Of the view while it is outside, against 1 of the position. With 0.01 the turn of the wrist moves the tool by 30 cm
# within the first second; so small, the position is as good as strictly above it.
SOFT_WEIGHT = 1e-6


class Solver:
    def __init__(self):
        self.robot = placo.RobotWrapper(str(scene.urdf(MARGIN_M)))
        pairs = Path(tempfile.mkdtemp(prefix="conik-compare-")) / "pairs.json"
        pairs.write_text(json.dumps([["tool", name] for name in scene.OBSTACLES]))
        self.robot.load_collision_pairs(str(pairs))
        self.solver = self.robot.make_solver()
        self.solver.mask_fbase(True)
        self.solver.dt = scene.PERIOD_S
        self.solver.enable_velocity_limits(True)
        self.position = self.solver.add_position_task("tool", scene.WAYPOINTS_M[0])
        self.position.configure("position", "soft", 1.0)
        self.solver.add_regularization_task(1e-8)
        avoid = self.solver.add_avoid_self_collisions_constraint()
        avoid.self_collisions_margin = MARGIN_M
        avoid.self_collisions_trigger = 0.05
        avoid.configure("obstacles", "hard", 1.0)
        self.view = self.solver.add_cone_constraint("view", "tool", scene.VIEW_MAX_RAD)
        self.view.configure("view", "soft", SOFT_WEIGHT)
        self.is_view_hard = False
        self.target = scene.WAYPOINTS_M[0]

    def set_target(self, target):
        self.target = target

    def step(self, q):
        for name, angle in zip(scene.JOINTS, q):
            self.robot.set_joint(name, angle)
        self.robot.update_kinematics()
        pose = self.robot.get_T_world_frame("tool")
        if not self.is_view_hard and np.arccos(pose[0, 2]) <= scene.VIEW_MAX_RAD:
            self.is_view_hard = True
            self.view.configure("view", "hard", 1.0)
        # A task takes all of its error in one period; so the target is put where the tool is to be next.
        share = scene.GAIN_PER_S * scene.PERIOD_S
        self.position.target_world = pose[:3, 3] + share * (self.target - pose[:3, 3])
        self.solver.solve(True)
        return np.array([self.robot.get_joint(name) for name in scene.JOINTS])

"""The scene for mink: a position as a task, the sets as limits, in one quadratic program.

Obstacles are mink's own collision avoidance, between balls. It has no limit for a direction; ours below is written
like its own: the bound may be approached by a share of what is left in each period; and from outside it is driven
in at a speed that the joints can do.
"""

import mink
import mujoco
import numpy as np
import scene
from mink.limits import CollisionAvoidanceLimit, Constraint, Limit, VelocityLimit

PACKAGE = "mink"
MARGIN_M = 0.005
# mink's own default for collision avoidance.
APPROACH_GAIN = 0.85
# How fast the cosine of the view is driven in from outside [1/s].
RECOVERY_PER_S = 0.3


class ViewLimit(Limit):
    """The cosine of the angle to the direction stays above that of the greatest angle."""

    def compute_qp_inequalities(self, configuration, dt):
        rotation = configuration.get_transform_frame_to_world("tool", "site").as_matrix()[:3, :3]
        turning = rotation @ configuration.get_frame_jacobian("tool", "site")[3:]
        row = np.cross(rotation[:, 2], scene.VIEW_DIRECTION) @ turning
        left = rotation[:, 2] @ scene.VIEW_DIRECTION - np.cos(scene.VIEW_MAX_RAD)
        bound = max(APPROACH_GAIN * left, -RECOVERY_PER_S * dt)
        return Constraint(G=-row[None, :], h=np.array([bound]))


class Solver:
    def __init__(self):
        model = mujoco.MjModel.from_xml_string(scene.mjcf(MARGIN_M))
        self.configuration = mink.Configuration(model, scene.START)
        # A gain is the share of the error that is taken in one period.
        gain = scene.GAIN_PER_S * scene.PERIOD_S
        self.position = mink.FrameTask("tool", "site", position_cost=1.0, orientation_cost=0.0, gain=gain)
        avoid = CollisionAvoidanceLimit(
            model,
            [(["tool"], list(scene.OBSTACLES))],
            gain=APPROACH_GAIN,
            minimum_distance_from_collisions=MARGIN_M,
            collision_detection_distance=0.05,
        )
        speeds = dict.fromkeys(scene.JOINTS, scene.SPEED_LIMIT)
        self.limits = [avoid, ViewLimit(), VelocityLimit(model, speeds)]

    def set_target(self, target):
        self.target = target

    def step(self, q):
        self.configuration.update(q)
        # The error is the logarithm of a pose; with the present orientation as the target it is that of the
        # position alone, and the tool goes straight.
        rotation = self.configuration.get_transform_frame_to_world("tool", "site").rotation()
        self.position.set_target(mink.SE3.from_rotation_and_translation(rotation, self.target))
        tasks = [self.position]
        velocity = mink.solve_ik(
            self.configuration, tasks, scene.PERIOD_S, solver="daqp", damping=1e-8, limits=self.limits
        )
        return q + velocity * scene.PERIOD_S

"""The scene for pink: a position as a task, the sets as control barrier functions, in one quadratic program.

Obstacles are pink's own barrier between two frames. It has none for a direction; ours below is written as its
documentation says. A barrier keeps h >= 0 by `dh/dt >= -gain * h`, and so drives a set that starts outside in.

The position is a task of ours too: pink's `FrameTask` without a cost of the orientation goes by the logarithm of
the whole pose, which turns of the wrist change as well. The tool then takes another way, and a comparison of times
says nothing.
"""

import numpy as np
import pink
import pinocchio as pin
import scene
from pink.barriers import Barrier, BodySphericalBarrier
from pink.limits import VelocityLimit
from pink.tasks import Task

PACKAGE = "pin-pink"
BARRIER_GAIN = 50.0
# How fast the view is driven in from outside [1/s]; as fast as the gain asks is more than the joints can do.
RECOVERY_PER_S = 0.3


class PositionTask(Task):
    """Error: target - position of the tool [m]."""

    target = None

    def compute_error(self, configuration):
        return self.target - configuration.get_transform_frame_to_world("tool").translation

    def compute_jacobian(self, configuration):
        rotation = configuration.get_transform_frame_to_world("tool").rotation
        return -rotation @ configuration.get_frame_jacobian("tool")[:3]

    def __repr__(self):
        return f"PositionTask(cost={self.cost}, gain={self.gain})"


class ViewBarrier(Barrier):
    """h = cosine of the angle to the direction - cosine of the greatest angle."""

    def __init__(self, gain):
        super().__init__(dim=1, gain=gain, gain_function=lambda h: max(h, -RECOVERY_PER_S / gain))

    def compute_barrier(self, configuration):
        axis = configuration.get_transform_frame_to_world("tool").rotation[:, 2]
        return np.array([axis @ scene.VIEW_DIRECTION - np.cos(scene.VIEW_MAX_RAD)])

    def compute_jacobian(self, configuration):
        rotation = configuration.get_transform_frame_to_world("tool").rotation
        turning = rotation @ configuration.get_frame_jacobian("tool")[3:]
        # d(axis) = turning x axis, so the cosine changes by (axis x direction) . turning.
        return (np.cross(rotation[:, 2], scene.VIEW_DIRECTION) @ turning)[None, :]


class Solver:
    def __init__(self):
        model = pin.buildModelFromUrdf(str(scene.urdf()))
        self.configuration = pink.Configuration(model, model.createData(), scene.START)
        # A gain is the share of the error that is taken in one period.
        gain = scene.GAIN_PER_S * scene.PERIOD_S
        self.position = PositionTask(cost=1.0, gain=gain)
        self.barriers = [
            # Its pull towards standing still would slow the position down.
            BodySphericalBarrier(("tool", name), least, gain=BARRIER_GAIN, safe_displacement_gain=0.0)
            for name, (_, least) in scene.OBSTACLES.items()
        ]
        self.barriers.append(ViewBarrier(BARRIER_GAIN))
        self.limits = [VelocityLimit(model)]

    def set_target(self, target):
        self.position.target = target

    def step(self, q):
        self.configuration.update(q)
        velocity = pink.solve_ik(
            self.configuration,
            [self.position],
            scene.PERIOD_S,
            solver="daqp",
            damping=1e-8,
            limits=self.limits,
            barriers=self.barriers,
        )
        return q + velocity * scene.PERIOD_S

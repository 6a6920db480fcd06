"""Set-based task-priority inverse kinematics: a real-time kinematic controller for robot arms.

A robot has tasks in decreasing priority. An *equality task* is to have one value ("be at this point"); a
*set-based task* is to stay between bounds ("stay 18 cm from that"). Once a period the controller gives the
joint velocity that keeps all sets above the first equality task and does what the tasks ask as well as that
allows, the more important ones first. There are no weights.

    import numpy as np
    import conik

    robot = conik.Robot.builtin("ur5-paper")
    stack = conik.Stack(robot)
    stack.set("obstacle", conik.Distance([0.40, -0.25, -0.33]), min=0.18)
    stack.equality("position", conik.Position([0.486, -0.066, -0.250]), gain=0.3)
    controller = conik.Controller(robot, stack, rate_hz=125)

    q = np.array([-0.84, -2.76, -1.88, -1.57, -1.48, 0.0])
    for tick in range(125 * 60):
        step = controller.step(q)
        q = step.q_ref

Lengths are in metres, angles in radians, times in seconds. Everything is in the world, which is the robot's
base frame unless it stands elsewhere. Whole scenario files are run with `conik.run`.
"""

from ._conik import ConikError, Kinematics, Robot, ScenarioError, Step, StepError
from .campaign import Campaign, campaign
from .controller import Controller
from .run import Run, run
from .stack import Stack
from .tasks import (
    Coordinate,
    Distance,
    Elbow,
    FieldOfView,
    Height,
    Joint,
    JointSpeed,
    LookAt,
    Manipulability,
    Orientation,
    OrientationAngle,
    OwnTask,
    Plane,
    PointingAngle,
    Pose,
    Position,
    Posture,
    ShapeDistance,
    SmallestSingularValue,
    Task,
    Workspace,
)

__all__ = [
    "Campaign",
    "ConikError",
    "Controller",
    "Coordinate",
    "Distance",
    "Elbow",
    "FieldOfView",
    "Height",
    "Joint",
    "JointSpeed",
    "Kinematics",
    "LookAt",
    "Manipulability",
    "Orientation",
    "OrientationAngle",
    "OwnTask",
    "Plane",
    "PointingAngle",
    "Pose",
    "Position",
    "Posture",
    "Robot",
    "Run",
    "ScenarioError",
    "ShapeDistance",
    "SmallestSingularValue",
    "Stack",
    "Step",
    "StepError",
    "Task",
    "Workspace",
    "campaign",
    "run",
]

"""A Pinocchio model in: written as URDF, read by Conik, compared with Pinocchio, and steered.

    python examples/11_pinocchio.py [--urdf arm.urdf]

Any `pin.Model` of revolute and prismatic joints with one degree of freedom each will do; the one here, an arm
with seven axes of which one is askew, is made in the script. If your model came from a URDF file, give Conik that
file: `conik.Robot.from_urdf(path)`.
"""

import argparse
import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np
import pinocchio as pin

import conik

TOOL = "tool"
RATE_HZ = 200.0
DURATION_S = 15.0
# Each joint: its axis, and where it is on the link before it: x, y, z [m], roll, pitch, yaw [rad].
JOINTS = [
    ([0.0, 0.0, 1.0], [0.0, 0.0, 0.34, 0.0, 0.0, 0.0]),
    ([0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 0.0, 0.0, 0.3]),
    ([0.0, 0.0, 1.0], [0.0, 0.0, 0.20, 0.0, 0.0, 0.0]),
    ([0.0, -1.0, 0.0], [0.03, 0.0, 0.20, 0.0, 0.1, 0.0]),
    ([0.0, 0.6, 0.8], [-0.03, 0.0, 0.20, 0.0, 0.0, 0.0]),
    ([0.0, 1.0, 0.0], [0.0, 0.0, 0.20, 0.2, 0.0, 0.0]),
    ([0.0, 0.0, 1.0], [0.0, 0.0, 0.10, 0.0, 0.0, 0.0]),
]
START = np.array([0.0, 0.6, 0.0, -1.4, 0.0, 1.0, 0.0])
TARGET_M = np.array([0.45, 0.30, 0.0])
# How high the elbow and the tool are to stay. The target is below: the tool comes as near as that allows.
ELBOW_M, FLOOR_M = 0.60, 0.02


def arm():
    """The arm, as Pinocchio has it."""
    model = pin.Model()
    model.name = "seven_axes"
    parent = 0
    for number, (axis, place) in enumerate(JOINTS, 1):
        placement = pin.SE3(pin.rpy.rpyToMatrix(*place[3:]), np.array(place[:3]))
        joint = pin.JointModelRevoluteUnaligned(np.array(axis))
        ranges = [np.array([value]) for value in (100.0, 2.0, -2.9, 2.9)]
        parent = model.addJoint(parent, joint, placement, f"joint_{number}", *ranges)
    tool = pin.SE3(np.eye(3), np.array([0.0, 0.0, 0.15]))
    model.addFrame(pin.Frame(TOOL, parent, 0, tool, pin.FrameType.OP_FRAME))
    return model


def urdf_of(model, tool):
    """A model of single joints as a URDF file, with a link for the frame `tool`."""
    robot = xml.Element("robot", name=model.name)
    names = [f"{name}_link" for name in model.names]
    for name in (*names, tool):
        xml.SubElement(robot, "link", name=name)
    for number in range(1, model.njoints):
        joint = model.joints[number]
        kind = "prismatic" if joint.shortname().startswith("JointModelP") else "revolute"
        limits = {
            "lower": repr(float(model.lowerPositionLimit[joint.idx_q])),
            "upper": repr(float(model.upperPositionLimit[joint.idx_q])),
            "velocity": repr(float(model.velocityLimit[joint.idx_v])),
            "effort": "0",
        }
        links = names[model.parents[number]], names[number]
        element = add_joint(robot, model.names[number], kind, *links, model.jointPlacements[number])
        xml.SubElement(element, "axis", xyz=numbers(axis_of(model, number)))
        xml.SubElement(element, "limit", limits)
    frame = model.frames[model.getFrameId(tool)]
    add_joint(robot, f"{tool}_joint", "fixed", names[frame.parentJoint], tool, frame.placement)
    return xml.tostring(robot, encoding="unicode")


def add_joint(robot, name, kind, parent, child, placement):
    element = xml.SubElement(robot, "joint", name=name, type=kind)
    xml.SubElement(element, "parent", link=parent)
    xml.SubElement(element, "child", link=child)
    rpy = pin.rpy.matrixToRpy(placement.rotation)
    xml.SubElement(element, "origin", xyz=numbers(placement.translation), rpy=numbers(rpy))
    return element


def axis_of(model, number):
    """The axis of a joint in its own frame: what it moves along or about at a speed of 1."""
    data = model.joints[number].createData()
    model.joints[number].calc(data, pin.neutral(model))
    motion = np.ravel(data.S)
    is_prismatic = np.linalg.norm(motion[:3]) > 0.5
    return motion[:3] if is_prismatic else motion[3:]


def numbers(values):
    return " ".join(repr(float(value)) for value in values)


def compare(model, robot, count=1000):
    """The greatest differences of the tool's pose [m, -] and of its Jacobian on random configurations."""
    random = np.random.default_rng(0)
    data = model.createData()
    tool = model.getFrameId(TOOL)
    poses, jacobians = [], []
    for q in random.uniform(model.lowerPositionLimit, model.upperPositionLimit, (count, model.nq)):
        pin.framesForwardKinematics(model, data, q)
        jacobian = pin.computeFrameJacobian(model, data, q, tool, pin.LOCAL_WORLD_ALIGNED)
        kinematics = robot.kinematics(q)
        poses.append(np.abs(kinematics.world_from() - data.oMf[tool].homogeneous).max())
        jacobians.append(np.abs(kinematics.jacobian() - jacobian).max())
    return max(poses), max(jacobians)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--urdf", type=Path, help="where to write the model [default: nowhere that lasts]")
    arguments = parser.parse_args()

    model = arm()
    with tempfile.TemporaryDirectory() as folder:
        path = arguments.urdf or Path(folder) / "arm.urdf"
        path.write_text(urdf_of(model, TOOL))
        robot = conik.Robot.from_urdf(path)
        pose, jacobian = compare(model, robot)
        print(f"joints: {robot.dof}")
        print(f"poses of the tool differ at most by: {pose:.1e}")
        print(f"Jacobians of the tool differ at most by: {jacobian:.1e}")
        # The file has to be there until the controller is made.
        controller = controller_of(robot)
    steer(model, controller)


def controller_of(robot):
    """The elbow and the tool stay above their heights; the tool goes to a point and looks down."""
    stack = conik.Stack(robot)
    stack.set("elbow_height", conik.Height(frame="joint_4_link"), min=ELBOW_M)
    stack.set("tool_height", conik.Height(), min=FLOOR_M)
    stack.equality("position", conik.Position(TARGET_M), gain=2.0)
    stack.equality("down", conik.PointingAngle([0.0, 0.0, -1.0], desired=0.0), gain=2.0)
    return conik.Controller(robot, stack, RATE_HZ)


def steer(model, controller):
    """Runs the controller, and looks with Pinocchio's model at what becomes of it, not with Conik's own."""
    q = START
    data = model.createData()
    tool_heights, elbow_heights = [], []
    for _ in range(int(RATE_HZ * DURATION_S)):
        pin.framesForwardKinematics(model, data, q)
        tool = data.oMf[model.getFrameId(TOOL)]
        tool_heights.append(tool.translation[2])
        elbow_heights.append(data.oMi[4].translation[2])
        q = controller.step(q).q_ref
    angle = np.arccos(np.clip(-tool.rotation[2, 2], -1.0, 1.0))
    print(f"elbow at the start: {elbow_heights[0]:.5f} m")
    print(f"lowest the elbow was: {min(elbow_heights):.5f} m")
    print(f"lowest the tool was: {min(tool_heights):.5f} m")
    print(f"left to the target: {np.linalg.norm(TARGET_M - tool.translation) * 1e3:.4f} mm")
    print(f"left to look straight down: {np.degrees(angle):.4f} deg")


if __name__ == "__main__":
    main()

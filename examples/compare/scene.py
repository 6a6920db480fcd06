"""The scene that all libraries are given: Example 2 of the paper, with the paper's UR5.

What comes of it is measured with the kinematics in this file, which belong to none of them.
"""

import tempfile
import xml.etree.ElementTree as xml
from pathlib import Path

import numpy as np

RATE_HZ = 125.0
PERIOD_S = 1.0 / RATE_HZ
DURATION_S = 60.0
START = np.radians([-48.0, -158.0, -108.0, -90.0, -85.0, 0.0])
# a [m], alpha [rad], d [m]: the Denavit-Hartenberg table of the paper, standard convention.
DH = [
    (0.0, np.pi / 2, 0.089),
    (-0.425, 0.0, 0.0),
    (-0.392, 0.0, 0.0),
    (0.0, np.pi / 2, 0.109),
    (0.0, -np.pi / 2, 0.095),
    (0.0, 0.0, 0.082),
]
JOINTS = [f"joint_{number}" for number in range(1, 7)]
SPEED_LIMIT = np.pi

# Each obstacle: where it is [m], and how far away the tool is to stay [m].
OBSTACLES = {
    "obstacle_a": (np.array([0.40, -0.25, -0.33]), 0.18),
    "obstacle_b": (np.array([0.40, 0.15, -0.33]), 0.15),
}
# The tool's z axis against this direction: |direction - axis| = 2 sin(angle / 2) is to stay below.
VIEW_DIRECTION = np.array([1.0, 0.0, 0.0])
VIEW_MAX = 0.2622
VIEW_MAX_RAD = 2.0 * np.arcsin(VIEW_MAX / 2.0)
WAYPOINTS_M = np.array([[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]])
ACCEPTANCE_M = 0.02
# The tool's error is to fall as exp(-gain t).
GAIN_PER_S = 0.3

# Libraries that know obstacles as shapes get a ball of this radius at the tool [m].
TOOL_BALL_M = 0.01


def base_from_tool(q):
    """Pose of the tool, shape (4, 4)."""
    pose = np.eye(4)
    for angle, (a, alpha, d) in zip(q, DH):
        turn = np.eye(4)
        turn[:2, :2] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
        pose = pose @ turn @ link_end(a, alpha, d)
    return pose


def link_end(a, alpha, d):
    """From a joint's frame, turned by the joint, to the frame of the next one."""
    c, s = np.cos(alpha), np.sin(alpha)
    return np.array([[1.0, 0.0, 0.0, a], [0.0, c, -s, 0.0], [0.0, s, c, d], [0.0, 0.0, 0.0, 1.0]])


def values(q):
    """Position of the tool [m], and the values of the sets."""
    pose = base_from_tool(q)
    sets = {name: np.linalg.norm(pose[:3, 3] - point) for name, (point, _) in OBSTACLES.items()}
    sets["view"] = np.linalg.norm(pose[:3, 2] - VIEW_DIRECTION)
    return pose[:3, 3], sets


def outside(name, value):
    """By how much a value is outside of its set; negative inside."""
    return value - VIEW_MAX if name == "view" else OBSTACLES[name][1] - value


def numbers(values_):
    return " ".join(repr(float(value)) for value in values_)


def urdf(margin_m=0.0):
    """A file with the arm. The world has a link at each obstacle, with a ball that is `margin_m` away from the
    ball at the tool when the tool is at its least distance; and a link whose z axis is the view's direction."""
    robot = xml.Element("robot", name="ur5")
    for name in ("world", *(f"link_{number}" for number in range(1, 7)), "tool", *OBSTACLES, "view"):
        xml.SubElement(robot, "link", name=name)
    balls = {"tool": TOOL_BALL_M}
    balls |= {name: least - TOOL_BALL_M - margin_m for name, (_, least) in OBSTACLES.items()}
    for link in robot.findall("link"):
        # Libraries for dynamics refuse links without a mass.
        inertial = xml.SubElement(link, "inertial")
        xml.SubElement(inertial, "mass", value="1")
        xml.SubElement(inertial, "inertia", ixx="0.01", ixy="0", ixz="0", iyy="0.01", iyz="0", izz="0.01")
        if link.get("name") in balls:
            geometry = xml.SubElement(xml.SubElement(link, "collision"), "geometry")
            xml.SubElement(geometry, "sphere", radius=repr(balls[link.get("name")]))

    def joint(name, kind, parent, child, xyz, rpy):
        element = xml.SubElement(robot, "joint", name=name, type=kind)
        xml.SubElement(element, "parent", link=parent)
        xml.SubElement(element, "child", link=child)
        xml.SubElement(element, "origin", xyz=numbers(xyz), rpy=numbers(rpy))
        return element

    parent, xyz, rpy = "world", (0, 0, 0), (0, 0, 0)
    for number, (a, alpha, d) in enumerate(DH, 1):
        element = joint(f"joint_{number}", "revolute", parent, f"link_{number}", xyz, rpy)
        xml.SubElement(element, "axis", xyz="0 0 1")
        limit = {"lower": "-12.6", "upper": "12.6", "velocity": repr(SPEED_LIMIT), "effort": "100"}
        xml.SubElement(element, "limit", limit)
        parent, xyz, rpy = f"link_{number}", (a, 0.0, d), (alpha, 0.0, 0.0)
    joint("tool_joint", "fixed", parent, "tool", xyz, rpy)
    for name, (point, _) in OBSTACLES.items():
        joint(f"{name}_joint", "fixed", "world", name, point, (0, 0, 0))
    # A turn about y by a quarter takes z to x.
    joint("view_joint", "fixed", "world", "view", (0, 0, 0), (0, np.pi / 2, 0))
    path = Path(tempfile.mkdtemp(prefix="conik-compare-")) / "ur5.urdf"
    path.write_text(xml.tostring(robot, encoding="unicode"))
    return path


def mjcf(margin_m):
    """The same as an MJCF model, with the site `tool` and balls named like the obstacles."""
    model = xml.Element("mujoco", model="ur5")
    xml.SubElement(model, "compiler", angle="radian")
    world = xml.SubElement(model, "worldbody")
    for name, (point, least) in OBSTACLES.items():
        radius = least - TOOL_BALL_M - margin_m
        xml.SubElement(world, "geom", name=name, type="sphere", size=repr(radius), pos=numbers(point))
    body, place = world, {}
    for number, (a, alpha, d) in enumerate(DH, 1):
        body = xml.SubElement(body, "body", name=f"link_{number}", **place)
        xml.SubElement(body, "inertial", pos="0 0 0", mass="1", diaginertia="0.01 0.01 0.01")
        xml.SubElement(body, "joint", name=f"joint_{number}", axis="0 0 1")
        turn = numbers([np.cos(alpha / 2), np.sin(alpha / 2), 0.0, 0.0])
        place = {"pos": numbers([a, 0.0, d]), "quat": turn}
    xml.SubElement(body, "site", name="tool", **place)
    ball = {"name": "tool", "type": "sphere", "size": repr(TOOL_BALL_M), "pos": place["pos"]}
    xml.SubElement(body, "geom", **ball)
    return xml.tostring(model, encoding="unicode")

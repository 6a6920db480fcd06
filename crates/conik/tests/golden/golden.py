#!/usr/bin/env python3
"""Writes `pinocchio.txt`: what Pinocchio says of the built-in robots, of URDF joint types and of random trees.

Run by hand:

    python3 -m venv env && env/bin/pip install pin
    env/bin/python crates/conik/tests/golden/golden.py

The robots are put together here from other documents than in `src/robot/builtin/`, where there are any:
from the transforms between links in the makers' ROS packages, not from Denavit-Hartenberg tables, and
with limits typed in once more. Angles such as 1.570796327 in those files stand for π/2.

The file has a line for each thing, its first word saying which; poses are R row by row, then the origin
[m]; Jacobians are of the tool, in the world, rows x, y, z of velocity, then of angular velocity.
"""

import math
import pathlib
import random

import numpy as np
import pinocchio as pin

PI, HALF = math.pi, math.pi / 2
FOLDER = pathlib.Path(__file__).parent
DRAW = random.Random(20151)
OUT = ["# Written by golden.py: do not edit."]


def numbers(values):
    return " ".join(repr(float(value)) for value in np.ravel(values))


def pose(placement):
    return f"{numbers(placement.rotation)} {numbers(placement.translation)}"


def degrees(*values):
    return [None if value is None else math.radians(value) for value in values]


# --- URDF text -------------------------------------------------------------------------------------


def urdf(joints):
    """A URDF of (name, type, parent, child, xyz, rpy[, axis])."""
    links = dict.fromkeys(link for joint in joints for link in joint[2:4])
    text = "".join(f'<link name="{link}"/>' for link in links)
    for name, kind, parent, child, xyz, rpy, *axis in joints:
        text += f'<joint name="{name}" type="{kind}"><parent link="{parent}"/><child link="{child}"/>'
        text += f'<origin xyz="{numbers(xyz)}" rpy="{numbers(rpy)}"/>'
        if kind != "fixed":
            text += f'<axis xyz="{numbers(axis or [0, 0, 1])}"/>'
            text += '<limit lower="-9" upper="9" velocity="1" effort="1"/>'
        text += "</joint>"
    return f'<robot name="robot">{text}</robot>'


def chain(names, placements):
    """A serial arm: `link_0` to `link_n`, joints about z."""
    return [
        (name, "revolute", f"link_{i}", f"link_{i + 1}", xyz, rpy)
        for i, (name, (xyz, rpy)) in enumerate(zip(names, placements))
    ]


# --- What Pinocchio says ---------------------------------------------------------------------------


def evaluate(model, world, tool, frames, names, qs):
    """Poses of the frames in `world`, and the Jacobian of the tool, joints in the order of `names`."""
    data = model.createData()
    for values in qs:
        q = pin.neutral(model)
        for name, value in zip(names, values):
            joint = model.joints[model.getJointId(name)]
            # Joints without end have the cosine and the sine.
            q[joint.idx_q : joint.idx_q + joint.nq] = (
                value if joint.nq == 1 else [math.cos(value), math.sin(value)]
            )
        pin.computeJointJacobians(model, data, q)
        pin.updateFramePlacements(model, data)
        place = {f.name: data.oMf[i] for i, f in enumerate(model.frames)}
        world_from = place[world].inverse() if world else pin.SE3.Identity()
        OUT.append(f"q {numbers(values)}")
        for frame in frames:
            OUT.append(f"frame {frame} {pose(world_from * place[frame])}")
        local = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        jacobian = pin.getFrameJacobian(model, data, model.getFrameId(tool), local)
        columns = [model.joints[model.getJointId(name)].idx_v for name in names]
        turn = np.kron(np.eye(2), world_from.rotation)
        yield turn @ jacobian[:, columns]


def configurations(limits, count=2):
    def one(limit):
        low, high = limit[0], limit[1]
        return DRAW.uniform(-PI if low is None else low, PI if high is None else high)

    return [[one(limit) for limit in limits] for _ in range(count)]


def robot(name, joints, world, tool, frames, limits):
    """A built-in robot. `limits`: lower, upper, speed, acceleration of each joint, None if there is none."""
    model = pin.buildModelFromXML(urdf(joints))
    names = [joint[0] for joint in joints if joint[1] != "fixed"]
    OUT.append(f"robot {name} {tool}")
    for joint, limit in zip(names, limits):
        OUT.append(f"limits {joint} " + " ".join(str(value) for value in limit))
    qs = configurations(limits)
    for jacobian in evaluate(model, world, tool, frames, names, qs):
        OUT.append(f"jacobian {numbers(jacobian)}")
    return model


# --- The makers' arms ------------------------------------------------------------------------------

UR_NAMES = ["shoulder_pan", "shoulder_lift", "elbow", "wrist_1", "wrist_2", "wrist_3"]
UR_NAMES = [f"{name}_joint" for name in UR_NAMES]


def ur(name, shoulder_z, forearm_x, wrist_1_x, wrist_1_z, wrist_2_y, wrist_3_y, limits):
    """`default_kinematics.yaml` and `ur_macro.xacro` of `ur_description`."""
    placements = [
        ([0, 0, shoulder_z], [0, 0, 0]),
        ([0, 0, 0], [HALF, 0, 0]),
        ([forearm_x, 0, 0], [0, 0, 0]),
        ([wrist_1_x, 0, wrist_1_z], [0, 0, 0]),
        ([0, wrist_2_y, 0], [HALF, 0, 0]),
        ([0, wrist_3_y, 0], [HALF, PI, PI]),
    ]
    joints = chain(UR_NAMES, placements) + [
        ("inertia", "fixed", "base_link", "link_0", [0, 0, 0], [0, 0, PI]),
        ("base_link-base", "fixed", "base_link", "base", [0, 0, 0], [0, 0, PI]),
        ("wrist_3-flange", "fixed", "link_6", "flange", [0, 0, 0], [0, -HALF, -HALF]),
        ("flange-tool0", "fixed", "flange", "tool0", [0, 0, 0], [HALF, 0, HALF]),
    ]
    # The table's frames 1 to 5 are not those of the URDF, whose links begin where the joints are.
    frames = ["base", "base_link", "link_0", "link_6", "flange", "tool0"]
    paper = name == "ur5-paper"
    frames = ["link_0", "link_6"] if paper else frames
    robot(name, joints, "base", "link_6" if paper else "tool0", frames, limits)


def ur_limits(speeds, endless=False):
    """`joint_limits.yaml`, but for its elbow: the data sheet says ±360°."""
    limits = [degrees(-360, 360, speed, None) for speed in speeds]
    if endless:
        limits[5][:2] = [None, None]
    return limits


def universal_robots():
    even, shoulder = [180] * 6, [120, 120] + [180] * 4
    wrist, heavy = [180] * 3 + [360] * 3, [120, 120, 150, 210, 210, 210]
    # Table I of the paper in these terms.
    paper = [degrees(None, None, 180, None)] * 6
    ur("ur5-paper", 0.089, -0.425, -0.392, 0.109, -0.095, 0.082, paper)
    ur("ur3", 0.1519, -0.24365, -0.21325, 0.11235, -0.08535, 0.0819, ur_limits(wrist, True))
    ur("ur5", 0.089159, -0.425, -0.39225, 0.10915, -0.09465, 0.0823, ur_limits(even))
    ur("ur10", 0.1273, -0.612, -0.5723, 0.163941, -0.1157, 0.0922, ur_limits(shoulder))
    ur("ur3e", 0.15185, -0.24355, -0.2132, 0.13105, -0.08535, 0.0921, ur_limits(wrist, True))
    ur("ur5e", 0.1625, -0.425, -0.3922, 0.1333, -0.0997, 0.0996, ur_limits(even))
    ur("ur10e", 0.1807, -0.6127, -0.57155, 0.17415, -0.11985, 0.11655, ur_limits(shoulder))
    ur("ur16e", 0.1807, -0.4784, -0.36, 0.17415, -0.11985, 0.11655, ur_limits(shoulder))
    ur("ur20", 0.2363, -0.862, -0.7287, 0.201, -0.1593, 0.1543, ur_limits(heavy))
    ur("ur30", 0.2363, -0.637, -0.5037, 0.201, -0.1593, 0.1543, ur_limits(heavy))


def franka():
    """`kinematics.yaml`, `joint_limits.yaml` and `franka_hand.xacro` of `franka_description`; accelerations:
    `rate_limiting.h` of libfranka 0.9 (Panda) and of later ones (FR3)."""
    placements = [
        ([0, 0, 0.333], [0, 0, 0]),
        ([0, 0, 0], [-HALF, 0, 0]),
        ([0, -0.316, 0], [HALF, 0, 0]),
        ([0.0825, 0, 0], [HALF, 0, 0]),
        ([-0.0825, 0.384, 0], [-HALF, 0, 0]),
        ([0, 0, 0], [HALF, 0, 0]),
        ([0.088, 0, 0], [HALF, 0, 0]),
    ]
    fixed = [
        ("joint8", "fixed", "link_7", "flange", [0, 0, 0.107], [0, 0, 0]),
        ("hand_joint", "fixed", "flange", "hand", [0, 0, 0], [0, 0, -PI / 4]),
        ("tcp_joint", "fixed", "hand", "hand_tcp", [0, 0, 0.1034], [0, 0, 0]),
    ]
    panda = zip(
        [-2.8973, -1.7628, -2.8973, -3.0718, -2.8973, -0.0175, -2.8973],
        [2.8973, 1.7628, 2.8973, -0.0698, 2.8973, 3.7525, 2.8973],
        [2.175] * 4 + [2.61] * 3,
        [15.0, 7.5, 10.0, 12.5, 15.0, 20.0, 20.0],
    )
    fr3 = zip(
        [-2.7437, -1.7837, -2.9007, -3.0421, -2.8065, 0.5445, -3.0159],
        [2.7437, 1.7837, 2.9007, -0.1518, 2.8065, 4.5169, 3.0159],
        [2.62] * 4 + [5.26, 4.18, 5.26],
        [10.0] * 7,
    )
    frames = [f"link_{i}" for i in range(8)] + ["flange", "hand", "hand_tcp"]
    for name, limits in [("panda", panda), ("fr3", fr3)]:
        joints = chain([f"{name}_joint{i}" for i in range(1, 8)], placements) + fixed
        robot(name, joints, "link_0", "flange", frames, [list(limit) for limit in limits])


def kuka():
    """`iiwa14.xacro` of `iiwa_description`; speeds: the maker's specification."""
    placements = [
        ([0, 0, 0.1575], [0, 0, 0]),
        ([0, 0, 0.2025], [HALF, 0, PI]),
        ([0, 0.2045, 0], [HALF, 0, PI]),
        ([0, 0, 0.2155], [HALF, 0, 0]),
        ([0, 0.1845, 0], [-HALF, PI, 0]),
        ([0, 0, 0.2155], [HALF, 0, 0]),
        ([0, 0.081, 0], [-HALF, PI, 0]),
    ]
    joints = chain([f"iiwa_joint_{i}" for i in range(1, 8)], placements)
    joints.append(("joint_ee", "fixed", "link_7", "flange", [0, 0, 0.045], [0, 0, 0]))
    ranges = [170, 120, 170, 120, 170, 120, 175]
    speeds = [85, 85, 100, 75, 130, 135, 135]
    limits = [degrees(-most, most, speed, None) for most, speed in zip(ranges, speeds)]
    robot("iiwa14", joints, "link_0", "flange", ["link_0", "flange"], limits)


def kinova():
    """The table of the user guide: its URDF differs from it by rounding."""
    from_table = [
        ([0, 0, -0.2848], [0, 0, 0]),
        ([0, 0, -0.0118], [0, 0, PI]),
        ([0, 0, -0.4208], [0, 0, PI]),
        ([0, 0, -0.0128], [0, 0, PI]),
        ([0, 0, -0.3143], [0, 0, PI]),
        ([0, 0, 0], [0, 0, PI]),
        ([0, 0, -0.1674], [0, 0, PI]),
    ]
    names = [f"joint_{i}" for i in range(1, 8)]
    joints = [("base", "fixed", "base_link", "link_0", [0, 0, 0], [PI, 0, 0])]
    for i, (name, (xyz, rpy)) in enumerate(zip(names, from_table), 1):
        # θ and d are along the axis of the joint, so they may as well be before it.
        alpha = PI if i == 7 else HALF
        joints.append((name, "continuous", f"link_{i - 1}", f"turned_{i}", xyz, rpy))
        joints.append((f"row_{i}", "fixed", f"turned_{i}", f"link_{i}", [0, 0, 0], [alpha, 0, 0]))
    joints.append(("interface", "fixed", "link_7", "end_effector_link", [0, 0, 0], [0, 0, 0]))
    ranges = [None, 128.9, None, 147.8, None, 120.3, None]
    limits = [
        degrees(most and -most, most) + [speed, None]
        for most, speed in zip(ranges, [1.39] * 4 + [1.22] * 3)
    ]
    frames = ["base_link"] + [f"link_{i}" for i in range(8)] + ["end_effector_link"]
    model = robot("gen3", joints, "base_link", "end_effector_link", frames, limits)
    against_urdf(model, names)


def against_urdf(model, names):
    """How far the Gen3's table is from its URDF, `gen3_macro.xacro` of `kortex_description`."""
    placements = [
        ([0, 0, 0.15643], [PI, 0, 0]),
        ([0, 0.005375, -0.12838], [HALF, 0, 0]),
        ([0, -0.21038, -0.006375], [-HALF, 0, 0]),
        ([0, 0.006375, -0.21038], [HALF, 0, 0]),
        ([0, -0.20843, -0.006375], [-HALF, 0, 0]),
        ([0, 0.00017505, -0.10593], [HALF, 0, 0]),
        ([0, -0.10593, -0.00017505], [-HALF, 0, 0]),
    ]
    joints = chain(names, placements)
    joints.append(("ee", "fixed", "link_7", "end", [0, 0, -0.061525], [PI, 0, 0]))
    other = pin.buildModelFromXML(urdf(joints))
    worst = [0.0, 0.0]
    for _ in range(1000):
        q = [DRAW.uniform(-PI, PI) for _ in names]
        ends = []
        for arm, end in [(model, "end_effector_link"), (other, "end")]:
            data = arm.createData()
            both = [v for a in q for v in ((a,) if arm.nq == 7 else (math.cos(a), math.sin(a)))]
            pin.framesForwardKinematics(arm, data, np.array(both))
            ends.append(data.oMf[arm.getFrameId(end)])
        apart = pin.log6(ends[0].inverse() * ends[1])
        worst = [max(worst[0], np.linalg.norm(ends[0].translation - ends[1].translation)),
                 max(worst[1], np.linalg.norm(apart.angular))]
    print(f"gen3: table and URDF at most {worst[0] * 1e3:.3f} mm and {worst[1]:.1e} rad apart")


# --- Joint types and trees -------------------------------------------------------------------------


def joint_types():
    """`joint_types.urdf`: every type of joint that a URDF has, but for those without a single axis."""
    model = pin.buildModelFromUrdf(str(FOLDER / "joint_types.urdf"))
    names = ["column", "left", "lift", "right", "finger"]
    frames = ["base", "mast", "left_arm", "carriage", "right_arm", "plate", "tip", "follower_tip"]
    OUT.append("urdf joint_types.urdf tip " + " ".join(names))
    # `follower` is at −1.5 · lift + 0.2; Pinocchio is told so, and its column added to that of `lift`.
    for _ in range(3):
        values = [DRAW.uniform(-1, 1) for _ in names]
        full = values + [-1.5 * values[names.index("lift")] + 0.2]
        mark = len(OUT)
        (jacobian,) = evaluate(model, "base", "tip", frames, names + ["follower"], [full])
        OUT[mark] = f"q {numbers(values)}"
        jacobian[:, names.index("lift")] += -1.5 * jacobian[:, -1]
        OUT.append(f"jacobian {numbers(jacobian[:, :-1])}")


def trees(count=3, bodies=9):
    """Random trees with turning and sliding joints, one of them a follower, as `RobotBuilder` makes them."""
    for tree in range(count):
        model, names, follower = pin.Model(), [], None
        after = [pin.SE3.Identity()]
        OUT.append(f"tree {tree}")
        for body in range(1, bodies + 1):
            parent = DRAW.randrange(max(0, body - 3), body)
            before, behind = random_pose(), random_pose()
            kind = DRAW.choice(["revolute", "revolute", "prismatic"])
            axis = pin.JointModelRZ() if kind == "revolute" else pin.JointModelPZ()
            name = f"joint_{body}"
            model.addJoint(parent, axis, after[parent] * before, name)
            after.append(behind)
            where = f"{kind} {parent} {pose(before)} {pose(behind)}"
            if body == 5:
                follower = (body - 1, DRAW.randrange(4), DRAW.uniform(-2, 2), DRAW.uniform(-1, 1))
                OUT.append(f"follower {where} {' '.join(map(repr, follower[1:]))}")
            else:
                names.append(name)
                OUT.append(f"joint {where}")
        for link in range(4):
            body = bodies - 2 * link if link < 3 else 0
            placement = random_pose()
            OUT.append(f"link link_{link} {body} {pose(placement)}")
            where = (after[body] if body else pin.SE3.Identity()) * placement
            frame = pin.Frame(f"link_{link}", body, 0, where, pin.FrameType.OP_FRAME)
            model.addFrame(frame)
        at, of, multiplier, offset = follower
        links = [f"link_{link}" for link in range(4)]
        values = [DRAW.uniform(-PI, PI) for _ in names]
        full = values[:at] + [multiplier * values[of] + offset] + values[at:]
        everything = [f"joint_{body}" for body in range(1, bodies + 1)]
        mark = len(OUT)
        (jacobian,) = evaluate(model, None, "link_0", links, everything, [full])
        OUT[mark] = f"q {numbers(values)}"
        own = np.delete(jacobian, at, axis=1)
        own[:, of] += multiplier * jacobian[:, at]
        OUT.append(f"jacobian {numbers(own)}")


def random_pose():
    turn = [DRAW.uniform(-2, 2) for _ in range(3)]
    return pin.SE3(pin.exp3(np.array(turn)), np.array([DRAW.uniform(-0.5, 0.5) for _ in range(3)]))


universal_robots()
franka()
kuka()
kinova()
joint_types()
trees()
(FOLDER / "pinocchio.txt").write_text("\n".join(OUT) + "\n")

"""The arm with its dynamics, simulated by MuJoCo: Conik's references go to position servos.

    python examples/10_mujoco.py [--picture 10_mujoco.svg]

The scene is that of 03_field_of_view. The references keep every set; the arm follows them with a lag, and is
where its servos bring it. How far that is outside of a set has to be added to its bound: the second run does,
and there the arm itself stays inside.

The model is made here, from the paper's Denavit-Hartenberg table, with the masses of a UR5. As in the arm's own
controller, gravity is compensated.
"""

import argparse
import xml.etree.ElementTree as xml

import mujoco
import numpy as np

import conik

RATE_HZ = 125.0
DURATION_S = 40.0
PHYSICS_STEP_S = 0.001
START = np.radians([-48.0, -158.0, -108.0, -90.0, -85.0, 0.0])
# a [m], alpha [rad], d [m] of each joint, and the mass of the link it moves [kg].
JOINTS = [
    (0.0, np.pi / 2, 0.089, 3.7),
    (-0.425, 0.0, 0.0, 8.4),
    (-0.392, 0.0, 0.0, 2.3),
    (0.0, np.pi / 2, 0.109, 1.2),
    (0.0, -np.pi / 2, 0.095, 1.2),
    (0.0, 0.0, 0.082, 0.2),
]
# Stiffness [Nm/rad] and damping [Nm s/rad] of the servos, of the large joints and of the wrist.
SERVOS = [(8000.0, 300.0)] * 3 + [(1500.0, 40.0)] * 3
# What the motors add to the inertia of each joint [kg m^2].
ARMATURE = 0.1
LINK_RADIUS_M = 0.04

# Each obstacle: where it is [m], and how far away the tool is to stay [m].
OBSTACLES = {
    "obstacle_a": ([0.40, -0.25, -0.33], 0.18),
    "obstacle_b": ([0.40, 0.15, -0.33], 0.15),
}
VIEW_MAX = 0.2622
# How much tighter the bounds of the second run are: more than the arm of the first was outside.
MARGIN_M, MARGIN_VIEW = 0.0001, 0.0001
WAYPOINTS_M = np.array([[0.486, -0.066, -0.250], [0.320, 0.370, -0.250]])
ACCEPTANCE_M = 0.02


def numbers(values):
    return " ".join(repr(float(value)) for value in values)


def arm():
    """The arm as an MJCF model: each body turns about its z axis and carries the next."""
    model = xml.Element("mujoco", model="ur5-paper")
    xml.SubElement(model, "compiler", angle="radian")
    xml.SubElement(model, "option", timestep=str(PHYSICS_STEP_S), integrator="implicitfast")
    body = xml.SubElement(model, "worldbody")
    actuators = xml.SubElement(model, "actuator")
    place = {}
    for number, ((a, alpha, d, mass), (stiffness, damping)) in enumerate(zip(JOINTS, SERVOS), 1):
        body = xml.SubElement(body, "body", name=f"link_{number}", gravcomp="1", **place)
        xml.SubElement(body, "joint", name=f"joint_{number}", axis="0 0 1", armature=str(ARMATURE))
        ends = numbers([0.0, 0.0, 0.0, a, 0.0, d])
        # Nothing in this scene touches: the sets are what keeps the tool away.
        xml.SubElement(
            body,
            "geom",
            type="capsule",
            size=str(LINK_RADIUS_M),
            fromto=ends,
            mass=str(mass),
            contype="0",
            conaffinity="0",
        )
        servo = {"kp": str(stiffness), "kv": str(damping)}
        xml.SubElement(actuators, "position", joint=f"joint_{number}", **servo)
        place = {"pos": numbers([a, 0.0, d]), "quat": numbers([np.cos(alpha / 2), np.sin(alpha / 2), 0.0, 0.0])}
    xml.SubElement(body, "site", name="tool", **place)
    return mujoco.MjModel.from_xml_string(xml.tostring(model, encoding="unicode"))


class Sets:
    """Values of the sets where the arm is, computed without Conik."""

    @staticmethod
    def of(data):
        tool = data.site("tool").xpos
        values = {name: np.linalg.norm(tool - point) for name, (point, _) in OBSTACLES.items()}
        z_axis = data.site("tool").xmat.reshape(3, 3)[:, 2]
        values["view"] = np.linalg.norm(z_axis - [1.0, 0.0, 0.0])
        return values

    @staticmethod
    def outside(name, value):
        """By how much a value is outside."""
        return value - VIEW_MAX if name == "view" else OBSTACLES[name][1] - value


class Run:
    """What was asked of the arm, and what it did; one entry a tick."""

    def __init__(self, margin_m, margin_view):
        """`margin_m`, `margin_view`: by how much tighter the controller's bounds are."""
        self.robot = conik.Robot.builtin("ur5-paper")
        stack = conik.Stack(self.robot)
        for name, (point, least) in OBSTACLES.items():
            stack.set(name, conik.Distance(point), min=least + margin_m)
        stack.set("view", conik.FieldOfView([1.0, 0.0, 0.0]), max=VIEW_MAX - margin_view)
        stack.equality("position", conik.Position(WAYPOINTS_M[0]), gain=0.3)
        self.controller = conik.Controller(self.robot, stack, RATE_HZ)
        self.model = arm()
        self.steps, self.measured, self.tool, self.lag = [], [], [], []
        self.reached = []
        self.go()

    def go(self):
        data = mujoco.MjData(self.model)
        data.qpos[:] = START
        data.ctrl[:] = START
        mujoco.mj_forward(self.model, data)
        start = self.robot.forward_kinematics(START)[:3, 3]
        self.kinematics_differ_by = np.abs(data.site("tool").xpos - start).max()
        substeps = round(1.0 / (RATE_HZ * PHYSICS_STEP_S))
        q = START
        for tick in range(int(RATE_HZ * DURATION_S)):
            mujoco.mj_forward(self.model, data)
            self.measured.append(Sets.of(data))
            self.tool.append(data.site("tool").xpos.copy())
            self.lag.append(q - data.qpos)
            # The loop is closed over the references, not over what was measured: so they keep the sets to the
            # last bit, and what the servos do is the servos' business.
            step = self.controller.step(q)
            self.steps.append(step)
            q = step.q_ref
            data.ctrl[:] = q
            mujoco.mj_step(self.model, data, substeps)
            self.take_next_waypoint(tick)

    def take_next_waypoint(self, tick):
        count = len(self.reached)
        if count < len(WAYPOINTS_M) and np.linalg.norm(self.tool[-1] - WAYPOINTS_M[count]) < ACCEPTANCE_M:
            self.reached.append(tick / RATE_HZ)
            if count + 1 < len(WAYPOINTS_M):
                self.controller.change("position", target=WAYPOINTS_M[count + 1])

    def furthest_outside(self, name, values):
        """The largest violation from the tick on at which all values are inside for the first time."""
        outside = np.array([Sets.outside(name, value[name]) for value in values])
        return outside[np.argmax(outside <= 0.0) :].max()

    def report(self, title):
        references = [step.values for step in self.steps]
        for number, time in enumerate(self.reached, 1):
            print(f"{title}, waypoint {number} reached by the arm after: {time:.3f} s")
        print(f"{title}, greatest lag of a joint: {np.degrees(np.abs(self.lag).max()):.3f} deg")
        asked = np.array([step.values["position"] for step in self.steps])
        aside = np.linalg.norm(asked - self.tool, axis=1)
        print(f"{title}, greatest lag of the tool: {aside.max() * 1e3:.2f} mm")
        for name in (*OBSTACLES, "view"):
            factor, unit = (1.0, "-") if name == "view" else (1e3, "mm")
            for what, values in (("references", references), ("arm", self.measured)):
                outside = self.furthest_outside(name, values)
                print(f"{title}, {what} outside {name}: {max(0.0, outside) * factor:.4f} {unit}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", 1)[0])
    parser.add_argument("--picture", help="where to draw the first run")
    arguments = parser.parse_args()

    run = Run(margin_m=0.0, margin_view=0.0)
    print(f"MuJoCo and Conik place the tool apart by: {run.kinematics_differ_by:.1e} m")
    run.report("bounds as they are")
    Run(margin_m=MARGIN_M, margin_view=MARGIN_VIEW).report("bounds with a margin")
    if arguments.picture:
        draw(arguments.picture, run)


def draw(path, run):
    import drawing

    t = np.arange(len(run.steps)) / RATE_HZ
    figure, way, (outside, lag) = drawing.figure_of_run("References to the servos of an arm simulated by MuJoCo")
    for (name, (point, least)), color in zip(OBSTACLES.items(), [drawing.VERMILION, drawing.PURPLE]):
        way.sphere(point, least, f"obstacle {name[-1]}", color)
        for values, what, line in (
            ([step.values for step in run.steps], "reference", "-"),
            (run.measured, "arm", ":"),
        ):
            depth = [(value[name] - least) * 1e3 for value in values]
            drawing.value_over_time(outside, t, depth, f"{what} to {name[-1]}", color, linestyle=line)
    way.line(run.tool, "way of the arm's tool")
    way.marks(run.tool[0], "start", "o")
    way.marks(WAYPOINTS_M, "waypoints", numbered=True)
    way.finish()
    drawing.bound(outside, 0.0)
    outside.set(ylabel="beyond the bound [mm]", ylim=(-0.15, 0.6))
    drawing.legend_above(outside, 2)
    large, wrist = np.degrees(np.abs(run.lag)[:, :3]).max(axis=1), np.degrees(np.abs(run.lag)[:, 3:]).max(axis=1)
    drawing.value_over_time(lag, t, large, "lag of shoulder and elbow")
    drawing.value_over_time(lag, t, wrist, "lag of the wrist", drawing.GREEN, linestyle="--")
    lag.set(ylabel="greatest lag [deg]")
    drawing.legend_above(lag)
    drawing.save(figure, path)


if __name__ == "__main__":
    main()

import gc
import weakref

import numpy as np
import pytest

import conik
from conftest import START, TARGET, follow


def test_goes_to_the_target_and_keeps_the_set(robot, stack, start):
    controller = conik.Controller(robot, stack, rate_hz=125)
    steps = follow(controller, start, 20)
    assert np.linalg.norm(steps[-1].errors["position"]) < 1e-4
    assert min(step.values["obstacle"] for step in steps) >= 0.18
    assert any(step.active == ("obstacle",) for step in steps)
    held = next(step for step in steps if step.active)
    assert "hold:obstacle" in held.codes
    assert any("obstacle" in sentence for sentence in held.why)


def test_step_is_what_the_command_computes(robot, start):
    scenario = {
        "robot": {"model": "ur5-paper", "q0_rad": START},
        "control": {"duration_s": 4},
        "task": [
            {"name": "obstacle", "type": "distance", "point_m": [0.40, -0.25, -0.33], "min": 0.18},
            {"name": "position", "type": "position", "target_m": TARGET, "gain_per_s": 1},
        ],
    }
    run = conik.run(scenario)
    stack = conik.Stack(robot)
    stack.set("obstacle", conik.Distance([0.40, -0.25, -0.33]), min=0.18)
    stack.equality("position", conik.Position(TARGET), gain=1)
    steps = follow(conik.Controller(robot, stack), start, 4)
    np.testing.assert_array_equal([step.q_ref for step in steps], run.q[1:])
    np.testing.assert_array_equal([step.values["obstacle"] for step in steps], run["obstacle"][:-1])


def test_numbers_come_as_arrays_of_doubles(robot, stack, start):
    controller = conik.Controller(robot, stack)
    for q in [start, list(start), tuple(start), start.astype(np.float32), np.repeat(start, 2)[::2]]:
        step = controller.step(q)
        for array in [step.qd, step.qdd, step.q_ref]:
            assert array.shape == (6,) and array.dtype == np.float64
    assert isinstance(step.values["obstacle"], float)
    assert step.values["position"].shape == (3,)
    assert set(step.errors) == {"position"}
    assert controller.task_names == ["obstacle", "position"]


def test_step_is_kept_when_the_controller_goes_on_or_is_gone(robot, stack, start):
    controller = conik.Controller(robot, stack)
    first = controller.step(start)
    before = first.q_ref.copy()
    follow(controller, first.q_ref, 1)
    del controller
    gc.collect()
    np.testing.assert_array_equal(first.q_ref, before)
    assert isinstance(first.why, list)


@pytest.mark.parametrize(
    ("q", "said"),
    [
        (START[:5], "6 joint positions expected, 5 found"),
        ([np.nan, *START[1:]], "joint 0 (from 0) is not a finite number"),
    ],
)
def test_bad_configuration_is_refused(robot, stack, q, said):
    controller = conik.Controller(robot, stack)
    with pytest.raises(conik.StepError, match=said.replace("(", r"\(").replace(")", r"\)")):
        controller.step(q)
    controller.step(START)


def test_target_that_moves_is_followed_without_lag(robot, start):
    stack = conik.Stack(robot)
    stack.equality("position", conik.Position([0.3, -0.3, 0.2]), gain=4)
    controller = conik.Controller(robot, stack, rate_hz=500)
    q, velocity = start, np.array([0.0, 0.1, 0.0])
    for tick in range(500 * 5):
        controller.change("position", target=[0.3, -0.3 + 0.1 * tick / 500, 0.2], velocity=velocity)
        step = controller.step(q)
        q = step.q_ref
    assert np.linalg.norm(step.errors["position"]) < 2e-5


def test_obstacle_that_moves_is_evaded(robot, start):
    stack = conik.Stack(robot)
    point = robot.forward_kinematics(start)[:3, 3] + [0.4, 0, 0]
    stack.set("obstacle", conik.Distance(point), min=0.15)
    controller = conik.Controller(robot, stack)
    q, inside = start, []
    for _ in range(125 * 3):
        controller.change("obstacle", point=point, velocity=[-0.2, 0, 0])
        step = controller.step(q)
        inside.append(step.values["obstacle"] - 0.15)
        q, point = step.q_ref, point - np.array([0.2 / 125, 0, 0])
    assert min(inside) >= 0
    assert min(inside) < 1e-6


def test_bound_that_moves_takes_the_robot_along(robot, stack, start):
    controller = conik.Controller(robot, stack)
    q = follow(controller, start, 10)[-1].q_ref
    for tick in range(125 * 4):
        controller.change("obstacle", min=0.18 + 0.01 * tick / 125, min_rate=0.01)
        step = controller.step(q)
        assert step.values["obstacle"] >= 0.18 + 0.01 * tick / 125
        q = step.q_ref


@pytest.mark.parametrize(
    ("name", "change", "said"),
    [
        ("nothing", {"min": 1}, "there is no task `nothing`; there are: obstacle, position"),
        ("obstacle", {"target": [0, 0, 0]}, "task `obstacle` has no target to be changed; it has: point"),
        ("position", {"min": 0}, "task `position` has no min to be changed; it has: target, velocity"),
        ("obstacle", {"min": 2, "max": 1}, "obstacle"),
        ("position", {"target": [0, np.nan, 0]}, "position"),
    ],
)
def test_change_that_makes_no_sense_is_refused(robot, stack, name, change, said):
    controller = conik.Controller(robot, stack)
    with pytest.raises(conik.ScenarioError) as error:
        controller.change(name, **change)
    assert said in str(error.value)


def test_rate_without_a_place_is_refused(robot, stack):
    controller = conik.Controller(robot, stack)
    for name, change in [("position", {"velocity": [0, 0, 1]}), ("obstacle", {"desired_rate": 1.0})]:
        with pytest.raises(ValueError, match="say where it is now too"):
            controller.change(name, **change)


def test_mistakes_are_said_as_the_command_says_them(robot):
    stack = conik.Stack(robot)
    with pytest.raises(conik.ScenarioError) as error:
        stack.set("view", conik.FieldOfView([1, 0, 0]), max=np.nan)
    assert 'task[1] "view".max: NaN is not a finite number; allowed: ' in str(error.value)
    with pytest.raises(conik.ScenarioError) as error:
        stack.equality("position", conik.Position([0, 0, 0]))
    assert "gain_per_s" in str(error.value)
    assert len(stack) == 0
    stack.equality("position", conik.Position([0.4, 0, 0]), gain=300)
    with pytest.raises(conik.ScenarioError) as error:
        conik.Controller(robot, stack, rate_hz=125)
    assert "gain_per_s" in str(error.value)
    with pytest.raises(conik.ScenarioError) as error:
        conik.Controller(robot, stack, rate_hz=500, mode_rule="cones")
    assert 'did you mean "cone"' in str(error.value)
    stack.equality("again", conik.Height(0.2), gain=1)
    with pytest.raises(conik.ScenarioError):
        stack.equality("again", conik.Height(0.2), gain=1)
    assert stack.names == ["position", "again"]


def test_every_type_of_task_is_taken(robot, start):
    stack = conik.Stack(robot)
    point, matrix = [0.4, -0.2, 0.1], robot.forward_kinematics(start)
    sets = {
        "coordinate": (conik.Coordinate("x"), 2.0),
        "distance": (conik.Distance(point, frame="link_4"), 2.0),
        "view": (conik.FieldOfView([1, 0, 0]), 2.0),
        "angle": (conik.PointingAngle([0, 0, 1], axis=[1, 0, 0]), 3.14),
        "look": (conik.LookAt(point), 3.14),
        "turn": (conik.OrientationAngle(matrix[:3, :3]), 3.0),
        "plane": (conik.Plane([0, 1, 0], 0.2), 2.0),
        "height": (conik.Height(relative_to="link_1"), 2.0),
        "joint": (conik.Joint("elbow_joint"), 3.0),
        "first": (conik.Joint(1), 3.0),
        "manipulability": (conik.Manipulability("pose"), 2.0),
        "singular": (conik.SmallestSingularValue(), 2.0),
        "elbow": (conik.Elbow("link_1", "link_2", "link_4", [0, 0, 1]), 3.1),
    }
    for name, (task, most) in sets.items():
        stack.set(name, task, max=most)
    stack.set("cell", conik.Workspace(center=[0, 0, 0], radius=2))
    stack.set("box", conik.Workspace(min=[-2, -2, -2], max=[2, 2, 2]))
    equalities = {
        "spin": (conik.JointSpeed(6, 0.1), None),
        "pose": (conik.Pose(matrix), 1),
        "position": (conik.Position(point, relative_to="link_1"), 1),
        "orientation": (conik.Orientation(desired_rpy=[0.1, 0.2, 0.3]), 1),
        "also": (conik.Distance(point, 0.3), 1),
        "posture": (conik.Posture(start), 1),
    }
    for name, (task, gain) in equalities.items():
        stack.equality(name, task, gain)
    step = conik.Controller(robot, stack).step(start)
    assert set(step.values) == {*sets, *equalities, "cell", "box/x", "box/y", "box/z"}
    assert np.all(np.isfinite(step.q_ref))


def test_rotations_are_taken_in_every_form(robot, start):
    matrix = robot.forward_kinematics(start)[:3, :3]
    w = np.sqrt(1 + np.trace(matrix)) / 2
    q = [w, *(np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]]) / 4 / w)]
    turns = [matrix, q, robot.forward_kinematics(start)]
    # Half turns about each axis, where the trace is least.
    for axis in np.eye(3):
        half = 2 * np.outer(axis, axis) - np.eye(3)
        stack = conik.Stack(robot)
        stack.set("turn", conik.OrientationAngle(half), max=3.2)
        stack.set("same", conik.OrientationAngle([0, *axis]), max=3.2)
        values = conik.Controller(robot, stack).step(start).values
        assert values["turn"] == pytest.approx(values["same"], abs=1e-9)
    for turn in turns:
        stack = conik.Stack(robot)
        stack.set("turn", conik.OrientationAngle(turn), max=1)
        assert conik.Controller(robot, stack).step(start).values["turn"] == pytest.approx(0, abs=1e-6)
    with pytest.raises(ValueError, match="no rotation"):
        conik.Orientation(2 * np.eye(3))
    with pytest.raises(ValueError, match="shape"):
        conik.Orientation([1, 2, 3])


def test_shapes_are_kept_apart(robot, start):
    stack = conik.Stack(robot)
    stack.shape("forearm", "link_3", "capsule", from_=[0, 0, 0], to=[0.3, 0, 0], radius=0.06)
    stack.obstacle("post", "cylinder", 0.02, from_=[0.6, 0.6, -1], to=[0.6, 0.6, 1], radius=0.05)
    stack.equality("position", conik.Position([0.2, 0.4, 0.1]), gain=1)
    step = conik.Controller(robot, stack).step(start)
    assert "forearm/post" in step.values
    with pytest.raises(conik.ScenarioError):
        stack.shape("more", "link_9", "sphere", center=[0, 0, 0], radius=0.1)
    with pytest.raises(TypeError, match="radius"):
        stack.shape("more", "link_2", "sphere", centre=[0, 0, 0])


def test_controllers_are_let_go(robot, stack):
    controller = conik.Controller(robot, stack)
    gone = weakref.ref(stack)
    del stack
    controller.step(START)
    del controller
    gc.collect()
    # pytest's fixture still has the stack.
    assert gone() is not None

import numpy as np
import pytest

import conik
from conftest import START

PENDULUM = """<robot name="pendulum">
  <link name="stand"/> <link name="rod"/> <link name="tip"/>
  <joint name="swing" type="revolute">
    <parent link="stand"/> <child link="rod"/> <origin xyz="0 0 1"/> <axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" velocity="2" effort="1"/>
  </joint>
  <joint name="end" type="fixed"><parent link="rod"/> <child link="tip"/> <origin xyz="0 0 0.5"/></joint>
</robot>"""


def test_builtin_robots_are_there():
    names = conik.Robot.builtin_names()
    assert "ur5-paper" in names and "panda" in names
    for name in names:
        robot = conik.Robot.builtin(name)
        assert robot.dof == len(robot.joint_names) == len(robot.position_limits)
        assert robot.tool_name in robot.link_names
    with pytest.raises(conik.ScenarioError, match="no built-in robot is called `ur55`; there are: "):
        conik.Robot.builtin("ur55")


def test_urdf_is_read(tmp_path):
    path = tmp_path / "pendulum.urdf"
    path.write_text(PENDULUM)
    robot = conik.Robot.from_urdf(path, tool="tip")
    assert (robot.dof, robot.joint_names, robot.tool_name) == (1, ["swing"], "tip")
    assert robot.position_limits == [(-1.0, 1.0)] and robot.speed_limits == [2.0]
    pose = robot.forward_kinematics([np.pi / 6])
    np.testing.assert_allclose(pose[:3, 3], [0.25, 0, 1 + 0.5 * np.cos(np.pi / 6)], atol=1e-12)
    stack = conik.Stack(robot)
    stack.equality("height", conik.Height(1.2), gain=2)
    controller = conik.Controller(robot, stack)
    q = np.array([0.1])
    for _ in range(1000):
        q = controller.step(q).q_ref
    # The limit of the joint is a set: it is held there.
    assert q[0] == pytest.approx(1.0) and q[0] <= 1.0
    assert controller.task_names == ["limit/swing", "height"]


def test_urdf_file_is_read_once(tmp_path):
    path = tmp_path / "pendulum.urdf"
    path.write_text(PENDULUM)
    robot = conik.Robot.from_urdf(path)
    path.unlink()
    for same in [robot, conik.Robot.from_urdf_text(PENDULUM, tool="tip")]:
        stack = conik.Stack(same)
        stack.equality("height", conik.Height(1.4), gain=2)
        assert conik.Controller(same, stack).step([0.1]).values["height"] == pytest.approx(1 + 0.5 * np.cos(0.1))


def test_urdf_with_mistakes_is_refused_with_the_place(tmp_path):
    path = tmp_path / "bad.urdf"
    path.write_text(PENDULUM.replace('type="revolute"', 'type="hinge"'))
    with pytest.raises(conik.ScenarioError) as error:
        conik.Robot.from_urdf(str(path))
    assert f"{path}" in str(error.value) and 'unknown type "hinge"' in str(error.value)
    with pytest.raises(conik.ScenarioError, match="cannot be read"):
        conik.Robot.from_urdf(tmp_path / "none.urdf")
    path.write_text(PENDULUM)
    with pytest.raises(conik.ScenarioError, match="nowhere"):
        conik.Robot.from_urdf(path, tool="nowhere")


def test_jacobian_is_the_derivative(robot, start):
    here = robot.kinematics(start)
    step = 1e-6
    for link in [None, "link_3"]:
        jacobian, pose = here.jacobian(link), here.world_from(link)
        assert jacobian.shape == (6, 6)
        for joint in range(6):
            moved = start + step * np.eye(6)[joint]
            change = (robot.forward_kinematics(moved, link) - pose) / step
            np.testing.assert_allclose(jacobian[:3, joint], change[:3, 3], atol=1e-5)
            turn = change[:3, :3] @ pose[:3, :3].T
            np.testing.assert_allclose(jacobian[3:, joint], [turn[2, 1], turn[0, 2], turn[1, 0]], atol=1e-5)


def test_places_and_limits_can_be_changed(robot, start):
    moved = robot.standing_at(position=[1, 2, 3], rpy=[0, 0, np.pi / 2])
    here, there = robot.forward_kinematics(start), moved.forward_kinematics(start)
    np.testing.assert_allclose(there[:3, 3], [1 - here[1, 3], 2 + here[0, 3], 3 + here[2, 3]], atol=1e-12)
    longer = robot.with_tool_offset([0, 0, 0.1])
    tip = longer.forward_kinematics(start)
    np.testing.assert_allclose(tip[:3, 3], here[:3, 3] + 0.1 * here[:3, 2], atol=1e-12)
    limited = robot.with_limits(position=[(-1, 1)] + [None] * 5, speed=[0.5] * 6)
    assert limited.position_limits[0] == (-1, 1) and limited.speed_limits == [0.5] * 6
    stack = conik.Stack(limited)
    stack.equality("posture", conik.Posture([0.0] * 6), gain=100)
    step = conik.Controller(limited, stack).step(START)
    assert np.abs(step.qd).max() == pytest.approx(0.5)
    with pytest.raises(conik.ScenarioError, match="give one for each"):
        robot.with_limits(speed=[1, 2])


def test_wrong_length_and_unknown_link_are_refused(robot):
    with pytest.raises(conik.ScenarioError, match="6 joint positions expected, 2 found"):
        robot.forward_kinematics([0, 0])
    with pytest.raises(conik.ScenarioError, match="no link `hand`; there are: "):
        robot.forward_kinematics(START, "hand")

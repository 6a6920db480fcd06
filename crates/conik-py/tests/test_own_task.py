import numpy as np
import pytest

import conik
from conftest import START, TARGET, follow


class Radius(conik.OwnTask):
    """Distance of the tool from the vertical axis [m]."""

    unit = "m"

    def value(self, kinematics):
        x, y = kinematics.world_from()[:2, 3]
        return np.hypot(x, y)

    def jacobian(self, kinematics):
        x, y = kinematics.world_from()[:2, 3]
        return np.array([x, y]) / np.hypot(x, y) @ kinematics.jacobian()[:2]


class Place(conik.OwnTask):
    """The tool's position, as `conik.Position` has it."""

    dimension = 3

    def value(self, kinematics):
        return kinematics.world_from()[:3, 3]

    def jacobian(self, kinematics):
        return kinematics.jacobian()[:3]


def test_set_of_one_s_own_is_kept(robot, start):
    stack = conik.Stack(robot)
    stack.set("radius", Radius(), min=0.45)
    stack.equality("position", conik.Position([0.05, 0.4, -0.2]), gain=1)
    steps = follow(conik.Controller(robot, stack), start, 10)
    values = [step.values["radius"] for step in steps]
    assert min(values) >= 0.45
    assert values[-1] == pytest.approx(0.45, abs=1e-6)
    assert steps[-1].active == ("radius",)


def test_equality_of_one_s_own_is_that_of_the_package(robot, start):
    end = []
    for task in [conik.Position(TARGET), Place(TARGET)]:
        stack = conik.Stack(robot)
        stack.set("view", conik.FieldOfView([1, 0, 0]), max=1.5)
        stack.equality("position", task, gain=1)
        stack.set("below", Radius(), max=0.3, gain=1)
        end.append(follow(conik.Controller(robot, stack), start, 1)[-1].q_ref)
    np.testing.assert_allclose(end[0], end[1], atol=1e-9)


def test_place_in_the_order_counts(robot, start):
    stack = conik.Stack(robot)
    stack.set("radius", Radius(), min=0.1)
    stack.set("view", conik.FieldOfView([1, 0, 0]), max=2)
    stack.equality("position", Place(TARGET), gain=1)
    stack.set("low", Radius(), max=0.8, gain=0.5)
    assert conik.Controller(robot, stack).task_names == ["radius", "view", "position", "low"]
    with pytest.raises(conik.ScenarioError, match="gain"):
        stack.set("lower", Radius(), max=0.8)
    with pytest.raises(conik.ScenarioError, match="name"):
        stack.set("low", Radius(), max=0.8, gain=1)


def test_what_a_task_raises_is_raised_by_the_step(robot):
    class Broken(Radius):
        broken = True

        def value(self, kinematics):
            if self.broken:
                raise ZeroDivisionError("its own words")
            return super().value(kinematics)

    stack = conik.Stack(robot)
    task = Broken()
    stack.set("radius", task, min=0.1)
    controller = conik.Controller(robot, stack)
    with pytest.raises(ZeroDivisionError, match="its own words"):
        controller.step(START)
    task.broken = False
    controller.step(START)


@pytest.mark.parametrize("jacobian", [np.zeros(5), np.zeros((2, 6)), "words", [np.nan] * 6])
def test_jacobian_that_is_none_is_told(robot, jacobian):
    class Broken(Radius):
        def jacobian(self, kinematics):
            return jacobian

    stack = conik.Stack(robot)
    stack.equality("radius", Broken(0.5), gain=1)
    with pytest.raises((conik.ConikError, ValueError)) as error:
        conik.Controller(robot, stack).step(START)
    assert str(error.value)


def test_attributes_may_change_between_ticks(robot, start):
    class Bias(Radius):
        bias = 0.0

        def value(self, kinematics):
            return super().value(kinematics) + self.bias

    task = Bias()
    stack = conik.Stack(robot)
    stack.set("radius", task, min=0.1)
    controller = conik.Controller(robot, stack)
    before = controller.step(start).values["radius"]
    task.bias = 0.25
    assert controller.step(start).values["radius"] == pytest.approx(before + 0.25)


def test_task_that_moves_is_kept_from_what_comes(robot, start):
    class Shrinking(Radius):
        """The cylinder grows: what is left between it and the tool."""

        grown = 0.0

        def value(self, kinematics):
            return super().value(kinematics) - self.grown

        def value_ahead(self, kinematics, ahead_s):
            return self.value(kinematics) - 0.05 * ahead_s

    task = Shrinking()
    stack = conik.Stack(robot)
    stack.set("radius", task, min=0.45)
    stack.equality("posture", conik.Posture(start), gain=1)
    controller = conik.Controller(robot, stack)
    q = start
    for _ in range(125 * 6):
        step = controller.step(q)
        assert step.values["radius"] >= 0.45
        q, task.grown = step.q_ref, task.grown + 0.05 / 125
    assert step.active == ("radius",)


def test_controller_that_is_at_work_is_not_waited_for(robot):
    class Nosy(Radius):
        controller = None

        def value(self, kinematics):
            if self.controller:
                self.controller.step(START)
            return super().value(kinematics)

    task = Nosy()
    stack = conik.Stack(robot)
    stack.set("radius", task, min=0.1)
    task.controller = conik.Controller(robot, stack)
    with pytest.raises(conik.ConikError, match="at work"):
        task.controller.step(START)
    task.controller = None


def test_task_without_a_method_says_which(robot):
    stack = conik.Stack(robot)
    stack.set("nothing", conik.OwnTask(), min=0)
    with pytest.raises(NotImplementedError, match="value"):
        conik.Controller(robot, stack).step(START)

import numpy as np
import pytest

import conik

START = [-0.84, -2.76, -1.88, -1.57, -1.48, 0.0]
TARGET = [0.486, -0.066, -0.250]


@pytest.fixture
def robot():
    return conik.Robot.builtin("ur5-paper")


@pytest.fixture
def stack(robot):
    """An obstacle on the way to a target."""
    stack = conik.Stack(robot)
    stack.set("obstacle", conik.Distance([0.40, -0.25, -0.33]), min=0.18)
    stack.equality("position", conik.Position(TARGET), gain=1.0)
    return stack


@pytest.fixture
def start():
    return np.array(START)


def follow(controller, q, seconds):
    """The steps of so many seconds."""
    steps = []
    for _ in range(int(seconds * controller.rate_hz)):
        steps.append(controller.step(q))
        q = steps[-1].q_ref
    return steps

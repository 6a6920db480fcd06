"""The compiled part of conik."""

from os import PathLike
from typing import Any, TypeAlias, final

import numpy as np
import numpy.typing as npt
from typing_extensions import Self

from ._numbers import Vector

__all__ = [
    "ConikError",
    "Controller",
    "Kinematics",
    "Robot",
    "ScenarioError",
    "Step",
    "StepError",
    "check",
    "run",
]

_Array: TypeAlias = npt.NDArray[np.float64]

class ConikError(Exception):
    """What conik cannot do, and why."""

class ScenarioError(ConikError):
    """A scenario, a robot or a stack of tasks with mistakes: one line for each."""

class StepError(ConikError):
    """A tick that gave no reference. The last one stands: stop the arm."""

@final
class Robot:
    """A robot: the joints between its base and its tool."""

    @staticmethod
    def builtin(name: str) -> Robot:
        """A robot that conik knows: "ur5-paper", "ur5e", "panda", ... (`Robot.builtin_names()`)."""

    @staticmethod
    def builtin_names() -> list[str]:
        """Names that `builtin` knows."""

    @staticmethod
    def from_urdf(
        path: str | PathLike[str], tool: str | list[str] | None = None, base: str | None = None
    ) -> Robot:
        """A robot from a URDF file.

        Its joints are those that move on the way from `base` (by default the root) to `tool`, in that order,
        then those on the way to further tools. Without `tool` the tree must have one end.
        """

    def standing_at(self, *, position: Vector | None = None, rpy: Vector | None = None) -> Robot:
        """The same with its base elsewhere in the world: `position` [m], and roll, pitch, yaw [rad]."""

    def with_tool_offset(self, position: Vector | None = None, rpy: Vector | None = None) -> Robot:
        """The same with its tool elsewhere on the link that carries it: `position` [m] and roll, pitch, yaw
        [rad] in the frame of that link."""

    def with_limits(
        self,
        *,
        position: list[tuple[float, float] | None] | None = None,
        speed: list[float] | None = None,
        acceleration: list[float] | None = None,
    ) -> Robot:
        """The same with other limits of its joints, one entry for each: least and greatest position [rad or m]
        or None, greatest speed [rad/s or m/s], greatest acceleration [rad/s^2 or m/s^2]."""

    @property
    def name(self) -> str: ...
    @property
    def dof(self) -> int:
        """Number of joints."""

    @property
    def joint_names(self) -> list[str]:
        """Names of the joints, in the order of q."""

    @property
    def link_names(self) -> list[str]:
        """Names of the links; each has a frame."""

    @property
    def tool_name(self) -> str:
        """The link that is the tool."""

    @property
    def position_limits(self) -> list[tuple[float, float] | None]:
        """Least and greatest position of each joint [rad or m]; None: it has none."""

    @property
    def speed_limits(self) -> list[float | None]:
        """Greatest speed of each joint [rad/s or m/s]."""

    @property
    def acceleration_limits(self) -> list[float | None]:
        """Greatest acceleration of each joint [rad/s^2 or m/s^2]."""

    def forward_kinematics(self, q: Vector, link: str | None = None) -> _Array:
        """Pose of a link, by default the tool: base_from_tool, shape (4, 4) [m]; in the world, if the robot was
        put elsewhere. `q`: joint positions [rad or m], shape (dof,)."""

    def kinematics(self, q: Vector) -> Kinematics:
        """All that follows from one configuration [rad or m], shape (dof,)."""

@final
class Kinematics:
    """A robot in one configuration."""

    @property
    def q(self) -> _Array:
        """The configuration [rad or m], shape (dof,)."""

    @property
    def dof(self) -> int:
        """Number of joints."""

    def world_from(self, link: str | None = None) -> _Array:
        """Pose of a link in the world, by default of the tool: shape (4, 4) [m]."""

    def jacobian(self, link: str | None = None) -> _Array:
        """Jacobian of a link, by default of the tool, in the axes of the world: shape (6, dof), three rows of the
        velocity of its origin [m/rad, or 1 of a sliding joint], then three of its angular velocity."""

@final
class Step:
    """One tick: what was decided, and why."""

    @property
    def qd(self) -> _Array:
        """Joint velocities [rad/s or m/s], shape (dof,)."""

    @property
    def qdd(self) -> _Array:
        """Joint accelerations since the last tick [rad/s^2 or m/s^2], shape (dof,)."""

    @property
    def q_ref(self) -> _Array:
        """Joint references for the end of this period [rad or m], q + T qd; shape (dof,)."""

    @property
    def active(self) -> tuple[str, ...]:
        """Names of the active sets."""

    @property
    def values(self) -> dict[str, Any]:
        """The value of each task at q [task's unit]: a float, or an array where it has several components."""

    @property
    def errors(self) -> dict[str, Any]:
        """The error of each equality task at q [task's unit]: desired value less value."""

    @property
    def why(self) -> list[str]:
        """Why the tick came out as it did, in sentences."""

    @property
    def codes(self) -> list[str]:
        """The same for programs: `hold:obstacle`, `speed:q3`."""

    @property
    def stood_still(self) -> bool:
        """Whether no velocity was found that keeps every set, so that the arm stands still for this period."""

class Controller:
    """What `conik.Controller` is made of."""

    def __new__(cls, robot: Robot, tables: dict[str, Any], own: dict[str, dict[str, Any]]) -> Self: ...
    def step(self, q: Vector) -> Step:
        """One tick: the mode at `q` and the reference at the end of the period.

        Arguments:
            q: the last reference [rad or m], not a measurement, shape (dof,); the loop is
                `q = controller.step(q).q_ref`.

        Raises:
            StepError: there is no reference; the last one stands.
        """

    @property
    def task_names(self) -> list[str]:
        """Names of the tasks, the most important first; the position limits of joints are among them."""

    @property
    def rate_hz(self) -> float:
        """Control rate [Hz]."""

    @property
    def _toml(self) -> str: ...
    def _change(self, name: str, change: dict[str, Any]) -> None: ...

def check(robot: Robot, tables: dict[str, Any]) -> None: ...
def run(
    *, path: str | PathLike[str] | None = None, tables: dict[str, Any] | None = None
) -> dict[str, Any]: ...

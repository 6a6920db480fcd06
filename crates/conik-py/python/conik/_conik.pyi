"""The compiled part of conik."""

from collections.abc import Callable
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
    "campaign_finish",
    "campaign_keep",
    "campaign_missing",
    "campaign_plan",
    "campaign_runs",
    "campaign_shard",
    "campaign_work",
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
    """A robot: the joints between its base and its tool.

    It never changes: what puts it elsewhere or gives it other limits returns another robot.
    """

    @staticmethod
    def builtin(name: str) -> Robot:
        """A robot that conik knows, from its maker's figures.

        Arguments:
            name: "ur5-paper", "ur5e", "panda", ...; `Robot.builtin_names()` has all.

        Raises:
            ScenarioError: there is none of that name.
        """

    @staticmethod
    def builtin_names() -> list[str]:
        """Names that `Robot.builtin` knows."""

    @staticmethod
    def from_urdf(
        path: str | PathLike[str], tool: str | list[str] | None = None, base: str | None = None
    ) -> Robot:
        """A robot from a URDF file.

        Its joints are those that move on the way from `base` (by default the root) to `tool`, in that order,
        then those on the way to further tools. Every link has a frame. Position limits of the file become sets of
        high priority, its speed limits hold too.

        Arguments:
            path: the file. Xacro must be expanded first.
            tool: the link that is the tool, or a list: the first is the tool, and the joints on the way to the
                others move too. Without it the tree must have one end.
            base: the link that stands still, by default the root of the tree.

        Raises:
            ScenarioError: the file cannot be read, or has mistakes, with the place of each.
        """

    @staticmethod
    def from_urdf_text(
        text: str, tool: str | list[str] | None = None, base: str | None = None
    ) -> Robot:
        """The same from the text of a URDF file; mistakes in it are said to be in `robot.urdf`."""

    def standing_at(self, *, position: Vector | None = None, rpy: Vector | None = None) -> Robot:
        """The same with its base elsewhere in the world.

        Arguments:
            position: of the base in the world [m], shape (3,); by default at the origin.
            rpy: roll, pitch and yaw about the fixed x, then y, then z axis [rad], shape (3,); by default not turned.
        """

    def with_tool_offset(self, position: Vector | None = None, rpy: Vector | None = None) -> Robot:
        """The same with its tool elsewhere on the link that carries it.

        Arguments:
            position: of the tool in the frame of that link [m], shape (3,); by default at its origin.
            rpy: roll, pitch and yaw about the fixed x, then y, then z axis [rad], shape (3,); by default not turned.
        """

    def with_limits(
        self,
        *,
        position: list[tuple[float, float] | None] | None = None,
        speed: list[float] | None = None,
        acceleration: list[float] | None = None,
    ) -> Robot:
        """The same with other limits of its joints. A kind that is not given stays as it is.

        Position limits are sets of high priority, named `limit/<joint>`. Speed limits shorten the whole velocity.
        Accelerations give way only to a set that could not be kept otherwise.

        Arguments:
            position: for each joint the least and the greatest position [rad or m], or None.
            speed: for each joint the greatest speed [rad/s or m/s].
            acceleration: for each joint the greatest acceleration [rad/s^2 or m/s^2].

        Raises:
            ScenarioError: a number is missing, or makes no sense.
        """

    @property
    def name(self) -> str:
        """Its name: that of the built-in robot, or that in the file."""
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
        """Pose of a link.

        Arguments:
            q: joint positions [rad or m], shape (dof,).
            link: its name; by default the tool.

        Returns:
            base_from_link [-, the last column m], shape (4, 4); world_from_link, if the robot was put elsewhere.

        Raises:
            ScenarioError: `q` has another length, or there is no such link.
        """

    def kinematics(self, q: Vector) -> Kinematics:
        """All that follows from one configuration: poses and Jacobians, as an `OwnTask` gets them.

        Arguments:
            q: joint positions [rad or m], shape (dof,).
        """

@final
class Kinematics:
    """A robot in one configuration: poses of its links, and their Jacobians."""

    @property
    def q(self) -> _Array:
        """The configuration [rad or m], shape (dof,)."""

    @property
    def dof(self) -> int:
        """Number of joints."""

    def world_from(self, link: str | None = None) -> _Array:
        """Pose of a link in the world.

        Arguments:
            link: its name; by default the tool.

        Returns:
            world_from_link [-, the last column m], shape (4, 4).
        """

    def jacobian(self, link: str | None = None) -> _Array:
        """Jacobian of a link, in the axes of the world.

        Arguments:
            link: its name; by default the tool.

        Returns:
            Three rows of the velocity of the link's origin [m/rad, of a joint that slides -], then three of its angular
                velocity [-, of a joint that slides rad/m], shape (6, dof).
        """

@final
class Step:
    """One tick: what was decided, and why. It stays what it is when the controller goes on."""

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
        """Names of the active sets, the most important first: those that are held at their border, or driven
        back to it."""

    @property
    def values(self) -> dict[str, Any]:
        """The value of each task at q [task's unit]: a float, or an array where it has several components."""

    @property
    def errors(self) -> dict[str, Any]:
        """The error of each equality task at q [task's unit]: desired value less value."""

    @property
    def why(self) -> list[str]:
        """Why the tick came out as it did, in sentences, with figures."""

    @property
    def codes(self) -> list[str]:
        """The same for programs: `hold:obstacle`, `speed:q3`, those of the column `why` of `log.csv`."""

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
def campaign_plan(
    *,
    path: str | PathLike[str] | None,
    tables: dict[str, Any] | None,
    runs: int,
    seed: int,
    starts: str,
    near: float,
    obstacles: float,
    targets: float,
    rates_hz: list[float],
    servo_lag: tuple[float, float] | None,
    control: dict[str, Any],
) -> str: ...
def campaign_missing(dir: str | PathLike[str], plan: str) -> tuple[list[int], int, int]: ...
def campaign_runs(plan: str, shard: int) -> int: ...
def campaign_shard(plan: str, shard: int) -> str: ...
def campaign_keep(dir: str | PathLike[str], plan: str, shard: int, lines: str) -> None: ...
def campaign_work(
    dir: str | PathLike[str], plan: str, jobs: int | None, show: Callable[[int], object]
) -> None: ...
def campaign_finish(dir: str | PathLike[str], plan: str) -> dict[str, Any]: ...

"""The controller: from a configuration to the next joint reference, once per period."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from ._conik import Controller as _Controller
from ._conik import Robot
from ._numbers import Rotation, Vector, floats, quaternion
from .stack import Stack

if TYPE_CHECKING:
    from typing_extensions import Self


class Controller(_Controller):
    """A kinematic controller for one robot and one stack of tasks.

    Arguments:
        robot: the robot that the stack is for.
        stack: the tasks; what is added to it later has no effect here.
        rate_hz: control rate [Hz].
        mode_rule: which rule chooses the active sets: "cone" (the velocity nearest to what each task asks that
            keeps every set), "paper" or "border" (a search over subsets).
        border: what happens at the border of a set between samples: "land" (no sample lies outside) or "freeze"
            (as in the paper).
        recursion: how lower tasks are fitted under the higher ones: "siciliano-slotine" or, as in the paper,
            "chiaverini".
        exclusive: groups of names of sets of which no two are ever active together; by the rules "paper" and
            "border".

    Raises:
        ScenarioError: what does not fit.
    """

    def __new__(
        cls,
        robot: Robot,
        stack: Stack,
        rate_hz: float = 125.0,
        *,
        mode_rule: str = "cone",
        border: str = "land",
        recursion: str = "siciliano-slotine",
        exclusive: Iterable[Iterable[str]] = (),
    ) -> Self:
        control = {
            "rate_hz": rate_hz,
            "mode_rule": mode_rule,
            "border": border,
            "recursion": recursion,
            "exclusive": [list(group) for group in exclusive],
        }
        return super().__new__(cls, robot, {"control": control, **stack._tables()}, dict(stack._own))

    def change(
        self,
        name: str,
        *,
        min: float | None = None,
        max: float | None = None,
        min_rate: float | None = None,
        max_rate: float | None = None,
        target: Vector | None = None,
        point: Vector | None = None,
        velocity: Vector | None = None,
        direction: Vector | None = None,
        orientation: Rotation | None = None,
        angular_velocity: Vector | None = None,
        offset: float | None = None,
        offset_rate: float | None = None,
        speed: float | None = None,
        desired: float | Vector | None = None,
        desired_rate: float | Vector | None = None,
    ) -> None:
        """Changes what a task is asked or given, from the next `step` on.

        What moves is told before every tick, with its velocity: a set is then kept from what comes, and a goal
        followed without lag. A velocity or a rate that is not given is zero. A bound or an obstacle that jumps
        may leave the robot outside of the set; it is then kept from getting worse.

        Arguments:
            name: the task.
            min: least value of a set [task's unit]; one that is not given stays as it is, -inf is none.
            max: greatest value [task's unit]; likewise, inf is none.
            min_rate: how fast `min` moves [task's unit/s].
            max_rate: how fast `max` moves [task's unit/s].
            target: point of `Position` and `Pose` [m], shape (3,), with `velocity`.
            point: point of `Distance` and `LookAt` [m], shape (3,), with `velocity`.
            velocity: how fast target or point moves, in the axes of the world or of `relative_to` [m/s],
                shape (3,).
            direction: of `FieldOfView` and `PointingAngle` [-], shape (3,), of any length but zero, with
                `angular_velocity`.
            orientation: of `Pose`, `Orientation`, `OrientationAngle` [-]: a matrix of shape (3, 3), or a
                quaternion of shape (4,) with its real part first; with `angular_velocity`.
            angular_velocity: how direction or orientation turns [rad/s], shape (3,).
            offset: of `Plane` [m], with `offset_rate`.
            offset_rate: how fast the plane moves along its normal [m/s].
            speed: of `JointSpeed` [rad/s or m/s].
            desired: of other equality tasks [task's unit]: a number, or one for each component.
            desired_rate: how fast it moves [task's unit/s], of the same shape.

        Raises:
            ScenarioError: the task is not there, or has no such thing.
        """
        given: dict[str, Any] = {
            "min": min,
            "max": max,
            "min_rate": min_rate,
            "max_rate": max_rate,
            "offset": offset,
            "offset_rate": offset_rate,
            "speed": speed,
            "orientation": None if orientation is None else quaternion(orientation),
        }
        vectors = {
            "target": target,
            "point": point,
            "velocity": velocity,
            "direction": direction,
            "angular_velocity": angular_velocity,
            "desired": desired,
            "desired_rate": desired_rate,
        }
        for rate, things in _RATES.items():
            told = {**given, **vectors}
            if told[rate] is not None and all(told[thing] is None for thing in things):
                raise ValueError(f"task `{name}`: with `{rate}`, say where it is now too: {' or '.join(things)}")
        given |= {key: None if value is None else floats(value) for key, value in vectors.items()}  # type: ignore[arg-type]
        self._change(name, given)


#: What moves at which rate: a rate alone would say nothing.
_RATES = {
    "velocity": ("target", "point"),
    "angular_velocity": ("direction", "orientation"),
    "offset_rate": ("offset",),
    "desired_rate": ("desired",),
}

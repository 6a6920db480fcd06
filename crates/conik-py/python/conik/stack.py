"""Tasks in decreasing priority."""

from __future__ import annotations

from typing import Any

from ._conik import Robot, check
from ._numbers import floats
from .tasks import OwnTask, Task


class Stack:
    """The tasks of a robot, the most important first; each is added below all others.

    The position limits of the robot's joints are sets above all of them. A set above the first equality task
    has *high priority*: no sample lies outside of it once it was entered. A set below it has *low priority*:
    it is driven back to its border as well as the tasks above allow.
    """

    def __init__(self, robot: Robot) -> None:
        self._robot = robot
        self._tasks: list[dict[str, Any]] = []
        self._own: dict[str, dict[str, Any]] = {}
        self._shapes: list[dict[str, Any]] = []
        self._obstacles: list[dict[str, Any]] = []
        self._self_collision: dict[str, Any] | None = None

    @property
    def robot(self) -> Robot:
        """The robot that the tasks are for."""
        return self._robot

    @property
    def names(self) -> list[str]:
        """Names of the tasks, the most important first."""
        return [task["name"] for task in self._tasks]

    def set(
        self,
        name: str,
        task: Task,
        min: float | None = None,
        max: float | None = None,
        gain: float | None = None,
        *,
        recovery: float | None = None,
        damping: str | float | None = None,
    ) -> None:
        """Adds a set-based task: its value is to stay between two bounds, of which at least one is given.

        Arguments:
            name: letters, digits and `_ . / -`, unique in the stack.
            task: what is measured; of one component.
            min: least value [task's unit].
            max: greatest value [task's unit].
            gain: how fast a set of low priority is driven back to its border [1/s]; needed below an equality
                task.
            recovery: how fast a set of high priority moves in while it is outside [task's unit/s]; without it,
                it is only kept from getting worse.
            damping: how a set of low priority is damped near singularities: "automatic", "per-direction",
                "smallest", "none", or a number.

        Raises:
            ScenarioError: what is wrong with it; the stack is then as it was.
        """
        self._add(
            name,
            task,
            {"min": min, "max": max, "gain_per_s": gain, "recovery_per_s": recovery, "damping": damping},
        )

    def equality(
        self, name: str, task: Task, gain: float | None = None, *, damping: str | float | None = None
    ) -> None:
        """Adds an equality task: its value is to become the desired one, which the task itself has.

        Arguments:
            name: letters, digits and `_ . / -`, unique in the stack.
            task: what is measured, with its desired value.
            gain: how fast the error falls [1/s]: in each period by gain / rate of what it is. A `JointSpeed`
                has none.
            damping: how it is damped near singularities: "automatic", "per-direction", "smallest", "none", or
                a number.

        Raises:
            ScenarioError: what is wrong with it; the stack is then as it was.
        """
        self._add(name, task, {"gain_per_s": gain, "damping": damping}, is_set=False)

    def shape(self, name: str, link: str, type: str, **keys: Any) -> None:
        """Fixes a shape to a link.

        Shapes are kept apart from obstacles, and with `self_collision` from each other. Each pair is a set above
        all tasks that are added.

        Arguments:
            name: unique among shapes and obstacles.
            link: the link in whose frame it is given.
            type: "sphere" (with `center`, `radius`), "capsule" (`from_`, `to`, `radius`), "box" (`center`, `size`,
                `rotation`) or "cylinder" (`from_`, `to`, `radius`).
            keys: `center`, `from_`, `to`, `size` [m], shape (3,); `radius` [m]; `rotation`: about this axis by its
                length [rad], shape (3,), by default not at all.

        Raises:
            ScenarioError: what is wrong with it; the stack is then as it was.
        """
        self._place(self._shapes, {"name": name, "link": link, "type": type, **_shape_keys(keys)})

    def obstacle(self, name: str, type: str, distance: float | None = None, **keys: Any) -> None:
        """Puts a shape into the world, from which the shapes of the robot keep their distance.

        Arguments:
            name: unique among shapes and obstacles.
            type: one of those of `shape`, or "half_space" (`point`, `normal`): what lies behind a plane.
            distance: least distance between the surfaces [m]. Without it the obstacle keeps nothing away, and is
                only measured by tasks of type `ShapeDistance`.
            keys: as of `shape`, in the world; `point` [m], `normal` out of it [-], shape (3,).

        Raises:
            ScenarioError: what is wrong with it; the stack is then as it was.
        """
        self._place(
            self._obstacles,
            {"name": name, "type": type, "distance_m": distance, **_shape_keys(keys)},
        )

    def self_collision(self, distance: float, exclude: list[list[str]] | None = None) -> None:
        """Keeps the shapes of the robot apart from each other, but for those on one link or on neighbours.

        Arguments:
            distance: least distance between the surfaces [m].
            exclude: groups of names of shapes of which no two are kept apart.
        """
        before = self._self_collision
        self._self_collision = _given({"distance_m": distance, "exclude": exclude})
        try:
            self._check()
        except Exception:
            self._self_collision = before
            raise

    def _add(self, name: str, task: Task, goal: dict[str, Any], is_set: bool = True) -> None:
        if isinstance(task, OwnTask):
            if is_set and task.dimension != 1:
                raise ValueError(f"task `{name}`: a set has one component, not {task.dimension}")
            desired = [] if is_set else task._desired()
            if not is_set and len(desired) != task.dimension:
                raise ValueError(f"task `{name}`: {len(desired)} desired values for {task.dimension} components")
            # A height stands for it where scenarios are checked.
            keys: dict[str, Any] = {"type": "height"} if is_set else {"type": "height", "desired": 0.0}
        elif isinstance(task, Task):
            keys = task._keys
            if not is_set and task._keys["type"] == "workspace":
                raise ValueError(f"task `{name}`: a workspace is a set; add it with `stack.set`")
        else:
            raise TypeError(f"task `{name}`: a task of this module is expected, not {task!r}")
        if is_set and "desired" in keys:
            raise ValueError(f"task `{name}`: a set has bounds, and no desired value")
        self._tasks.append({"name": name, **keys, **_given(goal)})
        try:
            self._check()
        except Exception:
            self._tasks.pop()
            raise
        if isinstance(task, OwnTask):
            self._own[name] = {"task": task, "desired": desired}

    def _place(self, things: list[dict[str, Any]], keys: dict[str, Any]) -> None:
        things.append(_given(keys))
        try:
            self._check()
        except Exception:
            things.pop()
            raise

    def _check(self) -> None:
        if self._tasks:
            # A gain is checked against the rate where that is known.
            check(self._robot, {"control": {"rate_hz": 10_000}, **self._tables()})

    def _tables(self) -> dict[str, Any]:
        return _given(
            {
                "shape": self._shapes or None,
                "obstacle": self._obstacles or None,
                "self_collision": self._self_collision,
                "task": self._tasks,
            }
        )

    def __len__(self) -> int:
        return len(self._tasks)

    def __repr__(self) -> str:
        return f"<conik.Stack of {', '.join(self.names) or 'no tasks'}>"


def _given(keys: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in keys.items() if value is not None}


#: Arguments of shapes, and the keys of a scenario file.
_SHAPE = {
    "center": "center_m",
    "radius": "radius_m",
    "from_": "from_m",
    "to": "to_m",
    "size": "size_m",
    "rotation": "rotation_rad",
    "point": "point_m",
    "normal": "normal",
    "velocity": "velocity_m_per_s",
}


def _shape_keys(keys: dict[str, Any]) -> dict[str, Any]:
    unknown = [key for key in keys if key not in _SHAPE]
    if unknown:
        raise TypeError(f"a shape has no {unknown[0]!r}; it may have: {', '.join(_SHAPE)}")
    return {
        _SHAPE[key]: float(value) if key == "radius" else floats(value)
        for key, value in keys.items()
        if value is not None
    }

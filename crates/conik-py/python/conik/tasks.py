"""What is measured. What is asked of it is said where it is added to a `Stack`.

Every task but those of joints and shapes takes two more arguments by name: `frame`, the link that is
measured (by default the tool), and `relative_to`, the link from which it is seen (by default the world):
points, directions and orientations are in its axes and move with it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._conik import Kinematics
from ._numbers import Rotation, Vector, floats, quaternion, rpy_quaternion


class Task:
    """What is measured: one of the classes below, or an `OwnTask`.

    Arguments:
        type: the type in a scenario file.
        keys: its keys there.
    """

    def __init__(self, type: str, **keys: Any) -> None:
        self._keys = {"type": type, **{key: value for key, value in keys.items() if value is not None}}

    def __repr__(self) -> str:
        keys = (f"{key}={value!r}" for key, value in self._keys.items() if key != "type")
        return f"conik.{type(self).__name__}({', '.join(keys)})"


class Position(Task):
    """Position of the origin of the frame [m], 3 numbers. An equality task."""

    def __init__(self, target: Vector, *, frame: str | None = None, relative_to: str | None = None) -> None:
        """`target`: where the frame is to be [m], 3 numbers."""
        super().__init__("position", target_m=floats(target), frame=frame, relative_to=relative_to)


class Coordinate(Task):
    """One coordinate of the position of the frame [m]: a wall or a ceiling along an axis, as a set."""

    def __init__(
        self,
        axis: str,
        desired: float | None = None,
        *,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`axis`: "x", "y" or "z", of the world or of `relative_to`; `desired` [m]: of an equality task."""
        super().__init__("coordinate", axis=axis, desired=desired, frame=frame, relative_to=relative_to)


class Distance(Task):
    """Distance of the origin of the frame to a point [m], 0 and more: with a `min` a ball to keep out of."""

    def __init__(
        self,
        point: Vector,
        desired: float | None = None,
        *,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`point` [m], 3 numbers; `desired` [m]: of an equality task."""
        super().__init__("distance", point_m=floats(point), desired=desired, frame=frame, relative_to=relative_to)


class FieldOfView(Task):
    """Norm of (direction - z axis of the frame): 2 sin(angle / 2) [-], from 0 to 2. Eq. (13) of the paper."""

    def __init__(
        self,
        direction: Vector,
        desired: float | None = None,
        *,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`direction`: any vector but zero, 3 numbers; `desired` [-]: of an equality task."""
        super().__init__(
            "field_of_view", direction=floats(direction), desired=desired, frame=frame, relative_to=relative_to
        )


class PointingAngle(Task):
    """Angle between an axis of the frame and a direction [rad], from 0 to pi: a cup upright, a torch down."""

    def __init__(
        self,
        direction: Vector,
        desired: float | None = None,
        *,
        axis: Vector | None = None,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`direction`: any vector but zero; `axis`: in the frame, by default its z axis; `desired` [rad]."""
        super().__init__(
            "pointing_angle",
            direction=floats(direction),
            axis=None if axis is None else floats(axis),
            desired=desired,
            frame=frame,
            relative_to=relative_to,
        )


class LookAt(Task):
    """Angle between the z axis of the frame and the line of sight to a point [rad], from 0 to pi: a camera that
    keeps something in its picture."""

    def __init__(
        self,
        point: Vector,
        desired: float | None = None,
        *,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`point` [m], 3 numbers; `desired` [rad]: of an equality task."""
        super().__init__("look_at", point_m=floats(point), desired=desired, frame=frame, relative_to=relative_to)


def _orientation(orientation: Rotation | None, rpy: Vector | None) -> list[float]:
    if (orientation is None) == (rpy is None):
        raise ValueError("give either the orientation, as a matrix or a quaternion, or `desired_rpy`")
    return quaternion(orientation) if orientation is not None else rpy_quaternion(rpy)  # type: ignore[arg-type]


class Orientation(Task):
    """Orientation of the frame [rad], against a desired one. An equality task of 3 components."""

    def __init__(
        self,
        desired: Rotation | None = None,
        *,
        desired_rpy: Vector | None = None,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`desired`: a matrix of 3 x 3 whose columns are the axes, or a quaternion of 4 with its real part
        first; or `desired_rpy` [rad]: roll, pitch and yaw about the fixed x, then y, then z axis."""
        super().__init__(
            "orientation",
            desired_quaternion_wxyz=_orientation(desired, desired_rpy),
            frame=frame,
            relative_to=relative_to,
        )


class OrientationAngle(Task):
    """Angle that is left to turn to a desired orientation [rad], from 0 to pi."""

    def __init__(
        self,
        orientation: Rotation | None = None,
        desired: float | None = None,
        *,
        desired_rpy: Vector | None = None,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`orientation` or `desired_rpy`: as of `Orientation`; `desired` [rad]: of an equality task."""
        super().__init__(
            "orientation_angle",
            desired_quaternion_wxyz=_orientation(orientation, desired_rpy),
            desired=desired,
            frame=frame,
            relative_to=relative_to,
        )


class Pose(Task):
    """Position and orientation of the frame [m, rad], against desired ones. An equality task of 6 components,
    in which a radian counts as much as a metre."""

    def __init__(
        self,
        target: Vector | npt.NDArray[np.floating],
        desired: Rotation | None = None,
        *,
        desired_rpy: Vector | None = None,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`target`: a matrix of 4 x 4, world_from_frame; or the position [m], 3 numbers, with the orientation
        as `desired` or `desired_rpy`, as of `Orientation`."""
        target = np.asarray(target, dtype=float)
        if target.shape == (4, 4):
            if desired is not None or desired_rpy is not None:
                raise ValueError("the matrix of 4 x 4 has the orientation already")
            target, desired = target[:3, 3], target[:3, :3]
        super().__init__(
            "pose",
            target_m=floats(target),
            desired_quaternion_wxyz=_orientation(desired, desired_rpy),
            frame=frame,
            relative_to=relative_to,
        )


class Plane(Task):
    """Signed distance of the origin of the frame to a plane [m], positive on the side of its normal: a table or
    a wall at any angle."""

    def __init__(
        self,
        normal: Vector,
        offset: float = 0.0,
        desired: float | None = None,
        *,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`normal`: any vector but zero, 3 numbers; `offset` [m]: how far the plane is from the origin along it;
        `desired` [m]: of an equality task."""
        super().__init__(
            "plane",
            normal=floats(normal),
            offset_m=offset,
            desired=desired,
            frame=frame,
            relative_to=relative_to,
        )


class Height(Task):
    """Height of the origin of the frame: its z [m]."""

    def __init__(
        self, desired: float | None = None, *, frame: str | None = None, relative_to: str | None = None
    ) -> None:
        """`desired` [m]: of an equality task."""
        super().__init__("height", desired=desired, frame=frame, relative_to=relative_to)


class Workspace(Task):
    """A sphere or a box that the origin of the frame stays inside. A set without bounds of its own:
    `stack.set("cell", Workspace(...))`. It becomes one set `cell`, or of a box `cell/x`, `cell/y`, `cell/z`."""

    def __init__(
        self,
        *,
        center: Vector | None = None,
        radius: float | None = None,
        min: Vector | None = None,
        max: Vector | None = None,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`center` [m] and `radius` [m] of a sphere, or the corners `min` and `max` [m] of a box."""
        super().__init__(
            "workspace",
            center_m=None if center is None else floats(center),
            radius_m=radius,
            min_m=None if min is None else floats(min),
            max_m=None if max is None else floats(max),
            frame=frame,
            relative_to=relative_to,
        )


class Joint(Task):
    """Position of one joint [rad, or m if it slides]. The position limits of the robot are sets already."""

    def __init__(self, joint: int | str, desired: float | None = None) -> None:
        """`joint`: its number from 1 at the base, or its name; `desired` [rad or m]: of an equality task."""
        super().__init__("joint", joint=joint, desired=desired)


class Posture(Task):
    """Positions of several joints [rad or m]. An equality task."""

    def __init__(self, desired: Vector, joints: list[int | str] | None = None) -> None:
        """`desired`: one number for each joint; `joints`: their numbers from 1 or names, by default all."""
        super().__init__("posture", desired_rad=floats(desired), joints=joints)


class JointSpeed(Task):
    """Speed of one joint, wherever it is [rad/s or m/s]. An equality task without a gain; its value is the
    joint's position."""

    def __init__(self, joint: int | str, speed: float) -> None:
        """`joint`: its number from 1 at the base, or its name; `speed` [rad/s or m/s]."""
        super().__init__("joint_speed", joint=joint, speed_rad_per_s=float(speed))


class Manipulability(Task):
    """Manipulability: the square root of det(J J^T) [m^3, of an orientation -], 0 at a singularity."""

    def __init__(
        self,
        part: str = "position",
        desired: float | None = None,
        *,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`part`: which rows of J count, "position", "orientation" or "pose";
        `desired` [value's unit]: of an equality task."""
        super().__init__("manipulability", part=part, desired=desired, frame=frame, relative_to=relative_to)


class SmallestSingularValue(Task):
    """The least speed of the frame for a joint speed of 1 [m/rad, of an orientation or a pose -]."""

    def __init__(
        self,
        part: str = "position",
        desired: float | None = None,
        *,
        frame: str | None = None,
        relative_to: str | None = None,
    ) -> None:
        """`part`: which rows of the Jacobian count, "position", "orientation" or "pose";
        `desired` [value's unit]: of an equality task."""
        super().__init__(
            "smallest_singular_value", part=part, desired=desired, frame=frame, relative_to=relative_to
        )


class Elbow(Task):
    """Swivel angle: from a direction to the elbow, about the line from shoulder to wrist [rad]."""

    def __init__(
        self,
        shoulder: str,
        elbow: str,
        wrist: str,
        direction: Vector,
        desired: float | None = None,
        *,
        relative_to: str | None = None,
    ) -> None:
        """`shoulder`, `elbow`, `wrist`: the links at whose origins they are; `direction`: where the elbow is
        at 0, any vector but zero, 3 numbers; `desired` [rad]: of an equality task. A set must not have pi inside,
        where the value jumps."""
        super().__init__(
            "elbow",
            shoulder=shoulder,
            elbow=elbow,
            wrist=wrist,
            direction=floats(direction),
            desired=desired,
            relative_to=relative_to,
        )


class ShapeDistance(Task):
    """Distance of two shapes of the stack [m], negative where they overlap: how far they would have to be
    shifted to come apart. Pairs that only have to keep away need no task: `Stack.obstacle` makes their sets."""

    def __init__(self, first: str, second: str, desired: float | None = None) -> None:
        """The names of a shape of the stack and of another one or of an obstacle."""
        super().__init__("shape_distance", shapes=[first, second], desired=desired)


class OwnTask(Task):
    """A task of your own: a class with a value and its exact Jacobian.

        class Radius(conik.OwnTask):
            "Distance of the tool from the vertical axis [m]."

            def value(self, kinematics):
                x, y = kinematics.world_from()[:2, 3]
                return np.hypot(x, y)

            def jacobian(self, kinematics):
                x, y = kinematics.world_from()[:2, 3]
                return np.array([x, y]) / np.hypot(x, y) @ kinematics.jacobian()[:2]

        stack.set("radius", Radius(), min=0.3)

    Values must follow from the configuration and from the object's own attributes alone, and be finite. What a
    method raises is raised by `Controller.step`. A task whose attributes change by themselves between ticks
    says how with a method `value_ahead(kinematics, ahead_s)`: the value that it will have `ahead_s` [s] from
    now if the robot stays where it is; as a set it is then kept from what comes.
    """

    dimension: int = 1
    """Number of components. Sets have one."""
    unit: str = "-"
    """Unit of the value, for people."""

    def __init__(self, desired: float | Vector | None = None) -> None:
        """`desired`: of an equality task, one number for each component; without it zeros."""
        # Subclasses need not call this.
        self.desired = desired

    def value(self, kinematics: Kinematics) -> Any:
        """The value in the configuration of `kinematics`: a number, or `dimension` of them."""
        raise NotImplementedError(f"{type(self).__name__} has no method `value`")

    def jacobian(self, kinematics: Kinematics) -> Any:
        """Its Jacobian there, of shape (`dimension`, dof), or (dof,) where the dimension is 1."""
        raise NotImplementedError(f"{type(self).__name__} has no method `jacobian`")

    def _desired(self) -> list[float]:
        desired = getattr(self, "desired", None)
        return [0.0] * self.dimension if desired is None else floats(np.atleast_1d(desired))

    def __repr__(self) -> str:
        return f"<{type(self).__module__}.{type(self).__qualname__}>"

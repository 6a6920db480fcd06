"""From whatever holds numbers to what `json` writes."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

#: A vector: a list, a tuple, an array.
Vector: TypeAlias = Sequence[float] | npt.NDArray[np.floating]
#: A rotation: a matrix of 3 x 3, or a quaternion of 4 with its real part first.
Rotation: TypeAlias = Sequence[float] | Sequence[Sequence[float]] | npt.NDArray[np.floating]


def floats(vector: Iterable[float]) -> list[float]:
    """The numbers of a vector."""
    return [float(number) for number in np.asarray(vector, dtype=float).ravel()]


def quaternion(rotation: Rotation) -> list[float]:
    """A rotation as a quaternion [w, x, y, z]."""
    given = np.asarray(rotation, dtype=float)
    if given.shape == (4,):
        return floats(given)
    if given.shape == (4, 4):
        given = given[:3, :3]
    if given.shape != (3, 3):
        raise ValueError(
            f"an orientation is a matrix of 3 x 3 or a quaternion of 4 numbers, its real part first; "
            f"this has the shape {given.shape}"
        )
    if not np.allclose(given @ given.T, np.eye(3), atol=1e-6) or np.linalg.det(given) < 0:
        raise ValueError("the matrix is no rotation: its rows must have length 1 and be at right angles")
    # Of the four ways to take the square roots, the one in which the largest is not near zero.
    m = given
    squares = [1 + m[0, 0] + m[1, 1] + m[2, 2]]
    squares += [1 + 2 * m[i, i] - m[0, 0] - m[1, 1] - m[2, 2] for i in range(3)]
    off = [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1]]
    sums = [m[2, 1] + m[1, 2], m[0, 2] + m[2, 0], m[1, 0] + m[0, 1]]
    largest = int(np.argmax(squares))
    rows = [
        [squares[0], off[0], off[1], off[2]],
        [off[0], squares[1], sums[2], sums[1]],
        [off[1], sums[2], squares[2], sums[0]],
        [off[2], sums[1], sums[0], squares[3]],
    ]
    quaternion_wxyz = np.asarray(rows[largest])
    return floats(quaternion_wxyz / np.linalg.norm(quaternion_wxyz))


def rpy_quaternion(rpy: Vector) -> list[float]:
    """Roll, pitch and yaw [rad], about the fixed x, then y, then z axis, as a quaternion [w, x, y, z]."""
    roll, pitch, yaw = (angle / 2 for angle in floats(rpy))
    cr, sr, cp, sp = np.cos(roll), np.sin(roll), np.cos(pitch), np.sin(pitch)
    cy, sy = np.cos(yaw), np.sin(yaw)
    return floats(
        [
            cr * cp * cy + sr * sp * sy,
            sr * cp * cy - cr * sp * sy,
            cr * sp * cy + sr * cp * sy,
            cr * cp * sy - sr * sp * cy,
        ]
    )

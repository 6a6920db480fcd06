"""Whole runs: of a scenario file or of its tables."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from . import _conik

if TYPE_CHECKING:
    import pandas
    import polars


class Run:
    """What a run leaves behind.

    `run["q1_rad"]` is a column, one number a tick; `run.names` has their names, which are those of `log.csv`.
    """

    columns: dict[str, npt.NDArray[np.float64]]
    """The columns by their names, each of shape (ticks,)."""
    active: npt.NDArray[np.int64]
    """The number of the active set of each tick, an index of `active_sets`; shape (ticks,)."""
    active_sets: list[tuple[str, ...]]
    """The sets that were active together, by their names."""
    why: npt.NDArray[np.int64]
    """The number of what each tick decided and why, an index of `reasons`; shape (ticks,)."""
    reasons: list[tuple[str, ...]]
    """The codes of reasons: `hold:obstacle_a`, `speed:q3`."""
    summary: dict[str, Any]
    """What `summary.json` has: outcome, waypoints, tasks, properties, ..."""
    scenario: str
    """The scenario as the text of a file."""

    def __init__(self, done: Mapping[str, Any]) -> None:
        self.columns = done["columns"]
        self.active = done["active"]
        self.active_sets = [tuple(active) for active in done["active_sets"]]
        self.why = done["why"]
        self.reasons = [tuple(reasons) for reasons in done["reasons"]]
        self.summary = json.loads(done["summary"])
        self.scenario = done["toml"]

    @property
    def names(self) -> list[str]:
        """Names of the columns."""
        return list(self.columns)

    @property
    def t_s(self) -> npt.NDArray[np.float64]:
        """Time of each tick [s], shape (ticks,)."""
        return self.columns["t_s"]

    @property
    def q(self) -> npt.NDArray[np.float64]:
        """Joint references [rad or m], shape (ticks, dof)."""
        return self._joints("q", "_rad")

    @property
    def qd(self) -> npt.NDArray[np.float64]:
        """Joint velocities from each tick to the next [rad/s or m/s], shape (ticks, dof)."""
        return self._joints("qd", "_rad_s")

    @property
    def tool(self) -> npt.NDArray[np.float64]:
        """Position of the tool in the world [m], shape (ticks, 3)."""
        return np.column_stack([self.columns[f"tool_{axis}_m"] for axis in "xyz"])

    def _joints(self, name: str, unit: str) -> npt.NDArray[np.float64]:
        joints: list[npt.NDArray[np.float64]] = []
        while (column := self.columns.get(f"{name}{len(joints) + 1}{unit}")) is not None:
            joints.append(column)
        return np.column_stack(joints)

    def is_active(self, name: str) -> npt.NDArray[np.bool_]:
        """Whether a set was active, for each tick: shape (ticks,).

        Arguments:
            name: of the set; one that was never active is active nowhere.
        """
        has = np.array([name in active for active in self.active_sets], dtype=bool)
        return has[self.active]

    def __getitem__(self, name: str) -> npt.NDArray[np.float64]:
        try:
            return self.columns[name]
        except KeyError:
            raise KeyError(f"no column {name!r}; there are: {', '.join(self.columns)}") from None

    def __len__(self) -> int:
        return len(self.active)

    def _table(self) -> dict[str, Any]:
        active = ["+".join(active) for active in self.active_sets]
        reasons = ["+".join(reasons) for reasons in self.reasons]
        return {
            **self.columns,
            "active": [active[number] for number in self.active],
            "why": [reasons[number] for number in self.why],
        }

    def to_pandas(self) -> pandas.DataFrame:
        """A pandas frame: the columns, then `active` and `why` as text. Needs `pip install pandas`."""
        import pandas

        return pandas.DataFrame(self._table())

    def to_polars(self) -> polars.DataFrame:
        """A polars frame: the columns, then `active` and `why` as text. Needs `pip install polars`."""
        import polars

        return polars.DataFrame(self._table())

    def __repr__(self) -> str:
        outcome = self.summary["outcome"]["kind"]
        return f"<conik.Run of {len(self)} ticks, {self.t_s[-1] if len(self) else 0:.3f} s, {outcome}>"


def run(scenario: str | os.PathLike[str] | Mapping[str, Any]) -> Run:
    """Runs a scenario on an ideal arm (q = q_ref), as fast as it goes.

    Arguments:
        scenario: the path of a scenario file, or its tables: {"robot": {...}, "control": {...}, "task": [...]},
            with the file's own keys and units. Arrays and numbers of numpy are taken.

    Returns:
        The log as arrays, and the summary.

    Raises:
        ScenarioError: every mistake in it, with its place and what would be right.
        KeyboardInterrupt: on Ctrl-C.
    """
    if isinstance(scenario, Mapping):
        return Run(_conik.run(tables=dict(scenario)))
    return Run(_conik.run(path=os.fspath(scenario)))


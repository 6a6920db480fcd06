"""Checks the Parquet file in a run folder with Arrow's reader, against the folder's log.csv.

    python check_parquet.py FOLDER
"""
import csv
import json
import math
import sys
from pathlib import Path

import pyarrow as pa
import pyarrow.parquet as pq


def main():
    folder = Path(sys.argv[1])
    (path,) = folder.glob("*.parquet")
    rows = list(csv.reader((folder / "log.csv").open()))
    summary = json.loads((folder / "summary.json").read_text())
    table = pq.read_table(path, page_checksum_verification=True)
    header, rows = rows[0], rows[1:]
    assert table.column_names == header
    assert table.num_rows == len(rows)

    types = {"mode": pa.uint64(), "active": pa.string(), "waypoint": pa.int32(), "why": pa.string()}
    for at, name in enumerate(header):
        column = table.column(name)
        assert column.type == types.get(name, pa.float64()), name
        cells = [row[at] for row in rows]
        if name in ("active", "why"):
            expected = cells
        elif name in ("mode", "waypoint"):
            expected = [int(cell) if cell else None for cell in cells]
        else:
            expected = [float(cell) if cell else math.nan for cell in cells]
        for found, wanted in zip(column.to_pylist(), expected):
            assert found == wanted or found != found and wanted != wanted, (name, found, wanted)

    metadata = pq.read_metadata(path).metadata
    assert json.loads(metadata[b"conik.summary"]) == summary
    assert b"[robot]" in metadata[b"conik.scenario"]
    units = json.loads(metadata[b"conik.units"])
    assert set(header) - set(units) == set(types)
    assert units["t_s"] == "s" and units["tool_x_m"] == "m"
    assert units["q2_rad"] == "rad" and units["qdd2_rad_s2"] == "rad/s²"
    for task, unit in summary["settings"]["units"].items():
        if task in header:
            assert units[task] == unit, task
    print(f"  {table.num_rows} rows, {table.num_columns} columns, {path.stat().st_size} bytes")


if __name__ == "__main__":
    main()

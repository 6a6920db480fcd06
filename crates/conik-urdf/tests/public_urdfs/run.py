#!/usr/bin/env python3
"""Reads real public URDF files and compares every link's pose with Pinocchio's.

    python3 crates/conik-urdf/tests/public_urdfs/run.py [FOLDER]

Without a folder of URDF files, `example-robot-data` supplies them. It and `pin` (Pinocchio) are installed
into a virtual environment under target/. Each file is read once for each of its ends as the tool, and
once with a link in the middle as the base, for a few random configurations each.
"""

import math
import pathlib
import random
import re
import subprocess
import sys
import venv
from collections import Counter

ROOT = pathlib.Path(__file__).resolve().parents[4]
ENVIRONMENT = ROOT / "target" / "public_urdfs"
DESCRIBE = ROOT / "target" / "debug" / "examples" / "describe"
TOLERANCE = 1e-12
MOST_TOOLS = 6


def prepare():
    """Builds the example, and goes on in an environment that has Pinocchio."""
    subprocess.run(["cargo", "build", "-q", "-j1", "-p", "conik-urdf", "--example", "describe"],
                   cwd=ROOT, check=True)
    python = ENVIRONMENT / "bin" / "python"
    if not python.exists():
        venv.create(ENVIRONMENT, with_pip=True)
        subprocess.run([python, "-m", "pip", "install", "-q", "pin==4.1.0", "example-robot-data==6.0.0"],
                       check=True)
    subprocess.run([python, __file__, *sys.argv[1:], "--prepared"], check=True)


def describe(file, base, tool, configurations=None):
    command = [DESCRIBE, file]
    command += ["--base", base] if base else []
    command += ["--tool", tool] if tool else []
    command += ["--poses"] if configurations is not None else []
    lines = "\n".join(" ".join(map(repr, q)) for q in configurations or [])
    done = subprocess.run(command, input=lines, capture_output=True, text=True)
    return done.returncode, done.stdout.splitlines(), done.stderr.strip()


def compare(file, base, tool, model, pin, numpy):
    """The greatest difference of any link's pose seen from the base; None where the file is refused."""
    status, lines, error = describe(file, base, tool)
    if status:
        return None, error
    joints = [line.split()[1] for line in lines if line.startswith("joint ")]
    generator = random.Random(1)
    qs = [[generator.uniform(-3, 3) for _ in joints] for _ in range(3)]
    _, lines, _ = describe(file, base, tool, qs)
    poses = [line.split("\t") for line in lines if line.startswith("link\t")]
    links = len(poses) // len(qs)
    held = {}
    data = model.createData()
    worst = 0.0
    for number, q in enumerate(qs):
        here = dict(zip(joints, q))
        full = pin.neutral(model)
        leaders = {name: (leader, m, o) for name, leader, m, o in mimics(file)}
        limits = bounds(file)

        def position(name):
            if name in leaders:
                leader, multiplier, offset = leaders[name]
                return multiplier * position(leader) + offset
            if name in here:
                return here[name]
            low, high = limits.get(name, (0.0, 0.0))
            return min(max(0.0, low), high)

        for joint, name in zip(model.joints[1:], list(model.names)[1:]):
            at = position(name)
            if joint.nq == 1:
                full[joint.idx_q] = at
            elif joint.nq == 2 and joint.nv == 1:
                full[joint.idx_q:joint.idx_q + 2] = [math.cos(at), math.sin(at)]
        pin.framesForwardKinematics(model, data, full)
        frames = {}
        for index, frame in enumerate(model.frames):
            if frame.type == pin.FrameType.BODY:
                frames[frame.name] = data.oMf[index].homogeneous
        rows = poses[number * links:(number + 1) * links]
        origin = numpy.linalg.inv(frames[rows[0][1]])
        for _, name, entries in rows:
            ours = numpy.array([float(entry) for entry in entries.split()]).reshape(4, 4)
            worst = max(worst, float(numpy.abs(ours - origin @ frames[name]).max()))
    return worst, ""


def elements(file):
    import xml.etree.ElementTree as tree
    return tree.parse(file).getroot()


def mimics(file):
    for joint in elements(file).findall("joint"):
        mimic = joint.find("mimic")
        if mimic is not None:
            yield (joint.get("name"), mimic.get("joint"),
                   float(mimic.get("multiplier", 1)), float(mimic.get("offset", 0)))


def bounds(file):
    found = {}
    for joint in elements(file).findall("joint"):
        limit = joint.find("limit")
        if limit is not None and joint.get("type") in ("revolute", "prismatic"):
            if limit.get("lower") or limit.get("upper"):
                found[joint.get("name")] = (float(limit.get("lower", 0)), float(limit.get("upper", 0)))
    return found


def main():
    import numpy
    import pinocchio as pin
    folders = [argument for argument in sys.argv[1:] if argument != "--prepared"]
    folder = pathlib.Path(folders[0] if folders else ENVIRONMENT)
    results, worst, compared = Counter(), 0.0, 0
    for file in sorted(folder.rglob("*.urdf")):
        status, _, error = describe(file, None, None)
        tools = [None]
        ends = re.search(r"the ends are (.*)", error)
        if status and ends:
            tools = re.findall(r'"([^"]*)"', ends[1])[:MOST_TOOLS]
        elif status:
            results["refused"] += 1
            print(f"refused  {file.name}: {error.removeprefix(str(file))}")
            continue
        try:
            model = pin.buildModelFromUrdf(str(file))
        except Exception as refusal:
            results["refused by Pinocchio only"] += 1
            print(f"only we  {file.name}: {refusal}")
            continue
        results["read"] += 1
        # The end of another branch as the base turns joints round.
        cases = [(None, tool) for tool in tools]
        cases += [(base, tool) for base, tool in zip(tools, tools[1:])]
        for base, tool in cases:
            difference, error = compare(file, base, tool, model, pin, numpy)
            if difference is None:
                results["ways refused"] += 1
                if "no joint moves" not in error:
                    print(f"way      {file.name} {base} -> {tool}: {error.removeprefix(str(file))}")
                continue
            compared += 1
            worst = max(worst, difference)
            if difference > TOLERANCE:
                results["DIFFERENT"] += 1
                print(f"DIFFERS  {file.name} {base} -> {tool}: {difference:.1e}")
    print(dict(results), f"{compared} ways compared, worst difference {worst:.1e}")
    sys.exit(results["DIFFERENT"] > 0)


if __name__ == "__main__":
    if "--prepared" in sys.argv:
        main()
    else:
        prepare()

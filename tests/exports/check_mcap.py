"""Checks the MCAP file in a run folder with the format's own reader, against the folder's log.csv.

    python check_mcap.py FOLDER
"""
import csv
import importlib
import json
import math
import sys
from collections import defaultdict
from pathlib import Path

from google.protobuf.descriptor_pb2 import DescriptorProto, FileDescriptorSet
from mcap.reader import make_reader
from mcap_protobuf.decoder import DecoderFactory


def nanoseconds(t_s):
    return round(float(t_s) * 1e9)


def own_descriptor(name):
    """What the published package says that a type of Foxglove's is."""
    package, _, short = name.rpartition(".")
    module = {
        "foxglove": f"foxglove_schemas_protobuf.{short}_pb2",
        "google.protobuf": f"google.protobuf.{short.lower()}_pb2",
    }[package]
    found = DescriptorProto()
    getattr(importlib.import_module(module), short).DESCRIPTOR.CopyToProto(found)
    return found


def plain(descriptor):
    """A type as names, numbers and kinds, without the order in which a file lists them."""
    fields = {
        field.name: (field.number, field.type, field.label, field.type_name, field.proto3_optional)
        for field in descriptor.field
    }
    enums = {
        enum.name: {value.name: value.number for value in enum.value}
        for enum in descriptor.enum_type
    }
    return fields, enums


def check_schemas(schemas):
    known = {schema.name for schema in schemas}
    assert {"foxglove.FrameTransforms", "foxglove.JointStates", "foxglove.SceneUpdate"} <= known
    for schema in schemas:
        assert schema.encoding == "protobuf", schema.name
        files = FileDescriptorSet.FromString(schema.data).file
        seen = set()
        for file in files:
            assert set(file.dependency) <= seen, f"{file.name} stands before what it needs"
            seen.add(file.name)
            for message in file.message_type:
                name = f"{file.package}.{message.name}"
                if file.package != "conik":
                    assert plain(message) == plain(own_descriptor(name)), name


def rotated(q, v):
    """v turned by the quaternion q."""
    t = [2 * (q.y * v[2] - q.z * v[1]), 2 * (q.z * v[0] - q.x * v[2]), 2 * (q.x * v[1] - q.y * v[0])]
    return [
        v[0] + q.w * t[0] + q.y * t[2] - q.z * t[1],
        v[1] + q.w * t[1] + q.z * t[0] - q.x * t[2],
        v[2] + q.w * t[2] + q.x * t[1] - q.y * t[0],
    ]


def in_world(frames, frame):
    """Where the origin of a frame is in the world."""
    point = [0.0, 0.0, 0.0]
    for _ in range(100):
        if frame == "world":
            return point
        edge = frames[frame]
        turned = rotated(edge.rotation, point)
        point = [a + getattr(edge.translation, axis) for a, axis in zip(turned, "xyz")]
        frame = edge.parent_frame_id
    raise AssertionError(f"{frame} is not under the world")


def main():
    folder = Path(sys.argv[1])
    (path,) = folder.glob("*.mcap")
    rows = list(csv.DictReader((folder / "log.csv").open()))
    summary = json.loads((folder / "summary.json").read_text())
    topics = defaultdict(dict)
    with path.open("rb") as file:
        reader = make_reader(file, validate_crcs=True, decoder_factories=[DecoderFactory()])
        check_schemas(reader.get_summary().schemas.values())
        metadata = {record.name: record.metadata for record in reader.iter_metadata()}
        attached = {record.name: record.data.decode() for record in reader.iter_attachments()}
        last = 0
        for _, channel, message, decoded in reader.iter_decoded_messages(log_time_order=False):
            assert message.log_time >= last, f"{channel.topic} goes back in time"
            last = message.log_time
            assert message.publish_time == message.log_time
            stamp = getattr(decoded, "timestamp", None)
            if stamp is not None:
                assert stamp.seconds * 10**9 + stamp.nanos == message.log_time, channel.topic
            # Of several lines at one time the last does.
            topics[channel.topic][message.log_time] = decoded

    times = [nanoseconds(row["t_s"]) for row in rows]
    assert times[0] == 0 and last == times[-1]
    assert metadata["scenario"]["toml"] == attached["scenario.toml"]
    assert json.loads(attached["summary.json"]) == summary
    assert metadata["conik"]["border"] == summary["settings"]["scenario"]["control"]["border"]

    names = summary["settings"]["joint_names"]
    sets = {name for row in rows for name in row["active"].split("+") if name}
    every_tick = ["/tf", "/tool", "/joint_states"]
    every_tick += [topic for topic in topics if topic.startswith("/task/")]
    is_measured = "q1_measured_rad" in rows[0]
    assert is_measured == ("/joint_states/measured" in topics)
    every_tick += ["/joint_states/measured"] * is_measured
    for topic in every_tick:
        assert sorted(topics[topic]) == times, topic
    assert {f"/task/{name}" for name in sets} <= set(topics)

    decision, scene, checked = None, {}, 0
    static = {edge.child_frame_id: edge for edge in topics["/tf_static"][0].transforms}
    for time, row in zip(times, rows):
        active = [name for name in row["active"].split("+") if name]
        frames = static | {edge.child_frame_id: edge for edge in topics["/tf"][time].transforms}
        assert all(edge.timestamp.ToNanoseconds() == time for edge in topics["/tf"][time].transforms)
        tool = [float(row[f"tool_{axis}_m"]) for axis in "xyz"]
        pose = topics["/tool"][time].pose
        assert math.dist(tool, [pose.position.x, pose.position.y, pose.position.z]) < 1e-9
        nearest = min(math.dist(tool, in_world(frames, frame)) for frame in frames)
        assert nearest < 1e-9, "no frame is at the tool"
        joints = topics["/joint_states"][time].joints
        assert [joint.name for joint in joints] == names
        for nth, joint in enumerate(joints, 1):
            assert joint.position == float(row[f"q{nth}_rad"])
            assert joint.velocity == float(row[f"qd{nth}_rad_s"])
            assert joint.acceleration == float(row[f"qdd{nth}_rad_s2"])
            assert not joint.HasField("effort")
        if is_measured:
            for nth, joint in enumerate(topics["/joint_states/measured"][time].joints, 1):
                assert joint.position == float(row[f"q{nth}_measured_rad"])
        for topic in every_tick:
            if not topic.startswith("/task/"):
                continue
            task, message = topic.removeprefix("/task/"), topics[topic][time]
            for field, column in [("value", task), ("error", f"{task}_error")]:
                assert message.HasField(field) == (column in row), topic
                if column in row:
                    assert getattr(message, field) == float(row[column]), topic
            if message.HasField("active"):
                assert message.active == (task in active)
                assert message.HasField("min") or message.HasField("max")
        decision = topics["/decision"].get(time, decision)
        assert (decision.active, decision.why) == (row["active"], row["why"])
        assert decision.active_count == len(active)
        assert decision.waypoint == int(row["waypoint"])
        assert decision.HasField("mode") == bool(row["mode"])
        assert decision.mode == int(row["mode"] or 0)
        for topic in ["/arm", "/scene", "/scene/moving"]:
            for entity in topics.get(topic, {}).get(time, type(topics["/arm"][0])()).entities:
                assert entity.frame_id == "world" or entity.frame_id in frames, entity.frame_id
                scene[entity.id] = entity
        # Spheres of tasks are where and as large as the task says, and lit while it is active.
        for task in summary["settings"]["scenario"]["task"]:
            entity = scene.get(f"task/{task['name']}/min")
            if task["type"] == "distance" and entity:
                checked += 1
                (sphere,) = entity.spheres
                assert sphere.size.x == 2 * task["min"], task["name"]
                until = task.get("moves_until_s", math.inf)
                shift = min(time * 1e-9, until)
                velocity = task.get("velocity_m_per_s", [0, 0, 0])
                centre = [p + v * shift for p, v in zip(task["point_m"], velocity)]
                at = sphere.pose.position
                assert math.dist(centre, [at.x, at.y, at.z]) < 1e-9, task["name"]
                is_orange = sphere.color.r > 0.8 and sphere.color.b < 0.1
                assert is_orange == (task["name"] in active), (task["name"], time)
    assert len(topics["/path"]) == 1
    points = topics["/path"][0].entities[0].lines[0].points
    first, end = rows[0], rows[-1]
    for point, row in [(points[0], first), (points[-1], end)]:
        assert math.dist([point.x, point.y, point.z], [float(row[f"tool_{a}_m"]) for a in "xyz"]) == 0
    assert topics["/log"][times[-1]].message in ("completed", metadata["conik"]["outcome"])
    print(f"  {len(rows)} rows, {len(topics)} topics, {checked} spheres looked at")


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Writes tests/data/logs: one joint log of two joints as programs store such logs, by libraries that share
no code with stiffarm. The tests read every one of them and compare with expected.csv.

    python3 -m venv venv && venv/bin/pip install pyarrow==26.0.1 rosbags==0.11.9 mcap==1.6.0
    venv/bin/python tools/joint_logs.py

The joints are called shoulder and elbow. Messages tell the elbow first, as ROS does, in the order of the alphabet.
"""

import math
import shutil
from pathlib import Path

import numpy
import pyarrow
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from pyarrow import parquet
from rosbags.rosbag2 import StoragePlugin
from rosbags.rosbag2 import Writer as Ros2Writer
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

OUT = Path(__file__).resolve().parent.parent / "tests" / "data" / "logs"
SAMPLES = 12
START = 1_700_000_000_123_456_789

# Whole parts of 1/64: the same number in single precision.
t = [k / 64 for k in range(SAMPLES)]
q = [[round(64 * math.sin(0.5 * k + j)) / 64 for k in range(SAMPLES)] for j in range(2)]
tau = [[round(64 * math.cos(0.3 * k - j)) / 32 for k in range(SAMPLES)] for j in range(2)]
command = [[x + 1 / 64 for x in row] for row in q]

CONTROLLER = """
std_msgs/Header header
string[] joint_names
trajectory_msgs/JointTrajectoryPoint reference
trajectory_msgs/JointTrajectoryPoint feedback
trajectory_msgs/JointTrajectoryPoint error
trajectory_msgs/JointTrajectoryPoint output
"""


def expected():
    lines = ["t,q1,q2,tau1,tau2,q_cmd1,q_cmd2"]
    for k in range(SAMPLES):
        row = [t[k], q[0][k], q[1][k], tau[0][k], tau[1][k], command[0][k], command[1][k]]
        lines.append(",".join(repr(x) for x in row))
    (OUT / "expected.csv").write_text("\n".join(lines) + "\n")


def own_parquet():
    """Columns of ours; a number is missing in the row behind the last, and its run has no name of its own."""
    columns = {
        "t[ms]": [1000 * x for x in t] + [1000.0],
        "q1": q[0] + [0.0],
        "q2[mrad]": [1000 * x for x in q[1]] + [None],
        "tau": [list(pair) for pair in zip(*tau)] + [[0.0, 0.0]],
        "run": ["first"] * (SAMPLES + 1),
        "note": ["x"] * (SAMPLES + 1),
    }
    table = pyarrow.table(columns).replace_schema_metadata({"torque_side": "link"})
    parquet.write_table(table, OUT / "own.parquet", compression="zstd", row_group_size=5)


def lerobot_parquet():
    """Two episodes; lists of a fixed length, single precision."""
    half = SAMPLES // 2

    def vectors(rows):
        flat = pyarrow.array(numpy.array(rows).T.ravel(), pyarrow.float32())
        return pyarrow.FixedSizeListArray.from_arrays(flat, 2)

    columns = {
        "observation.state": vectors(q),
        "action": vectors(command),
        "timestamp": pyarrow.array([t[k % half] for k in range(SAMPLES)], pyarrow.float32()),
        "frame_index": pyarrow.array([k % half for k in range(SAMPLES)], pyarrow.int64()),
        "episode_index": pyarrow.array([k // half for k in range(SAMPLES)], pyarrow.int64()),
    }
    parquet.write_table(pyarrow.table(columns), OUT / "lerobot.parquet", compression="snappy")


def ros2(plugin, name):
    """/joint_states, in which a gripper speaks too and the arm does not tell velocities; and its controller."""
    store = get_typestore(Stores.ROS2_HUMBLE)
    kind = "control_msgs/msg/JointTrajectoryControllerState"
    store.register(get_types_from_msg(CONTROLLER, kind))
    make = store.types
    folder = OUT / "bag"
    shutil.rmtree(folder, ignore_errors=True)

    def header(k):
        stamp = START + round(1e9 * t[k])
        time = make["builtin_interfaces/msg/Time"](sec=stamp // 10**9, nanosec=stamp % 10**9)
        return make["std_msgs/msg/Header"](stamp=time, frame_id="base_link")

    def numbers(*values):
        return numpy.array(values, dtype=numpy.float64)

    def point(values):
        last = make["builtin_interfaces/msg/Duration"](sec=0, nanosec=0)
        return make["trajectory_msgs/msg/JointTrajectoryPoint"](
            positions=values, velocities=numbers(), accelerations=numbers(), effort=numbers(), time_from_start=last
        )

    with Ros2Writer(folder, version=9, storage_plugin=plugin) as bag:
        states = bag.add_connection("/joint_states", "sensor_msgs/msg/JointState", typestore=store)
        control = bag.add_connection("/arm/controller_state", kind, typestore=store)
        state = make["sensor_msgs/msg/JointState"]
        for k in range(SAMPLES):
            # Later than the stamp, and unevenly: what counts is the stamp.
            arrival = START + round(1e9 * t[k]) + 1_000_000 * (1 + k % 3)
            arm = state(
                header=header(k), name=["elbow", "shoulder"], position=numbers(q[1][k], q[0][k]),
                velocity=numbers(), effort=numbers(tau[1][k], tau[0][k]),
            )
            gripper = state(
                header=header(k), name=["finger"], position=numbers(0.01), velocity=numbers(0.0), effort=numbers(0.0)
            )
            follows = make[kind](
                header=header(k), joint_names=["elbow", "shoulder"], reference=point(numbers(command[1][k], command[0][k])),
                feedback=point(numbers(q[1][k], q[0][k])), error=point(numbers()), output=point(numbers()),
            )
            bag.write(states, arrival, store.serialize_cdr(gripper, gripper.__msgtype__))
            bag.write(states, arrival, store.serialize_cdr(arm, arm.__msgtype__))
            bag.write(control, arrival, store.serialize_cdr(follows, kind))
    stored = next(path for path in folder.iterdir() if path.suffix in (".mcap", ".db3"))
    stored.replace(OUT / name)
    shutil.rmtree(folder)


def ros1(name):
    """Messages of ROS 1, compressed by LZ4; every number is told."""
    store = get_typestore(Stores.ROS1_NOETIC)
    make, kind = store.types, "sensor_msgs/msg/JointState"
    with open(OUT / name, "wb") as file:
        writer = McapWriter(file, compression=CompressionType.LZ4)
        writer.start(profile="ros1")
        schema = writer.register_schema(name="sensor_msgs/JointState", encoding="ros1msg", data=b"")
        channel = writer.register_channel(topic="joint_states", message_encoding="ros1", schema_id=schema)
        for k in range(SAMPLES):
            stamp = START + round(1e9 * t[k])
            time = make["builtin_interfaces/msg/Time"](sec=stamp // 10**9, nanosec=stamp % 10**9)
            message = make[kind](
                header=make["std_msgs/msg/Header"](seq=k, stamp=time, frame_id=""),
                name=["elbow", "shoulder"],
                position=numpy.array([q[1][k], q[0][k]]),
                velocity=numpy.array([0.0, 0.0]),
                effort=numpy.array([tau[1][k], tau[0][k]]),
            )
            data = bytes(store.serialize_ros1(message, kind))
            writer.add_message(channel_id=channel, log_time=stamp, publish_time=stamp, data=data)
        writer.finish()


if __name__ == "__main__":
    OUT.mkdir(parents=True, exist_ok=True)
    expected()
    own_parquet()
    lerobot_parquet()
    ros2(StoragePlugin.MCAP, "ros2.mcap")
    ros2(StoragePlugin.SQLITE3, "ros2.db3")
    ros1("ros1.mcap")

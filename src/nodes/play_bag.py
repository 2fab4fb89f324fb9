#!/usr/bin/env python3
"""Plays the tool's poses and tf from a bag. Of a bag without poses it says what is missing, and ends; a launch that
requires it ends too. After the bag's end it stays, and so does the launch. The bag's other topics are left out, as
`rosbag play --wait-for-subscribers` would wait for someone to listen to each of them.
Usage: play_bag.py BAG POSE_TOPIC [OPTION of rosbag play]..."""

import os
import signal
import sys

import rosbag
import rospy

INPUTS = {  # by node.pose_input: the topic, if not that of the poses, and its types
    "pose": (None, ["geometry_msgs/PoseStamped"]),
    "transform": (None, ["geometry_msgs/TransformStamped"]),
    "tf": ("/tf", ["tf2_msgs/TFMessage", "tf/tfMessage"]),
}


def topics_of(path):
    """Names under which a bag's topics are played: their names in the bag, and types."""
    with rosbag.Bag(path) as bag:
        return {rospy.resolve_name(name): (name, info.msg_type)
                for name, info in bag.get_type_and_topic_info().topics.items()}


def read_topics(path):
    try:
        return topics_of(path)
    except OSError as error:
        fail(path, f"cannot be read: {error.strerror}")
    except rosbag.ROSBagUnindexedException:
        fail(path, "truncated or unindexed: must be whole; `rosbag reindex` mends it")
    except rosbag.ROSBagException as error:
        fail(path, f"is no bag: must be one of rosbag's format 2.0 ({error})")


def fail(path, complaint):
    sys.exit(f"play_bag: {path}: {complaint}")


def check(path, topics, pose_topic):
    """The topic that holds the tool's poses."""
    pose_input = str(rospy.get_param("cutting_node/node/pose_input", "pose"))
    if pose_input not in INPUTS:
        return pose_topic  # the node refuses it
    topic, types = INPUTS[pose_input]
    topic = rospy.resolve_name(topic or pose_topic)
    if topic not in topics:
        held = ", ".join(sorted(topics)) or "none"
        fail(path, f"no topic {topic}: must hold the tool's poses (node.pose_input: {pose_input}); it has {held}")
    if topics[topic][1] not in types:
        fail(path, f"topic {topic} is {topics[topic][1]}: must be {types[0]} (node.pose_input: {pose_input})")
    return topic


def main(path, pose_topic, *options):
    path = os.path.abspath(path)
    topics = read_topics(path)
    inputs = {check(path, topics, pose_topic), "/tf", "/tf_static"}
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    played = sorted(topics[topic][0] for topic in inputs if topic in topics)
    # rosrun and not the program rosbag, which does not hand on the node's name. In this process' place, so that signals
    # reach it; it stays, or its last messages might be lost.
    os.execvp("rosrun", ["rosrun", "rosbag", "play", path, *options, "--keep-alive", "--topics", *played])


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])

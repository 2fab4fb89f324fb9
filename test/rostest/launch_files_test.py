#!/usr/bin/env python3
"""The launch files: those that are given no poses end by themselves and say why, and others go on."""

import os
import signal
import subprocess
import tempfile
import unittest

import rosbag
import rospy
import rostest
from cfem_cutting.msg import StepReport
from geometry_msgs.msg import PointStamped

from node_test import BOX, PATIENCE, SLICE, wait_until


class LaunchFilesTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name

    def launch(self, file, *arguments, config=BOX):
        launch = subprocess.Popen(["roslaunch", "cfem_cutting", file, "rviz:=false", "config:=" + config, *arguments],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True,
                                  cwd=self.folder, env=dict(os.environ, PWD=self.folder))
        self.addCleanup(self.end, launch)
        return launch

    def end(self, launch):
        """With its nodes."""
        launch.send_signal(signal.SIGINT)
        launch.communicate(timeout=PATIENCE)

    def check_end(self, words, file, *arguments):
        """The launch ends, and one line says all the words."""
        output, _ = self.launch(file, *arguments).communicate(timeout=PATIENCE)
        lines = [line for line in output.splitlines() if all(word in line for word in words)]
        self.assertEqual(len(lines), 1, output)

    def write(self, name, text):
        path = os.path.join(self.folder, name)
        with open(path, "w") as file:
            file.write(text)
        return path

    def test_bag_that_is_not_there(self):
        for name in ("none.bag", self.folder + "/none.bag"):
            self.check_end([self.folder + "/none.bag", "No such file"], "playback.launch", "bag:=" + name)

    def test_file_that_is_no_bag(self):
        self.check_end(["no.bag", "is no bag"], "playback.launch", "bag:=" + self.write("no.bag", "no bag\n" * 100))

    def test_bag_without_the_topic(self):
        self.check_end([SLICE, "no topic /elsewhere", "/tool/measured_cp"], "playback.launch", "bag:=" + SLICE,
                       "pose_topic:=/elsewhere")

    def test_bag_of_another_type(self):
        path = os.path.join(self.folder, "points.bag")
        with rosbag.Bag(path, "w") as bag:
            bag.write("tool/measured_cp", PointStamped(), rospy.Time(1))
        self.check_end([path, "PointStamped", "must be geometry_msgs/PoseStamped"], "playback.launch", "bag:=" + path)

    def test_path_that_is_not_there(self):
        self.check_end([self.folder + "/none.yaml", "cannot be read"], "path.launch", "path:=none.yaml")

    def test_names_that_begin_at_home(self):
        home = os.path.expanduser("~")
        self.check_end([home + "/no/none.bag", "No such file"], "playback.launch", "bag:=~/no/none.bag")
        self.check_end([home + "/no/none.yaml", "cannot be read"], "path.launch", "path:=~/no/none.yaml")

    def test_names_with_spaces_and_addresses(self):
        self.check_end([self.folder + "/a b.bag", "No such file"], "playback.launch", "bag:=a b.bag")
        self.check_end(["/config/paths/none.yaml", "cannot be read"], "path.launch",
                       "path:=package://cfem_cutting/config/paths/none.yaml")

    def test_place_of_the_tissue_that_is_none(self):
        self.check_end(["right number of arguments"], "cutting.launch", "world_to_tissue:=1 2 3")

    def bag_with_more(self):
        """The slice, and a topic that nobody listens to."""
        path = os.path.join(self.folder, "more.bag")
        with rosbag.Bag(SLICE) as bag, rosbag.Bag(path, "w") as more:
            for topic, message, time in bag.read_messages():
                more.write(topic, message, time)
            more.write("/elsewhere", PointStamped(), time)
        return path

    def test_launch_outlives_bag_and_path(self):
        path = self.write("short.yaml", "tool: {frame: scalpel, waypoints: [{t: 0, xyz: [0, 0, 0.1]}, "
                                        "{t: 1, xyz: [0.1, 0, 0.1]}]}\n")
        playback = ("playback.launch", "bag:=" + self.bag_with_more(), "rate:=10")
        for arguments in (playback, ("path.launch", "path:=" + path)):
            steps = []
            subscriber = rospy.Subscriber("step_report", StepReport, steps.append)
            launch = self.launch(*arguments)
            wait_until(lambda: len(steps) > 50, "it steps")
            wait_until(lambda: self.have_stopped(steps), "the steps stop")
            self.assertIsNone(launch.poll(), arguments)
            self.end(launch)
            subscriber.unregister()

    def have_stopped(self, steps):
        before = len(steps)
        rospy.sleep(2.0)
        return len(steps) == before

    def test_tool_frame_is_followed_beside_a_topic_of_poses_that_nobody_needs(self):
        with open(BOX) as file:
            config = self.write("tf.yaml", file.read().replace("node:\n", "node:\n  pose_input: tf\n  tool_frame: scalpel\n"))
        steps = []
        subscriber = rospy.Subscriber("step_report", StepReport, steps.append)
        launch = self.launch("playback.launch", "bag:=" + SLICE, "rate:=10", config=config)
        wait_until(lambda: len(steps) > 50, "it steps")
        self.end(launch)
        subscriber.unregister()


if __name__ == "__main__":
    rospy.init_node("launch_files_test")
    rostest.rosrun("cfem_cutting", "launch_files", LaunchFilesTest)

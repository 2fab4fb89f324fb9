#!/usr/bin/env python3
"""The node's end: within two seconds of SIGINT, and with a zero wrench; bad parameters stop it at once."""

import os
import signal
import subprocess
import time
import unittest

import rospy
import rostest
from geometry_msgs.msg import PoseStamped, WrenchStamped

from node_test import BOX, PATIENCE, force, is_zero, make_pose, slice_poses, wait_until

NODE = subprocess.run(["catkin_find", "--first-only", "--libexec", "cfem_cutting", "cutting_node"],
                      stdout=subprocess.PIPE, universal_newlines=True).stdout.strip()


class ShutdownTest(unittest.TestCase):
    def start(self, name, *options):
        subprocess.run(["rosparam", "load", BOX, "/" + name], check=True)
        return subprocess.Popen([NODE, "__name:=" + name, *options], stderr=subprocess.PIPE, universal_newlines=True)

    def test_signals(self):
        for number in (signal.SIGINT, signal.SIGTERM):
            self.check_signal(number)

    def check_signal(self, number):
        wrenches = []
        subscriber = rospy.Subscriber("tool/body/measured_cf", WrenchStamped, wrenches.append)
        poses = rospy.Publisher("tool/measured_cp", PoseStamped, queue_size=100000)
        node = self.start("stopped_%d" % number)
        wait_until(lambda: poses.get_num_connections() and subscriber.get_num_connections(), "the node is there")
        for stamp, xyz in slice_poses(1000.0, seconds=60.0, rate=100.0):  # more than it can do until it is stopped
            poses.publish(make_pose(stamp, xyz))
        wait_until(lambda: any(force(w) > 0.01 for w in wrenches), "it is cutting")
        node.send_signal(number)
        start = time.monotonic()
        self.assertEqual(node.wait(PATIENCE), 0)
        self.assertLess(time.monotonic() - start, 2.0)
        wait_until(lambda: is_zero(wrenches[-1]), "the last wrench is zero", 5)
        subscriber.unregister()
        poses.unregister()

    def test_bad_parameter(self):
        rospy.set_param("/bad/tissue/voxel_sise", 0.004)
        node = self.start("bad")
        _, errors = node.communicate(timeout=PATIENCE)
        self.assertEqual(node.returncode, 2)
        complaint = [line for line in errors.splitlines() if "voxel_sise" in line]
        self.assertEqual(len(complaint), 1, errors)

    def test_replay_without_master(self):
        environment = dict(os.environ, ROS_MASTER_URI="http://127.0.0.1:9")
        done = subprocess.run(["rosrun", "cfem_cutting", "replay", "--help"], env=environment, stdout=subprocess.PIPE,
                              universal_newlines=True, timeout=PATIENCE)
        self.assertEqual(done.returncode, 0)
        self.assertIn("--config", done.stdout)


if __name__ == "__main__":
    rospy.init_node("shutdown_test")
    rostest.rosrun("cfem_cutting", "shutdown", ShutdownTest)

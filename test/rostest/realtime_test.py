#!/usr/bin/env python3
"""In real time a node that is held up sweeps through all poses, so it severs what a node that keeps up severs."""

import os
import signal
import threading
import time
import xmlrpc.client

import rosgraph
import rosnode
import rospy
import rostest

from node_test import NodeTest, is_zero, make_pose, slice_poses, wait_until

MAX_LAG = 0.1  # s, node.max_lag


class RealtimeTest(NodeTest):
    def play_in_real_time(self, first, pid=None):
        """Sends a slice; holds the process up again and again, half of the time."""
        stop = threading.Event()

        def hold_up():
            while not stop.is_set():
                os.kill(pid, signal.SIGSTOP)
                time.sleep(0.3)
                os.kill(pid, signal.SIGCONT)
                time.sleep(0.3)

        thread = threading.Thread(target=hold_up)
        if pid:
            thread.start()
        start = time.monotonic()
        for stamp, xyz in slice_poses(first, seconds=4.0):
            time.sleep(max(0.0, start + stamp - first - time.monotonic()))
            self.poses.publish(make_pose(stamp, xyz))
        stop.set()
        if pid:
            thread.join()
        self.wait_for_step(stamp)
        wait_until(lambda: is_zero(self.wrenches[-1]), "the blade is let go of")
        return self.steps[-1]

    def test_held_up(self):
        uri = rosnode.get_api_uri(rosgraph.Master("/realtime_test"), "/cutting_node")
        pid = xmlrpc.client.ServerProxy(uri).getPid("/realtime_test")[2]
        fast = self.play_in_real_time(1000.0)
        self.assertGreater(fast.links_severed, 0)
        self.call("reset")
        del self.steps[:]
        slow = self.play_in_real_time(2000.0, pid)
        self.assertGreater(slow.skipped, 0.0)
        self.assertEqual(slow.links_severed, fast.links_severed)
        caught_up = [step for step in self.steps if step.lag <= MAX_LAG]
        self.assertGreater(len(caught_up), len(self.steps) / 2)

    def test_blade_is_held_until_timeout(self):
        poses = list(slice_poses(3000.0, seconds=1.0))
        start = time.monotonic()
        for stamp, xyz in poses:
            time.sleep(max(0.0, start + stamp - 3000.0 - time.monotonic()))
            self.poses.publish(make_pose(stamp, xyz))
        wait_until(lambda: self.steps[-1].header.stamp.to_sec() > stamp + 0.02, "steps go on with the blade held")
        wait_until(lambda: is_zero(self.wrenches[-1]), "the input is stale")

    def test_silence_is_not_slowness(self):
        for first in (4000.0, 4010.0):
            start = time.monotonic()
            for stamp, xyz in slice_poses(first, seconds=0.5):
                time.sleep(max(0.0, start + stamp - first - time.monotonic()))
                self.poses.publish(make_pose(stamp, xyz))
            self.wait_for_step(stamp)
            time.sleep(1.0)  # longer than the input's timeout
            skipped = self.steps[-1].skipped - self.steps[0].skipped
            self.assertLess(skipped, 5.0)


if __name__ == "__main__":
    rospy.init_node("realtime_test")
    rostest.rosrun("cfem_cutting", "realtime", RealtimeTest)

#!/usr/bin/env python3
"""Poses that are no use are counted and left out, and the cut goes on."""

import subprocess
import time

import rospy
import rostest
from rosgraph_msgs.msg import Log

from node_test import NodeTest, force, is_zero, make_pose, slice_poses, wait_until

NAN = float("nan")


class BadPosesTest(NodeTest):
    def test_bad_poses_change_nothing(self):
        last = self.send_slice(1000.0)
        self.wait_for_step(last)
        expected = [(e.unit, e.links_severed) for e in self.all_events()]
        self.assertTrue(expected)
        self.call("reset")
        wait_until(lambda: self.count("received") > 0, "diagnostics come")
        before = dict(self.diagnostics["tool input"])

        bad = 0
        for i, (stamp, xyz) in enumerate(slice_poses(2000.0)):
            self.poses.publish(make_pose(stamp, xyz))
            if i % 10 == 5:
                bad += 1
                self.poses.publish(make_pose(stamp + 0.001, (NAN, 0, 0)))
                self.poses.publish(make_pose(stamp + 0.001, (0, 0, 1e9)))
                self.poses.publish(make_pose(stamp + 0.001, xyz, (0, 0, 0, 0)))
                self.poses.publish(make_pose(stamp + 0.001, xyz, (0, 0, 0, NAN)))
                self.poses.publish(make_pose(stamp + 0.001, xyz, (1, 1, 1, 1)))
                self.poses.publish(make_pose(0, xyz))
                self.poses.publish(make_pose(stamp - 0.5, (0.09, 0.09, 0.0)))
                self.poses.publish(make_pose(stamp, (0.09, 0.09, 0.0)))
                self.poses.publish(make_pose(stamp + 0.001, xyz, frame="nowhere"))
        self.wait_for_step(stamp)
        self.assertEqual([(e.unit, e.links_severed) for e in self.all_events()], expected)
        for key, count in (("invalid", 5), ("no_stamp", 1), ("out_of_order", 2), ("no_transform", 1)):
            wanted = int(before[key]) + count * bad
            wait_until(lambda: self.count(key) == wanted, "%s is %d, not %d" % (key, wanted, self.count(key)), 20)

    def test_console_names_topic_value_and_rule(self):
        lines = []
        subscriber = rospy.Subscriber("/rosout", Log, lambda log: lines.append(log.msg))
        bad = (((NAN, 0, 0), (0, 0, 0, 1), ["/tool/measured_cp", "[nan, 0, 0]", "must be finite"]),
               ((0, 0, 0), (0, 0, 0, 2), ["/tool/measured_cp", "[0, 0, 0, 2]", "must be of length 1"]))
        for xyz, quaternion, words in bad:
            end = time.monotonic() + 30
            while time.monotonic() < end and not any(all(word in line for word in words) for line in lines):
                self.poses.publish(make_pose(7000, xyz, quaternion))
                time.sleep(0.1)
            self.assertLess(time.monotonic(), end, (words, lines))
        subscriber.unregister()

    def test_a_second_publisher_is_told(self):
        lines = []
        subscriber = rospy.Subscriber("/rosout", Log, lambda log: lines.append(log.msg))
        other = subprocess.Popen(["rostopic", "pub", "-r", "1", "/tool/measured_cp", "geometry_msgs/PoseStamped", "{}"],
                                 stdout=subprocess.DEVNULL)
        self.addCleanup(other.wait)
        self.addCleanup(other.terminate)
        wait_until(lambda: any("/tool/measured_cp" in line and "2 publishers" in line for line in lines),
                   "a line names the topic and the publishers", 30)
        subscriber.unregister()

    def jumps(self):
        return int(self.diagnostics.get("simulation", {}).get("jumps", -1))

    def test_jump_cuts_nothing(self):
        wait_until(lambda: self.jumps() >= 0, "diagnostics come")
        for way in (0.03, 0.05):  # step by step the first one is no jump
            before = self.jumps()
            start = 3000 + 1000 * way
            for i in range(20):
                self.poses.publish(make_pose(start + 0.02 * i, (0.03, 0.05, 0.06 if i < 10 else 0.06 - way)))
            self.wait_for_step(start + 0.38)
            self.assertEqual(self.steps[-1].links_severed, 0)
            wait_until(lambda: self.jumps() > before, "the jump is counted", 20)

    def test_blade_is_let_go_of_while_poses_cannot_be_placed(self):
        for i in range(60):
            self.poses.publish(make_pose(6000 + 0.02 * i, (0.03, 0.05, 0.06 - 0.0003 * i)))
        self.wait_for_step(6001.18)
        self.assertGreater(force(self.wrenches[-1]), 0.01)
        end = time.monotonic() + 5
        while time.monotonic() < end and not is_zero(self.wrenches[-1]):
            i += 1
            self.poses.publish(make_pose(6000 + 0.02 * i, (0.03, 0.05, 0.04), frame="nowhere"))
            time.sleep(0.02)
        self.assertTrue(is_zero(self.wrenches[-1]))
        del self.wrenches[:]
        wait_until(lambda: self.wrenches, "a zero wrench comes again for who listens since", 5)

    def test_leading_slash(self):
        for i in range(20):
            self.poses.publish(make_pose(4000 + 0.02 * i, (0.03, 0.05, 0.08), frame="/tissue"))
        self.wait_for_step(4000.38)

    def test_burst_at_ten_kilohertz(self):
        start = time.monotonic()
        for stamp, xyz in slice_poses(5000.0, seconds=2.0, rate=10000.0):
            self.poses.publish(make_pose(stamp, xyz))
        rospy.loginfo("20000 poses in %.1f s", time.monotonic() - start)
        self.wait_for_step(stamp)
        self.assertGreater(self.steps[-1].links_severed, 0)
        self.assertEqual(self.count("thinned"), 0)


if __name__ == "__main__":
    rospy.init_node("bad_poses_test")
    rostest.rosrun("cfem_cutting", "bad_poses", BadPosesTest)

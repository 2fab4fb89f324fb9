#!/usr/bin/env python3
"""Poses that are no use are counted and left out, and the cut goes on."""

import time

import rospy
import rostest

from node_test import NodeTest, make_pose, slice_poses, wait_until

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
                self.poses.publish(make_pose(stamp + 0.001, xyz, (0, 0, 0, 0)))
                self.poses.publish(make_pose(stamp + 0.001, xyz, (0, 0, 0, NAN)))
                self.poses.publish(make_pose(stamp + 0.001, xyz, (1, 1, 1, 1)))
                self.poses.publish(make_pose(0, xyz))
                self.poses.publish(make_pose(stamp - 0.5, (0.09, 0.09, 0.0)))
                self.poses.publish(make_pose(stamp, (0.09, 0.09, 0.0)))
                self.poses.publish(make_pose(stamp + 0.001, xyz, frame="nowhere"))
        self.wait_for_step(stamp)
        self.assertEqual([(e.unit, e.links_severed) for e in self.all_events()], expected)
        for key, count in (("invalid", 4), ("no_stamp", 1), ("out_of_order", 2), ("no_transform", 1)):
            wanted = int(before[key]) + count * bad
            wait_until(lambda: self.count(key) == wanted, "%s is %d, not %d" % (key, wanted, self.count(key)), 20)

    def test_jump_cuts_nothing(self):
        for i in range(20):
            self.poses.publish(make_pose(3000 + 0.02 * i, (0.03, 0.05, 0.08 if i < 10 else 0.03)))
        self.wait_for_step(3000.38)
        self.assertEqual(self.steps[-1].links_severed, 0)

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

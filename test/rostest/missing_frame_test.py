#!/usr/bin/env python3
"""A region that follows a frame that never comes: it stays, and the console says so."""

import time

import rospy
import rostest
from rosgraph_msgs.msg import Log

from node_test import NodeTest, make_pose


class MissingFrameTest(NodeTest):
    def test_console_names_the_frame(self):
        lines = []
        subscriber = rospy.Subscriber("/rosout", Log, lambda log: lines.append(log.msg))
        start = time.monotonic()
        while time.monotonic() < start + 40 and not any("left_grasper" in line for line in lines):
            self.poses.publish(make_pose(1000 + time.monotonic() - start, (0.03, 0.05, 0.08)))
            time.sleep(0.02)
        warnings = [line for line in lines if "left_grasper" in line]
        self.assertEqual(len(warnings), 1, lines)
        self.assertIn("tissue.fixed", warnings[0])
        subscriber.unregister()


if __name__ == "__main__":
    rospy.init_node("missing_frame_test")
    rostest.rosrun("cfem_cutting", "missing_frame", MissingFrameTest)

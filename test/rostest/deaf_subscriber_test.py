#!/usr/bin/env python3
"""A subscriber that never reads does not fill the node's memory."""

import socket
import struct
import xmlrpc.client

import rosgraph
import rosnode
import rospy
import rostest

from node_test import NodeTest, wait_until

TOPICS = {
    "/step_report": "cfem_cutting/StepReport",
    "/tissue/surface": "cfem_cutting/SurfaceMesh",
    "/tissue/markers": "visualization_msgs/MarkerArray",
    "/tool/body/measured_cf": "geometry_msgs/WrenchStamped",
}
ALLOWED = 100e6  # bytes; unbounded queues of surfaces alone would take more


def subscribe_and_never_read(node_uri, topic, kind):
    code, message, (_, host, port) = xmlrpc.client.ServerProxy(node_uri).requestTopic("/deaf", topic, [["TCPROS"]])
    assert code == 1, message
    connection = socket.create_connection((host, port))
    fields = ["callerid=/deaf", "topic=" + topic, "md5sum=*", "type=" + kind]
    header = b"".join(struct.pack("<I", len(f)) + f.encode() for f in fields)
    connection.sendall(struct.pack("<I", len(header)) + header)
    return connection


class DeafSubscriberTest(NodeTest):
    def memory(self):
        with open("/proc/%d/statm" % self.pid) as file:
            return int(file.read().split()[1]) * 4096

    def test_memory_is_bounded(self):
        uri = rosnode.get_api_uri(rosgraph.Master("/deaf"), "/cutting_node")
        self.pid = xmlrpc.client.ServerProxy(uri).getPid("/deaf")[2]
        connections = [subscribe_and_never_read(uri, topic, kind) for topic, kind in TOPICS.items()]
        before = self.memory()
        for round in range(4):
            last = self.send_slice(1000.0 * (round + 1), seconds=20.0)
            wait_until(lambda: self.steps and self.steps[-1].header.stamp.to_sec() > last - 0.1, "the steps are done")
        self.assertLess(self.memory() - before, ALLOWED)
        for connection in connections:
            connection.close()


if __name__ == "__main__":
    rospy.init_node("deaf_subscriber_test")
    rostest.rosrun("cfem_cutting", "deaf_subscriber", DeafSubscriberTest)

#pragma once
/// Reports, surfaces and poses as messages and back. Positions are in the tissue frame unless said otherwise.

#include <geometry_msgs/Pose.h>
#include <geometry_msgs/Transform.h>
#include <geometry_msgs/Wrench.h>
#include <std_msgs/Header.h>

#include <string>

#include "cfem_cutting/ros/messages.h"
#include "cfem_cutting/simulation/reports.h"
#include "cfem_cutting/surface/tissue_surface.h"

namespace cfem_cutting {

/// Header of a message about a step.
/// @param time s since the epoch, as in the stamps of poses; a time before the epoch becomes zero
std_msgs::Header make_header(const std::string& frame, double time);

geometry_msgs::Point to_point(const Vec3& p);
geometry_msgs::Vector3 to_vector(const Vec3& v);
geometry_msgs::Wrench to_wrench(const Wrench& wrench);
geometry_msgs::Transform to_transform(const Pose& pose);

/// Pose of a message, if it is one: finite, not absurdly far away (kFarthestPosition), and with a quaternion
/// of length 1 (to 1 %; it is normalised).
/// @return false if it is none; `pose` is unchanged then
bool to_pose(const geometry_msgs::Pose& message, Pose& pose);
bool to_pose(const geometry_msgs::Transform& message, Pose& pose);

/// Why to_pose refuses a message: value and rule; empty if it does not.
std::string fault_of(const geometry_msgs::Pose& message);
std::string fault_of(const geometry_msgs::Transform& message);

/// Name of a frame without the leading slash of tf's first version.
std::string frame_name(const std::string& frame_id);

FractureEventMessage to_message(const FractureEvent& event, const std::string& frame);
ContactForces to_contact_forces(const StepReport& report, const std::string& frame);

/// @param lag, skipped s
StepReportMessage to_message(const StepReport& report, const std::string& frame, double lag, double skipped);

/// @param scalars one per vertex
SurfaceMesh to_message(const DeformedSurface& surface, const std::vector<double>& scalars,
                       const std_msgs::Header& header);

}  // namespace cfem_cutting

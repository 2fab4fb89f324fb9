#include <urdf_model/model.h>
#include <urdf_parser/urdf_parser.h>

#include "cfem_cutting/blade/blade.h"
#include "cfem_cutting/geometry/errors.h"

namespace cfem_cutting {
namespace {

Pose to_pose(const urdf::Pose& pose) {
  const urdf::Rotation& q = pose.rotation;
  return Eigen::Translation3d(pose.position.x, pose.position.y, pose.position.z) *
         Eigen::Quaterniond(q.w, q.x, q.y, q.z);
}

urdf::LinkConstSharedPtr find_link(const urdf::ModelInterface& model, const std::string& key,
                                   const std::string& name) {
  const urdf::LinkConstSharedPtr link = model.getLink(name);
  if (!link) throw ConfigError(key + ": " + name + ": the URDF '" + model.getName() + "' has no such link");
  return link;
}

/// Pose of a link in the frame of the nearest link towards the root that a joint which isn't fixed carries.
struct Anchored {
  std::string root;
  std::string joint;  // that carries it, empty at the URDF's root
  Pose X_RL = Pose::Identity();
};
Anchored anchor(urdf::LinkConstSharedPtr link) {
  Anchored anchored;
  while (link->parent_joint && link->parent_joint->type == urdf::Joint::FIXED) {
    anchored.X_RL = to_pose(link->parent_joint->parent_to_joint_origin_transform) * anchored.X_RL;
    link = link->getParent();
  }
  anchored.root = link->name;
  if (link->parent_joint) anchored.joint = link->parent_joint->name;
  return anchored;
}

}  // namespace

Polyline edge_from_urdf(const std::string& urdf_xml, const std::string& tool_link,
                        const std::vector<std::string>& edge_links) {
  const urdf::ModelInterfaceSharedPtr model = urdf::parseURDF(urdf_xml);
  if (!model) throw ConfigError("blade.urdf: the document is not a URDF");
  const Anchored tool = anchor(find_link(*model, "blade.tool_link", tool_link));
  Polyline edge;
  for (const std::string& name : edge_links) {
    const Anchored link = anchor(find_link(*model, "blade.edge_links", name));
    if (link.root != tool.root)
      throw ConfigError("blade.edge_links: " + name + ": must be joined to " + tool_link +
                        " by fixed joints, not by '" + (link.joint.empty() ? tool.joint : link.joint) + "'");
    edge.push_back((tool.X_RL.inverse() * link.X_RL).translation());
  }
  return edge;
}

}  // namespace cfem_cutting

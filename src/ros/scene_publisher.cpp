#include "cfem_cutting/ros/scene_publisher.h"

#include <visualization_msgs/MarkerArray.h>

#include "cfem_cutting/ros/conversions.h"
#include "cfem_cutting/ros/markers.h"

namespace cfem_cutting {

ScenePublisher::ScenePublisher(ros::NodeHandle& node, const Config& config)
    : frame_(config.simulation.tissue.frame),
      look_(config.simulation.surface),
      period_(1.0 / config.node.marker_rate) {
  const ros::SubscriberStatusCallback greet = [this](const ros::SingleSubscriberPublisher&) {
    new_listener_ = true;
  };
  markers_ = node.advertise<visualization_msgs::MarkerArray>("tissue/markers", 2, greet);
  surface_ = node.advertise<SurfaceMesh>("tissue/surface", 2, greet);
  thread_ = std::thread([this] { run(); });
}

ScenePublisher::~ScenePublisher() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

bool ScenePublisher::wants(bool changed) {
  changed_ = changed_ || changed;
  const auto now = std::chrono::steady_clock::now();
  if (now - last_ < period_ || (!changed_ && !new_listener_)) return false;
  if (markers_.getNumSubscribers() + surface_.getNumSubscribers() == 0) return false;
  last_ = now;
  new_listener_ = false;
  changed_ = false;
  return true;
}

void ScenePublisher::offer(Scene scene) {
  {
    const std::lock_guard lock(mutex_);
    scene_ = std::move(scene);
  }
  wake_.notify_one();
}

void ScenePublisher::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return stopping_ || scene_; });
    if (stopping_) return;
    const Scene scene = std::move(*scene_);
    scene_.reset();
    lock.unlock();
    publish(scene);
    lock.lock();
  }
}

void ScenePublisher::publish(const Scene& scene) {
  if (markers_.getNumSubscribers() > 0) markers_.publish(to_markers(scene, frame_, look_));
  if (surface_.getNumSubscribers() > 0) {
    surface_.publish(to_message(scene.surface, scene.offsets, make_header(frame_, scene.time)));
  }
}

}  // namespace cfem_cutting

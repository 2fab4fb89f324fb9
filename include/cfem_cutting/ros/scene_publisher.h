#pragma once

#include <ros/node_handle.h>
#include <ros/publisher.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "cfem_cutting/io/config_reader.h"
#include "cfem_cutting/ros/scene.h"

namespace cfem_cutting {

/// Publishes the scene as markers and as a surface, at its own rate and only while someone listens, in a
/// thread of its own: the steps do not wait for it.
class ScenePublisher {
 public:
  ScenePublisher(ros::NodeHandle& node, const Config& config);
  ~ScenePublisher();

  /// Whether a scene is wanted now: someone listens, its turn has come, and it differs from the last one or a
  /// listener is new.
  bool wants(bool changed);

  /// Makes the next scene wanted though no step is taken.
  void wake() { new_listener_ = true; }

  /// Hands a scene over.
  void offer(Scene scene);

 private:
  void run();
  void publish(const Scene& scene);

  std::string frame_;
  SurfaceConfig look_;
  std::chrono::duration<double> period_;
  std::chrono::steady_clock::time_point last_;
  std::atomic<bool> new_listener_{false};
  bool changed_ = true;
  ros::Publisher markers_, surface_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Scene> scene_;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace cfem_cutting

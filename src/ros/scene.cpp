#include "cfem_cutting/ros/scene.h"

namespace cfem_cutting {

Scene take_scene(const Simulation& simulation, const StepReport& last) {
  Scene scene;
  scene.time = last.time;
  scene.surface = simulation.deformed_surface();
  scene.offsets = simulation.offsets(scene.surface);
  scene.front = simulation.front();
  scene.spatial = last.spatial;
  scene.contacts = last.contacts;
  return scene;
}

}  // namespace cfem_cutting

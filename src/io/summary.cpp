#include "cfem_cutting/io/summary.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "cfem_cutting/geometry/self_crossings.h"

namespace cfem_cutting {
namespace {

using Json = nlohmann::ordered_json;

void write_json(const OutputFolder& folder, const std::string& name, const Json& json) {
  std::ofstream file = folder.create(name);
  file << json.dump(2, ' ', false, Json::error_handler_t::replace) << '\n';
  close_checked(file, name);
}

double ratio(double sum, int count) { return count > 0 ? sum / count : 0.0; }

Json surface_figures(const TissueSurface& surface) {
  const TriangleMesh rest = surface.rest();
  const SurfaceQuality quality = assess(rest);
  return {{"vertices", surface.vertices.size()},
          {"triangles", surface.triangles.size()},
          {"closed", quality.defects.closed()},
          {"manifold", quality.defects.manifold()},
          {"volume_m3", quality.volume},
          {"flipped", count_flipped(surface)},
          {"degenerate", quality.degenerate},
          {"needles", quality.needles},
          {"self_intersecting", count_self_crossings(rest)}};
}

Json figures(const Distances& distances) {
  return {{"max_m", distances.largest}, {"mean_m", distances.mean()}, {"samples", distances.count}};
}

/// Crease and cut end together.
Json blade_distance(const FrontFidelity& front) {
  Distances both = front.crease;
  both.add(front.cut_end);
  return {{"max_m", both.largest}, {"mean_m", both.mean()}};
}

Json front_figures(const FrontFidelity& front) {
  return {{"crease", figures(front.crease)},
          {"cut_end", figures(front.cut_end)},
          {"vertices", figures(front.vertices)},
          {"covered", figures(front.covered)},
          {"buried_samples", front.buried}};
}

Json cut_face_figures(const CutFaceDistances& distances) {
  Json json = figures(distances.faces);
  json["held_corners"] = figures(distances.held_corners);
  return json;
}

std::string text_of(const Box& box) {
  char text[160];
  std::snprintf(text, sizeof(text), "[%.3g, %.3g, %.3g] to [%.3g, %.3g, %.3g]", box.min().x(), box.min().y(),
                box.min().z(), box.max().x(), box.max().y(), box.max().z());
  return text;
}

/// The smallest value that this part of the values does not exceed (nearest rank).
double percentile(const std::vector<double>& sorted, double part) {
  if (sorted.empty()) return 0.0;
  const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(sorted.size())));
  return sorted[std::max<std::size_t>(rank, 1) - 1];
}

}  // namespace

void RunStatistics::add(const StepReport& report, const FrontFidelity& fidelity, const Polyline& edge) {
  front.add(fidelity);
  for (const Vec3& point : edge) edge_box.extend(point);
  ++steps;
  fracture_events += static_cast<int>(report.events.size());
  for (const FractureEvent& event : report.events) fracture_work += event.fracture_work;
  cut_area = report.cut_area;
  blade_work = report.blade_work;
  max_iterations = std::max(max_iterations, report.iterations);
  unconverged_steps += !report.converged;
  steps_with_inverted_elements += report.inverted_elements > 0;
  const double force = report.spatial.force.norm();
  peak_force = std::max(peak_force, force);
  if (report.contacts.empty()) return;
  ++steps_in_contact_;
  force_sum_ += force;
}

double RunStatistics::mean_force() const { return ratio(force_sum_, steps_in_contact_); }

std::vector<std::string> run_warnings(const RunStatistics& statistics) {
  std::vector<std::string> warnings;
  if (statistics.unconverged_steps > 0)
    warnings.push_back("the solver did not converge in " + std::to_string(statistics.unconverged_steps) +
                       " of " + std::to_string(statistics.steps) + " steps");
  if (statistics.steps_with_inverted_elements > 0)
    warnings.push_back("elements were flat or inverted in " +
                       std::to_string(statistics.steps_with_inverted_elements) + " of " +
                       std::to_string(statistics.steps) + " steps");
  return warnings;
}

std::vector<std::string> miss_warnings(const RunStatistics& statistics, const TissueSurface& tissue) {
  if (statistics.touched() || statistics.edge_box.isEmpty()) return {};
  Box tissue_box;
  for (const SurfaceVertex& vertex : tissue.vertices) tissue_box.extend(vertex.X);
  return {"the blade's edge touched no tissue: it was within " + text_of(statistics.edge_box) +
          ", the tissue is within " + text_of(tissue_box) + " (m, tissue frame)"};
}

void write_summary(const OutputFolder& folder, const Simulation& simulation, const RunStatistics& statistics,
                   const std::vector<std::string>& warnings) {
  const CompositeMesh& mesh = simulation.model().mesh();
  const VoxelVolume& volume = simulation.volume();
  write_json(folder, "summary.json",
             {{"steps", statistics.steps},
              {"sim_time_s", statistics.steps * simulation.config().dynamics.time_step},
              {"voxels", volume.voxels().size()},
              {"composite_elements", mesh.elements().size()},
              {"dofs", 3 * mesh.node_count()},
              {"links_total", volume.link_count()},
              {"links_severed", volume.severed_count()},
              {"pieces", simulation.pieces().count()},
              {"piece_volumes_m3", simulation.pieces().volumes},
              {"mass_kg", simulation.model().total_mass()},
              {"cut_area_m2", statistics.cut_area},
              {"fracture_events", statistics.fracture_events},
              {"fracture_work_j", statistics.fracture_work},
              {"blade_work_j", statistics.blade_work},
              {"peak_force_n", statistics.peak_force},
              {"mean_force_n", statistics.mean_force()},
              {"max_solver_iterations", statistics.max_iterations},
              {"surface", surface_figures(simulation.surface())},
              {"blade_distance", blade_distance(statistics.front)},
              {"front", front_figures(statistics.front)},
              {"cut_faces", cut_face_figures(simulation.cut_face_distances())},
              {"warnings", warnings}});
}

void write_timing(const OutputFolder& folder, double wall_time, std::vector<double> step_times) {
  std::sort(step_times.begin(), step_times.end());
  const double sum = std::accumulate(step_times.begin(), step_times.end(), 0.0);
  write_json(folder, "timing.json",
             {{"wall_time_s", wall_time},
              {"step_ms",
               {{"mean", ratio(sum, static_cast<int>(step_times.size()))},
                {"p50", percentile(step_times, 0.5)},
                {"p99", percentile(step_times, 0.99)},
                {"max", percentile(step_times, 1.0)}}}});
}

}  // namespace cfem_cutting

#pragma once

#include <string>
#include <vector>

#include "cfem_cutting/io/output_folder.h"
#include "cfem_cutting/simulation/simulation.h"

namespace cfem_cutting {

/// Figures over a run, gathered step by step.
class RunStatistics {
 public:
  /// @param edge m, the blade's, in the tissue frame
  void add(const StepReport& report, const FrontFidelity& fidelity, const Polyline& edge);

  FrontFidelity front;

  int steps = 0;
  int fracture_events = 0;
  double cut_area = 0.0;       ///< m²
  double fracture_work = 0.0;  ///< J
  double blade_work = 0.0;     ///< J
  double peak_force = 0.0;     ///< N
  int max_iterations = 0;
  int unconverged_steps = 0;
  int steps_with_inverted_elements = 0;
  double mean_force() const;  ///< N, over steps in contact
  bool touched() const { return steps_in_contact_ > 0 || fracture_events > 0; }
  Box edge_box;  ///< m, where the blade's edge was, in the tissue frame

 private:
  int steps_in_contact_ = 0;
  double force_sum_ = 0.0;
};

/// What went wrong in a run's steps.
std::vector<std::string> run_warnings(const RunStatistics& statistics);

/// If the blade moved past all tissue, as with a wrong frame or unit.
std::vector<std::string> miss_warnings(const RunStatistics& statistics, const TissueSurface& tissue);

/// Writes summary.json; its surface figures are those of the undeformed surface.
/// @throw FileError
void write_summary(const OutputFolder& folder, const Simulation& simulation, const RunStatistics& statistics,
                   const std::vector<std::string>& warnings);

/// Writes timing.json.
/// @param wall_time s
/// @param step_times ms
/// @throw FileError
void write_timing(const OutputFolder& folder, double wall_time, std::vector<double> step_times);

}  // namespace cfem_cutting

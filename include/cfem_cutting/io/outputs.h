#pragma once

#include <fstream>
#include <string>
#include <vector>

#include "cfem_cutting/io/output_folder.h"
#include "cfem_cutting/simulation/simulation.h"

namespace cfem_cutting {

/// The tables of a run, written as it goes on: steps.csv, events.csv, front.csv, probes.csv.
class RunTables {
 public:
  RunTables(const OutputFolder& folder, std::size_t probes);
  void add(const StepReport& report, const FrontFidelity& front,
           const std::vector<Vec3>& probe_displacements);
  /// @throw FileError
  void close();

 private:
  std::ofstream steps_, events_, front_, probes_;
};

/// timing.csv: milliseconds per step and stage; a stage that a step did without is 0.
class TimingTable {
 public:
  void add(const StepReport& report, double milliseconds);
  /// Whole steps, ms.
  std::vector<double> steps() const;
  /// @throw FileError
  void write(const OutputFolder& folder) const;

 private:
  struct Row {
    double time, total;
    std::vector<double> stages;
  };
  std::vector<std::string> stages_;  // in the order of their first use
  std::vector<Row> rows_;
};

/// links.csv: severed links by lattice index and axis, sorted.
void write_links(const OutputFolder& folder, const VoxelVolume& volume);

/// The surface as it lies now or, undeformed, at rest; closed, with the rim's vertices not doubled.
void write_deformed_surface(const OutputFolder& folder, const std::string& name,
                            const Simulation& simulation);
void write_rest_surface(const OutputFolder& folder, const std::string& name, const Simulation& simulation);

}  // namespace cfem_cutting

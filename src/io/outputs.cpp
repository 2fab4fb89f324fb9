#include "cfem_cutting/io/outputs.h"

#include <algorithm>
#include <array>

#include "csv_row.h"

namespace cfem_cutting {
namespace {

void add_event(std::ostream& stream, const FractureEvent& event) {
  CsvRow(stream) << event.time << event.unit << event.links_severed << event.area << event.largest_offset
                 << event.fracture_work << event.blade_work << event.peak_force << event.centroid
                 << event.normal << event.piece_volumes.size() << int{event.separated};
}

}  // namespace

RunTables::RunTables(const OutputFolder& folder, std::size_t probes)
    : steps_(folder.create("steps.csv")),
      events_(folder.create("events.csv")),
      front_(folder.create("front.csv")),
      probes_(folder.create("probes.csv")) {
  steps_ << "t,phase,unit,max_offset,candidates,links_severed,area,pieces,fx,fy,fz,mx,my,mz,blade_work,"
            "iterations,"
            "residual\n";
  events_ << "t,unit,links_severed,area,largest_offset,fracture_work,blade_work,peak_force,cx,cy,cz,nx,ny,nz,"
             "pieces,"
             "separated\n";
  front_ << "t,crease_max,crease_samples,cut_end_max,cut_end_samples,covered_max,covered_samples,"
            "buried_samples\n";
  CsvRow header(probes_);
  header << std::string("t");
  for (std::size_t p = 0; p < probes; ++p)
    for (const char* axis : {"x", "y", "z"}) header << "u" + std::string(axis) + std::to_string(p);
}

void RunTables::add(const StepReport& report, const FrontFidelity& front,
                    const std::vector<Vec3>& probe_displacements) {
  CsvRow(steps_) << report.time << int{static_cast<std::uint8_t>(report.phase)} << report.unit
                 << report.largest_offset << report.candidates << report.links_severed << report.cut_area
                 << report.pieces << report.body.force << report.body.moment << report.blade_work
                 << report.iterations << report.residual;
  for (const FractureEvent& event : report.events) add_event(events_, event);
  CsvRow row(front_);
  row << report.time;
  for (const Distances* distances : {&front.crease, &front.cut_end, &front.covered})
    row << distances->largest << distances->count;
  row << front.buried;
  CsvRow probes(probes_);
  probes << report.time;
  for (const Vec3& displacement : probe_displacements) probes << displacement;
}

void RunTables::close() {
  close_checked(steps_, "steps.csv");
  close_checked(events_, "events.csv");
  close_checked(front_, "front.csv");
  close_checked(probes_, "probes.csv");
}

void TimingTable::add(const StepReport& report, double milliseconds) {
  Row row{report.time, milliseconds, {}};
  for (const StageTime& stage : report.stages) {
    const auto found = std::find(stages_.begin(), stages_.end(), stage.stage);
    const auto column = static_cast<std::size_t>(found - stages_.begin());
    if (found == stages_.end()) stages_.push_back(stage.stage);
    row.stages.resize(std::max(row.stages.size(), column + 1));
    row.stages[column] += stage.milliseconds;
  }
  rows_.push_back(std::move(row));
}

std::vector<double> TimingTable::steps() const {
  std::vector<double> totals;
  for (const Row& row : rows_) totals.push_back(row.total);
  return totals;
}

void TimingTable::write(const OutputFolder& folder) const {
  std::ofstream file = folder.create("timing.csv");
  {
    CsvRow header(file);
    header << std::string("t") << std::string("total");
    for (const std::string& stage : stages_) header << stage;
  }
  for (const Row& row : rows_) {
    CsvRow line(file);
    line << row.time << row.total;
    for (std::size_t s = 0; s < stages_.size(); ++s) line << (s < row.stages.size() ? row.stages[s] : 0.0);
  }
  close_checked(file, "timing.csv");
}

void write_links(const OutputFolder& folder, const VoxelVolume& volume) {
  std::vector<std::array<int, 4>> links;
  for (const LinkId& link : volume.severed_links()) {
    const Vec3i& index = volume.voxel(link.voxel).index;
    links.push_back({index.x(), index.y(), index.z(), link.axis});
  }
  std::sort(links.begin(), links.end());
  std::ofstream file = folder.create("links.csv");
  file << "i,j,k,axis\n";
  for (const auto& [i, j, k, axis] : links) CsvRow(file) << i << j << k << axis;
  close_checked(file, "links.csv");
}

void write_deformed_surface(const OutputFolder& folder, const std::string& name,
                            const Simulation& simulation) {
  const TissueSurface& surface = simulation.surface();
  DeformedSurface deformed = simulation.deformed_surface();
  deformed.positions.resize(surface.vertices.size());  // the doubles come last
  write_ply(folder.file(name), {deformed.positions, surface.triangles}, surface.cut, surface.label);
}

void write_rest_surface(const OutputFolder& folder, const std::string& name, const Simulation& simulation) {
  const TissueSurface& surface = simulation.surface();
  write_ply(folder.file(name), surface.rest(), surface.cut, surface.label);
}

}  // namespace cfem_cutting

/// Writes specimens as CalculiX input (NAME.inp) together with this library's displacements (NAME.csv).

#include <algorithm>
#include <fstream>
#include <iostream>

#include "two_materials.h"

namespace cfem_cutting {
namespace {

struct Specimen {
  std::string name;
  VoxelVolume volume;
  int level;
  std::vector<Material> materials;
  ElementKind kind;
};

VoxelVolume cut_box() {
  VoxelVolume volume = box_volume({0.12, 0.06, 0.06}, 0.01);
  sever_plane(volume, {0.06, 0.0, 0.0}, Vec3(1.0, 0.3, 0.0).normalized(),
              [](const Vec3& X) { return X.z() > 0.02; });
  return volume;
}

VoxelVolume cut_two_material_box() {
  VoxelVolume volume = two_material_box();
  sever_plane(volume, {0.05, 0.0, 0.0}, Vec3::UnitX(), [](const Vec3& X) { return X.z() > 0.04; });
  return volume;
}

std::vector<Specimen> specimens() {
  std::vector<Specimen> all;
  for (ElementKind kind : {ElementKind::kTrilinear, ElementKind::kIncompatibleModes}) {
    const std::string element = kind == ElementKind::kTrilinear ? "_c3d8" : "_c3d8i";
    all.push_back({"box" + element, box_volume({0.12, 0.06, 0.06}, 0.01), 0, {soft(0.45)}, kind});
    all.push_back({"coarse_box" + element, box_volume({0.12, 0.08, 0.08}, 0.01), 1, {soft(0.3)}, kind});
    all.push_back({"cut_box" + element, cut_box(), 0, {soft(0.45)}, kind});
    all.push_back({"two_materials" + element, two_material_box(), 0, soft_and_stiff(), kind});
    all.push_back({"cut_two_materials" + element, cut_two_material_box(), 0, soft_and_stiff(), kind});
  }
  return all;
}

const Vec3 kGravity(1.0, 2.0, -9.81);
constexpr double kPull = 0.002;  // N, on every node of the end

HeldNodes held_end(const CompositeMesh& mesh) {
  return hold_where(mesh, [](const Vec3& X) { return X.x() < 1e-9; });
}

std::vector<int> pulled_nodes(const CompositeMesh& mesh) {
  const double end = mesh.rest().row(0).maxCoeff() - 1e-9;
  return hold_where(mesh, [&](const Vec3& X) { return X.x() > end; }).nodes;
}

/// A point force on a node: a constraint without stiffness at the corner of one of its elements.
PointConstraint pull(const CompositeMesh& mesh, int node) {
  PointConstraint c;
  for (int e = 0; e < static_cast<int>(mesh.elements().size()); ++e) {
    const auto& nodes = mesh.elements()[e].nodes;
    if (std::find(nodes.begin(), nodes.end(), node) != nodes.end())
      c.at = mesh.embed_in_element(e, mesh.rest().col(node));
  }
  c.direction = Vec3::UnitY();
  c.multiplier = kPull;
  return c;
}

void write_mesh(const Specimen& specimen, const CompositeMesh& mesh, std::ostream& inp) {
  inp << "*NODE, NSET=ALL\n";
  for (int n = 0; n < mesh.node_count(); ++n)
    inp << n + 1 << ", " << mesh.rest()(0, n) << ", " << mesh.rest()(1, n) << ", " << mesh.rest()(2, n)
        << '\n';
  const std::string type = specimen.kind == ElementKind::kTrilinear ? "C3D8" : "C3D8I";
  for (std::size_t m = 0; m < specimen.materials.size(); ++m) {
    inp << "*ELEMENT, TYPE=" << type << ", ELSET=PART" << m << '\n';
    for (std::size_t e = 0; e < mesh.elements().size(); ++e) {
      const CompositeElement& element = mesh.elements()[e];
      const int label = specimen.volume.voxel(element.voxels.front()).label;
      if (match_material(specimen.materials, label) != static_cast<int>(m)) continue;
      inp << e + 1;
      for (int corner : {0, 1, 3, 2, 4, 5, 7, 6}) inp << ", " << element.nodes[corner] + 1;
      inp << '\n';
    }
  }
}

void write_materials(const std::vector<Material>& materials, std::ostream& inp) {
  for (std::size_t m = 0; m < materials.size(); ++m)
    inp << "*MATERIAL, NAME=M" << m << "\n*ELASTIC\n"
        << materials[m].young_modulus << ", " << materials[m].poisson_ratio << "\n*DENSITY\n"
        << materials[m].density << "\n*SOLID SECTION, ELSET=PART" << m << ", MATERIAL=M" << m << '\n';
}

void write_input(const Specimen& specimen, const CompositeMesh& mesh, std::ostream& inp) {
  inp.precision(12);
  write_mesh(specimen, mesh, inp);
  write_materials(specimen.materials, inp);
  inp << "*BOUNDARY\n";
  for (int node : held_end(mesh).nodes) inp << node + 1 << ", 1, 3\n";
  inp << "*STEP\n*STATIC\n*CLOAD\n";
  for (int node : pulled_nodes(mesh)) inp << node + 1 << ", 2, " << kPull << '\n';
  inp << "*DLOAD\n";
  for (std::size_t m = 0; m < specimen.materials.size(); ++m)
    inp << "PART" << m << ", GRAV, " << kGravity.norm() << ", " << kGravity.x() / kGravity.norm() << ", "
        << kGravity.y() / kGravity.norm() << ", " << kGravity.z() / kGravity.norm() << '\n';
  inp << "*NODE PRINT, NSET=ALL\nU\n*END STEP\n";
}

bool write(const Specimen& specimen, const std::string& directory) {
  const ElasticModel model(specimen.volume, specimen.level, specimen.materials, specimen.kind,
                           Kinematics::kLinear);
  const CompositeMesh& mesh = model.mesh();
  std::vector<PointConstraint> load;
  for (int node : pulled_nodes(mesh)) load.push_back(pull(mesh, node));
  NodeField x = mesh.rest();
  Integrator integrator(precise());
  if (!integrator.equilibrate(model, x, kGravity, held_end(mesh), load).converged) return false;

  std::ofstream inp(directory + "/" + specimen.name + ".inp"), csv(directory + "/" + specimen.name + ".csv");
  write_input(specimen, mesh, inp);
  csv.precision(12);
  for (int n = 0; n < mesh.node_count(); ++n)
    csv << n + 1 << ',' << x(0, n) - mesh.rest()(0, n) << ',' << x(1, n) - mesh.rest()(1, n) << ','
        << x(2, n) - mesh.rest()(2, n) << '\n';
  return inp.good() && csv.good();
}

}  // namespace
}  // namespace cfem_cutting

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: " << argv[0] << " DIRECTORY\n";
    return 2;
  }
  for (const cfem_cutting::Specimen& specimen : cfem_cutting::specimens()) {
    if (cfem_cutting::write(specimen, argv[1])) continue;
    std::cerr << specimen.name << ": could not be solved or written to " << argv[1] << '\n';
    return 1;
  }
}

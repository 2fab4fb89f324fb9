#include "rules.h"
#include "schema.h"

namespace cfem_cutting {
namespace {

Fields<Material> material_fields() {
  using M = Material;
  Field<M> label = field<M>(
      "label", "", integer(0, 255), [](M & m) -> auto& { return m.label; },
      "Label of the volume that this material is for.");
  label.doc.default_value = "all labels";
  return {
      label,
      field<M>(
          "young_modulus", "Pa", positive(), [](M & m) -> auto& { return m.young_modulus; }, "Stiffness."),
      field<M>(
          "poisson_ratio", "", below(0, 0.5), [](M & m) -> auto& { return m.poisson_ratio; },
          "Near 0.5: volume is kept."),
      field<M>(
          "density", "kg/m³", positive(), [](M & m) -> auto& { return m.density; }, "Density."),
      checked_only<M>("toughness", "J/m²", positive(),
                      "Kept for the energy and stress criteria; not used by offset."),
      checked_only<M>("tensile_strength", "Pa", positive(),
                      "Kept for the energy and stress criteria; not used by offset."),
  };
}

Fields<GripConfig> grip_fields() {
  using G = GripConfig;
  return {
      required(field<G>(
          "box.min", "m", vector(), [](G & g) -> auto& { return g.box.min(); },
          "Lower corner, tissue frame.")),
      required(field<G>(
          "box.max", "m", vector(), [](G & g) -> auto& { return g.box.max(); },
          "Upper corner, tissue frame.")),
      field<G>(
          "displacement", "m", vector(), [](G & g) -> auto& { return g.displacement; },
          "Where the nodes are moved: retraction, stretching."),
      field<G>(
          "ramp", "s", positive(), [](G & g) -> auto& { return g.ramp; },
          "Time that the displacement takes."),
      field<G>(
          "follow", "", filled_text(), [](G & g) -> auto& { return g.follow; },
          "tf frame that carries the nodes; instead of a displacement."),
  };
}

void check_grip(const Value& value, const GripConfig& grip) {
  const YAML::Node box = value.node["box"];
  if (!box || !box["min"] || !box["max"])
    refuse({value.key + ".box", box}, "{min: [x, y, z], max: [x, y, z]}");
  if (grip.box.isEmpty()) refuse({value.key + ".box", box}, "a box with min <= max");
  if (!grip.follow.empty() && (value.node["displacement"] || value.node["ramp"]))
    refuse(value, "moved by displacement or by follow, not by both");
}

/// One edge for all axes, or three.
Field<TissueConfig> voxel_size_field() {
  const Rule<double> rule = positive();
  const auto read = [rule](const Value& value, TissueConfig& tissue) {
    double edge;
    Vec3 edges;
    if (parse(value.node, edge))
      edges = Vec3::Constant(edge);
    else if (!parse(value.node, edges))
      edges.setZero();
    if ((edges.array() <= 0).any()) refuse(value, "a number > 0 or three of them");
    tissue.voxel_size = edges;
  };
  return {{"voxel_size", format(TissueConfig{}.voxel_size.x()), "m", "a number > 0 or three of them",
           "Edges of the voxels."},
          read,
          {}};
}

const Rule<std::vector<Material>> kMaterials{"a list of mappings, not empty",
                                             [](const std::vector<Material>& m) { return !m.empty(); }};
const Rule<std::vector<GripConfig>> kGrips{"a list of mappings",
                                           [](const std::vector<GripConfig>&) { return true; }};

}  // namespace

Fields<TissueConfig> tissue_fields() {
  using T = TissueConfig;
  return {
      field<T>(
          "frame", "", filled_text(), [](T & t) -> auto& { return t.frame; },
          "tf frame of the tissue's rest shape."),
      field<T>(
          "source", "", filled_text(), [](T & t) -> auto& { return t.source; },
          "`box`, a closed mesh (.stl, .obj, .ply, .off) or a label volume (.inr, .inr.gz, .nrrd, .nii, "
          ".nii.gz, .mha, .mhd): package://, file:// or a path."),
      field<T>(
          "box_size", "m", positive_vector(), [](T & t) -> auto& { return t.box_size; },
          "For the source box, whose lower corner is the tissue frame's origin."),
      field<T>(
          "scale", "m", positive(), [](T & t) -> auto& { return t.scale; },
          "Metres per unit of a mesh; volumes carry their own, in mm."),
      field<T>(
          "xyz", "m", vector(), [](T & t) -> auto& { return t.xyz; },
          "Place of the source in the tissue frame."),
      field<T>(
          "rpy", "rad", vector(), [](T & t) -> auto& { return t.rpy; },
          "Turn of the source about the fixed axes x, y, z, as in URDF."),
      field<T>(
          "labels", "", some_labels(), [](T & t) -> auto& { return t.labels; },
          "Label volumes: which labels are tissue."),
      voxel_size_field(),
      field<T>(
          "composite_level", "", integer(0, 4), [](T & t) -> auto& { return t.composite_level; },
          "A composite element has 2^level voxels along an edge."),
      field<T>(
          "gravity", "m/s²", vector(), [](T & t) -> auto& { return t.gravity; },
          "Gravity in the tissue frame."),
      list<T>(
          "materials", material_fields(), "one of the defaults below", kMaterials,
          [](T & t) -> auto& { return t.materials; }, [](const Value&, const Material&) {},
          "The first that matches a voxel's label is used."),
      list<T>(
          "fixed", grip_fields(), "[]", kGrips, [](T & t) -> auto& { return t.fixed; }, check_grip,
          "Regions whose nodes are held."),
  };
}

}  // namespace cfem_cutting

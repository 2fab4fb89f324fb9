#include "schema.h"

#include "rules.h"

namespace cfem_cutting {
namespace {

/// Energy and stress are names of criteria that are still to come: refused, not ignored.
Field<FractureOptions> criterion_field() {
  const auto read = [](const Value& value, FractureOptions&) {
    std::string word;
    if (!parse(value.node, word) || (word != "offset" && word != "energy" && word != "stress"))
      refuse(value, "offset");
    if (word != "offset") throw ConfigError(value.key + ": " + word + ": only offset is implemented");
  };
  return {{"criterion", "offset", "", "offset", "What decides on fracture; energy and stress are to come."},
          read,
          {}};
}

const Rule<Polyline> kEdge{"a list of at least two points [x, y, z], no two in a row equal, or [] for none",
                           [](const Polyline& edge) {
                             for (std::size_t i = 1; i < edge.size(); ++i)
                               if (edge[i] == edge[i - 1]) return false;
                             return edge.size() != 1;
                           }};
const Rule<std::vector<std::string>> kEdgeLinks{
    "a list of at least two names, or [] for none",
    [](const std::vector<std::string>& links) { return links.size() != 1; }};
const Rule<std::vector<Vec3>> kPoints{"a list of points [x, y, z]",
                                      [](const std::vector<Vec3>&) { return true; }};

}  // namespace

Fields<BladeConfig> blade_fields() {
  using B = BladeConfig;
  return {
      field<B>(
          "edge", "m", kEdge, [](B & b) -> auto& { return b.edge; },
          "Cutting edge in the tool frame, heel to tip. Exactly one of edge and edge_links is given."),
      field<B>(
          "edge_links", "", kEdgeLinks, [](B & b) -> auto& { return b.edge_links; },
          "Cutting edge as frames of the URDF, heel to tip, joined to tool_link by fixed joints."),
      field<B>(
          "urdf", "", text(), [](B & b) -> auto& { return b.urdf; },
          "URDF of the tool: package://, file:// or a path; empty: the parameter robot_description."),
      field<B>(
          "back", "", direction(), [](B & b) -> auto& { return b.back; },
          "From the edge to the spine, tool frame: which way the blade cannot cut."),
      field<B>(
          "friction", "", not_negative(), [](B & b) -> auto& { return b.friction; },
          "Coulomb coefficient along the edge."),
      field<B>(
          "tool_link", "", filled_text(), [](B & b) -> auto& { return b.tool_link; },
          "Link whose pose comes in."),
      field<B>(
          "max_travel", "m", positive(), [](B & b) -> auto& { return b.max_travel; },
          "A blade that goes farther in one pose cuts nothing on the way."),
  };
}

Fields<FractureOptions> fracture_fields() {
  using F = FractureOptions;
  return {
      choice<F>(
          "mode",
          std::vector<std::pair<std::string, FractureMode>>{{"delayed", FractureMode::kDelayed},
                                                            {"immediate", FractureMode::kImmediate}},
          [](F & f) -> auto& { return f.mode; },
          "delayed: tissue deforms before it gives way; immediate: cut as soon as it is touched."),
      criterion_field(),
      field<F>(
          "onset_offset", "m", positive(), [](F & f) -> auto& { return f.onset_offset; },
          "d0: an offset beyond it makes the tissue fracture."),
      field<F>(
          "release_offset", "m", not_negative(), [](F & f) -> auto& { return f.release_offset; },
          "d1 < d0: links whose offset is beyond it are then severed."),
  };
}

Fields<DynamicsConfig> solver_fields() {
  using D = DynamicsConfig;
  using Elements = std::vector<std::pair<std::string, ElementKind>>;
  using KinematicsWords = std::vector<std::pair<std::string, Kinematics>>;
  using Integrations = std::vector<std::pair<std::string, bool>>;
  return {
      choice<D>(
          "element",
          Elements{{"incompatible_modes", ElementKind::kIncompatibleModes},
                   {"trilinear", ElementKind::kTrilinear}},
          [](D & d) -> auto& { return d.element; }, "trilinear is too stiff in bending."),
      choice<D>(
          "kinematics",
          KinematicsWords{{"corotational", Kinematics::kCorotational}, {"linear", Kinematics::kLinear}},
          [](D & d) -> auto& { return d.kinematics; }, "linear is for small rotations only."),
      choice<D>(
          "integration", Integrations{{"implicit_euler", false}, {"quasi_static", true}},
          [](D & d) -> auto& { return d.quasi_static; }, "quasi_static: equilibrium in each step."),
      field<D>(
          "time_step", "s", up_to(0.1), [](D & d) -> auto& { return d.time_step; },
          "Steps fall on multiples of it."),
      field<D>(
          "tolerance", "", between(1e-12, 0.1), [](D & d) -> auto& { return d.solver.tolerance; },
          "Relative residual of a linear solve."),
      field<D>(
          "max_iterations", "", integer(1, 100000), [](D & d) -> auto& { return d.solver.max_iterations; },
          "Of a linear solve."),
      field<D>(
          "rayleigh_mass", "1/s", not_negative(), [](D & d) -> auto& { return d.solver.rayleigh_mass; },
          "Damping in proportion to mass."),
      field<D>(
          "rayleigh_stiffness", "s", not_negative(),
          [](D & d) -> auto& { return d.solver.rayleigh_stiffness; }, "Damping in proportion to stiffness."),
      field<D>(
          "threads", "", integer(0, 1024), [](D & d) -> auto& { return d.solver.threads; },
          "0: as many as there are cores."),
  };
}

Fields<NodeConfig> node_fields() {
  using N = NodeConfig;
  using Inputs = std::vector<std::pair<std::string, PoseInput>>;
  using Timings = std::vector<std::pair<std::string, Timing>>;
  return {
      choice<N>(
          "pose_input",
          Inputs{{"pose", PoseInput::kPose}, {"transform", PoseInput::kTransform}, {"tf", PoseInput::kTf}},
          [](N & n) -> auto& { return n.pose_input; }, "Where the tool's pose comes from."),
      field<N>(
          "tool_frame", "", filled_text(), [](N & n) -> auto& { return n.tool_frame; },
          "The tool's frame for pose_input tf."),
      choice<N>(
          "timing", Timings{{"lossless", Timing::kLossless}, {"realtime", Timing::kRealtime}},
          [](N & n) -> auto& { return n.timing; },
          "lossless: every step, however long it takes; realtime: skips simulated time when it lags."),
      field<N>(
          "max_lag", "s", positive(), [](N & n) -> auto& { return n.max_lag; },
          "realtime: farther behind, one step sweeps through all waiting poses."),
      field<N>(
          "input_timeout", "s", positive(), [](N & n) -> auto& { return n.input_timeout; },
          "Without a pose for so long the node stops stepping and sends zero forces."),
      field<N>(
          "marker_rate", "Hz", positive(), [](N & n) -> auto& { return n.marker_rate; },
          "Of markers and surface."),
      field<N>(
          "output_dir", "", filled_text(), [](N & n) -> auto& { return n.output_dir; },
          "Where saved surfaces go."),
      field<N>(
          "reset_on_loop", "", true_or_false(), [](N & n) -> auto& { return n.reset_on_loop; },
          "When time runs backwards, start with whole tissue."),
  };
}

const Fields<Config>& config_fields() {
  static const Fields<Config> fields = [] {
    Fields<Config> all;
    add_section(
        all, "tissue", tissue_fields(), [](Config & c) -> auto& { return c.simulation.tissue; });
    add_section(
        all, "blade", blade_fields(), [](Config & c) -> auto& { return c.simulation.blade; });
    add_section(
        all, "fracture", fracture_fields(), [](Config & c) -> auto& { return c.simulation.fracture; });
    add_section(
        all, "surface", surface_fields(), [](Config & c) -> auto& { return c.simulation.surface; });
    add_section(
        all, "solver", solver_fields(), [](Config & c) -> auto& { return c.simulation.dynamics; });
    all.push_back(field<Config>(
        "probes", "m", kPoints, [](Config & c) -> auto& { return c.simulation.probes; },
        "Material points whose displacement is reported."));
    add_section(
        all, "node", node_fields(), [](Config & c) -> auto& { return c.node; });
    return all;
  }();
  return fields;
}

const std::vector<KeyDoc>& schema() {
  static const std::vector<KeyDoc> docs = [] {
    std::vector<KeyDoc> all;
    for (const Field<Config>& field : config_fields()) {
      all.push_back(field.doc);
      all.insert(all.end(), field.children.begin(), field.children.end());
    }
    return all;
  }();
  return docs;
}

}  // namespace cfem_cutting

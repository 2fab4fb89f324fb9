#pragma once
/// For each key of the schema a configuration that breaks its rule.

#include <string>
#include <vector>

namespace cfem_cutting {

struct Rejection {
  std::string schema_key;
  std::string yaml;
  std::string message;  ///< how it starts
};

inline const std::vector<Rejection> kTissueRejections{
    {"tissue.frame", "tissue: {frame: ''}", "tissue.frame: "},
    {"tissue.source", "tissue: {source: 5}", "tissue.source: 5: must be a text"},
    {"tissue.box_size", "tissue: {box_size: [0.1, 0, 0.1]}", "tissue.box_size: "},
    {"tissue.scale", "tissue: {scale: 0}", "tissue.scale: 0: must be a number > 0"},
    {"tissue.xyz", "tissue: {xyz: [0, 0]}", "tissue.xyz: "},
    {"tissue.rpy", "tissue: {rpy: [0, 0, a]}", "tissue.rpy: "},
    {"tissue.labels", "tissue: {labels: [256]}", "tissue.labels: "},
    {"tissue.voxel_size", "tissue: {voxel_size: [0.1, 0.1]}", "tissue.voxel_size: "},
    {"tissue.composite_level", "tissue: {composite_level: 5}", "tissue.composite_level: 5: "},
    {"tissue.gravity", "tissue: {gravity: 9.81}", "tissue.gravity: "},
    {"tissue.materials", "tissue: {materials: []}", "tissue.materials: "},
    {"tissue.materials[].label", "tissue: {materials: [{label: 1.5}]}", "tissue.materials[0].label: "},
    {"tissue.materials[].young_modulus", "tissue: {materials: [{young_modulus: -1}]}",
     "tissue.materials[0].young_modulus: -1"},
    {"tissue.materials[].poisson_ratio", "tissue: {materials: [{}, {poisson_ratio: 0.5}]}",
     "tissue.materials[1].poisson_ratio: 0.5: must be a number in [0, 0.5)"},
    {"tissue.materials[].density", "tissue: {materials: [{density: .nan}]}", "tissue.materials[0].density: "},
    {"tissue.materials[].toughness", "tissue: {materials: [{toughness: 0}]}",
     "tissue.materials[0].toughness: "},
    {"tissue.materials[].tensile_strength", "tissue: {materials: [{tensile_strength: x}]}",
     "tissue.materials[0].tensile_strength: "},
    {"tissue.fixed", "tissue: {fixed: {}}", "tissue.fixed: "},
    {"tissue.fixed[].box.min", "tissue: {fixed: [{box: {max: [1, 1, 1]}}]}", "tissue.fixed[0].box: "},
    {"tissue.fixed[].box.max", "tissue: {fixed: [{box: {min: [0, 0, 2], max: [1, 1, 1]}}]}",
     "tissue.fixed[0].box: "},
    {"tissue.fixed[].displacement", "tissue: {fixed: [{displacement: 1}]}", "tissue.fixed[0].displacement: "},
    {"tissue.fixed[].ramp", "tissue: {fixed: [{ramp: 0}]}", "tissue.fixed[0].ramp: 0: "},
    {"tissue.fixed[].follow", "tissue: {fixed: [{follow: []}]}", "tissue.fixed[0].follow: "},
};

inline const std::vector<Rejection> kOtherRejections{
    {"blade.edge", "blade: {edge: [[0, 0, 0]]}", "blade.edge: "},
    {"blade.edge_links", "blade: {edge_links: [heel]}", "blade.edge_links: "},
    {"blade.urdf", "blade: {urdf: 1}", "blade.urdf: "},
    {"blade.back", "blade: {back: [0, 0, 0]}", "blade.back: "},
    {"blade.friction", "blade: {friction: -0.1}", "blade.friction: "},
    {"blade.tool_link", "blade: {tool_link: ''}", "blade.tool_link: "},
    {"blade.max_travel", "blade: {max_travel: 0}", "blade.max_travel: "},
    {"fracture.mode", "fracture: {mode: slow}", "fracture.mode: slow: must be delayed or immediate"},
    {"fracture.criterion", "fracture: {criterion: energy}",
     "fracture.criterion: energy: only offset is implemented"},
    {"fracture.onset_offset", "fracture: {onset_offset: 0}", "fracture.onset_offset: "},
    {"fracture.release_offset", "fracture: {release_offset: 0.003}",
     "fracture.release_offset: 0.003: must be less"},
    {"surface.influence_domain_adaptation", "surface: {influence_domain_adaptation: 2}",
     "surface.influence_domain_adaptation: 2: must be true or false"},
    {"surface.shading", "surface: {shading: phong}", "surface.shading: phong: must be flat or smooth"},
    {"surface.hidden_labels", "surface: {hidden_labels: [1, 256]}", "surface.hidden_labels: "},
    {"surface.label_colours",
     "surface: {label_colours: [{label: 1, colour: [0, 0, 0]}, {label: 1, colour: [1, 1, 1]}]}",
     "surface.label_colours: "},
    {"surface.label_colours[].label", "surface: {label_colours: [{colour: [0, 0, 0]}]}",
     "surface.label_colours[0]: "},
    {"surface.label_colours[].colour", "surface: {label_colours: [{label: 1, colour: [0, 0, 1.5]}]}",
     "surface.label_colours[0].colour: [0, 0, 1.5]: must be three numbers from 0 to 1"},
    {"solver.element", "solver: {element: tet}", "solver.element: "},
    {"solver.kinematics", "solver: {kinematics: x}", "solver.kinematics: "},
    {"solver.integration", "solver: {integration: true}", "solver.integration: "},
    {"solver.time_step", "solver: {time_step: 0.2}", "solver.time_step: 0.2: must be a number in (0, 0.1]"},
    {"solver.tolerance", "solver: {tolerance: 1e-13}", "solver.tolerance: "},
    {"solver.max_iterations", "solver: {max_iterations: 0}", "solver.max_iterations: "},
    {"solver.rayleigh_mass", "solver: {rayleigh_mass: -1}", "solver.rayleigh_mass: "},
    {"solver.rayleigh_stiffness", "solver: {rayleigh_stiffness: -1}", "solver.rayleigh_stiffness: "},
    {"solver.threads", "solver: {threads: -1}", "solver.threads: "},
    {"probes", "probes: [0, 0, 0]", "probes: "},
    {"node.pose_input", "node: {pose_input: joy}", "node.pose_input: "},
    {"node.tool_frame", "node: {tool_frame: ''}", "node.tool_frame: "},
    {"node.timing", "node: {timing: fast}", "node.timing: "},
    {"node.max_lag", "node: {max_lag: 0}", "node.max_lag: "},
    {"node.input_timeout", "node: {input_timeout: 0}", "node.input_timeout: "},
    {"node.marker_rate", "node: {marker_rate: 0}", "node.marker_rate: "},
    {"node.output_dir", "node: {output_dir: ''}", "node.output_dir: "},
    {"node.reset_on_loop", "node: {reset_on_loop: maybe}", "node.reset_on_loop: "},
};

inline std::vector<Rejection> rejections() {
  std::vector<Rejection> all = kTissueRejections;
  all.insert(all.end(), kOtherRejections.begin(), kOtherRejections.end());
  return all;
}

}  // namespace cfem_cutting

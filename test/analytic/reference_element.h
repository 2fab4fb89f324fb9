#pragma once
/// Composite elements by plain summation over integration points, written apart from the library's.

#include "cfem_cutting/elasticity/elastic_model.h"

namespace cfem_cutting {

/// K = Σ_v ∫ BᵀCB over the element's voxels: 2 × 2 × 2 Gauss points in full voxels, the filled samples in
/// others; with Wilson's modes (less their mean strain) condensed out if asked. Without the library's
/// stabilisation of partly filled elements.
ElementMatrix reference_stiffness(const VoxelVolume& volume, const CompositeMesh& mesh, int element,
                                  const std::vector<Material>& materials, ElementKind kind);

/// Whether the element's voxels fill its block.
bool is_whole(const VoxelVolume& volume, const CompositeMesh& mesh, int element);

/// u = G (X − corner) at the element's nodes.
Eigen::Matrix<double, 24, 1> affine_displacement(const CompositeMesh& mesh, int element, const Mat3& G);

}  // namespace cfem_cutting

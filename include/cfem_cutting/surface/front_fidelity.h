#pragma once

#include "cfem_cutting/surface/tissue_surface.h"

namespace cfem_cutting {

/// Distances gathered over samples, m.
struct Distances {
  int count = 0;
  double sum = 0.0;
  double largest = 0.0;
  double mean() const { return count > 0 ? sum / count : 0.0; }
  void add(double distance);
  void add(const Distances& other);
};

/// A part of the edge by arc length from the heel, m.
struct EdgePart {
  double from, to;
};

/// How close the drawn crease and cut end are to the blade's edge. The chain is made of the surface's edges
/// between vertices on the front; it is a cut end where one of them is in a sheet in which a cut ends, else a
/// crease.
///
/// The edge is sampled eight times a voxel. Where the blade holds tissue (between contact points) or a sample
/// lies on the chain, its distance is that to the chain. Other samples inside the drawn surface are covered
/// by tissue that the blade does not hold, such as the sides of its own slot where they lap over each other:
/// the distance is that to the surface. Samples farther than a voxel from all surface, or held in a step
/// without any chain, are in tissue where no link is severed yet, such as a stab narrower than a voxel: there
/// is nothing to draw, and they are counted apart.
struct FrontFidelity {
  Distances crease;    ///< from the edge
  Distances cut_end;   ///< from the edge
  Distances vertices;  ///< from the vertices on the front to the edge
  Distances covered;   ///< from the edge to the surface over it
  int buried = 0;      ///< samples in tissue without surface
  void add(const FrontFidelity& other);
};

/// @param front the blade's edge, m, in the frame of the drawn surface
/// @param held parts of the edge between contact points
/// @param voxel m, edge of a voxel
FrontFidelity measure_front(const TissueSurface& surface, const DeformedSurface& drawn, const Polyline& front,
                            const std::vector<EdgePart>& held, double voxel);

}  // namespace cfem_cutting

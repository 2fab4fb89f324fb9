#include "cfem_cutting/surface/front_fidelity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "nearby_surface.h"

namespace cfem_cutting {
namespace {

constexpr double kSample = 0.125;   // of a voxel, along the edge
constexpr double kOnChain = 0.005;  // of a voxel: nearer is on the chain or on the surface

/// An edge of the surface along the front.
struct ChainEdge {
  Vec3 a, b;
  bool cut_end;
};

std::vector<ChainEdge> find_chain(const TissueSurface& surface, const DeformedSurface& drawn) {
  std::vector<ChainEdge> chain;
  const auto vertex = [&](int v) -> const SurfaceVertex& { return surface.vertices[drawn.source[v]]; };
  for (const auto& triangle : drawn.triangles)
    for (int i = 0; i < 3; ++i) {
      const int a = triangle[i], b = triangle[(i + 1) % 3];
      if (a < b && vertex(a).on_front && vertex(b).on_front)
        chain.push_back({drawn.positions[a], drawn.positions[b], vertex(a).cut_end || vertex(b).cut_end});
    }
  for (std::size_t v = 0; v < surface.vertices.size(); ++v)
    if (surface.vertices[v].on_front)
      chain.push_back({drawn.positions[v], drawn.positions[v], surface.vertices[v].cut_end});
  return chain;
}

double distance_to(const Vec3& p, const ChainEdge& edge) {
  const Vec3 along = edge.b - edge.a;
  const double t = along.isZero(0.0) ? 0.0 : (p - edge.a).dot(along) / along.squaredNorm();
  return (p - edge.a - std::clamp(t, 0.0, 1.0) * along).norm();
}

struct Nearest {
  double distance = std::numeric_limits<double>::infinity();
  bool cut_end = false;
};

Nearest nearest_on(const std::vector<ChainEdge>& chain, const Vec3& p) {
  Nearest nearest;
  for (const ChainEdge& edge : chain) {
    const double distance = distance_to(p, edge);
    if (distance < nearest.distance) nearest = {distance, edge.cut_end};
  }
  return nearest;
}

/// How deep a point lies inside the drawn surface, m: infinity beyond a voxel, 0 outside.
double depth_of(const NearbySurface& nearby, const Vec3& p, double voxel) {
  if (nearby.winding_number(p) <= 0) return 0.0;
  const double depth = nearby.distance(p);
  return depth < voxel ? depth : std::numeric_limits<double>::infinity();
}

bool holds(const std::vector<EdgePart>& parts, double along) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](const EdgePart& part) { return along >= part.from && along <= part.to; });
}

}  // namespace

void Distances::add(double distance) {
  ++count;
  sum += distance;
  largest = std::max(largest, distance);
}

void Distances::add(const Distances& other) {
  count += other.count;
  sum += other.sum;
  largest = std::max(largest, other.largest);
}

void FrontFidelity::add(const FrontFidelity& other) {
  crease.add(other.crease);
  cut_end.add(other.cut_end);
  vertices.add(other.vertices);
  covered.add(other.covered);
  buried += other.buried;
}

FrontFidelity measure_front(const TissueSurface& surface, const DeformedSurface& drawn, const Polyline& front,
                            const std::vector<EdgePart>& held, double voxel) {
  FrontFidelity fidelity;
  const std::vector<ChainEdge> chain = find_chain(surface, drawn);
  for (const ChainEdge& edge : chain)
    if (edge.a == edge.b) fidelity.vertices.add(project(front, edge.a).distance);
  const Polyline samples = refine(front, kSample * voxel);
  Box around;
  for (const Vec3& sample : samples) around.extend(sample);
  const NearbySurface nearby(drawn, around, voxel);
  double along = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (i > 0) along += (samples[i] - samples[i - 1]).norm();
    const Nearest nearest = nearest_on(chain, samples[i]);
    const bool on_chain = nearest.distance <= kOnChain * voxel;
    if (on_chain || (holds(held, along) && !chain.empty())) {
      (nearest.cut_end ? fidelity.cut_end : fidelity.crease).add(nearest.distance);
      continue;
    }
    const double depth = depth_of(nearby, samples[i], voxel);
    if (std::isinf(depth) || holds(held, along)) {
      ++fidelity.buried;
    } else if (depth > kOnChain * voxel) {
      fidelity.covered.add(depth);
    }
  }
  return fidelity;
}

}  // namespace cfem_cutting

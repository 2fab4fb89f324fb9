#pragma once

#include <vector>

#include "cfem_cutting/geometry/types.h"

namespace cfem_cutting {

/// The point of a polyline nearest to a query.
struct PolylineProjection {
  Vec3 point;             ///< m
  Vec3 tangent;           ///< unit, along the polyline
  int segment = 0;        ///< index of the segment's first point
  double t = 0.0;         ///< position in the segment; < 0 or > 1 only beyond the polyline's ends
  double distance = 0.0;  ///< m, from the query to `point`; `point` itself stays on the polyline
};

/// @pre polyline has at least two points, no two consecutive ones equal
PolylineProjection project(const Polyline& polyline, const Vec3& query);

/// Arc lengths from a polyline's first point to each, m.
std::vector<double> arc_lengths(const Polyline& polyline);

/// Arc length from a polyline's first point to a projection on it, m.
double arc_length(const Polyline& polyline, const PolylineProjection& at);

/// The point at a distance along a polyline of one or more points, m; its last point beyond its length.
Vec3 point_along(const Polyline& polyline, double along);

/// Splits each segment evenly so that none is longer than max_length (m); keeps all given points.
Polyline refine(const Polyline& polyline, double max_length);

/// The point of triangle abc, which may be flat, that is nearest to p.
Vec3 nearest_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Distance from a point to triangle abc, m.
double point_triangle_distance(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

}  // namespace cfem_cutting

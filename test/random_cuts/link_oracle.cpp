#include "link_oracle.h"

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <queue>
#include <stdexcept>

namespace cfem_cutting::random_cuts {
namespace {

/// Multiples of 2⁻²⁰⁰ m; throws on overflow.
using Integer = boost::multiprecision::checked_int1024_t;
using ExactPoint = std::array<Integer, 3>;

Integer exact(double metres) {
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(metres, &exponent), 53));
  if (mantissa == 0) return 0;
  const int shift = exponent - 53 + 200;
  if (shift < 0) throw std::range_error("a coordinate is too small for the oracle");
  return Integer(mantissa) * (Integer(1) << shift);
}

/// det[b − a, c − a, d − a].
template <typename Number>
Number determinant(const std::array<std::array<Number, 3>, 4>& points) {
  std::array<std::array<Number, 3>, 3> m;
  for (int row = 0; row < 3; ++row)
    for (int axis = 0; axis < 3; ++axis) m[row][axis] = points[row + 1][axis] - points[0][axis];
  return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
         m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
         m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// A point, which shifts with the lattice or doesn't.
struct Point {
  Vec3 X;
  bool shifts;
};
using Tetrahedron = std::array<Point, 4>;

/// Sign in floating point; 0 if rounding might have turned it.
int sure_sign(const Tetrahedron& t) {
  double largest = 0.0;
  for (const Point& point : t) largest = std::max(largest, (point.X - t[0].X).cwiseAbs().maxCoeff());
  const double volume = (t[1].X - t[0].X).dot((t[2].X - t[0].X).cross(t[3].X - t[0].X));
  const double rounding = 1e-13 * largest * largest * largest;
  return volume > rounding ? 1 : volume < -rounding ? -1 : 0;
}

/// Sign of a tetrahedron's volume. It is linear in the shift where one corner, or both ends of a link, shift:
/// so the first of its value and its slopes along x, y, z that isn't zero decides.
int sign(const Tetrahedron& t) {
  const int sure = sure_sign(t);
  if (sure != 0) return sure;
  std::array<ExactPoint, 4> points;
  for (int i = 0; i < 4; ++i)
    for (int axis = 0; axis < 3; ++axis) points[i][axis] = exact(t[i].X[axis]);
  int result = determinant(points).sign();
  for (int axis = 0; axis < 3 && result == 0; ++axis) {
    std::array<ExactPoint, 4> shifted = points;
    for (int i = 0; i < 4; ++i) shifted[i][axis] += t[i].shifts ? 1 : 0;
    result = determinant(shifted).sign();
  }
  return result;
}

/// Link ab against a triangle by five tetrahedron volumes.
bool meets(const Vec3& a, const Vec3& b, const SweptTriangle& t) {
  const Point p{t.corners[0], false}, q{t.corners[1], false}, r{t.corners[2], false}, from{a, true},
      to{b, true};
  if (sign({p, q, r, from}) == sign({p, q, r, to})) return false;
  const int pq = sign({from, to, p, q});
  return pq != 0 && pq == sign({from, to, q, r}) && pq == sign({from, to, r, p});
}

int linked_voxel(const VoxelVolume& volume, const Vec3i& index) {
  const int v = volume.find(index);
  return v >= 0 && volume.voxel(v).linked() ? v : -1;
}

/// Calls visit(link, from, to) for the links whose boxes meet that of a triangle.
template <typename Visit>
void for_links_near(const VoxelVolume& volume, const SweptTriangle& t, Visit visit) {
  const Lattice& lattice = volume.lattice();
  Box box(t.corners[0]);
  box.extend(t.corners[1]).extend(t.corners[2]);
  const Vec3i low = (lattice.voxel_at(box.min()).array() - 1).max(0);
  const Vec3i high = (lattice.voxel_at(box.max()).array()).min(lattice.size.array() - 1);
  for (int k = low.z(); k <= high.z(); ++k)
    for (int j = low.y(); j <= high.y(); ++j)
      for (int i = low.x(); i <= high.x(); ++i)
        for (int axis = 0; axis < 3; ++axis) {
          const Vec3i index(i, j, k), next = index + Vec3i::Unit(axis);
          const Vec3 from = lattice.centre(index), to = lattice.centre(next);
          if (!box.intersects(Box(from, to))) continue;
          const int v = linked_voxel(volume, index);
          if (v >= 0 && linked_voxel(volume, next) >= 0) visit(LinkId{v, axis}, from, to);
        }
}

int meetings_of(const std::map<LinkId, int>& meetings, const VoxelVolume& volume, const Vec3i& index,
                int axis) {
  const auto found = meetings.find({volume.find(index), axis});
  return found == meetings.end() ? 0 : found->second;
}

/// Labels the linked voxels that a seed reaches.
void flood(const VoxelVolume& volume, const std::map<LinkId, int>& severed, int seed,
           std::vector<int>& piece_of_voxel) {
  std::queue<int> waiting({seed});
  for (; !waiting.empty(); waiting.pop()) {
    const int v = waiting.front();
    for (int direction = 0; direction < kDirections; ++direction) {
      const int next = linked_voxel(volume, volume.voxel(v).index + step(direction));
      const LinkId link{direction % 2 ? v : next, direction / 2};
      if (next < 0 || piece_of_voxel[next] >= 0 || severed.count(link)) continue;
      piece_of_voxel[next] = piece_of_voxel[v];
      waiting.push(next);
    }
  }
}

}  // namespace

std::map<LinkId, int> count_meetings(const VoxelVolume& volume, const Sheet& sheet) {
  std::map<LinkId, int> meetings;
  for (const SweptTriangle& t : sheet)
    for_links_near(volume, t, [&](const LinkId& link, const Vec3& from, const Vec3& to) {
      if (meets(from, to, t)) ++meetings[link];
    });
  return meetings;
}

int count_leaks(const VoxelVolume& volume, const std::map<LinkId, int>& meetings) {
  int leaks = 0;
  for (const Voxel& voxel : volume.voxels())
    for (int a = 0; a < 3; ++a) {
      const int b = (a + 1) % 3;
      const Vec3i index = voxel.index, beside = index + Vec3i::Unit(a), above = index + Vec3i::Unit(b);
      if (linked_voxel(volume, index) < 0 || linked_voxel(volume, beside) < 0 ||
          linked_voxel(volume, above) < 0 || linked_voxel(volume, beside + Vec3i::Unit(b)) < 0)
        continue;
      const int times = meetings_of(meetings, volume, index, a) + meetings_of(meetings, volume, index, b) +
                        meetings_of(meetings, volume, beside, b) + meetings_of(meetings, volume, above, a);
      leaks += times % 2;
    }
  return leaks;
}

std::vector<int> flood_pieces(const VoxelVolume& volume, const std::map<LinkId, int>& severed) {
  const int voxels = static_cast<int>(volume.voxels().size());
  std::vector<int> piece_of_voxel(voxels, -1);
  for (int v = 0, pieces = 0; v < voxels; ++v) {
    if (!volume.voxel(v).linked() || piece_of_voxel[v] >= 0) continue;
    piece_of_voxel[v] = pieces++;
    flood(volume, severed, v, piece_of_voxel);
  }
  for (int v = 0; v < voxels; ++v)
    if (!volume.voxel(v).linked()) piece_of_voxel[v] = piece_of_voxel[volume.voxel(v).host];
  return piece_of_voxel;
}

}  // namespace cfem_cutting::random_cuts

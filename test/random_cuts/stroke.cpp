#include "stroke.h"

#include <algorithm>

namespace cfem_cutting::random_cuts {
namespace {

/// Half an edge or a way over the tissue's radius: still past the tissue where the sheet bends.
constexpr double kOverhang = 1.3;

int random_frames(Dice& dice) { return static_cast<int>(dice.log_uniform(1.0, 200.999)); }

/// Ascending from 0 to 1, evenly or not.
std::vector<double> random_times(Dice& dice, bool even) {
  const int frames = random_frames(dice);
  std::vector<double> times{0.0, 1.0};
  for (int i = 1; i < frames; ++i)
    times.push_back(even ? static_cast<double>(i) / frames : dice.uniform(0.0, 1.0));
  std::sort(times.begin(), times.end());
  return times;
}

/// a sin(ωt + φ), 0 in half of all cases.
struct Wave {
  double amplitude, frequency, phase;
  double operator()(double t) const { return amplitude * std::sin(frequency * t + phase); }
};

Wave random_wave(Dice& dice, double largest) {
  const double amplitude = dice.chance(0.5) ? dice.uniform(-largest, largest) : 0.0;
  const double frequency = dice.uniform(1.0, 6.0);
  return {amplitude, frequency, dice.uniform(0.0, 6.0)};
}

/// Along x, bent in z.
Polyline random_edge(Dice& dice, double half_length) {
  const Wave bend = random_wave(dice, 0.1 * half_length);
  const int segments = dice.integer(1, 12);
  Polyline edge;
  for (int i = 0; i <= segments; ++i) {
    const double t = static_cast<double>(i) / segments;
    edge.emplace_back((2.0 * t - 1.0) * half_length, 0.0, bend(t));
  }
  return edge;
}

/// Anywhere at any angle: the blade moves along y of a turned frame, while it rises and turns.
Stroke stroke_anywhere(Dice& dice, const Tissue& tissue) {
  const double reach = kOverhang * tissue.radius;
  const double h = tissue.volume.lattice().spacing.minCoeff();
  const Mat3 sheet = dice.rotation();
  const Vec3 middle = tissue.centre + sheet.col(2) * dice.uniform(-0.5, 0.5) * tissue.radius;
  const bool jittered = dice.chance(0.5);
  const Wave rise = random_wave(dice, 0.2 * tissue.radius), yaw = random_wave(dice, 0.3),
             roll = random_wave(dice, 0.2), pitch = random_wave(dice, 0.5);
  Stroke stroke{make_blade(random_edge(dice, reach), -Vec3::UnitY(), 0.0), {}};
  for (const double t : random_times(dice, !jittered)) {
    Pose X = Pose::Identity();
    X.translate(middle + sheet * Vec3(0.0, (2.0 * t - 1.0) * reach, rise(t)));
    if (jittered) X.pretranslate(dice.vector(0.5 * h));
    X.linear() = sheet * Eigen::AngleAxisd(yaw(t), Vec3::UnitZ()) *
                 Eigen::AngleAxisd(roll(t), Vec3::UnitY()) * Eigen::AngleAxisd(pitch(t), Vec3::UnitX());
    if (jittered) X.rotate(Eigen::AngleAxisd(dice.uniform(0.0, 0.02), dice.rotation().col(0)));
    stroke.poses.push_back(X);
  }
  return stroke;
}

/// A face, a centre or a point between, near the tissue's middle.
Vec3 random_lattice_point(Dice& dice, const Tissue& tissue) {
  const Lattice& lattice = tissue.volume.lattice();
  const double reach = 0.5 * tissue.radius / lattice.spacing.maxCoeff();
  Vec3i index = lattice.voxel_at(tissue.centre);
  const bool centre = dice.chance(0.5);
  for (int& i : index) i += dice.integer(static_cast<int>(-reach), static_cast<int>(reach));
  Vec3 X = lattice.centre(index);
  for (int axis = 0; axis < 3; ++axis)
    if (!centre && dice.chance(0.5)) X[axis] = lattice.corner(index)[axis];
  return X;
}

Pose at(const Vec3& translation) {
  Pose X = Pose::Identity();
  X.translation() = translation;
  return X;
}

/// In the plane of a lattice's faces or centres, in any direction in it.
Stroke stroke_in_lattice_plane(Dice& dice, const Tissue& tissue) {
  const double reach = kOverhang * tissue.radius;
  const double h = tissue.volume.lattice().spacing.minCoeff();
  const int axis = dice.integer(0, 2);
  const double angle = dice.chance(0.5) ? 0.5 * EIGEN_PI * dice.integer(0, 3) : dice.uniform(0.0, 6.3);
  Vec3 along = Vec3::Zero(), way = Vec3::Zero();
  along[(axis + 1) % 3] = way[(axis + 2) % 3] = std::round(std::cos(angle) * 1024.0) / 1024.0;
  along[(axis + 2) % 3] = std::round(std::sin(angle) * 1024.0) / 1024.0;
  way[(axis + 1) % 3] = -along[(axis + 2) % 3];
  Vec3 middle = tissue.centre;
  middle[axis] = random_lattice_point(dice, tissue)[axis];
  const bool jittered = dice.chance(0.5);
  Stroke stroke{make_blade({-reach * along, reach * along}, -way, 0.0), {}};
  for (const double t : random_times(dice, !jittered)) {
    Vec3 X = middle + (2.0 * t - 1.0) * reach * way;
    if (jittered) X += dice.vector(0.5 * h);
    X[axis] = middle[axis];
    stroke.poses.push_back(at(X));
  }
  return stroke;
}

/// Edge and way along axes or diagonals of the lattice, all points half a voxel apart.
Stroke stroke_through_lattice_points(Dice& dice, const Tissue& tissue) {
  const Vec3 half = 0.5 * tissue.volume.lattice().spacing;
  Vec3 along, way;
  double sine = 0.0;
  while (sine < 0.5) {
    along = dice.step().cwiseProduct(half);
    way = dice.step().cwiseProduct(half);
    sine = along.cross(way).norm() / (along.norm() * way.norm());
  }
  const Vec3 middle = random_lattice_point(dice, tissue);
  const double reach = (kOverhang * tissue.radius + (middle - tissue.centre).norm()) / sine;
  const int edge_steps = static_cast<int>(std::ceil(reach / along.norm()));
  const int way_steps = static_cast<int>(std::ceil(reach / way.norm()));
  Polyline edge;
  for (int i = -edge_steps; i <= edge_steps; ++i) edge.push_back(i * along);
  Stroke stroke{make_blade(edge, -way, 0.0), {}};
  const bool jittered = dice.chance(0.5);
  const int stride = dice.integer(1, 4);
  for (int i = -way_steps; i <= way_steps + stride; i += stride) {
    const Vec3 jitter =
        jittered ? Vec3(dice.integer(-1, 1) * along + dice.integer(-1, 1) * way) : Vec3::Zero();
    stroke.poses.push_back(at(middle + i * way + jitter));
  }
  return stroke;
}

/// Moves points of the edge and poses by up to 1e-12 voxels.
void disturb(Stroke& stroke, Dice& dice, double h) {
  const double largest = h * dice.log_uniform(1e-16, 0.5e-12);
  for (Vec3& point : stroke.blade.edge) point += dice.vector(largest);
  for (Pose& pose : stroke.poses) pose.translation() += dice.vector(largest);
}

}  // namespace

Stroke random_stroke(Dice& dice, const Tissue& tissue, Aim aim) {
  if (aim == Aim::kAnywhere) return stroke_anywhere(dice, tissue);
  Stroke stroke =
      dice.chance(0.5) ? stroke_in_lattice_plane(dice, tissue) : stroke_through_lattice_points(dice, tissue);
  if (aim == Aim::kNearlyLattice) disturb(stroke, dice, tissue.volume.lattice().spacing.minCoeff());
  return stroke;
}

void stop(Stroke& stroke, Dice& dice) {
  const double part = dice.uniform(0.3, 0.8) * static_cast<double>(stroke.poses.size() - 1);
  const int last = static_cast<int>(part);
  const Pose end = interpolate(stroke.poses[last], stroke.poses[last + 1], part - last);
  stroke.poses.resize(last + 1);
  stroke.poses.push_back(end);
  const Vec3 heel = stroke.blade.edge.front(), tip = stroke.blade.edge.back();
  if (dice.chance(0.5)) stroke.blade.edge = {heel, heel + dice.uniform(0.3, 0.7) * (tip - heel)};
}

}  // namespace cfem_cutting::random_cuts

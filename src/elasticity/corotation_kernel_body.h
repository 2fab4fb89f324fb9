// No include guard: corotation_kernel.cpp includes this once per instruction set, with KERNEL_NAMESPACE and
// what lanes_body.h needs defined.

namespace KERNEL_NAMESPACE {

#include "lanes_body.h"

static inline void cross(const Vector* a, const Vector* b, Vector* c) {
  c[0] = a[1] * b[2] - a[2] * b[1];
  c[1] = a[2] * b[0] - a[0] * b[2];
  c[2] = a[0] * b[1] - a[1] * b[0];
}

/// Rows of cofactors of a matrix given by rows.
static inline void cofactors(const Vector* A, Vector* C) {
  cross(A + 3, A + 6, C);
  cross(A + 6, A, C + 3);
  cross(A, A + 3, C + 6);
}

/// @return the determinant of F; R is its rotation where that is well above zero
static inline Vector rotation_of(const Vector* F, Vector* R, Vector* change) {
  Vector C[9], det = {};
  for (int i = 0; i < 9; ++i) R[i] = F[i];
  for (int iteration = 0; iteration < 12; ++iteration) {
    cofactors(R, C);
    const Vector d = R[0] * C[0] + R[1] * C[1] + R[2] * C[2];
    if (iteration == 0) det = d;
    const Vector half_over_d = 0.5 / d;
    Vector squares = {};
    for (int i = 0; i < 9; ++i) {
      const Vector next = 0.5 * R[i] + half_over_d * C[i];
      squares += (next - R[i]) * (next - R[i]);
      R[i] = next;
    }
    *change = squares;
    bool done = true;
    for (int l = 0; l < kWidth; ++l) done = done && !(squares[l] > 1e-18);
    if (done) break;
  }
  return det;
}

/// Takes the change of R with x into account: f −= q × g with (tr(S) I − S) q = Σ y × f, S = RᵀF.
/// @return the determinant of tr(S) I − S
static inline Vector add_spin(const Vector* y, const Vector* g, Vector* f) {
  Vector G[9] = {}, torque[3] = {}, C[9], q[3], c[3];
  for (int n = 0; n < 8; ++n) {
    cross(y + 3 * n, f + 3 * n, c);
    for (int i = 0; i < 3; ++i) torque[i] += c[i];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) G[3 * i + j] -= y[3 * n + i] * g[3 * n + j];
  }
  const Vector trace = G[0] + G[4] + G[8];
  for (int i = 0; i < 3; ++i) G[4 * i] -= trace;
  cofactors(G, C);
  const Vector det = G[0] * C[0] + G[1] * C[1] + G[2] * C[2];
  for (int i = 0; i < 3; ++i) q[i] = (C[i] * torque[0] + C[3 + i] * torque[1] + C[6 + i] * torque[2]) / det;
  for (int n = 0; n < 8; ++n) {
    cross(q, g + 3 * n, c);
    for (int i = 0; i < 3; ++i) f[3 * n + i] -= c[i];
  }
  return det;
}

static void respond_lanes(const CorotationBatch& batch, int lane) {
  Vector x[24], y[24], u[24], f[24], g[24], F[9] = {}, R[9], change;
  for (int n = 0; n < 8; ++n)
    for (int l = 0; l < kWidth; ++l) {
      const double* node = batch.x + 3 * static_cast<long>(batch.nodes[kLanes * n + lane + l]);
      const double* first = batch.x + 3 * static_cast<long>(batch.nodes[lane + l]);
      for (int i = 0; i < 3; ++i) x[3 * n + i][l] = node[i] - first[i];
    }
  for (int i = 0; i < 24; ++i) g[i] = load(batch.gradient + kLanes * i + lane);
  for (int n = 0; n < 8; ++n)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) F[3 * i + j] += x[3 * n + i] * g[3 * n + j];
  const Vector volume_ratio = rotation_of(F, R, &change);
  for (int n = 0; n < 8; ++n)
    for (int i = 0; i < 3; ++i) {
      y[3 * n + i] = R[i] * x[3 * n] + R[3 + i] * x[3 * n + 1] + R[6 + i] * x[3 * n + 2];
      u[3 * n + i] = y[3 * n + i] - (n >> i & 1) * batch.block_size[i];
    }
  if (is_of_modes(batch.form)) {
    Vector modes[24];
    for (int i = 0; i < 24; ++i) modes[i] = u[i];
    transform(modes);
    multiply_modes(batch.form, batch.stiffness, lane, modes, f);
    for (int i = 0; i < 3; ++i) f[i] = Vector{};
    transform(f);
  } else {
    multiply_nodes(batch.form, batch.stiffness, lane, u, f);
  }
  Vector energy = {};
  for (int i = 0; i < 24; ++i) energy += 0.5 * u[i] * f[i];
  store(batch.energy + lane, energy);
  const Vector spin_determinant = add_spin(y, g, f);
  for (int n = 0; n < 8; ++n)
    for (int i = 0; i < 3; ++i)
      u[3 * n + i] = -(R[3 * i] * f[3 * n] + R[3 * i + 1] * f[3 * n + 1] + R[3 * i + 2] * f[3 * n + 2]);
  for (int n = 0; n < 8; ++n)
    for (int l = 0; l < kWidth; ++l)
      for (int i = 0; i < 3; ++i)
        batch.forces[4 * (kLanes * n + place_of_lane(lane + l)) + i] = u[3 * n + i][l];
  for (int i = 0; i < 9; ++i) store(batch.rotations + kLanes * i + lane, R[i]);
  for (int l = 0; l < kWidth; ++l)
    batch.regular[lane + l] = volume_ratio[l] > 0.01 && change[l] < 1e-18 && spin_determinant[l] > 1e-2;
}

static void respond(const CorotationBatch& batch) {
  for (int lane = 0; lane < kLanes; lane += kWidth) respond_lanes(batch, lane);
}

}  // namespace KERNEL_NAMESPACE

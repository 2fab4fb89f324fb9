// No include guard: element_kernel.cpp includes this once per instruction set and type, with
// KERNEL_NAMESPACE defined, what lanes_body.h needs, and for types whose quads are gathered by shuffles
// KERNEL_QUADS(a, b, c, d): the indices a, b, c, d, a + 4, b + 4, ... of a register.

namespace KERNEL_NAMESPACE {

#include "lanes_body.h"

#ifdef KERNEL_QUADS

typedef float Quad __attribute__((vector_size(16), aligned(4), may_alias));
typedef float Tight __attribute__((vector_size(16)));

#define QUAD(l) static_cast<Tight>(*reinterpret_cast<const Quad*>(x + 4 * static_cast<long>(nodes[l])))
#define EIGHT(a, b) __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7)
#define SHUFFLE(a, b, i, j, k, l) __builtin_shufflevector(a, b, KERNEL_QUADS(i, j, k, l))

/// The quads of nodes 0, 4, 8, ... as one register.
static inline Vector every_fourth(const KERNEL_SCALAR* x, const int* nodes) {
#if KERNEL_WIDTH == 4
  return QUAD(0);
#elif KERNEL_WIDTH == 8
  return EIGHT(QUAD(0), QUAD(4));
#else
  return __builtin_shufflevector(EIGHT(QUAD(0), QUAD(4)), EIGHT(QUAD(8), QUAD(12)), 0, 1, 2, 3, 4, 5, 6, 7, 8,
                                 9, 10, 11, 12, 13, 14, 15);
#endif
}

/// Values of one node of each lane's element, by coordinate.
static inline void gather(const KERNEL_SCALAR* x, const int* nodes, Vector* values) {
  const Vector a = every_fourth(x, nodes), b = every_fourth(x, nodes + 1);
  const Vector c = every_fourth(x, nodes + 2), d = every_fourth(x, nodes + 3);
  const Vector ab = SHUFFLE(a, b, 0, kWidth, 1, kWidth + 1), cd = SHUFFLE(c, d, 0, kWidth, 1, kWidth + 1);
  values[0] = SHUFFLE(ab, cd, 0, 1, kWidth, kWidth + 1);
  values[1] = SHUFFLE(ab, cd, 2, 3, kWidth + 2, kWidth + 3);
  values[2] = SHUFFLE(SHUFFLE(a, b, 2, kWidth + 2, 3, kWidth + 3),
                      SHUFFLE(c, d, 2, kWidth + 2, 3, kWidth + 3), 0, 1, kWidth, kWidth + 1);
}

/// The inverse of gather, into places.
static inline void scatter(const Vector* values, int lane, KERNEL_SCALAR* y) {
  const Vector x0 = SHUFFLE(values[0], values[1], 0, kWidth, 1, kWidth + 1);
  const Vector x2 = SHUFFLE(values[0], values[1], 2, kWidth + 2, 3, kWidth + 3);
  const Vector zero = {};
  const Vector z0 = SHUFFLE(values[2], zero, 0, kWidth, 1, kWidth);
  const Vector z2 = SHUFFLE(values[2], zero, 2, kWidth, 3, kWidth);
  store(y + lane, SHUFFLE(x0, z0, 0, 1, kWidth, kWidth + 1));
  store(y + 16 + lane, SHUFFLE(x0, z0, 2, 3, kWidth + 2, kWidth + 3));
  store(y + 32 + lane, SHUFFLE(x2, z2, 0, 1, kWidth, kWidth + 1));
  store(y + 48 + lane, SHUFFLE(x2, z2, 2, 3, kWidth + 2, kWidth + 3));
}

#undef QUAD
#undef EIGHT
#undef SHUFFLE

#else

static inline void gather(const KERNEL_SCALAR* x, const int* nodes, Vector* values) {
  for (int l = 0; l < kWidth; ++l)
    for (int i = 0; i < 3; ++i) values[i][l] = x[4 * static_cast<long>(nodes[l]) + i];
}

static inline void scatter(const Vector* values, int lane, KERNEL_SCALAR* y) {
  for (int l = 0; l < kWidth; ++l)
    for (int i = 0; i < 4; ++i) y[4 * place_of_lane(lane + l) + i] = i < 3 ? values[i][l] : 0;
}

#endif

/// R, row by row, by the quaternion of its Rodrigues parameters.
static inline void unpack_rotation(const KERNEL_SCALAR* parameters, Vector* R) {
  Vector v[3], square[3];
  for (int i = 0; i < 3; ++i) v[i] = load(parameters + kLanes * i);
  const Vector size = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  const Vector scale = 2 / (1 + size);
  const Vector twice_w = 2 * (scale - 1);
  for (int i = 0; i < 3; ++i) v[i] *= scale;
  for (int i = 0; i < 3; ++i) square[i] = 2 * v[i] * v[i];
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    const Vector product = 2 * v[i] * v[j], turn = twice_w * v[k];
    R[4 * i] = 1 - square[j] - square[k];
    R[3 * i + j] = product - turn;
    R[3 * j + i] = product + turn;
  }
}

/// y = R K Rᵀ x by a form of transformed nodes; x is used up.
static inline void multiply_transformed(const ElementBatch<KERNEL_SCALAR>& batch, int lane, const Vector* R,
                                        Vector* x, Vector* y) {
  Vector u[24] = {};
  transform(x);
  rotate(R, true, 1, x, u);
  multiply_modes(batch.form, batch.stiffness, lane, u, x);
  rotate(R, false, 1, x, y);
  for (int i = 0; i < 3; ++i) y[i] = u[i];
  transform(y);
}

static void multiply(const ElementBatch<KERNEL_SCALAR>& batch) {
  for (int lane = 0; lane < kLanes; lane += kWidth) {
    Vector x[24], u[24], R[9];
#pragma GCC unroll 8
    for (int n = 0; n < 8; ++n) gather(batch.x, batch.nodes + kLanes * n + lane, x + 3 * n);
    unpack_rotation(batch.rotation + lane, R);
    if (is_of_modes(batch.form)) {
      multiply_transformed(batch, lane, R, x, u);
    } else {
      rotate(R, true, 0, x, u);
      multiply_nodes(batch.form, batch.stiffness, lane, u, x);
      rotate(R, false, 0, x, u);
    }
#pragma GCC unroll 8
    for (int n = 0; n < 8; ++n) scatter(u + 3 * n, lane, batch.y + 4 * kLanes * n);
  }
}

#ifdef KERNEL_QUADS
#include "diagonal_body.h"
#endif

}  // namespace KERNEL_NAMESPACE

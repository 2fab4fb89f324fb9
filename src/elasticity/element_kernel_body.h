// No include guard: element_kernel.cpp includes this once per instruction set and type, with
// KERNEL_NAMESPACE, KERNEL_SCALAR and KERNEL_BYTES (of a register) defined. Plain arrays and no templates
// inside, so that no code for one instruction set can be merged with code for another.

namespace KERNEL_NAMESPACE {

typedef KERNEL_SCALAR Vector __attribute__((vector_size(KERNEL_BYTES)));
typedef KERNEL_SCALAR Loose __attribute__((vector_size(KERNEL_BYTES), aligned(4), may_alias));

constexpr int kWidth = KERNEL_BYTES / static_cast<int>(sizeof(KERNEL_SCALAR));
constexpr int kRows = 12;

static inline Vector load(const KERNEL_SCALAR* p) { return *reinterpret_cast<const Loose*>(p); }
static inline void store(KERNEL_SCALAR* p, Vector v) { *reinterpret_cast<Loose*>(p) = v; }

/// u = Rᵀ x (transposed) or R x for each node.
static inline void rotate(const Vector* R, bool transposed, const Vector* x, Vector* u) {
  for (int n = 0; n < 8; ++n) {
    for (int i = 0; i < 3; ++i) {
      const Vector a = R[transposed ? i : 3 * i], b = R[transposed ? 3 + i : 3 * i + 1];
      const Vector c = R[transposed ? 6 + i : 3 * i + 2];
      u[3 * n + i] = a * x[3 * n] + b * x[3 * n + 1] + c * x[3 * n + 2];
    }
  }
}

static inline void multiply_shared(const KERNEL_SCALAR* K, const Vector* u, Vector* f) {
  for (int row = 0; row < 24; row += kRows) {
    Vector sum[kRows] = {};
    for (int j = 0; j < 24; ++j)
      for (int r = 0; r < kRows; ++r) sum[r] += K[24 * j + row + r] * u[j];  // symmetric
    for (int r = 0; r < kRows; ++r) f[row + r] = sum[r];
  }
}

/// Each entry below the diagonal serves twice.
static inline void multiply_own(const KERNEL_SCALAR* K, const Vector* u, Vector* f) {
  Vector sum[24] = {};
#pragma GCC unroll 24
  for (int j = 0; j < 24; ++j) {
    const KERNEL_SCALAR* column = K + 16 * (24 * j - j * (j - 1) / 2);
    Vector even = load(column) * u[j], odd = {};
#pragma GCC unroll 24
    for (int i = j + 1; i < 24; ++i) {
      const Vector k = load(column + 16 * (i - j));
      sum[i] += k * u[j];
      if (i & 1) {
        odd += k * u[i];
      } else {
        even += k * u[i];
      }
    }
    sum[j] += even + odd;
  }
  for (int i = 0; i < 24; ++i) f[i] = sum[i];
}

static void multiply(const ElementBatch<KERNEL_SCALAR>& batch) {
  for (int lane = 0; lane < kLanes; lane += kWidth) {
    Vector x[24], u[24], R[9];
    for (int n = 0; n < 8; ++n)
      for (int l = 0; l < kWidth; ++l)
        for (int i = 0; i < 3; ++i) x[3 * n + i][l] = batch.x[3 * batch.nodes[kLanes * n + lane + l] + i];
    for (int i = 0; i < 9; ++i) R[i] = load(batch.rotation + kLanes * i + lane);
    rotate(R, true, x, u);
    if (batch.shared) {
      multiply_shared(batch.stiffness, u, x);
    } else {
      multiply_own(batch.stiffness + lane, u, x);
    }
    rotate(R, false, x, u);
    for (int i = 0; i < 24; ++i) store(batch.y + kLanes * i + lane, u[i]);
  }
}

}  // namespace KERNEL_NAMESPACE

// No include guard: a kernel includes this inside its namespace, once per instruction set and type, with
// KERNEL_SCALAR, KERNEL_BYTES (of a register) and KERNEL_WIDTH (its lanes) defined. Plain arrays and no
// templates inside, so that no code for one instruction set can be merged with code for another.

typedef KERNEL_SCALAR Vector __attribute__((vector_size(KERNEL_BYTES)));
typedef KERNEL_SCALAR Loose __attribute__((vector_size(KERNEL_BYTES), aligned(4), may_alias));

constexpr int kWidth = KERNEL_WIDTH;
constexpr int kRows = 12;

static inline Vector load(const KERNEL_SCALAR* p) { return *reinterpret_cast<const Loose*>(p); }
static inline void store(KERNEL_SCALAR* p, Vector v) { *reinterpret_cast<Loose*>(p) = v; }

/// u = Rᵀ x (transposed) or R x for nodes from the first on.
static inline void rotate(const Vector* R, bool transposed, int first, const Vector* x, Vector* u) {
#pragma GCC unroll 8
  for (int n = first; n < 8; ++n) {
#pragma GCC unroll 3
    for (int i = 0; i < 3; ++i) {
      const Vector a = R[transposed ? i : 3 * i], b = R[transposed ? 3 + i : 3 * i + 1];
      const Vector c = R[transposed ? 6 + i : 3 * i + 2];
      u[3 * n + i] = a * x[3 * n] + b * x[3 * n + 1] + c * x[3 * n + 2];
    }
  }
}

/// Σ (−1)^|s & n| v_n for each s: Walsh's transform over the nodes, a coordinate at a time in registers.
static inline void transform(Vector* v) {
#pragma GCC unroll 3
  for (int i = 0; i < 3; ++i) {
#pragma GCC unroll 3
    for (int bit = 1; bit < 8; bit *= 2) {
#pragma GCC unroll 4
      for (int pair = 0; pair < 4; ++pair) {
        const int n = 2 * pair - (pair & (bit - 1));  // bits of `pair`, and a zero at `bit`
        const Vector a = v[3 * n + i], b = v[3 * (n + bit) + i];
        v[3 * n + i] = a + b;
        v[3 * (n + bit) + i] = a - b;
      }
    }
  }
}

/// f = K u by MirroredMatrix, of transformed nodes: what is left of K are eight blocks.
static inline void multiply_blocks(const KERNEL_SCALAR* K, const Vector* u, Vector* f) {
#pragma GCC unroll 8
  for (int p = 0; p < 8; ++p) {
    for (int i = 0; i < 3; ++i) {
      const KERNEL_SCALAR* k = K + 9 * p + 3 * i;
      f[3 * (p ^ 1 << i) + i] = k[0] * u[3 * (p ^ 1)] + k[1] * u[3 * (p ^ 2) + 1] + k[2] * u[3 * (p ^ 4) + 2];
    }
  }
}

static inline void multiply_whole(const KERNEL_SCALAR* K, const Vector* u, Vector* f) {
  for (int row = 0; row < 24; row += kRows) {
    Vector sum[kRows] = {};
    for (int j = 0; j < 24; ++j)
      for (int r = 0; r < kRows; ++r) sum[r] += K[24 * j + row + r] * u[j];  // symmetric
    for (int r = 0; r < kRows; ++r) f[row + r] = sum[r];
  }
}

/// In a lower triangle, column by column, the entry in row i and column j ≤ i, of one lane after the other.
static inline const KERNEL_SCALAR* entry(const KERNEL_SCALAR* K, int size, int i, int j) {
  return K + kLanes * (size * j - j * (j + 1) / 2 + i);
}

/// f = K u by a lower triangle: each entry below the diagonal serves twice. Some columns at once, whose sums
/// stay in registers.
__attribute__((always_inline)) static inline void multiply_triangle(const KERNEL_SCALAR* K, int size,
                                                                    const Vector* u, Vector* f) {
  constexpr int kColumns = 3;
  Vector sum[24] = {};
#pragma GCC unroll 8
  for (int j = 0; j < size; j += kColumns) {
    Vector own[kColumns];
#pragma GCC unroll 3
    for (int c = 0; c < kColumns; ++c) {
      own[c] = sum[j + c];
#pragma GCC unroll 3
      for (int r = 0; r < kColumns; ++r)
        own[c] += load(r < c ? entry(K, size, j + c, j + r) : entry(K, size, j + r, j + c)) * u[j + r];
    }
    for (int i = j + kColumns; i < size; ++i) {
#pragma GCC unroll 3
      for (int c = 0; c < kColumns; ++c) {
        const Vector k = load(entry(K, size, i, j + c));
        own[c] += k * u[i];
        sum[i] += k * u[j + c];
      }
    }
#pragma GCC unroll 3
    for (int c = 0; c < kColumns; ++c) f[j + c] = own[c];
  }
}

/// f = K u by DeformationMatrix, of transformed nodes.
static inline void multiply_deformations(const KERNEL_SCALAR* K, const Vector* u, Vector* f) {
  constexpr int kKept[18] = {3, 6, 7, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23};
  constexpr int kPairs[3][2] = {{6, 4}, {12, 5}, {13, 8}};  // kept and left out
  Vector kept[18], forces[18], all[24];
#pragma GCC unroll 24
  for (int i = 3; i < 24; ++i) all[i] = u[i];
#pragma GCC unroll 3
  for (int p = 0; p < 3; ++p) all[kPairs[p][0]] += load(K + kLanes * p) * u[kPairs[p][1]];
#pragma GCC unroll 18
  for (int i = 0; i < 18; ++i) kept[i] = all[kKept[i]];
  multiply_triangle(K + 3 * kLanes, 18, kept, forces);
#pragma GCC unroll 18
  for (int i = 0; i < 18; ++i) f[kKept[i]] = forces[i];
#pragma GCC unroll 3
  for (int p = 0; p < 3; ++p) f[kPairs[p][1]] = load(K + kLanes * p) * f[kPairs[p][0]];
}

/// Whether a form is one of transformed nodes. Of these the first is a translation, which has no forces.
static inline bool is_of_modes(MatrixForm form) {
  return form == MatrixForm::kMirrored || form == MatrixForm::kDeformations;
}

/// f = K u by a form of transformed nodes, without the first, for lanes from `lane` on of a batch.
static inline void multiply_modes(MatrixForm form, const KERNEL_SCALAR* K, int lane, const Vector* u,
                                  Vector* f) {
  if (form == MatrixForm::kMirrored) {
    multiply_blocks(K, u, f);
  } else {
    multiply_deformations(K + lane, u, f);
  }
}

/// f = K u by another form.
static inline void multiply_nodes(MatrixForm form, const KERNEL_SCALAR* K, int lane, const Vector* u,
                                  Vector* f) {
  if (form == MatrixForm::kWhole) {
    multiply_whole(K, u, f);
  } else {
    multiply_triangle(K + lane, 24, u, f);
  }
}

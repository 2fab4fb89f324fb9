// No include guard: element_kernel_body.h includes this inside its namespace.

/// An element's block of one node with itself, K row by row, of which only the symmetric half is used.
static inline void node_block(MatrixForm form, const KERNEL_SCALAR* K, int lane, int n, Vector* block) {
  for (int j = 0; j < 3; ++j) {
    const int column = 3 * n + j;
    for (int i = j; i < 3; ++i) {
      const Vector value = form == MatrixForm::kWhole ? K[24 * column + 3 * n + i] + Vector{}
                           : form == MatrixForm::kTriangles
                               ? load(entry(K + lane, 24, 3 * n + i, column))
                               : load(entry(K + lane + kLanes * (3 + kDeformationTriangle + 6 * n), 3, i, j));
      block[3 * i + j] = block[3 * j + i] = value;
    }
  }
}

/// Rows and columns of the three entries that one call makes: the diagonal, or what is beside it.
static inline int row_of(bool beside, int entry) { return beside ? entry == 0 : entry; }
static inline int column_of(bool beside, int entry) { return beside ? 2 - entry / 2 : entry; }

/// Entries of R K Rᵀ for each node n. Reflections change the signs of what is beside K's diagonal, so that
/// Rᵀ's three products with those are added up with a sign each.
static inline void turn_mirrored(const KERNEL_SCALAR* K, const Vector* R, bool beside, Vector* y) {
  KERNEL_SCALAR k[9] = {};
  for (int p = 0; p < 8; ++p)
    for (int i = 0; i < 9; ++i) k[i] += K[9 * p + i];
  for (int entry = 0; entry < 3; ++entry) {
    const Vector *a = R + 3 * row_of(beside, entry), *b = R + 3 * column_of(beside, entry);
    const Vector even = k[0] * a[0] * b[0] + k[4] * a[1] * b[1] + k[8] * a[2] * b[2];
    const Vector xy = k[1] * (a[0] * b[1] + a[1] * b[0]);
    const Vector xz = k[2] * (a[0] * b[2] + a[2] * b[0]);
    const Vector yz = k[5] * (a[1] * b[2] + a[2] * b[1]);
    const Vector sums[4] = {even + xy + xz + yz, even - xy - xz + yz, even - xy + xz - yz,
                            even + xy - xz - yz};
    for (int n = 0; n < 8; ++n) y[3 * n + entry] = sums[n < 4 ? n : 7 - n];
  }
}

static inline void turn_unmirrored(const ElementBatch<KERNEL_SCALAR>& batch, int lane, const Vector* R,
                                   bool beside, Vector* y) {
  for (int n = 0; n < 8; ++n) {
    Vector block[9];
    node_block(batch.form, batch.stiffness, lane, n, block);
    for (int entry = 0; entry < 3; ++entry) {
      const Vector *a = R + 3 * row_of(beside, entry), *b = R + 3 * column_of(beside, entry);
      Vector sum = {};
      for (int i = 0; i < 3; ++i)
        sum += a[i] * (block[3 * i] * b[0] + block[3 * i + 1] * b[1] + block[3 * i + 2] * b[2]);
      y[3 * n + entry] = sum;
    }
  }
}

static void diagonal(const ElementBatch<KERNEL_SCALAR>& batch, bool beside) {
  for (int lane = 0; lane < kLanes; lane += kWidth) {
    Vector R[9], y[24];
    unpack_rotation(batch.rotation + lane, R);
    if (batch.form == MatrixForm::kMirrored) {
      turn_mirrored(batch.stiffness, R, beside, y);
    } else {
      turn_unmirrored(batch, lane, R, beside, y);
    }
    for (int n = 0; n < 8; ++n) scatter(y + 3 * n, lane, batch.y + 4 * kLanes * n);
  }
}

#include "element_kernel.h"

namespace cfem_cutting {
namespace {

#define KERNEL_BYTES 16
#define KERNEL_NAMESPACE baseline_float
#define KERNEL_SCALAR float
#define KERNEL_WIDTH 4
#define KERNEL_QUADS(a, b, c, d) (a), (b), (c), (d)
#include "element_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_SCALAR
#undef KERNEL_WIDTH
#undef KERNEL_QUADS
#define KERNEL_NAMESPACE baseline_double
#define KERNEL_SCALAR double
#define KERNEL_WIDTH 2
#include "element_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_SCALAR
#undef KERNEL_WIDTH
#undef KERNEL_BYTES

#if defined(__x86_64__) && defined(__GNUC__)
#define KERNEL_BYTES 32
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#define KERNEL_NAMESPACE avx2_float
#define KERNEL_SCALAR float
#define KERNEL_WIDTH 8
#define KERNEL_QUADS(a, b, c, d) (a), (b), (c), (d), (a) + 4, (b) + 4, (c) + 4, (d) + 4
#include "element_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_SCALAR
#undef KERNEL_WIDTH
#undef KERNEL_QUADS
#define KERNEL_NAMESPACE avx2_double
#define KERNEL_SCALAR double
#define KERNEL_WIDTH 4
#include "element_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_SCALAR
#undef KERNEL_WIDTH
#pragma GCC pop_options
#undef KERNEL_BYTES

#define KERNEL_BYTES 64
#pragma GCC push_options
#pragma GCC target("avx512f,avx2,fma")
#define KERNEL_NAMESPACE avx512_float
#define KERNEL_SCALAR float
#define KERNEL_WIDTH 16
#define KERNEL_QUADS(a, b, c, d)                                                                        \
  (a), (b), (c), (d), (a) + 4, (b) + 4, (c) + 4, (d) + 4, (a) + 8, (b) + 8, (c) + 8, (d) + 8, (a) + 12, \
      (b) + 12, (c) + 12, (d) + 12
#include "element_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_SCALAR
#undef KERNEL_WIDTH
#undef KERNEL_QUADS
#define KERNEL_NAMESPACE avx512_double
#define KERNEL_SCALAR double
#define KERNEL_WIDTH 8
#include "element_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_SCALAR
#undef KERNEL_WIDTH
#pragma GCC pop_options
#undef KERNEL_BYTES
#endif

/// Widest first.
std::vector<ElementKernel> find_kernels() {
  std::vector<ElementKernel> kernels;
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f"))
    kernels.push_back({"AVX-512", avx512_float::multiply, avx512_double::multiply, avx512_float::diagonal});
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    kernels.push_back({"AVX2", avx2_float::multiply, avx2_double::multiply, avx2_float::diagonal});
#endif
  kernels.push_back(
      {"baseline", baseline_float::multiply, baseline_double::multiply, baseline_float::diagonal});
  return kernels;
}

}  // namespace

const std::vector<ElementKernel>& element_kernels() {
  static const std::vector<ElementKernel> found = find_kernels();
  return found;
}

void multiply(const ElementBatch<float>& batch) { element_kernels().front().single(batch); }
void multiply(const ElementBatch<double>& batch) { element_kernels().front().precise(batch); }
void find_diagonal(const ElementBatch<float>& batch, bool beside) {
  element_kernels().front().diagonal(batch, beside);
}

}  // namespace cfem_cutting

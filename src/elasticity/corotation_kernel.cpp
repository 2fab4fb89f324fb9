#include "corotation_kernel.h"

namespace cfem_cutting {
namespace {

#define KERNEL_SCALAR double

#define KERNEL_NAMESPACE baseline
#define KERNEL_BYTES 16
#define KERNEL_WIDTH 2
#include "corotation_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_BYTES
#undef KERNEL_WIDTH

#if defined(__x86_64__) && defined(__GNUC__)
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#define KERNEL_NAMESPACE avx2
#define KERNEL_BYTES 32
#define KERNEL_WIDTH 4
#include "corotation_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_BYTES
#undef KERNEL_WIDTH
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx2,fma")
#define KERNEL_NAMESPACE avx512
#define KERNEL_BYTES 64
#define KERNEL_WIDTH 8
#include "corotation_kernel_body.h"
#undef KERNEL_NAMESPACE
#undef KERNEL_BYTES
#undef KERNEL_WIDTH
#pragma GCC pop_options
#endif

/// Widest first.
std::vector<CorotationKernel> find_kernels() {
  std::vector<CorotationKernel> kernels;
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f")) kernels.push_back({"AVX-512", avx512::respond});
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    kernels.push_back({"AVX2", avx2::respond});
#endif
  kernels.push_back({"baseline", baseline::respond});
  return kernels;
}

}  // namespace

const std::vector<CorotationKernel>& corotation_kernels() {
  static const std::vector<CorotationKernel> found = find_kernels();
  return found;
}

void respond(const CorotationBatch& batch) { corotation_kernels().front().respond(batch); }

}  // namespace cfem_cutting

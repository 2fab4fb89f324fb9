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

using Kernel = void (*)(const CorotationBatch&);

Kernel choose_kernel() {
#if defined(__x86_64__) && defined(__GNUC__)
  if (__builtin_cpu_supports("avx512f")) return avx512::respond;
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return avx2::respond;
#endif
  return baseline::respond;
}

}  // namespace

void respond(const CorotationBatch& batch) {
  static const Kernel chosen = choose_kernel();
  chosen(batch);
}

}  // namespace cfem_cutting

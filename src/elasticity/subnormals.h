#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace cfem_cutting {

/// While it lives, numbers of this thread too small for full precision are zero. Where loads fade out through
/// a body, fields are full of them, and processors are many times slower with them.
class FlushSubnormals {
 public:
#if defined(__SSE2__)
  FlushSubnormals() : before_(_mm_getcsr()) { _mm_setcsr(before_ | kFlushToZero | kSubnormalsAreZero); }
  ~FlushSubnormals() { _mm_setcsr(before_); }
#endif
  FlushSubnormals(const FlushSubnormals&) = delete;
  FlushSubnormals& operator=(const FlushSubnormals&) = delete;

#if defined(__SSE2__)
 private:
  static constexpr unsigned kFlushToZero = 0x8000, kSubnormalsAreZero = 0x0040;
  unsigned before_;
#else
  FlushSubnormals() {}
#endif
};

}  // namespace cfem_cutting

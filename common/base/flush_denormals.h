// Turns denormal numbers off: no result needs them, and every processor is slow with them.
#pragma once

#include <pmmintrin.h>
#include <xmmintrin.h>

namespace tacipc {

/// While this object lives, denormal numbers count as zero on this thread.
class FlushDenormals {
 public:
  FlushDenormals() : before_(_mm_getcsr()) {
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
  }
  ~FlushDenormals() { _mm_setcsr(before_); }
  FlushDenormals(const FlushDenormals&) = delete;
  FlushDenormals& operator=(const FlushDenormals&) = delete;

 private:
  unsigned int before_;
};

}  // namespace tacipc

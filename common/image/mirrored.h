// Mirrored continuation of a row of pixels beyond its ends.
#pragma once

namespace tacipc {

/// Returns the index of pixel i of a row of n values, mirrored about the outer edges (… 1 0 | 0 1 … n−1 | n−1 …).
inline int mirrored(int i, int n) {
  const int period = 2 * n;
  const int phase = ((i % period) + period) % period;
  return phase < n ? phase : period - 1 - phase;
}

}  // namespace tacipc

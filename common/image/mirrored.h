// How rows of pixels continue beyond their ends.
#pragma once

namespace tacipc {

/// Index i of a row of n values continued by mirroring about the edge between pixels (… 1 0 | 0 1 … n−1 | n−1 …).
inline int mirrored(int i, int n) {
  const int period = 2 * n;
  const int phase = ((i % period) + period) % period;
  return phase < n ? phase : period - 1 - phase;
}

}  // namespace tacipc

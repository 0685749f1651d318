// How fast memory gives and takes: the yardstick for what only streams through it.
#pragma once

namespace tacipc::bench {

/// Bytes per second of a = b + s c over arrays far larger than any cache, on `threads` threads; what is written is
/// counted twice, as it is first fetched. Best of `repeats`, by wall time.
double memory_bytes_per_s(int threads, int repeats);

}  // namespace tacipc::bench

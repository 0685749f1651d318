// How fast memory gives and takes: the yardstick for what only streams through it.
#pragma once

namespace tacipc::bench {

/// Bytes per second of processor time of a = b + s c on one thread, over arrays far larger than any cache; what is
/// written is counted twice, as it is first fetched. Best of `repeats`.
double memory_bytes_per_s(int repeats);

}  // namespace tacipc::bench

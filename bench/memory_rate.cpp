#include "bench/memory_rate.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "bench/machine.h"
#include "common/base/error.h"

namespace tacipc::bench {

double memory_bytes_per_s(int repeats) {
  constexpr std::size_t kFloats = std::size_t{1} << 25;  // 128 MiB each
  std::vector<float> a(kFloats, 0.0f), b(kFloats, 1.0f), c(kFloats, 2.0f);
  double least_s = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const auto factor = static_cast<float>(repeat);
    const double start = processor_s();
    for (std::size_t i = 0; i < kFloats; ++i) a[i] = b[i] + factor * c[i];
    least_s = std::min(least_s, processor_s() - start);
    if (a[kFloats / 3] != 1.0f + 2.0f * factor) throw DataError("memory holds something else than was written");
  }
  return 4.0 * sizeof(float) * static_cast<double>(kFloats) / least_s;
}

}  // namespace tacipc::bench

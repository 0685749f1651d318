#include "bench/memory_rate.h"

#include <chrono>
#include <cstddef>
#include <limits>
#include <thread>
#include <vector>

#include "common/error.h"

namespace tacipc::bench {
namespace {

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

}  // namespace

double memory_bytes_per_s(int threads, int repeats) {
  constexpr std::size_t kFloats = std::size_t{1} << 25;  // 128 MiB each
  std::vector<float> a(kFloats, 0.0f), b(kFloats, 1.0f), c(kFloats, 2.0f);
  double least_s = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < repeats; ++repeat) {
    const float factor = static_cast<float>(repeat);
    const double start = now_s();
    std::vector<std::jthread> workers;
    for (int t = 0; t < threads; ++t) {
      workers.emplace_back([&, t] {
        const std::size_t first = kFloats / static_cast<std::size_t>(threads) * static_cast<std::size_t>(t),
                          last = t + 1 == threads ? kFloats : first + kFloats / static_cast<std::size_t>(threads);
        for (std::size_t i = first; i < last; ++i) a[i] = b[i] + factor * c[i];
      });
    }
    workers.clear();
    least_s = std::min(least_s, now_s() - start);
    if (a[kFloats / 3] != 1.0f + 2.0f * factor) throw DataError("memory holds something else than was written");
  }
  return 4.0 * sizeof(float) * static_cast<double>(kFloats) / least_s;
}

}  // namespace tacipc::bench

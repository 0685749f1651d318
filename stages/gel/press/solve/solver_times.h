// Where a press spends its time.
#pragma once

#include <chrono>
#include <cstdint>

namespace tacipc {

/// Wall seconds by part, and counts. Parts do not overlap: patches_s is all the time that patches take.
struct SolverTimes {
  double search_s = 0.0;       // broad phase
  double limits_s = 0.0;       // continuous collision detection, inversion
  double line_search_s = 0.0;  // energies
  double elastic_s = 0.0;      // elastic derivatives and their assembly
  double contact_s = 0.0;      // those of contact and friction
  double linear_s = 0.0;       // linear systems
  double patches_s = 0.0;
  std::int64_t solves = 0;    // linear systems of the whole gel,
  std::int64_t products = 0;  // and matrix–vector products for them;
  int factorised = 0;         // those where the products did not suffice
};

/// Adds the time it lives to a sum.
class Stopwatch {
 public:
  explicit Stopwatch(double& sum) : sum_(sum) {}
  ~Stopwatch() { sum_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  double& sum_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// f(), its time added to a sum.
template <typename F>
auto timed(double& sum, F&& f) {
  const Stopwatch watch(sum);
  return f();
}

}  // namespace tacipc

// Solver time by part, and work counters.
#pragma once

#include <chrono>
#include <cstdint>

namespace tacipc {

/// Wall time in seconds by part, and counts. Parts do not overlap: patches_s is all the time spent on patches.
struct SolverTimes {
  double search_s = 0.0;       // broad phase
  double limits_s = 0.0;       // continuous collision detection and inversion limits
  double line_search_s = 0.0;  // energies in the line search
  double elastic_s = 0.0;      // elastic derivatives and their assembly
  double contact_s = 0.0;      // contact and friction derivatives and their assembly
  double linear_s = 0.0;       // linear systems
  double patches_s = 0.0;      // all work on patches
  std::int64_t solves = 0;     // linear systems of the whole gel
  std::int64_t products = 0;   // matrix–vector products of these solves
  int factorised = 0;          // systems that were factorised because the products did not suffice
};

/// Adds its own lifetime, in seconds, to a sum.
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

/// Returns f() and adds its duration to a sum.
template <typename F>
auto timed(double& sum, F&& f) {
  const Stopwatch watch(sum);
  return f();
}

}  // namespace tacipc

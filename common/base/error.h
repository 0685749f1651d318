// Errors and their exit codes: 2 for wrong flags or configuration, 1 for failed work.
#pragma once

#include <fmt/core.h>

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace tacipc {

/// Wrong flags (exit code 2).
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Errors in one configuration file, each `file:line:column: path.key: reason` (exit code 2).
class ConfigError : public std::runtime_error {
 public:
  explicit ConfigError(std::vector<std::string> faults);
  const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::vector<std::string> faults_;
};

/// An input file or mesh is not valid, or an output cannot be written (exit code 1).
class DataError : public std::runtime_error {
 public:
  explicit DataError(const std::string& message) : std::runtime_error(message) {}
  template <typename... Args>
  requires(sizeof...(Args) > 0) explicit DataError(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

/// The numerical method failed: not converged, intersected, inverted (exit code 1).
class SolverError : public std::runtime_error {
 public:
  explicit SolverError(const std::string& message) : std::runtime_error(message) {}
  template <typename... Args>
  requires(sizeof...(Args) > 0) explicit SolverError(fmt::format_string<Args...> format, Args&&... args)
      : std::runtime_error(fmt::format(format, std::forward<Args>(args)...)) {}
};

/// A number of a frame that misses its limit; both in the unit of the check.
struct Miss {
  int frame = 0;
  std::string check;
  double value = 0.0;
  double limit = 0.0;
};

/// A frame was solved but does not pass its checks (exit code 1). The failure file repeats the numbers.
class VerdictError : public SolverError {
 public:
  VerdictError(Miss miss, const std::string& message) : SolverError(message), miss_(std::move(miss)) {}
  const Miss& miss() const { return miss_; }

 private:
  Miss miss_;
};

}  // namespace tacipc

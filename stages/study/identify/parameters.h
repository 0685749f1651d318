// Fitted unknowns: the sensor's mechanics, and the unknowns of each measurement.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "common/benchmark/identify_spec.h"

namespace tacipc {

/// One unknown. The fit works with u: the number itself, or its logarithm if the prior is one of the logarithm.
struct Unknown {
  std::string name;
  std::string measurement = {};  // only measurement with this unknown; empty: the unknown belongs to the sensor
  Prior prior;

  double u_of(double value) const;
  double value_of(double u) const;
  double u_mean() const { return u_of(prior.mean); }
  double u_low() const;  // −∞ if a logarithm is bounded by 0
  double u_high() const;
};

/// All unknowns in a fixed order.
class Unknowns {
 public:
  explicit Unknowns(const IdentifySpec& spec);

  Eigen::Index size() const { return std::ssize(all_); }
  const Unknown& operator[](Eigen::Index i) const { return all_[i]; }
  const std::vector<Unknown>& all() const { return all_; }
  std::optional<Eigen::Index> find(const std::string& name, const std::string& measurement = {}) const;
  /// Value of an unknown at u; `held` if it is not fitted.
  double value(const Eigen::VectorXd& u, const std::string& name, const std::string& measurement, double held) const;
  Eigen::VectorXd prior_mean() const;
  bool within_bounds(const Eigen::VectorXd& u) const;

 private:
  std::vector<Unknown> all_;
};

}  // namespace tacipc

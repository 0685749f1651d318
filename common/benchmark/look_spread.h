// How far numbers that belong to images spread over the images of a training, and how far others are from these.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/base/value.h"
#include "common/config/config.h"

namespace tacipc {

/// A mean, and the directions in which the numbers were seen to vary by more than a fifth of their unit, the smallest
/// difference that matters. Far is what goes farther along these directions than the training did, or beside them.
class LookSpread {
 public:
  struct Limits {
    double margin;        // of what a group needs whose spread was learnt without it
    double least_beside;  // beside the directions
  };
  /// Rows of numbers, by groups of images that belong together (of one sample). \pre at least one row
  static LookSpread of(const std::vector<Eigen::MatrixXd>& groups, const Limits& limits);

  /// 1: as far as numbers of the training may be.
  double distance(const Eigen::VectorXd& numbers) const;

  Value::Map to_value() const;
  /// `size`: how many numbers a row has. Faults are noted in the reader.
  static LookSpread read(ConfigReader& in, Eigen::Index size);

 private:
  struct Sums;
  struct Parts {
    double along, beside;
  };
  static LookSpread fitted(const Sums& sums);
  Parts parts_of(const Eigen::VectorXd& numbers) const;

  Eigen::VectorXd mean_;
  Eigen::MatrixXd directions_;  // columns, of length 1
  Eigen::VectorXd deviations_;  // of each
  double along_limit_ = 0.0, beside_limit_ = 0.0;
};

}  // namespace tacipc

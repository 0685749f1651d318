// Spread of per-image numbers over the training images, and the distance of other images from them.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "common/base/value.h"
#include "common/config/config.h"

namespace tacipc {

/// Mean of the training, and the directions in which its numbers vary by more than a fifth of their unit, the smallest
/// relevant difference. The distance is large for numbers beyond the training's range along these directions, or off
/// them.
class LookSpread {
 public:
  /// Limits of the distance.
  struct Limits {
    double margin;        // factor on the distance of a group from a spread that was fitted without it
    double least_beside;  // smallest limit for the distance off the directions
  };
  /// Fits a spread.
  /// \param groups rows of numbers, by groups of images that belong together (of one sample)
  /// \pre at least one row
  static LookSpread of(const std::vector<Eigen::MatrixXd>& groups, const Limits& limits);

  /// Returns the distance; 1 is the limit for images of the training.
  double distance(const Eigen::VectorXd& numbers) const;

  Value::Map to_value() const;
  /// Reads a spread. Errors are noted in the reader.
  /// \param size numbers per row
  static LookSpread read(ConfigReader& in, Eigen::Index size);

 private:
  struct Sums;
  struct Parts {
    double along, beside;
  };
  static LookSpread fitted(const Sums& sums);
  Parts parts_of(const Eigen::VectorXd& numbers) const;

  Eigen::VectorXd mean_;
  Eigen::MatrixXd directions_;  // unit columns
  Eigen::VectorXd deviations_;  // standard deviation along each
  double along_limit_ = 0.0, beside_limit_ = 0.0;
};

}  // namespace tacipc

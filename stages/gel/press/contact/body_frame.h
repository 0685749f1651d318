// Rigid frame that follows a body without a mount.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// Frame that moves with a body: its origin is the mean of the vertices, its axes are rotated by R from rest. In this
/// frame a body that deforms little stays near its rest position, however far it has moved, and distances are
/// unchanged. Straight paths stay straight: places(x + p) is places(x) + displacements(p).
struct BodyFrame {
  Matrix3 rotation = Matrix3::Identity();  // R
  Eigen::RowVector3d rest_mean_m = Eigen::RowVector3d::Zero();

  /// Positions in the frame: (x − x̄) R + X̄.
  Positions places(const Eigen::Ref<const Positions>& x) const {
    return ((x.rowwise() - x.colwise().mean()) * rotation).rowwise() + rest_mean_m;
  }
  /// Displacements in the frame: (p − p̄) R.
  Positions displacements(const Eigen::Ref<const Positions>& p) const {
    return (p.rowwise() - p.colwise().mean()) * rotation;
  }
};

/// Frame that minimises Σ |places(x) − X|² over the body's vertices with equal weights, X at rest: R is the rotation
/// nearest to Σ (x − x̄)(X − X̄)ᵀ [Kabsch 1976]. Equal rows give equal bits.
/// \pre `rest` and `x` have the same number of rows, at least one
BodyFrame body_frame(const Eigen::Ref<const Positions>& rest, const Eigen::Ref<const Positions>& x);

}  // namespace tacipc

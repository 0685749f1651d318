// Where a body that nothing holds has gone as a whole.
#pragma once

#include "common/base/types.h"

namespace tacipc {

/// A frame that goes along with a body: its origin with the mean of the vertices, its axes turned by R from rest. Seen
/// from it the body is near its place at rest while it deforms little, however far it has gone, and all distances are
/// as they are. What goes straight goes straight: places(x + p) is places(x) + displacements(p).
struct BodyFrame {
  Matrix3 rotation = Matrix3::Identity();  // R
  Eigen::RowVector3d rest_mean_m = Eigen::RowVector3d::Zero();

  /// (x − x̄) R + X̄
  Positions places(const Eigen::Ref<const Positions>& x) const {
    return ((x.rowwise() - x.colwise().mean()) * rotation).rowwise() + rest_mean_m;
  }
  /// (p − p̄) R
  Positions displacements(const Eigen::Ref<const Positions>& p) const {
    return (p.rowwise() - p.colwise().mean()) * rotation;
  }
};

/// The frame with Σ |places(x) − X|² least over the body's vertices, X at rest, each counted alike: R is the rotation
/// nearest to Σ (x − x̄)(X − X̄)ᵀ.   [Kabsch 1976] The same rows give the same bits.
/// \pre as many rows of `rest` as of `x`, one at least
BodyFrame body_frame(const Eigen::Ref<const Positions>& rest, const Eigen::Ref<const Positions>& x);

}  // namespace tacipc

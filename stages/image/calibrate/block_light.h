// Contribution of each light group to each block of a photograph, traced with one camera pixel per block.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "common/benchmark/ball_labels.h"
#include "common/benchmark/ball_press.h"
#include "common/image/image.h"
#include "common/optics/trace.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// Signal of every block, row by row, in R, G and B, with vignetting, at exposure 1. One column per light group at
/// colour 1, then one column for an ambient of 1.
using BlockLight = std::array<Eigen::MatrixXd, 3>;

/// Position of a ball's centre in frame S, and its depth.
struct BallPlace {
  double x_m = 0.0;
  double y_m = 0.0;
  double depth_m = 0.0;
};

/// Position of the ball for a label changed by offsets of centre and radius (pixels). The camera's view of centre and
/// rim on the plane z = 0 gives the position; the depth is the one at which the rim has that width.
/// \throw DataError, naming the label's image, if the camera does not see the plane there or the press does not reach
/// that contact
BallPlace ball_place(const BallPress& press, const BallLabel& label, const Eigen::Vector3d& offsets_px,
                     const Sensor& sensor);

/// Traces the light of one photograph's membrane: of the gel at rest, or under a ball.
class BlockTracer {
 public:
  /// Traces the gel at rest.
  BlockTracer(const Sensor& sensor, int block_px, const TraceSettings& settings);
  /// Traces the gel under a ball.
  /// \pre `press` outlives this object
  BlockTracer(const BallPress& press, BallLabel label, int block_px, const TraceSettings& settings);
  ~BlockTracer();
  BlockTracer(BlockTracer&&) noexcept;

  const std::optional<BallLabel>& label() const { return label_; }
  /// Light for a sensor and offsets. `key` identifies them; the light of the last two keys is cached.
  const BlockLight& light(const Eigen::VectorXd& key, const Sensor& sensor, const Eigen::Vector3d& offsets_px);
  /// For each block: true if it and its neighbours show only gel, and it shows no printed marker.
  std::vector<bool> clean_blocks(const Sensor& sensor);

 private:
  TraceResult trace_blocks(const Sensor& sensor, const Eigen::Vector3d& offsets_px);

  const BallPress* press_ = nullptr;
  std::optional<BallLabel> label_ = std::nullopt;
  int block_px_;
  TraceSettings settings_;
  Membrane membrane_;
  std::unique_ptr<RayScene> scene_;
  std::vector<std::pair<Eigen::VectorXd, BlockLight>> remembered_ = {};  // cache; the most recently used entry is last
};

}  // namespace tacipc

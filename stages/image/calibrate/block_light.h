// What each light group gives each block of a photograph, traced with a camera of one pixel per block.
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

/// Signal of every block, row by row, in R, G and B: a column for each light group at colour 1, then one for an ambient
/// of 1; vignetting is in, exposure 1.
using BlockLight = std::array<Eigen::MatrixXd, 3>;

struct BallPlace {
  double x_m = 0.0;
  double y_m = 0.0;
  double depth_m = 0.0;
};

/// Where a label, changed by offsets of centre and radius (pixels), puts the ball: centre and rim as the camera sees
/// them on the plane z = 0, and the depth at which the rim is that wide. \throw DataError, naming the label's image, if
/// the camera does not see the plane there or the press does not reach that contact.
BallPlace ball_place(const BallPress& press, const BallLabel& label, const Eigen::Vector3d& offsets_px,
                     const Sensor& sensor);

/// One photograph's membrane, of the gel at rest or under a ball.
class BlockTracer {
 public:
  /// The gel at rest.
  BlockTracer(const Sensor& sensor, int block_px, const TraceSettings& settings);
  /// Under a ball. \pre `press` lives as long as this
  BlockTracer(const BallPress& press, BallLabel label, int block_px, const TraceSettings& settings);
  ~BlockTracer();
  BlockTracer(BlockTracer&&) noexcept;

  const std::optional<BallLabel>& label() const { return label_; }
  /// `key` stands for what sensor and offsets are: of the last two keys the light is remembered.
  const BlockLight& light(const Eigen::VectorXd& key, const Sensor& sensor, const Eigen::Vector3d& offsets_px);
  /// Per block whether it and its neighbours show nothing but the gel and itself no printed marker.
  std::vector<bool> clean_blocks(const Sensor& sensor);

 private:
  TraceResult trace_blocks(const Sensor& sensor, const Eigen::Vector3d& offsets_px);

  const BallPress* press_ = nullptr;
  std::optional<BallLabel> label_ = std::nullopt;
  int block_px_;
  TraceSettings settings_;
  Membrane membrane_;
  std::unique_ptr<RayScene> scene_;
  std::vector<std::pair<Eigen::VectorXd, BlockLight>> remembered_ = {};  // the last used last
};

}  // namespace tacipc

// Estimates the cost of a planned dataset: core-hours and disk space.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/rendered_frames.h"

namespace tacipc {

/// Cost of a press on one core; bench-press fits and writes this model.
struct CostModel {
  double press_frame_s = 0.0;
  double motion_frame_s = 0.0;
  double vertices_exponent = 0.0;
  double contacts_exponent = 0.0;
  double averaged_volume_factor = 1.0;

  static CostModel read(ConfigReader& in);
};

/// Sizes of a gel and its camera that determine the cost.
struct GelSize {
  double vertices = 0.0;
  double front_vertices = 0.0;
  double pixels = 0.0;
  double poissons_ratio = 0.0;
};

/// Numbers of frames of a motion.
struct MotionLength {
  int press_frames = 0;
  int other_frames = 0;
  std::vector<std::string> kinds = {};  // kinds of the phases
};

/// Processor seconds of a sample by the model.
double modelled_seconds(const CostModel& model, const GelSize& gel, const MotionLength& motion, RenderedFrames frames);
/// Bytes of a sample on disk by the model.
double modelled_bytes(const GelSize& gel, const MotionLength& motion, RenderedFrames frames);

/// Estimated cost of all samples; times in processor seconds.
struct CostEstimate {
  std::size_t samples = 0;
  std::size_t made = 0;        // number of made samples, which the estimate uses
  std::size_t unmeasured = 0;  // samples whose gel or motion has no made sample
  double seconds = 0.0;        // time of all samples
  double seconds_spent = 0.0;  // time spent on the made samples
  double bytes = 0.0;          // size of all samples
  double bytes_left = 0.0;     // size of the samples still to come
};

/// Estimate from made samples, if there are any: the mean of their gel and motion. A gel or motion without a made
/// sample uses the model, scaled by the ratio for the made ones; without any made sample the model alone.
/// \throw DataError if a gel is not made yet
CostEstimate estimate_cost(const std::filesystem::path& dataset, const CostModel& model);

/// Lines of text about the estimate.
std::string to_text(const CostEstimate& estimate, const std::filesystem::path& dataset);

/// Folders of `count` samples, below samples/, spread over the plan by the golden ratio so that they cover all motions
/// and objects alike.
std::vector<std::string> pilot_samples(const std::filesystem::path& dataset, std::size_t count);

}  // namespace tacipc

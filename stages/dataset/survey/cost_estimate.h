// What a planned dataset will cost: core-hours and disk.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "common/config/config.h"
#include "common/sample/rendered_frames.h"

namespace tacipc {

/// What a press costs on one core; bench-press fits it and writes it down.
struct CostModel {
  double press_frame_s = 0.0;
  double motion_frame_s = 0.0;
  double vertices_exponent = 0.0;
  double contacts_exponent = 0.0;
  double averaged_volume_factor = 1.0;

  static CostModel read(ConfigReader& in);
};

/// What of a gel and its camera the cost depends on.
struct GelSize {
  double vertices = 0.0;
  double front_vertices = 0.0;
  double pixels = 0.0;
  double poissons_ratio = 0.0;
};

struct MotionLength {
  int press_frames = 0;
  int other_frames = 0;
  std::vector<std::string> kinds = {};  // of the phases
};

/// Processor seconds of a sample by the model.
double modelled_seconds(const CostModel& model, const GelSize& gel, const MotionLength& motion, RenderedFrames frames);
/// Its bytes on disk.
double modelled_bytes(const GelSize& gel, const MotionLength& motion, RenderedFrames frames);

struct CostEstimate {
  std::size_t samples = 0;
  std::size_t made = 0;        // by which it is measured
  std::size_t unmeasured = 0;  // of gels or motions of which none is made
  double seconds = 0.0;        // of all samples
  double seconds_spent = 0.0;  // of the made ones
  double bytes = 0.0;          // of all samples
  double bytes_left = 0.0;     // of those to come
};

/// From samples that are made where there are any (mean of their gel and motion), else from the model; a gel or motion
/// without a made sample gets the model, scaled as the made ones were. \throw DataError if a gel is not made yet
CostEstimate estimate_cost(const std::filesystem::path& dataset, const CostModel& model);

/// Lines that say so.
std::string to_text(const CostEstimate& estimate, const std::filesystem::path& dataset);

/// Folders below samples/ of so many samples, spread over the plan by the golden ratio so that they meet all motions
/// and objects alike.
std::vector<std::string> pilot_samples(const std::filesystem::path& dataset, std::size_t count);

}  // namespace tacipc

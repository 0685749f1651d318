// How far simulated marker vectors are from measured ones, those that were fitted and those that were not.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "stages/study/identify/fit.h"

namespace tacipc {

/// Of the vectors of a photograph, fitted or predicted: how many, the mean lengths of what was measured and of the
/// error, px, and the share of coordinates that lie in their 95 % interval.
struct MarkerErrors {
  std::string photograph;
  bool fitted = false;
  int vectors = 0;
  double measured_px = 0.0, error_px = 0.0, inside = 0.0;
};
/// By measurement, of press and shear: fitted, then predicted, each half of the markers by a fit to the other half.
std::map<std::size_t, std::vector<MarkerErrors>> all_marker_errors(MechanicsModel& model, const Posterior& posterior);

}  // namespace tacipc

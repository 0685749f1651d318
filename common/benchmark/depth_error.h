// Errors of a depth map against a reference of the same view.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "common/benchmark/metrics_rows.h"
#include "common/image/image.h"

namespace tacipc {

/// With a, b the depths of map and reference (m along the camera's axis), r those of the gel at rest, means over the
/// pixels of a region.
struct DepthError {
  std::size_t pixels = 0;
  double mae_m = 0.0;     // mean |a − b|
  double mse_m2 = 0.0;    // mean (a − b)²
  double max_m = 0.0;     // max |a − b|
  double mae_norm = 0.0;  // mae over the reference's deepest press, max (r − b) of the whole image
  double mse_norm = 0.0;  // mse over its square
  double slope_ratio =
      0.0;  // √(Σ |∇a|² / Σ |∇b|²): below 1 the map is smoother than the reference; NaN where b is flat
  double iou = 0.0;  // pixels pressed in both over pixels pressed in either, of the whole image; NaN if there are none
};

struct DepthErrors {
  DepthError full;
  DepthError pressed;                      // where the reference is pressed
  std::optional<DepthError> contact = {};  // where the reference lies on the object's surface
  std::optional<DepthError> beside = {};   // not there, but near; without that surface: not pressed, but near
};

struct DepthRegions {
  double pressed_m = 0.0;  // a pixel is pressed where the membrane came nearer than at rest by more than this
  double contact_m = 0.0;  // and in contact where the object's surface would press it, and is this near to it
  int beside_px = 0;       // near: at most so many columns and rows away; 0: there is no such region
};

/// Its row in a table, in mm.
MetricsRow row_of(const std::string& name, const char* region, const DepthError& error);

/// Pixels that are NaN in map, reference or rest do not count; slopes are differences of neighbours to the right and
/// below, in m per pixel. `surface` is the depth of the rigid object where it is in the gel, else of the gel at rest
/// (`baseline` without deformation); null: no region `contact`. \pre maps of equal size. \throw DataError if no pixel
/// counts, the reference is pressed nowhere, or lies nowhere on the surface
DepthErrors depth_errors(const FloatImage& map, const FloatImage& reference, const FloatImage& rest,
                         const DepthRegions& regions, const FloatImage* surface = nullptr);

}  // namespace tacipc

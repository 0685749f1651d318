// Errors of a depth map against a reference of the same view.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "common/benchmark/metrics_rows.h"
#include "common/image/image.h"

namespace tacipc {

/// Errors over the pixels of a region. a and b are the depths of map and reference (m along the camera's axis), r the
/// depth of the gel at rest.
struct DepthError {
  std::size_t pixels = 0;
  double mae_m = 0.0;     // mean |a − b|
  double mse_m2 = 0.0;    // mean (a − b)²
  double max_m = 0.0;     // max |a − b|
  double mae_norm = 0.0;  // mae over the reference's deepest indentation, max (r − b) over the whole image
  double mse_norm = 0.0;  // mse over the square of that indentation
  double slope_ratio = 0.0;  // √(Σ |∇a|² / Σ |∇b|²): below 1 the map is smoother than the reference; NaN if b is flat
  double iou = 0.0;          // pixels pressed in both over pixels pressed in either, whole image; NaN if there are none
};

/// Errors by region.
struct DepthErrors {
  DepthError full;
  DepthError pressed;                      // region in which the reference is pressed
  std::optional<DepthError> contact = {};  // region in which the reference touches the object's surface
  std::optional<DepthError> beside = {};   // near the contact (without the surface: the pressed region), outside it
};

/// Definition of the regions.
struct DepthRegions {
  double pressed_m = 0.0;  // a pixel is pressed if its depth is smaller than at rest by more than this
  double contact_m = 0.0;  // a pixel is in contact if the object's surface would press it and is this near
  int beside_px = 0;       // largest distance in columns and rows that counts as near; 0: no such region
};

/// Returns the errors as a row of a table, in mm.
MetricsRow row_of(const std::string& name, const char* region, const DepthError& error);

/// Compares a depth map with a reference. Pixels that are NaN in map, reference or rest are ignored; slopes are
/// differences of neighbours to the right and below, in m per pixel.
/// \param surface depth of the rigid object inside the gel, elsewhere of the gel at rest (`baseline` without
/// deformation); null: no region `contact`
/// \pre maps of equal size
/// \throw DataError if no pixel counts, or the reference is pressed nowhere or touches the surface nowhere
DepthErrors depth_errors(const FloatImage& map, const FloatImage& reference, const FloatImage& rest,
                         const DepthRegions& regions, const FloatImage* surface = nullptr);

}  // namespace tacipc

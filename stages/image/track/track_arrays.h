// Arrays that track writes.
#pragma once

#include "common/format/npy_field.h"

namespace tacipc {

/// Marker positions per frame.
inline const NpyField& marker_track_field() {
  static const NpyField kField{
      .file = "marker_track.npy",
      .type = NpyType::f8,
      .shape = {"frames", "#M", 2},
      .unit = "px",
      .meaning = "column and row of each marker found in the images; pixel (0, 0) spans 0 … 1; NaN where it is lost",
      .finite = false};
  return kField;
}

/// Values of TrackQuality.
inline const NpyField& marker_quality_field() {
  static const NpyField kField{.file = "marker_quality.npy",
                               .type = NpyType::u1,
                               .shape = {"frames", "#M"},
                               .unit = "code",
                               .meaning = "0 lost, 1 by optical flow alone, 2 centre of the dot"};
  return kField;
}

}  // namespace tacipc

// Data of every sample for a dataset's pages: its state, a few numbers, its cost.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/base/types.h"
#include "common/sample/dataset_plan.h"
#include "common/sample/sample_status.h"
#include "common/stage/record.h"
#include "common/stage/stage_timings.h"

namespace tacipc {

/// Numbers of a sample, each the largest over its frames unless noted.
struct SampleNumbers {
  std::optional<double> depth_mm = std::nullopt;  // indentation visible to the camera
  std::optional<double> press_force_n = std::nullopt;
  std::optional<double> tangential_force_n = std::nullopt;
  std::optional<double> shear_ratio = std::nullopt;  // tangential over press force, if the press force is above 1 %
  std::optional<double> twist_deg = std::nullopt;    // rotation about z since the first frame, with its sign
  std::optional<double> area_mm2 = std::nullopt;     // contact area
  std::optional<double> balance_relative = std::nullopt;
  std::optional<double> min_distance_m = std::nullopt;  // smallest value, also of the next member
  std::optional<double> min_volume_ratio = std::nullopt;
};

/// Reads timings; nothing if there is no such file.
/// \throw DataError if it is malformed
std::optional<StageTimings> timings_if_there(const std::filesystem::path& file);

/// One sample as the dataset's pages list it.
struct SampleRow {
  PlannedRow plan;
  SampleStatus status = SampleStatus::unmade;
  std::optional<Failure> failure = std::nullopt;  // failure of a failed sample
  bool dropped = false;                           // files of a stage were removed after packing
  SampleNumbers numbers;
  std::string outcome = {}, reason = {};  // labels of a made finger of a grasp; `reason` for any outcome except lifted
  std::optional<StageTimings> press = std::nullopt, render = std::nullopt;
};

/// Reads the records of a sample and judges them again. A made sample whose records cannot be read, or fail a check,
/// counts as failed.
SampleRow read_row(const PlannedRow& plan, const std::filesystem::path& dataset, SampleStatus status);

/// Rotation about z from the first to another pose (`gel_from_object`), degrees in (−180, 180]. It is the rotation
/// about z that leaves the least remaining rotation: atan2(R₁₀ − R₀₁, R₀₀ + R₁₁) of R = R₂ R₁ᵀ; 0 if only rounding is
/// left.
double turn_about_z_deg(const Matrix4& first, const Matrix4& second);

}  // namespace tacipc

// What a dataset's page knows of every sample: its state, a few numbers, its cost.
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

/// Each is the largest over the frames of the sample.
struct SampleNumbers {
  std::optional<double> depth_mm = std::nullopt;  // into the gel, where the camera sees it
  std::optional<double> press_force_n = std::nullopt;
  std::optional<double> tangential_force_n = std::nullopt;
  std::optional<double> shear_ratio = std::nullopt;  // tangential over press force, where the latter is above 1 %
  std::optional<double> twist_deg = std::nullopt;    // turn about z since the first frame, with its sign
  std::optional<double> area_mm2 = std::nullopt;     // of contact
  std::optional<double> balance_relative = std::nullopt;
  std::optional<double> min_distance_m = std::nullopt;  // these two: the smallest
  std::optional<double> min_volume_ratio = std::nullopt;
};

/// Nothing if there is no such file. \throw DataError if it is malformed
std::optional<StageTimings> timings_if_there(const std::filesystem::path& file);

struct SampleRow {
  PlannedRow plan;
  SampleStatus status = SampleStatus::unmade;
  std::optional<Failure> failure = std::nullopt;  // of a failed one
  bool dropped = false;                           // files of a stage were removed after packing
  SampleNumbers numbers;
  std::string outcome = {}, reason = {};  // labels of a made finger of a grasp; reason: of any outcome but lifted
  std::optional<StageTimings> press = std::nullopt, render = std::nullopt;
};

/// Reads the records of a sample and judges them again. A made sample whose records cannot be read, or miss a check,
/// comes back as a failed one.
SampleRow read_row(const PlannedRow& plan, const std::filesystem::path& dataset, SampleStatus status);

/// Turn about z from the first to another pose (`gel_from_object`), degrees in (−180, 180]: the angle by
/// which the turn between them would have to be undone for the least rest, atan2(R₁₀ − R₀₁, R₀₀ + R₁₁) of R = R₂ R₁ᵀ; 0
/// where only rounding is left.
double turn_about_z_deg(const Matrix4& first, const Matrix4& second);

}  // namespace tacipc

// Counts a dataset's samples and collects their numbers, a few dozen bytes per sample.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "stages/dataset/report/dataset/coverage.h"
#include "stages/dataset/report/dataset/sample_row.h"

namespace tacipc {

/// Quantity whose coverage is shown.
struct Quantity {
  const char* name;
  const char* unit;  // empty: no unit
  const char* meaning;
  std::optional<double> SampleNumbers::*number;

  std::string label() const { return unit[0] == '\0' ? name : std::string(name) + " (" + unit + ")"; }
};
inline constexpr std::array<Quantity, 5> kQuantities{{
    {"depth", "mm", "deepest indentation that the camera sees", &SampleNumbers::depth_mm},
    {"press force", "N", "into the gel", &SampleNumbers::press_force_n},
    {"shear ratio", "", "tangential over press force", &SampleNumbers::shear_ratio},
    {"twist", "°", "turn of the object about z since the first frame", &SampleNumbers::twist_deg},
    {"contact area", "mm²", "of the front face that feels the object", &SampleNumbers::area_mm2},
}};
inline constexpr std::size_t kDepth = 0, kPressForce = 1, kShearRatio = 2, kTwist = 3,
                             kArea = 4;  // indices in kQuantities

/// Number of samples by status.
struct StatusCounts {
  std::array<std::size_t, 4> of{};

  std::size_t operator[](SampleStatus status) const { return of[static_cast<std::size_t>(status)]; }
  std::size_t total() const { return of[0] + of[1] + of[2] + of[3]; }
};

/// Costs of one stage over many samples.
struct CostColumn {
  std::vector<double> wall_s, processor_s, memory_mb;
  void add(const StageTimings& cost);
};

/// A failed sample and its failure.
struct FailedSample {
  PlannedRow plan;
  Failure failure;
};

/// Counts samples and collects their numbers, one sample at a time.
class DatasetTally {
 public:
  /// \param kept_failures number of failed samples to keep; further ones are only counted
  explicit DatasetTally(std::size_t kept_failures) : kept_failures_(kept_failures) {}
  void add(const SampleRow& row);

  /// Values of a quantity over made samples that have it, by the word of a column.
  std::map<std::string, std::vector<double>> values(std::size_t quantity, const std::string& column) const;
  /// Values of two quantities over made samples that have both.
  std::pair<std::vector<double>, std::vector<double>> pairs(std::size_t first, std::size_t second) const;

  StatusCounts all;
  std::size_t dropped = 0;
  /// Counts by column ("split", "pose split", "gel", "object", "motion") and word.
  std::map<std::string, std::map<std::string, StatusCounts>> counts;
  CostColumn press, render;
  std::vector<FailedSample> failures;
  std::map<std::string, std::size_t> failures_by_kind;  // number of failures by stage and check
  /// Extremes over all made samples.
  std::optional<double> worst_balance, smallest_distance_m, smallest_volume_ratio;

 private:
  /// Words of a column as numbers, and the number of each made sample.
  struct Words {
    std::map<std::string, std::uint32_t> number;
    std::vector<std::uint32_t> of_sample;
    void add(const std::string& word);
  };

  std::size_t kept_failures_;
  std::map<std::string, Words> words_;                           // words of made samples, by column
  std::array<std::vector<double>, kQuantities.size()> numbers_;  // numbers of made samples; NaN if missing
};

/// Name of a gel as in the plan: sensor and mesh.
inline std::string gel_of(const PlannedRow& plan) { return plan.sensor + "-" + plan.mesh; }

}  // namespace tacipc

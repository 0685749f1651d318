// Labels of a press whose uncertainty an ensemble gives: for the sample, its members, and a coarser gel.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/sample/ensemble.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"

namespace tacipc {

enum class EnsembleLabel { press_force, tangential_force, torque, contact_area, deepest_indentation, object_depth };

/// Labels of one press, in SI units except the area in mm².
class LabelledPress {
 public:
  /// \param object_m vertices of the object in its own frame, m
  /// \throw DataError if the press is not finished
  LabelledPress(std::filesystem::path folder, const Positions& object_m);

  std::size_t frames() const { return per_frame_.size(); }
  bool mount_gives_way() const { return arrays_.has(PressArray::holder_pose); }
  /// Value of a label: one number, for the torque three.
  std::vector<double> label(EnsembleLabel label, std::size_t frame) const;

 private:
  std::vector<RecordLines<PressFrameLines>> per_frame_;
  PressFolder arrays_;
  const Positions& object_m_;
  std::vector<int> front_;
  Positions rest_m_;
};

/// Presses of the ensemble for one sample. Standard deviations are sample deviations over n members, with n − 1.
class EnsembleLabels {
 public:
  /// \throw DataError if a press has other frames than the sample, or its files were dropped
  EnsembleLabels(const DatasetEnsemble& ensemble, const std::filesystem::path& sample_folder,
                 const std::filesystem::path& object_mesh);
  EnsembleLabels(const EnsembleLabels&) = delete;
  EnsembleLabels& operator=(const EnsembleLabels&) = delete;

  const std::vector<std::string>& made() const { return made_; }        // members that count
  const std::vector<std::string>& missing() const { return missing_; }  // presses that failed or are missing
  const DatasetEnsemble& ensemble() const { return ensemble_; }

  /// Label of the sample itself.
  std::vector<double> label(EnsembleLabel label, std::size_t frame) const { return sample_->label(label, frame); }
  /// Standard deviation over the members; nothing for fewer than two members.
  std::optional<std::vector<double>> sigma(EnsembleLabel label, std::size_t frame) const;
  /// Label of the same sensor in the members' mesh minus that of the sample; nothing if that press is missing.
  std::optional<std::vector<double>> mesh_difference(EnsembleLabel label, std::size_t frame) const;
  bool any_mount_gives_way() const;

 private:
  DatasetEnsemble ensemble_;
  Positions object_m_;
  std::optional<LabelledPress> sample_, nominal_;
  std::vector<LabelledPress> members_;
  std::vector<std::string> made_, missing_;
};

}  // namespace tacipc

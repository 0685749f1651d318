// Reads a finished sample frame by frame: results of press and render, checked against their records.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/image/image.h"
#include "common/sample/press_folder.h"
#include "common/sample/press_record.h"
#include "common/sample/render_folder.h"
#include "common/sample/scene_folder.h"
#include "common/sensor/sensor.h"
#include "common/stage/record.h"
#include "stages/dataset/pack/ensemble_labels.h"

namespace tacipc {

/// Numbers of one frame, row-major, in SI units or 8-bit values.
struct Numbers {
  std::vector<std::size_t> shape;
  std::vector<double> values;
};

/// Contact on the front of a finger in one frame: for each vertex the length of the normal force (N) and the state.
struct FingerFront {
  Eigen::VectorXd normal_n;
  std::vector<ContactState> states;
};

/// Reason why a field is missing.
struct Absent {
  std::string reason;
};

using FieldData = std::variant<Numbers, FloatImage, ByteImage, Absent>;

/// Frames of a sample. Pictures come from the folder of the variant set by look_at; empty: from the sensor itself.
class SampleFrames {
 public:
  /// \throw DataError if a record is missing or malformed, the images belong to another press or sensor, or frame 0 has
  /// no image
  explicit SampleFrames(std::filesystem::path folder);

  /// Frames of the press that have images, ascending, starting with 0. Frame i of the packed sample is frames()[i].
  const std::vector<std::size_t>& frames() const { return frames_; }
  std::size_t press_frames() const { return per_frame_.size(); }
  const std::vector<std::string>& variants() const { return variants_; }
  void look_at(const std::string& variant) { variant_ = variant; }
  bool in_variant() const { return !variant_.empty(); }

  const Record& press() const { return press_; }
  const Record& render() const { return render_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// File passed to press by a flag ("sensor", "gel", "object", "sample").
  std::filesystem::path press_input(const std::string& flag) const;
  /// Text of a configuration that press or render used.
  /// \throw DataError if it has changed since
  std::string config_text(const std::string& stage, const std::string& flag) const;
  const Sensor& sensor() const { return sensor_; }

  /// Channels of a frame's image; Absent with `reason` if there is no such file.
  FieldData image(std::size_t frame, FrameFile file, const std::string& reason);
  /// Column and row of each marker, shape (markers, 2).
  FieldData marker_px(std::size_t frame, const std::string& reason);
  /// Arrays of the press.
  const PressFolder& arrays() const { return arrays_; }
  RecordLines<PressSummary> press_summary() const { return summary_of<PressSummary>(press_); }
  /// Record of the grasp of which the sample is a finger.
  const std::optional<Record>& grasp() const { return grasp_; }
  /// \pre grasp()
  RecordLines<GraspSummary> grasp_summary() const { return summary_of<GraspSummary>(*grasp_); }
  /// Slip times of this finger.
  /// \pre grasp()
  RecordLines<SlipLines> slip() const {
    return grasp_summary().section(is_right_finger() ? &GraspSummary::slip_right : &GraspSummary::slip_left);
  }
  /// A number of the frame in the grasp's record.
  /// \pre grasp()
  template <typename T>
  double grasp_number(std::size_t frame, T GraspFrameLines::*number) const {
    return grasp_per_frame_[frame].number(number);
  }
  bool is_right_finger() const { return folder_.filename() == "right"; }
  /// Arrays of the grasp.
  /// \pre grasp()
  const ArrayFolder& grasp_arrays() const { return *grasp_arrays_; }
  /// Contact of the left (0) or right (1) finger of the grasp.
  /// \pre grasp()
  FingerFront finger_front(std::size_t side, std::size_t frame) const;
  /// A number of the frame in the press's record.
  template <typename T>
  double press_number(std::size_t frame, T PressFrameLines::*number) const {
    return per_frame_[frame].number(number);
  }
  template <typename T>
  std::optional<double> find_press_number(std::size_t frame, T PressFrameLines::*number) const {
    return per_frame_[frame].find(number);
  }
  /// Adds the presses of an ensemble for this sample.
  /// \throw DataError as EnsembleLabels
  void add_ensemble(const DatasetEnsemble& ensemble);
  /// \pre add_ensemble
  const EnsembleLabels& ensemble() const { return *ensemble_; }
  bool has_ensemble() const { return ensemble_ != nullptr; }
  /// Triangles of the front, as indices of its own vertices.
  Numbers front_triangles();

 private:
  std::optional<std::filesystem::path> picture(std::size_t frame, const std::string& name);

  std::filesystem::path folder_;
  Record press_;
  Record render_;
  std::map<std::string, std::string> picture_hashes_;
  std::vector<RecordLines<PressFrameLines>> per_frame_;
  std::optional<Record> grasp_;
  std::vector<RecordLines<GraspFrameLines>> grasp_per_frame_;
  std::optional<ArrayFolder> grasp_arrays_;
  std::optional<PressFolder> other_finger_;
  PressFolder arrays_;
  std::vector<std::size_t> frames_;
  std::vector<std::string> variants_;
  std::string variant_;
  Sensor sensor_;
  std::unique_ptr<EnsembleLabels> ensemble_;
};

}  // namespace tacipc

// All data of one sample for the page, collected from the records of its stages.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/image/image.h"
#include "stages/dataset/report/markers.h"
#include "stages/dataset/report/motion.h"
#include "stages/dataset/report/verdict.h"

namespace tacipc {

/// One saved frame of the press. Values that older records lack are optional.
struct FrameReport {
  std::optional<double> depth_m = std::nullopt;  // depth of the object's lowest point below z = 0; negative above
  double press_force_n = 0.0;
  int newton_iterations = 0;
  std::optional<double> min_gap_m = std::nullopt;  // absent if nothing was near
  double min_volume_ratio = 1.0;
  std::optional<double> time_s = std::nullopt;
  std::string phase = {};
  std::optional<double> tangential_force_n = std::nullopt;
  std::optional<double> torque_z_n_m = std::nullopt;  // torque on the gel about the z axis of S
  std::optional<double> balance_n = std::nullopt;
  std::optional<double> balance_relative = std::nullopt;
  std::optional<double> contact_area_mm2 = std::nullopt;
  std::optional<double> mean_pressure_pa = std::nullopt;
  std::optional<double> peak_pressure_pa = std::nullopt;
  std::optional<double> pose_error_m = std::nullopt;
  std::optional<int> sticking = std::nullopt;
  std::optional<int> slipping = std::nullopt;
  std::optional<int> substeps = std::nullopt;
};

/// Placement of the object above the gel; grasps have none.
struct PlacementReport {
  std::string face;    // side of the object that presses
  std::string chosen;  // origin of that choice
  double rotate_deg = 0.0;
  double center_x_mm = 0.0;
  double center_y_mm = 0.0;
};

/// Result of the decimation.
struct DecimateReport {
  std::optional<int> vertices_in;
  std::optional<int> vertices_out;
  std::optional<double> hausdorff_mm;
  bool passed_through = false;                        // the mesh was already small enough
  std::vector<std::pair<std::string, int>> findings;  // repairs made and defects left, if they occurred
};

/// Pictures of the last frame, and of the gel without contact. A map is represented by its preview. If a dataset has no
/// previews, it is the map itself (EXR); absent if the dataset also has no maps.
struct SampleImages {
  std::filesystem::path tactile, no_contact;
  std::optional<std::filesystem::path> indentation = std::nullopt, normal = std::nullopt;
  std::optional<std::filesystem::path> markers = std::nullopt;  // tactile image with printed markers
};

/// True if a page can show the file as it is.
inline bool is_picture(const std::filesystem::path& file) { return file.extension() != ".exr"; }
/// Reads one of these images as a picture, also a map.
ByteImage read_picture(const std::filesystem::path& file);

/// A tactile image from the middle of a motion.
struct PhaseImage {
  std::string phase;
  int frame = 0;
  std::filesystem::path tactile;
};

/// All data of one sample.
struct SampleReport {
  std::filesystem::path folder;
  std::string name;
  std::string object;                  // empty if unknown
  std::optional<std::string> failure;  // reason of the failure; absent: passed
  std::vector<std::string> warnings;

  std::string motion;                        // requested motion as text
  std::optional<double> depth_m;             // depth at the end of the press
  std::optional<double> press_force_n;       // force in the last frame
  std::optional<double> tangential_force_n;  // force in the last frame
  std::optional<int> contact_frames;         // number of frames in which something touches the gel
  std::optional<double> min_distance_m;
  std::optional<double> min_volume_ratio;
  std::optional<int> newton_iterations;
  std::optional<int> gel_vertices;
  std::optional<double> friction_coefficient;
  std::optional<double> first_slip_time_s;
  std::optional<double> gross_slip_time_s;
  std::optional<double> balance_limit;  // limit of the contact force's balance in the verdict
  std::string element;                  // empty if unknown
  std::optional<int> press_end_frame;
  std::optional<PlacementReport> placement;
  std::vector<FrameReport> frames;
  std::vector<PhaseReport> phases;
  std::vector<CheckReport> checks;  // checks; for a press that failed one, only that check
  std::vector<MarkerPicture> marker_pictures;

  std::optional<DecimateReport> decimate;
  std::optional<std::filesystem::path> sides;  // picture of the six sides of the object

  std::optional<bool> synthetic_reference;
  std::optional<double> max_indentation_m;
  std::optional<SampleImages> images;
  std::vector<PhaseImage> phase_images;

  std::string film = {};  // HTML of an animation, if all frames were rendered
  std::string view = {};  // position on the page of the 3-D view; empty if there is none

  std::vector<std::pair<std::string, std::filesystem::path>> records;  // label and path of existing files
  std::vector<std::pair<std::string, std::filesystem::path>> data;

  bool passed() const { return !failure; }
};

/// Reads DIR/press and DIR/render, and the record of the object. A sample with missing or broken data counts as failed,
/// with the data that could be read.
/// \throw DataError if the folder is not a sample's
SampleReport read_sample(const std::filesystem::path& folder);

/// Marks the sample as failed, without pictures, because a picture cannot be read.
void leave_out_pictures(SampleReport& sample, const std::string& why);

}  // namespace tacipc

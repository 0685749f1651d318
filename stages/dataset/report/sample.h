// What there is to say about one sample, gathered from the records of its stages.
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

/// One saved instant of the press. What older records lack is optional.
struct FrameReport {
  std::optional<double> depth_m = std::nullopt;  // of the object's lowest point below z = 0; negative while it is above
  double press_force_n = 0.0;
  int newton_iterations = 0;
  std::optional<double> min_gap_m = std::nullopt;  // absent where nothing was near
  double min_volume_ratio = 1.0;
  std::optional<double> time_s = std::nullopt;
  std::string phase = {};
  std::optional<double> tangential_force_n = std::nullopt;
  std::optional<double> torque_z_n_m = std::nullopt;  // on the gel about the z axis of S
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

/// How the object stands over the gel; nothing of a grasp.
struct PlacementReport {
  std::string face;    // side that presses
  std::string chosen;  // who chose it
  double rotate_deg = 0.0;
  double center_x_mm = 0.0;
  double center_y_mm = 0.0;
};

/// Result of the decimation.
struct DecimateReport {
  std::optional<int> vertices_in;
  std::optional<int> vertices_out;
  std::optional<double> hausdorff_mm;
  bool passed_through = false;                        // small enough as it was
  std::vector<std::pair<std::string, int>> findings;  // repairs made and faults left, those that occurred
};

/// Pictures of the last frame, and of the gel without contact. Of a map that is its preview; the map itself (EXR) where
/// a dataset wants no preview, and nothing where it does not want the map either.
struct SampleImages {
  std::filesystem::path tactile, no_contact;
  std::optional<std::filesystem::path> indentation = std::nullopt, normal = std::nullopt;
  std::optional<std::filesystem::path> markers = std::nullopt;  // the tactile image with printed markers
};

/// Whether a page can show the file as it is.
inline bool is_picture(const std::filesystem::path& file) { return file.extension() != ".exr"; }
/// One of them as a picture, whatever it is.
ByteImage read_picture(const std::filesystem::path& file);

/// A tactile image from the middle of a motion.
struct PhaseImage {
  std::string phase;
  int frame = 0;
  std::filesystem::path tactile;
};

struct SampleReport {
  std::filesystem::path folder;
  std::string name;
  std::string object;                  // empty if not known
  std::optional<std::string> failure;  // why the sample failed; absent: passed
  std::vector<std::string> warnings;

  std::string motion;                        // what was asked for, in words
  std::optional<double> depth_m;             // at the end of the press
  std::optional<double> press_force_n;       // in the last frame
  std::optional<double> tangential_force_n;  // in the last frame
  std::optional<int> contact_frames;         // in which anything touches the gel
  std::optional<double> min_distance_m;
  std::optional<double> min_volume_ratio;
  std::optional<int> newton_iterations;
  std::optional<int> gel_vertices;
  std::optional<double> friction_coefficient;
  std::optional<double> first_slip_time_s;
  std::optional<double> gross_slip_time_s;
  std::optional<double> balance_limit;  // of the contact force, as the press was judged
  std::string element;                  // empty if not known
  std::optional<int> press_end_frame;
  std::optional<PlacementReport> placement;
  std::vector<FrameReport> frames;
  std::vector<PhaseReport> phases;
  std::vector<CheckReport> checks;  // of a press that failed one: that
  std::vector<MarkerPicture> marker_pictures;

  std::optional<DecimateReport> decimate;
  std::optional<std::filesystem::path> sides;  // picture of what each side of the object shows

  std::optional<bool> synthetic_reference;
  std::optional<double> max_indentation_m;
  std::optional<SampleImages> images;
  std::vector<PhaseImage> phase_images;

  std::string film = {};  // HTML of a moving picture, where all frames were rendered
  std::string view = {};  // in 3-D: where on the view's page; empty if there is none

  std::vector<std::pair<std::string, std::filesystem::path>> records;  // label and file, those that exist
  std::vector<std::pair<std::string, std::filesystem::path>> data;

  bool passed() const { return !failure; }
};

/// Reads DIR/press and DIR/render, and the record beside the object. A sample of which something is missing or broken
/// comes back as a failed one, with what could be read of it. \throw DataError if the folder is not a sample's.
SampleReport read_sample(const std::filesystem::path& folder);

/// Of a picture that cannot be read: the sample is a failed one, without pictures.
void leave_out_pictures(SampleReport& sample, const std::string& why);

}  // namespace tacipc

// Marker motion while an object is moved sideways or turned, by the press or by any simulator that writes the same
// arrays.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/config.h"

namespace tacipc::verify {

/// A block of the marker grid, bounds inclusive, counted from 0 at the smallest y and x.
struct MarkerChoice {
  int first_row = 0, last_row = 0;
  int first_column = 0, last_column = 0;

  static MarkerChoice read(ConfigReader& in);
  bool has(int row, int column) const {
    return row >= first_row && row <= last_row && column >= first_column && column <= last_column;
  }
};

/// Displacements of all markers. Entry 0 is the end of the press.
struct MarkerMotion {
  std::string name;
  int press_end_frame = 0;
  bool turns = false;                     // true: the object turns; false: it moves sideways
  std::vector<double> way;                // travel of the object, m, or rad if it turns
  std::vector<Eigen::Matrix2Xd> markers;  // displacement in x and y since the end of the press, m, per frame
  std::vector<Eigen::Matrix2Xd>
      carried;            // displacement that every marker would have if it moved with the object, m, per frame
  Eigen::Matrix2Xd rest;  // marker positions in frame 0, m
  std::vector<int> rows, columns;  // row and column of each marker
};

/// Reads markers and poses of a press folder.
/// \param frames number of frames in the folder
/// \param press_end frame at which the press ends
/// \throw DataError if the object does not move after the press, or files do not fit together
MarkerMotion read_marker_motion(const std::filesystem::path& folder, const std::string& name, std::size_t frames,
                                std::size_t press_end);

/// Reads the motion of another simulator. Frames and the end of the press (the last frame of that phase) come from its
/// phases; the name is that of its record, <name>.yaml, otherwise that of the folder.
/// \throw DataError if nothing follows the press, the object does not move, or files do not fit together
MarkerMotion read_other_motion(const std::filesystem::path& folder);

/// Mean displacement length of the chosen markers, m, per frame.
/// \throw DataError if none of them exists
std::vector<double> mean_displacements(const MarkerMotion& motion, const MarkerChoice& chosen);
/// Mean displacement length that the chosen markers would have if they moved with the object, m, per frame.
std::vector<double> mean_of_carried(const MarkerMotion& motion, const MarkerChoice& chosen);

/// Compares the final displacements of another simulator's chosen markers with those of TacIPC at the same rows and
/// columns.
struct MotionComparison {
  double mean_m = 0.0;     // mean displacement of the other simulator at equal travel, m
  double ratio = 0.0;      // `mean_m` over the mean displacement of TacIPC
  double error_m = 0.0;    // mean length of the difference at equal travel, m
  double largest_m = 0.0;  // largest length of the difference, m
};

/// Compares both at the travel of the last frame of `ours`; the other motion is interpolated there.
/// \throw DataError if the other motion is shorter, or lacks a marker of a chosen row and column
MotionComparison compare(const MarkerMotion& ours, const MarkerMotion& other, const MarkerChoice& chosen);

/// Plot of the markers in the last frame, in the style of the paper: a dot at each position at rest and a line from it,
/// green for the chosen markers; the mean displacement stands below. Lines are enlarged such that a displacement of
/// `longest_m` is twice as long as the grid's width over its markers in a row.
/// \param longest_m default: the longest displacement of this motion, m
std::string marker_quiver_svg(const MarkerMotion& motion, const MarkerChoice& chosen,
                              std::optional<double> longest_m = std::nullopt);
/// Longest displacement in the last frame, m.
double longest_displacement(const MarkerMotion& motion);

/// CSV of every marker in every frame from the end of the press, with the columns
/// frame,marker,row,column,x_mm,y_mm,dx_um,dy_um.
std::string marker_vectors_csv(const MarkerMotion& motion);

}  // namespace tacipc::verify

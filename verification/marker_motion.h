// Motion of markers while an object is dragged or turned, of our press or of any simulator that writes the same arrays.
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

/// Frames count from the end of the press, entry 0.
struct MarkerMotion {
  std::string name;
  int press_end_frame = 0;
  bool turns = false;                     // the object is turned; else it is dragged
  std::vector<double> way;                // of the object: m, or rad if it turns
  std::vector<Eigen::Matrix2Xd> markers;  // displacement in x and y since the end of the press, m, per frame
  std::vector<Eigen::Matrix2Xd> carried;  // the same as if every marker had moved with the object
  Eigen::Matrix2Xd rest;                  // of each marker in frame 0, m
  std::vector<int> rows, columns;         // of each marker
};

/// Reads the markers and poses of a press folder with so many frames, whose press ends at `press_end`. \throw DataError
/// if the object does not move after it, or files do not fit together
MarkerMotion read_marker_motion(const std::filesystem::path& folder, const std::string& name, std::size_t frames,
                                std::size_t press_end);

/// The same of another simulator: frames and the end of the press (the last frame of that phase) from its phases, the
/// name that of its record, <name>.yaml, else of the folder. \throw DataError also if nothing follows the press
MarkerMotion read_other_motion(const std::filesystem::path& folder);

/// Mean length of the chosen markers' displacement, m, per frame. \throw DataError if none of them is there
std::vector<double> mean_displacements(const MarkerMotion& motion, const MarkerChoice& chosen);
/// The same as if they had moved with the object.
std::vector<double> mean_of_carried(const MarkerMotion& motion, const MarkerChoice& chosen);

/// Another simulator's chosen markers at the end against ours of the same row and column.
struct MotionComparison {
  double mean_m = 0.0;     // of theirs, in their last frame
  double ratio = 0.0;      // to ours
  double error_m = 0.0;    // mean length of the difference, theirs where its object has gone as far as ours in the end
  double largest_m = 0.0;  // largest such length
};

/// The result is interpolated at the travel of our last frame. \throw DataError if the other does not go as
/// far, or has no marker of a chosen row and column
MotionComparison compare(const MarkerMotion& ours, const MarkerMotion& other, const MarkerChoice& chosen);

/// The markers in the last frame as the paper draws them: lines from where they were at rest, there a dot, green for
/// the chosen ones; the mean displacement below. Lines are enlarged so that one of `longest_m` is twice as long as the
/// grid is wide over its markers in a row; without it, the longest line there is.
std::string marker_quiver_svg(const MarkerMotion& motion, const MarkerChoice& chosen,
                              std::optional<double> longest_m = std::nullopt);
/// Length of the longest displacement in the last frame, m.
double longest_displacement(const MarkerMotion& motion);

/// frame,marker,row,column,x_mm,y_mm,dx_um,dy_um: every marker in every frame from the end of the press.
std::string marker_vectors_csv(const MarkerMotion& motion);

}  // namespace tacipc::verify

// Contact circles detected in photographs of ball presses: a table with one row per photograph.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/benchmark/ball_labels.h"
#include "common/config/config.h"

namespace tacipc {

/// Columns of the table, and the division of its photographs into calibration and test.
struct CircleTable {
  std::string image, diameter_mm, x_px, y_px, radius_px;  // names of columns
  std::string leave_out;                                  // column that is 0 in rows to use; other rows are ignored
  int calibrate_every = 0;  // period of calibration rows: the first of each group calibrates, the others are tested
  double box_radii = 0.0;   // half the width of the contact box over the circle's radius
  double background_radii = 0.0;  // distance from the centre, in radii, beyond which a photograph shows no contact
  std::array<int, 2> image_px{};  // width and height

  static CircleTable read(ConfigReader& in);
};

/// Reads the rows in use of balls of this radius, in the order of the table.
/// \throw DataError `FILE: …` if there is no such row or a column is missing, `FILE:LINE: …` for a row that cannot be
/// read
std::vector<BallLabel> read_contact_circles(const std::filesystem::path& path, const CircleTable& table,
                                            double ball_radius_m);

}  // namespace tacipc

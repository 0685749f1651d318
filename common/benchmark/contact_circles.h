// Contact circles found in photographs of ball presses, as a table with one row per photograph.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "common/benchmark/ball_labels.h"
#include "common/config/config.h"

namespace tacipc {

/// Which columns of the table hold what, and how its photographs are divided.
struct CircleTable {
  std::string image, diameter_mm, x_px, y_px, radius_px;  // names of columns
  std::string leave_out;                                  // column whose rows count only where it is 0
  int calibrate_every = 0;        // of the rows that count, the first of so many calibrates, the others are tested
  double box_radii = 0.0;         // half the contact box over the circle's radius
  double background_radii = 0.0;  // so many radii from the centre a photograph shows no contact
  std::array<int, 2> image_px{};  // width and height

  static CircleTable read(ConfigReader& in);
};

/// Rows in the order of the table, images as it names them, of balls of this radius, that do not say to be left out.
/// \throw DataError `FILE: …` without such a row, for a missing column, `FILE:LINE: …` for a row one cannot read
std::vector<BallLabel> read_contact_circles(const std::filesystem::path& path, const CircleTable& table,
                                            double ball_radius_m);

}  // namespace tacipc

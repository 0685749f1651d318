// Reads marker displacements and slipping contacts in selected frames.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace tacipc {

/// Point of the front face and its displacement, mm, in x and y of frame S.
struct MarkerArrow {
  double x_mm = 0.0, y_mm = 0.0;
  double dx_mm = 0.0, dy_mm = 0.0;
};

/// Front vertex in contact, at its position in that frame.
struct ContactPoint {
  double x_mm = 0.0, y_mm = 0.0;
  bool slips = false;
};

/// Markers and contacts of one frame.
struct MarkerPicture {
  int frame = 0;
  bool since_press = false;  // true: displacement since the end of the press; false: since rest
  std::vector<MarkerArrow> arrows;
  std::vector<ContactPoint> contacts;
};

/// Pictures of the `chosen` frames. Displacements count since rest up to the end of the press, and since that end in
/// later frames. The last frame has a picture of each kind. Empty if press wrote neither markers nor contact states.
/// \param frames number of frames
/// \param press_end frame at which the press ended
/// \throw DataError if an array has a wrong shape or value
std::vector<MarkerPicture> read_marker_pictures(const std::filesystem::path& press_folder, int frames,
                                                std::optional<int> press_end, const std::vector<int>& chosen);

}  // namespace tacipc

// Where markers have gone and which contacts slip, in the frames that are worth a look.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

namespace tacipc {

/// A point of the front face and where it went, mm, in the x and y of frame S.
struct MarkerArrow {
  double x_mm = 0.0, y_mm = 0.0;
  double dx_mm = 0.0, dy_mm = 0.0;
};

/// A front vertex in contact, where it is in that frame.
struct ContactPoint {
  double x_mm = 0.0, y_mm = 0.0;
  bool slips = false;
};

struct MarkerPicture {
  int frame = 0;
  bool since_press = false;  // displacement counts from the end of the press, else from rest
  std::vector<MarkerArrow> arrows;
  std::vector<ContactPoint> contacts;
};

/// Pictures of the `chosen` frames: since rest up to the end of the press and in the last one, since the end of the
/// press in those after it. Nothing where press wrote neither markers nor contact states. `press_end` is the frame at
/// which the press ended; `frames` how many there are.
/// \throw DataError if an array's shape or a value in it is wrong.
std::vector<MarkerPicture> read_marker_pictures(const std::filesystem::path& press_folder, int frames,
                                                std::optional<int> press_end, const std::vector<int>& chosen);

}  // namespace tacipc

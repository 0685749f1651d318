#include "stages/report/markers.h"

#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "common/error.h"
#include "common/npy.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;
using Shape = std::vector<std::size_t>;

constexpr std::size_t kAny = std::numeric_limits<std::size_t>::max();

/// An array of known shape (extents that are not known: kAny) whose values are finite where they are used.
class Array {
 public:
  Array(const fs::path& path, const Shape& shape) : path_(path), array_(read_npy(path)) {
    bool fits = array_.shape.size() == shape.size();
    for (std::size_t d = 0; fits && d < shape.size(); ++d) fits = shape[d] == kAny || array_.shape[d] == shape[d];
    if (fits) return;
    std::string expected;
    for (const std::size_t extent : shape)
      expected += (expected.empty() ? "" : ", ") + (extent == kAny ? "any" : fmt::format("{}", extent));
    throw DataError("{}: has the shape ({}), expected ({})", path.string(), fmt::join(array_.shape, ", "), expected);
  }
  std::size_t extent(std::size_t d) const { return array_.shape[d]; }
  /// Value at this position of the flat array.
  double at(std::size_t index) const {
    const double value = array_.data[index];
    if (!std::isfinite(value)) throw DataError("{}: value {} is not finite", path_.string(), index);
    return value;
  }

 private:
  fs::path path_;
  NpyArray array_;
};

constexpr double kMm = 1e3;

struct Markers {
  Array positions;     // frames × markers × 3
  Array displacement;  // frames × markers × 2 × 3

  std::vector<MarkerArrow> arrows(std::size_t frame, std::size_t origin, bool since_press) const {
    const std::size_t count = positions.extent(1);
    std::vector<MarkerArrow> list;
    for (std::size_t m = 0; m < count; ++m) {
      const std::size_t from = 3 * (origin * count + m), by = 6 * (frame * count + m) + (since_press ? 3 : 0);
      list.push_back({kMm * positions.at(from), kMm * positions.at(from + 1), kMm * displacement.at(by),
                      kMm * displacement.at(by + 1)});
    }
    return list;
  }
};

struct Contacts {
  Array vertices;   // row of positions per front vertex
  Array state;      // frames × front vertices
  Array positions;  // frames × gel vertices × 3

  std::vector<ContactPoint> points(std::size_t frame) const {
    constexpr double kNone = 0, kSlip = 2;
    const std::size_t front = vertices.extent(0), gel = positions.extent(1);
    std::vector<ContactPoint> list;
    for (std::size_t i = 0; i < front; ++i) {
      const double is = state.at(frame * front + i);
      if (is == kNone) continue;
      const std::size_t at = 3 * (frame * gel + static_cast<std::size_t>(vertices.at(i)));
      list.push_back({kMm * positions.at(at), kMm * positions.at(at + 1), is == kSlip});
    }
    return list;
  }
};

std::optional<Markers> read_markers(const fs::path& folder, std::size_t frames) {
  if (!fs::is_regular_file(folder / "markers.npy")) return std::nullopt;
  Array positions(folder / "markers.npy", {frames, kAny, 3});
  const std::size_t count = positions.extent(1);
  return Markers{std::move(positions), Array(folder / "marker_displacement.npy", {frames, count, 2, 3})};
}

std::optional<Contacts> read_contacts(const fs::path& folder, std::size_t frames) {
  if (!fs::is_regular_file(folder / "contact_state.npy")) return std::nullopt;
  const fs::path vertices_path = folder / "front_vertices.npy";
  Array vertices(vertices_path, {kAny});
  Array positions(folder / "positions.npy", {frames, kAny, 3});
  const std::size_t front = vertices.extent(0), gel = positions.extent(1);
  for (std::size_t i = 0; i < front; ++i) {
    if (vertices.at(i) < 0 || vertices.at(i) >= static_cast<double>(gel))
      throw DataError("{}: {} is no row of positions.npy", vertices_path.string(), vertices.at(i));
  }
  return Contacts{std::move(vertices), Array(folder / "contact_state.npy", {frames, front}), std::move(positions)};
}

}  // namespace

std::vector<MarkerPicture> read_marker_pictures(const fs::path& press_folder, int frames, std::optional<int> press_end,
                                                const std::vector<int>& chosen) {
  const auto count = static_cast<std::size_t>(frames);
  const auto markers = read_markers(press_folder, count);
  const auto contacts = read_contacts(press_folder, count);
  if (!contacts && (!markers || markers->positions.extent(1) == 0)) return {};
  std::vector<MarkerPicture> pictures;
  const auto add = [&](int frame, bool since_press) {
    const auto at = static_cast<std::size_t>(frame);
    const std::size_t origin = since_press ? static_cast<std::size_t>(*press_end) : 0;
    pictures.push_back({.frame = frame,
                        .since_press = since_press,
                        .arrows = markers ? markers->arrows(at, origin, since_press) : std::vector<MarkerArrow>(),
                        .contacts = contacts ? contacts->points(at) : std::vector<ContactPoint>()});
  };
  for (const int frame : chosen) {
    const bool after = press_end && frame > *press_end;
    if (!after || frame == frames - 1) add(frame, false);
    if (after) add(frame, true);
  }
  return pictures;
}

}  // namespace tacipc

#include "stages/dataset/report/markers.h"

#include "common/sample/press_folder.h"

namespace tacipc {
namespace {

constexpr double kMm = 1e3;

std::vector<MarkerArrow> arrows_of(const PressFolder& press, std::size_t frame, std::optional<std::size_t> press_end) {
  const Positions from = press.markers(press_end.value_or(0));
  const MarkerDisplacement moved = press.marker_displacements(frame);
  const Positions& by = press_end ? moved.since_press : moved.since_rest;
  std::vector<MarkerArrow> list;
  for (Eigen::Index m = 0; m < from.rows(); ++m)
    list.push_back({kMm * from(m, 0), kMm * from(m, 1), kMm * by(m, 0), kMm * by(m, 1)});
  return list;
}

std::vector<ContactPoint> contacts_of(const PressFolder& press, const std::vector<int>& front, std::size_t frame) {
  const Positions gel = press.positions(frame);
  const std::vector<ContactState> states = press.contact_states(frame);
  std::vector<ContactPoint> list;
  for (std::size_t v = 0; v < front.size(); ++v) {
    if (states[v] != ContactState::none)
      list.push_back({kMm * gel(front[v], 0), kMm * gel(front[v], 1), states[v] == ContactState::slip});
  }
  return list;
}

}  // namespace

std::vector<MarkerPicture> read_marker_pictures(const std::filesystem::path& press_folder, int frames,
                                                std::optional<int> press_end, const std::vector<int>& chosen) {
  using enum PressArray;
  const PressFolder press(press_folder, {{kFrames, static_cast<std::size_t>(frames)}});
  const bool has_markers = press.has(markers), has_contacts = press.has(contact_state);
  if (!has_contacts && (!has_markers || press.extent(markers, kMarkers) == 0)) return {};
  const std::vector<int> front = has_contacts ? press.front_vertices() : std::vector<int>();
  std::vector<MarkerPicture> pictures;
  const auto add = [&](int frame, bool since_press) {
    const auto at = static_cast<std::size_t>(frame);
    const auto origin = since_press ? std::optional(static_cast<std::size_t>(*press_end)) : std::nullopt;
    pictures.push_back({.frame = frame,
                        .since_press = since_press,
                        .arrows = has_markers ? arrows_of(press, at, origin) : std::vector<MarkerArrow>(),
                        .contacts = has_contacts ? contacts_of(press, front, at) : std::vector<ContactPoint>()});
  };
  for (const int frame : chosen) {
    const bool after = press_end && frame > *press_end;
    if (!after || frame == frames - 1) add(frame, false);
    if (after) add(frame, true);
  }
  return pictures;
}

}  // namespace tacipc

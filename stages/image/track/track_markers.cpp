#include "stages/image/track/track_markers.h"

#include <fmt/core.h>

#include <algorithm>
#include <limits>

#include "common/base/error.h"
#include "common/base/statistics.h"
#include "stages/image/track/find_dots.h"
#include "stages/image/track/flow.h"
#include "stages/image/track/light_image.h"

namespace tacipc {
namespace {

const Eigen::Vector2d kLost = Eigen::Vector2d::Constant(std::numeric_limits<double>::quiet_NaN());

/// Data of a marker from the first image.
struct Marker {
  DotCenter rest;
  double spacing_px = 0.0;
  std::vector<std::size_t> neighbours = {};  // indices of the markers with a dot, nearest first
};

std::vector<Marker> markers_of(const std::vector<DotCenter>& dots) {
  constexpr std::size_t kNeighbours = 8;
  std::vector<Marker> markers;
  std::vector<Eigen::Vector2d> places;
  for (const DotCenter& dot : dots) places.push_back(dot.px);
  const std::vector<double> nearest = spacings(places);
  for (std::size_t i = 0; i < dots.size(); ++i) {
    markers.push_back({.rest = dots[i], .spacing_px = nearest[i]});
    std::vector<std::size_t>& others = markers.back().neighbours;
    for (std::size_t j = 0; j < dots.size(); ++j)
      if (j != i) others.push_back(j);
    const auto distance = [&](std::size_t j) { return (places[j] - places[i]).squaredNorm(); };
    std::ranges::stable_sort(others, [&](auto a, auto b) { return distance(a) < distance(b); });
    others.resize(std::min(kNeighbours, others.size()));
  }
  return markers;
}

/// Median displacement of the neighbours that flow has found, per coordinate; nothing for fewer than two.
std::optional<Eigen::Vector2d> neighbours_displacement(const std::vector<Marker>& markers, const Marker& marker,
                                                       const std::vector<std::optional<Eigen::Vector2d>>& found) {
  std::vector<double> x, y;
  for (const std::size_t j : marker.neighbours)
    if (found[j]) {
      x.push_back(found[j]->x() - markers[j].rest.px.x());
      y.push_back(found[j]->y() - markers[j].rest.px.y());
    }
  if (x.size() < 2) return std::nullopt;
  return Eigen::Vector2d(median(std::move(x)), median(std::move(y)));
}

/// Markers of one image, in the order of `markers`.
struct Found {
  std::vector<Eigen::Vector2d> px;
  std::vector<TrackQuality> quality;
};

/// Dot near a prediction, if one can be the marker's.
std::optional<DotCenter> dot_near(const FloatImage& light, const Eigen::Vector2d& predicted, const Marker& marker,
                                  double spacing_px, const TrackConfig& config) {
  const DotWindow window = DotWindow::of(marker.rest.diameter_px(), spacing_px);
  const auto dot = dot_center(light, predicted, window, config.least_contrast);
  if (!dot || (dot->px - predicted).norm() > config.most_correction_px) return std::nullopt;
  const double ratio = dot->area_px / marker.rest.area_px;
  if (ratio > config.most_area_ratio || ratio * config.most_area_ratio < 1.0) return std::nullopt;
  return dot;
}

/// Of two markers nearer to each other than half a rest diameter, only the better predicted one keeps its position.
void drop_shared_dots(const std::vector<Marker>& markers, const std::vector<Eigen::Vector2d>& predicted, Found& found) {
  for (std::size_t i = 0; i < markers.size(); ++i)
    for (const std::size_t j : markers[i].neighbours) {
      if (found.quality[i] == TrackQuality::lost || found.quality[j] == TrackQuality::lost) continue;
      if ((found.px[i] - found.px[j]).norm() > 0.5 * markers[i].rest.diameter_px()) continue;
      const bool i_goes = (found.px[i] - predicted[i]).norm() > (found.px[j] - predicted[j]).norm();
      const std::size_t goes = i_goes ? i : j;
      found.px[goes] = kLost;
      found.quality[goes] = TrackQuality::lost;
    }
}

Found follow(const std::vector<Marker>& markers, double spacing_px, const Found& before, const ByteImage& previous,
             const ByteImage& image, const TrackConfig& config) {
  std::vector<std::size_t> known;
  std::vector<Eigen::Vector2d> from;
  for (std::size_t i = 0; i < markers.size(); ++i)
    if (before.quality[i] != TrackQuality::lost) {
      known.push_back(i);
      from.push_back(before.px[i]);
    }
  const auto there = flow(previous, image, from, spacing_px, config);
  std::vector<std::optional<Eigen::Vector2d>> flowed(markers.size());
  for (std::size_t k = 0; k < known.size(); ++k) flowed[known[k]] = there[k];

  const FloatImage light = light_of(image, config.curve);
  Found now{std::vector<Eigen::Vector2d>(markers.size(), kLost),
            std::vector<TrackQuality>(markers.size(), TrackQuality::lost)};
  std::vector<Eigen::Vector2d> predicted(markers.size(), kLost);
  std::vector<bool> trusted(markers.size(), false);
  for (std::size_t i = 0; i < markers.size(); ++i) {
    const Marker& marker = markers[i];
    const auto common = neighbours_displacement(markers, marker, flowed);
    const bool by_flow =
        flowed[i] && !(common && (*flowed[i] - marker.rest.px - *common).norm() > 0.5 * marker.spacing_px);
    trusted[i] = by_flow;
    if (by_flow) {
      predicted[i] = *flowed[i];
    } else if (common) {
      predicted[i] = marker.rest.px + *common;
    }
  }
  const std::vector<double> spacing = spacings(predicted);
  for (std::size_t i = 0; i < markers.size(); ++i) {
    if (predicted[i].hasNaN()) continue;
    if (const auto dot = dot_near(light, predicted[i], markers[i], spacing[i], config)) {
      now.px[i] = dot->px;
      now.quality[i] = TrackQuality::center;
    } else if (trusted[i]) {
      now.px[i] = predicted[i];
      now.quality[i] = TrackQuality::flow;
    }
  }
  drop_shared_dots(markers, predicted, now);
  return now;
}

/// For each start position the nearest free dot, within half the spacing of the positions and of the dots.
std::vector<std::optional<std::size_t>> matched(const std::vector<Eigen::Vector2d>& start,
                                                const std::vector<DotCenter>& dots) {
  std::vector<Eigen::Vector2d> there;
  for (const DotCenter& dot : dots) there.push_back(dot.px);
  const std::vector<double> spacing = spacings(start), apart = spacings(there);
  std::vector<bool> taken(dots.size(), false);
  std::vector<std::optional<std::size_t>> out(start.size());
  for (std::size_t i = 0; i < start.size(); ++i) {
    double nearest = 0.5 * spacing[i];
    for (std::size_t j = 0; j < dots.size(); ++j)
      if (const double d = (dots[j].px - start[i]).norm(); !taken[j] && d < nearest && d < 0.5 * apart[j]) {
        nearest = d;
        out[i] = j;
      }
    if (out[i]) taken[*out[i]] = true;
  }
  return out;
}

}  // namespace

MarkerTracks track_markers(int count, const std::function<ByteImage(int)>& image, const TrackConfig& config,
                           const std::optional<std::vector<Eigen::Vector2d>>& start) {
  ByteImage previous = image(0);
  std::vector<DotCenter> dots = find_dots(light_of(previous, config.curve), config);
  // Row of the result for each dot.
  std::vector<std::size_t> row_of;
  if (start) {
    std::vector<DotCenter> chosen;
    const auto dot_of = matched(*start, dots);
    for (std::size_t i = 0; i < dot_of.size(); ++i)
      if (dot_of[i]) {
        chosen.push_back(dots[*dot_of[i]]);
        row_of.push_back(i);
      }
    dots = std::move(chosen);
  } else {
    for (std::size_t i = 0; i < dots.size(); ++i) row_of.push_back(i);
  }
  if (dots.empty())
    throw DataError("the first image shows no markers: no spots of {:g} to {:g} px that are darker by {:g}{}",
                    config.least_diameter_px, config.most_diameter_px, config.least_contrast,
                    start ? " where they should start" : "");

  const std::vector<Marker> markers = markers_of(dots);
  MarkerTracks tracks{.num_markers = static_cast<int>(start ? start->size() : dots.size()), .px = {}};
  double spacing_px = 1e9;
  for (const Marker& marker : markers) spacing_px = std::min(spacing_px, marker.spacing_px);
  Found found;
  for (const DotCenter& dot : dots) {
    found.px.push_back(dot.px);
    found.quality.push_back(TrackQuality::center);
    tracks.rest_diameter_px += dot.diameter_px() / static_cast<double>(dots.size());
  }
  const auto keep = [&] {
    std::vector<Eigen::Vector2d> px(tracks.num_markers, kLost);
    std::vector<TrackQuality> quality(px.size(), TrackQuality::lost);
    for (std::size_t k = 0; k < row_of.size(); ++k) {
      px[row_of[k]] = found.px[k];
      quality[row_of[k]] = found.quality[k];
    }
    tracks.px.push_back(std::move(px));
    tracks.quality.push_back(std::move(quality));
  };
  keep();
  for (int f = 1; f < count; ++f) {
    ByteImage next = image(f);
    if (next.width != previous.width || next.height != previous.height)
      throw DataError("image {} is {} x {} pixels, those before {} x {}", f, next.width, next.height, previous.width,
                      previous.height);
    found = follow(markers, spacing_px, found, previous, next, config);
    keep();
    previous = std::move(next);
  }
  return tracks;
}

std::string tracks_csv(const MarkerTracks& tracks, const std::vector<int>& frames) {
  std::string out = "marker,frame,x_px,y_px,dx_px,dy_px,quality\n";
  for (std::size_t m = 0; m < static_cast<std::size_t>(tracks.num_markers); ++m)
    for (std::size_t f = 0; f < tracks.px.size(); ++f) {
      const TrackQuality quality = tracks.quality[f][m];
      const Eigen::Vector2d at = tracks.px[f][m], moved = at - tracks.px.front()[m];
      out += fmt::format("{},{},", m, frames[f]);
      out += quality == TrackQuality::lost
                 ? std::string(",,,")
                 : fmt::format("{:.4f},{:.4f},{:.4f},{:.4f}", at.x(), at.y(), moved.x(), moved.y());
      out += fmt::format(",{}\n", static_cast<int>(quality));
    }
  return out;
}

}  // namespace tacipc

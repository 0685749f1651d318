#include "stages/image/track/agreement.h"

#include <algorithm>
#include <optional>

namespace tacipc {

Agreement agreement(const MarkerTracks& tracks, const std::vector<std::vector<Eigen::Vector2d>>& truth) {
  Agreement out;
  double sum = 0.0;
  for (std::size_t m = 0; m < static_cast<std::size_t>(tracks.num_markers); ++m) {
    std::optional<std::size_t> marker;
    double nearest = tracks.rest_diameter_px;
    for (std::size_t i = 0; i < truth.front().size(); ++i)
      if (const double d = (truth.front()[i] - tracks.px.front()[m]).norm(); d < nearest) {
        nearest = d;
        marker = i;
      }
    if (!marker) continue;
    ++out.markers;
    for (std::size_t f = 0; f < truth.size(); ++f) {
      const Eigen::Vector2d& known = truth[f][*marker];
      if (known.hasNaN()) continue;
      ++out.visible;
      if (tracks.quality[f][m] == TrackQuality::lost) {
        ++out.lost;
        continue;
      }
      const double distance = (tracks.px[f][m] - known).norm();
      sum += distance;
      out.max_px = std::max(out.max_px, distance);
    }
  }
  if (out.visible > out.lost) out.mean_px = sum / (out.visible - out.lost);
  return out;
}

}  // namespace tacipc

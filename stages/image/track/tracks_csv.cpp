#include "stages/image/track/tracks_csv.h"

#include <fmt/core.h>

namespace tacipc {

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

#include <algorithm>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/sample/render_folder.h"
#include "common/stage/stage.h"
#include "stages/image/track/agreement.h"
#include "stages/image/track/track_arrays.h"

namespace {

using namespace tacipc;
namespace fs = std::filesystem;

const StageSpec kTrack{
    .name = "track",
    .summary = "Measure the positions of printed markers in a series of images.",
    .inputs = {{.flag = "--config", .help = "dots and flow (YAML)"},
               {.flag = "--render", .help = "folder that render wrote: its marker images", .required = false},
               {.flag = "--image", .help = "or images of one camera, in order (PNG)", .required = false, .many = true},
               {.flag = "--start",
                .help = "markers to follow, as positions in the first image (NPY, #M × 2, px)",
                .required = false}}};

/// Positions in px from an (#M, 2) array.
std::vector<Eigen::Vector2d> read_places(const fs::path& file) {
  const MarkerPixels px = read_marker_px(file);
  std::vector<Eigen::Vector2d> places;
  for (Eigen::Index i = 0; i < px.rows(); ++i) places.emplace_back(px.row(i));
  return places;
}

/// Images and their frame numbers; for render also the known positions of the markers.
struct Series {
  std::vector<fs::path> images = {};
  std::vector<int> frames = {};
  std::vector<std::vector<Eigen::Vector2d>> truth = {};
};

Series rendered(const fs::path& render) {
  if (!fs::exists(render / "render.yaml")) throw DataError("{}: has no render.yaml", render.string());
  Series series;
  for (const std::size_t frame : frames_in(render)) {
    series.frames.push_back(static_cast<int>(frame));
    series.images.push_back(frame_path(render, frame, FrameFile::marker));
    if (!fs::exists(series.images.back()))
      throw DataError("{}: is not there; the sensor prints no markers", series.images.back().string());
    const fs::path folder = render / frame_name(frame);
    series.truth.push_back(read_places(folder / marker_px_field().file));
    if (series.truth.back().size() != series.truth.front().size())
      throw DataError("{}: has another number of markers than the first frame", folder.string());
  }
  if (series.frames.empty()) throw DataError("{}: has no frames", render.string());
  return series;
}

void write_tracks(Stage& stage, const MarkerTracks& tracks, const std::vector<int>& frames) {
  std::vector<double> px;
  std::vector<double> quality;
  for (std::size_t f = 0; f < tracks.px.size(); ++f)
    for (std::size_t m = 0; m < tracks.px[f].size(); ++m) {
      px.insert(px.end(), {tracks.px[f][m].x(), tracks.px[f][m].y()});
      quality.push_back(static_cast<double>(tracks.quality[f][m]));
    }
  const Extents extents{{"frames", tracks.px.size()}, {"#M", static_cast<std::size_t>(tracks.num_markers)}};
  write_field(marker_track_field(), stage.output(marker_track_field().file), extents, px);
  write_field(marker_quality_field(), stage.output(marker_quality_field().file), extents, quality);
  write_file(stage.output("tracks.csv"), tracks_csv(tracks, frames));
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTrack, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<TrackConfig>("--config");
    const auto render = stage.optional_input("--render");
    if (render.has_value() != stage.inputs("--image").empty()) throw UsageError("give either --render or --image");
    Series series{.images = stage.inputs("--image"), .frames = {}};
    if (render) series = rendered(*render);
    if (!render)
      for (std::size_t i = 0; i < series.images.size(); ++i) series.frames.push_back(static_cast<int>(i));
    std::optional<std::vector<Eigen::Vector2d>> start;
    if (const auto file = stage.optional_input("--start")) start = read_places(*file);

    const MarkerTracks tracks = track_markers(
        static_cast<int>(series.images.size()), [&](int f) { return read_png(series.images[f], 3); }, config, start);
    write_tracks(stage, tracks, series.frames);

    int lost = 0, by_flow = 0;
    double longest = 0.0;
    for (std::size_t f = 0; f < tracks.px.size(); ++f)
      for (std::size_t m = 0; m < tracks.px[f].size(); ++m) {
        lost += tracks.quality[f][m] == TrackQuality::lost;
        by_flow += tracks.quality[f][m] == TrackQuality::flow;
        if (tracks.quality[f][m] != TrackQuality::lost)
          longest = std::max(longest, (tracks.px[f][m] - tracks.px.front()[m]).norm());
      }
    stage.summarize({{"frames", Value::List(series.frames.begin(), series.frames.end())},
                     {"markers", tracks.num_markers},
                     {"rest_diameter_px", tracks.rest_diameter_px},
                     {"longest_displacement_px", longest},
                     {"lost", lost},
                     {"by_flow_alone", by_flow}});
    if (!render) return;
    const Agreement found = agreement(tracks, series.truth);
    stage.summarize({{"known_markers", found.markers},
                     {"known_places", found.visible},
                     {"known_places_lost", found.lost},
                     {"mean_error_px", found.mean_px},
                     {"max_error_px", found.max_px}});
  });
}

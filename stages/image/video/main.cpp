#include <fmt/ranges.h>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/base/parse.h"
#include "common/sample/film.h"
#include "common/sample/press_folder.h"
#include "common/sample/scene_folder.h"
#include "common/stage/stage.h"
#include "stages/image/video/mp4_file.h"

namespace {

using namespace tacipc;
namespace fs = std::filesystem;

constexpr Film::Size kMost{3840, 2160};

const StageSpec kVideo{
    .name = "video",
    .summary = "Write all frames of a press, a grasp or a scene as a video: tactile image, markers, indentation.",
    .inputs = {{.flag = "--press", .help = "folder that press wrote, of one gel, of a grasp or of a scene"},
               {.flag = "--render",
                .help = "folder that render wrote, of all frames; one for each gel",
                .required = true,
                .many = true}},
    .options = {
        {.flag = "--slower", .help = "how many times slower than the motion: a number, or auto", .fallback = "auto"}}};

/// Press folders of one gel or several, and the times of the frames.
struct Filmed {
  std::vector<fs::path> presses;
  std::size_t frames = 0;
  std::vector<double> times_s;  // empty if they are unknown
};

Filmed read_filmed(const fs::path& folder) {
  if (is_scene_folder(folder)) {
    SceneFolder scene = read_scene_folder(folder);
    Filmed filmed{.presses = {}, .frames = scene.times_s.size(), .times_s = scene.times_s};
    for (const SceneGel& gel : scene.gels) filmed.presses.push_back(gel.press());
    return filmed;
  }
  const PressFolder press = PressFolder::finished(folder);
  Filmed filmed{.presses = {folder}, .frames = press.extent(PressArray::positions, kFrames), .times_s = {}};
  if (press.has(PressArray::time)) filmed.times_s = press.times();
  return filmed;
}

/// Folder of a gel's images, identified by the press in its record.
const fs::path& images_of(const fs::path& press, const std::vector<fs::path>& renders) {
  for (const fs::path& render : renders) {
    if (!fs::is_regular_file(render / "render.yaml"))
      throw DataError("{}: has no render.yaml, so the render did not finish", render.string());
    const auto path = Record::from_file(render / "render.yaml").section("inputs").section("press").text("path");
    if (path && fs::weakly_canonical(render / *path) == fs::weakly_canonical(press)) return render;
  }
  throw DataError("no --render is of {}", press.string());
}

/// Factor of slow motion; 0 for auto.
double slowness(const std::string& text) {
  if (text == "auto") return 0.0;
  const auto slower = parse_number<double>(text);
  if (!slower || !(*slower > 0.0)) throw UsageError("--slower: '" + text + "' is neither a number above 0 nor auto");
  return *slower;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kVideo, argc, argv, [](Stage& stage) {
    const double slower = slowness(stage.option("--slower"));
    const Filmed filmed = read_filmed(stage.input("--press"));
    const std::vector<fs::path>& renders = stage.inputs("--render");
    if (renders.size() != filmed.presses.size())
      throw UsageError(fmt::format("--render: {} are given for {} gels", renders.size(), filmed.presses.size()));
    std::vector<FilmedGel> gels;
    for (const fs::path& press : filmed.presses) gels.push_back({press, images_of(press, renders)});
    const FilmTimes times = film_times(filmed.times_s, filmed.frames, slower);
    const Film film(std::move(gels), filmed.frames, kMost);
    Mp4File file(stage.output("video.mp4"), film.size().width, film.size().height);
    for (std::size_t f = 0; f < film.frames(); ++f) {
      show_progress(static_cast<double>(f) / static_cast<double>(film.frames()), fmt::format("frame {}", f));
      file.add(film.picture(f), times.seconds[f]);
    }
    file.close();
    double seconds = 0.0;
    for (const double shown_s : times.seconds) seconds += shown_s;
    const std::vector<std::string> columns = film.columns();
    Value::Map lines{{"frames", film.frames()},
                     {"seconds", seconds},
                     {"width_px", film.size().width},
                     {"height_px", film.size().height},
                     {"columns", Value::List(columns.begin(), columns.end())}};
    if (times.slower > 0.0) lines.emplace_back("slower", times.slower);
    if (film.shrunk_by() > 1) lines.emplace_back("shrunk_by", film.shrunk_by());
    stage.summarize(lines);
    log_info("{} frames of {} in {:.3g} s, {}", film.frames(), fmt::join(columns, ", "), seconds, pace_text(times));
  });
}

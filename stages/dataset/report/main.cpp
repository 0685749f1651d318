#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <variant>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/log.h"
#include "common/image/image.h"
#include "common/sample/press_folder.h"
#include "common/stage/stage.h"
#include "stages/dataset/report/card.h"
#include "stages/dataset/report/contact_sheet.h"
#include "stages/dataset/report/dataset/dataset_report.h"
#include "stages/dataset/report/film_strip.h"
#include "stages/dataset/report/grasp_part.h"
#include "stages/dataset/report/page.h"
#include "stages/dataset/report/robot_part.h"
#include "stages/dataset/report/sample.h"
#include "stages/dataset/report/scene_index.h"
#include "stages/dataset/report/scene_part.h"
#include "stages/dataset/report/view/scene_pictures.h"
#include "stages/dataset/report/view/scene_view.h"
#include "stages/dataset/report/view/view_data.h"
#include "stages/dataset/report/view/view_page.h"

namespace {

using namespace tacipc;

const StageSpec kReport{
    .name = "report",
    .summary = "Show samples on one page, or a whole dataset on many: pictures, curves, verdicts, coverage, costs.",
    .inputs = {{.flag = "--sample",
                .help = "folder of a sample, with press and render in it",
                .required = false,
                .many = true},
               {.flag = "--grasp", .help = "or folder of a grasp, with left and right in it", .required = false},
               {.flag = "--scene",
                .help = "or folder of a scene, with gels in it; several: a page that leads to theirs",
                .required = false,
                .many = true},
               {.flag = "--plan", .help = "or of a dataset: samples.csv of plan", .required = false},
               {.flag = "--dataset", .help = "with --plan: dataset.yaml of plan", .required = false},
               {.flag = "--config", .help = "with --plan: how much is shown (YAML)", .required = false}},
    .options = {{.flag = "--title", .help = "heading of the page", .fallback = "Tactile samples"}}};

/// Writes the data of one view under its id, if there is one, and lists it. A view shows a sample but proves nothing,
/// so one that cannot be read is left out.
/// \param read gives the view
/// \param say gives its texts
template <typename Read, typename Say>
bool write_view(Stage& stage, const ViewedSample& of, std::vector<ViewedSample>& viewed, Read&& read, Say&& say) {
  std::string script;
  try {
    const std::optional<SceneView> view = read();
    if (!view) return false;
    script = view_script(*view, say(*view));
  } catch (const std::runtime_error& error) {
    log_warning("{}: no 3-D view: {}", of.name, error.what());
    return false;
  }
  write_file(stage.output(view_data_name(of.id)), script);
  viewed.push_back(of);
  return true;
}

void write_view_page(Stage& stage, const std::vector<ViewedSample>& viewed) {
  if (viewed.empty()) return;
  write_file(stage.output(kViewScript), view_program());
  write_file(stage.output(kViewPage), view_page(stage.option("--title"), viewed));
}

void write_views(Stage& stage, std::vector<SampleReport>& samples) {
  std::vector<ViewedSample> viewed;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    SampleReport& sample = samples[i];
    const auto read = [&] {
      auto view = read_press_view(sample.folder / "press");
      if (view) link_pictures(*view, {sample.folder / "render"}, stage.out());
      return view;
    };
    const auto say = [&](const SceneView& view) { return frame_texts(sample, view); };
    if (write_view(stage, {card_id(i), sample.name}, viewed, read, say)) sample.view = card_id(i);
  }
  write_view_page(stage, viewed);
}

constexpr int kFilmQuality = 85;
constexpr const char* kFilm = "film.jpg";  // animation of gels that share one world

/// Writes the animation of gels of which all frames were rendered. `times_s` gives the times of the frames.
/// \return its HTML; empty for fewer frames, or if one cannot be read
template <typename Times>
std::string write_film(Stage& stage, const std::string& name, const std::vector<FilmedGel>& gels, std::size_t frames,
                       Times&& times_s, const std::string& file) {
  for (const FilmedGel& gel : gels)
    if (!has_all_frames(gel.render, frames)) return "";
  try {
    const FilmStrip strip = film_strip(gels, times_s());
    write_file(stage.output(file), jpeg_bytes(strip.sheet, kFilmQuality, file));
    return film_figure(strip, file);
  } catch (const std::runtime_error& error) {
    log_warning("{}: no moving picture: {}", name, error.what());
    return "";
  }
}

void write_films(Stage& stage, std::vector<SampleReport>& samples) {
  for (std::size_t i = 0; i < samples.size(); ++i) {
    SampleReport& sample = samples[i];
    if (!sample.images) continue;
    // If they were rendered for `track` or for a video, all frames are in a folder of their own.
    const auto all = sample.folder / "frames";
    const FilmedGel gel{sample.folder / "press", std::filesystem::exists(all) ? all : sample.folder / "render"};
    sample.film = write_film(
        stage, sample.name, {gel}, sample.frames.size(), [&] { return PressFolder(gel.press).times(); },
        "films/" + card_id(i) + ".jpg");
  }
}

/// Gels that share one world: fingers of a grasp, or the gels of a scene.
struct Together {
  std::filesystem::path folder;
  SceneFolder scene;
  std::variant<GraspReport, SceneReport> report;
  const char* id;                         // id of the section and of the view
  const char* strip;                      // file of the row of pictures
  std::optional<RobotReport> robot = {};  // robot of the scene, if it has one
  bool has_pictures = false;              // pictures of the robot exist next to the page
  std::string film = {};                  // HTML of the animation

  bool& has_view() {
    return std::visit([](auto& of) -> bool& { return of.has_view; }, report);
  }
  PageWords words() const {
    if (const auto* grasp = std::get_if<GraspReport>(&report)) {
      PageWords words = grasp_words(*grasp);
      words.first += film;
      return words;
    }
    const SceneReport& of = std::get<SceneReport>(report);
    PageWords words = scene_words(of);
    words.first += film;
    if (robot) {
      words.intro = "A simulated robot with gels of camera-based tactile sensors.";
      words.first = robot_sections(*robot, of.bodies, of.frames, has_pictures) + words.first;
    }
    return words;
  }
  std::vector<std::string> texts(const SceneView& view) const {
    if (const auto* grasp = std::get_if<GraspReport>(&report)) return grasp_texts(*grasp, view);
    return scene_texts(std::get<SceneReport>(report), view);
  }
  ByteImage pictures() const {
    if (const auto* grasp = std::get_if<GraspReport>(&report)) return grasp_strip(scene.gels, grasp->moments);
    return picture_strip(scene.gels, std::get<SceneReport>(report).frames);
  }
};

std::optional<Together> read_together(const Stage& stage) {
  if (const auto folder = stage.optional_input("--grasp"))
    return Together{*folder, read_scene_folder(*folder), read_grasp(*folder), kGraspId, kGraspStrip};
  for (const auto& folder : stage.inputs("--scene")) {
    SceneReport scene = read_scene(folder);
    auto robot = read_robot_report(folder);
    if (robot) scene.frames = steps_over_time(*robot, scene.frames);
    return Together{folder, read_scene_folder(folder), std::move(scene), kSceneId, kSceneStrip, std::move(robot)};
  }
  return std::nullopt;
}

/// Adds the robot to the view of its scene, and writes pictures of both.
void show_robot(Stage& stage, Together& all, SceneView& view) {
  constexpr int kWidth = 440, kHeight = 420;
  add_robot(view, all.robot->motion, robot_folder(all.folder), all.scene);
  const SceneReport& scene = std::get<SceneReport>(all.report);
  const auto instants = pictured_instants(view, first_contact(scene.bodies));
  write_png(stage.output(kRobotStrip), scene_pictures(view, instants, scene.frames, kWidth, kHeight));
  all.has_pictures = true;
}

/// Writes one view of all gels, to which the card of each gel also links.
/// \param samples in the order of the scene's gels
void write_view_of_all(Stage& stage, Together& all, std::vector<SampleReport>& samples) {
  std::vector<ViewedSample> viewed;
  const auto read = [&] {
    auto view = read_scene_view(all.scene, all.folder);
    std::vector<std::filesystem::path> renders;
    for (const SceneGel& gel : all.scene.gels) renders.push_back(gel.folder / "render");
    if (view) link_pictures(*view, renders, stage.out());
    if (view && all.robot) show_robot(stage, all, *view);
    return view;
  };
  const auto say = [&](const SceneView& view) { return all.texts(view); };
  all.has_view() = write_view(stage, {all.id, all.id}, viewed, read, say);
  if (all.has_view()) {
    for (std::size_t i = 0; i < samples.size(); ++i)
      samples[i].view = fmt::format("{}/{}", all.id, all.scene.gels[i].name);
  }
  write_view_page(stage, viewed);
}

/// Reads the pictures of a sample before any is shown: a picture that cannot be read makes only its own sample fail.
void try_pictures(SampleReport& sample) {
  if (!sample.images) return;
  const SampleImages& images = *sample.images;
  try {
    for (const auto& file : {std::optional(images.tactile), std::optional(images.no_contact), images.indentation,
                             images.normal, images.markers})
      if (file) read_picture(*file);
    for (const PhaseImage& phase : sample.phase_images) read_picture(phase.tactile);
  } catch (const std::runtime_error& error) {
    leave_out_pictures(sample, error.what());
  }
}

void report_samples(Stage& stage) {
  // The record hashes a report that lies in a sample's folder, so an old one must be removed.
  for (const char* name :
       {"index.html", "contact_sheet.png", kGraspStrip, kSceneStrip, kRobotStrip, kFilm, "films", kViewPage, "view"}) {
    std::error_code error;
    std::filesystem::remove_all(stage.out() / name, error);
    if (error) throw DataError("{}: cannot be removed: {}", (stage.out() / name).string(), error.message());
  }
  if (stage.inputs("--scene").size() > 1) return report_scenes(stage);
  std::optional<Together> all = read_together(stage);
  std::vector<std::filesystem::path> folders = stage.inputs("--sample");
  if (all) {
    write_png(stage.output(all->strip), all->pictures());
    for (const SceneGel& gel : all->scene.gels) folders.push_back(gel.folder);
  }
  std::vector<SampleReport> samples;
  for (std::size_t i = 0; i < folders.size(); ++i) {
    SampleReport& sample = samples.emplace_back(read_sample(folders[i]));
    if (all) sample.name = all->scene.gels[i].name + (stage.optional_input("--grasp") ? " finger" : "");
    try_pictures(sample);
    if (!sample.passed()) log_warning("{}: failed: {}", sample.name, *sample.failure);
  }
  if (all) {
    std::vector<FilmedGel> gels;
    for (const SceneGel& gel : all->scene.gels) gels.push_back({gel.press(), gel.folder / "render"});
    const std::vector<double>& times_s = all->scene.times_s;
    all->film = write_film(
        stage, all->folder.string(), gels, times_s.size(), [&] { return times_s; }, kFilm);
    write_view_of_all(stage, *all, samples);
  } else {
    write_films(stage, samples);
    write_views(stage, samples);
  }
  write_file(stage.output("index.html"),
             report_page(stage.option("--title"), samples, stage.out(), all ? all->words() : PageWords{}));
  write_png(stage.output("contact_sheet.png"), contact_sheet(stage.option("--title"), samples));
  const auto passed = std::count_if(samples.begin(), samples.end(), [](const auto& s) { return s.passed(); });
  stage.summarize({{"samples", samples.size()},
                   {"passed", static_cast<std::int64_t>(passed)},
                   {"failed", static_cast<std::int64_t>(samples.size()) - passed}});
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kReport, argc, argv, [](Stage& stage) {
    int of_samples = stage.optional_input("--grasp") ? 1 : 0, of_dataset = 0;
    for (const char* flag : {"--sample", "--scene"}) of_samples += stage.inputs(flag).empty() ? 0 : 1;
    for (const char* flag : {"--plan", "--dataset", "--config"}) of_dataset += stage.optional_input(flag) ? 1 : 0;
    if (of_samples > 1) throw UsageError("give one of --sample, --grasp and --scene");
    const bool samples = of_samples == 1;
    if (samples == (of_dataset > 0) || (!samples && of_dataset != 3))
      throw UsageError(
          "give either --sample, once per sample, or --grasp, or --scene, or --plan, --dataset and --config of a "
          "dataset");
    samples ? report_samples(stage) : report_dataset(stage);
  });
}

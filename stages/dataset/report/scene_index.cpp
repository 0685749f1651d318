#include "stages/dataset/report/scene_index.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/format/html_text.h"
#include "common/image/image.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/robot_part.h"
#include "stages/dataset/report/sample.h"
#include "stages/dataset/report/scene_part.h"
#include "stages/dataset/report/view/scene_pictures.h"
#include "stages/dataset/report/view/scene_view.h"
#include "tacipc_report_texts.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

/// Content of the page on one scene.
struct ListedScene {
  fs::path folder;
  std::string name;
  SceneFolder arrays;
  SceneReport report;
  std::optional<RobotReport> robot;
  int gels = 0, passed = 0;
  std::string pictures = {};  // file of the row of pictures, empty if there is none
};

std::string name_of(const fs::path& folder) {
  const fs::path full = fs::absolute(folder).lexically_normal();
  return (full.has_filename() ? full : full.parent_path()).filename().string();
}

ListedScene read_listed(const fs::path& folder) {
  ListedScene scene{.folder = folder,
                    .name = name_of(folder),
                    .arrays = read_scene_folder(folder),
                    .report = read_scene(folder),
                    .robot = read_robot_report(folder)};
  if (scene.robot) scene.report.frames = steps_over_time(*scene.robot, scene.report.frames);
  for (const SceneGel& gel : scene.arrays.gels) {
    ++scene.gels;
    scene.passed += read_sample(gel.folder).passed() ? 1 : 0;
  }
  return scene;
}

/// Writes the pictures; none if gels or bodies of the scene no longer exist.
void write_pictures(Stage& stage, ListedScene& scene, const std::string& file) {
  constexpr int kWidth = 340, kHeight = 320;
  try {
    auto view = read_scene_view(scene.arrays, scene.folder);
    if (!view) return;
    if (scene.robot) add_robot(*view, scene.robot->motion, robot_folder(scene.folder), scene.arrays);
    const auto instants = pictured_instants(*view, first_contact(scene.report.bodies));
    write_png(stage.output(file), scene_pictures(*view, instants, scene.report.frames, kWidth, kHeight));
    scene.pictures = file;
  } catch (const std::runtime_error& error) {
    log_warning("{}: no pictures: {}", scene.name, error.what());
  }
}

/// Largest force on any gel, normal and along its front.
PadForce largest_force(const ListedScene& scene) {
  PadForce largest;
  const SceneBodies& bodies = scene.report.bodies;
  const std::size_t count = bodies.bodies.size();
  for (std::size_t f = 0; f < bodies.per_frame.size(); ++f) {
    for (std::size_t gel = 0; gel < count; ++gel) {
      if (bodies.kinds[gel] != "gel") continue;
      Vector3 force = Vector3::Zero();
      for (std::size_t by = 0; by < count; ++by) force += bodies.per_frame[f][gel * count + by].force_n;
      const PadForce on_pad = pad_force(bodies.body_pose[f][gel], force);
      largest.normal_n = std::max(largest.normal_n, on_pad.normal_n);
      largest.tangential_n = std::max(largest.tangential_n, on_pad.tangential_n);
    }
  }
  return largest;
}

std::string numbers_of(const ListedScene& scene) {
  const PadForce force = largest_force(scene);
  std::string html = "<ul class=\"tiles\">\n" + tile(number_text(scene.arrays.times_s.back()) + " s", "simulated") +
                     tile(count_text(scene.arrays.times_s.size()), "frames") +
                     tile(number_text(force.normal_n) + " N", "largest force into a gel") +
                     tile(number_text(force.tangential_n) + " N", "largest along its front");
  if (scene.robot && !scene.robot->tries.empty()) {
    const CouplingSum sum = sum_of(scene.robot->tries);
    html += tile(count_text(sum.windows), "windows, all converged", "good") +
            tile(number_text(static_cast<double>(sum.tries) / sum.windows), "tries a window") +
            tile(fmt::format("{:.1e}", sum.residual), "largest residual left");
  }
  return html + "</ul>\n";
}

std::string card_of(const ListedScene& scene, const fs::path& page_folder) {
  const fs::path page = scene.folder / "report" / "index.html";
  const bool linked = fs::is_regular_file(page);
  const std::string link = html_link(page, page_folder), name = html_text(scene.name);
  std::string html = "<article class=\"card\">\n<header><h3>";
  html += linked ? fmt::format("<a href=\"{}\">{}</a>", link, name) : name;
  html += fmt::format("</h3> <span class=\"verdict {}\">{} of {} gels passed</span>",
                      scene.passed == scene.gels ? "passed" : "failed", scene.passed, scene.gels);
  if (scene.robot && !scene.robot->variables.empty()) {
    html += "<span class=\"quiet\">";
    for (const auto& [variable, value] : scene.robot->variables)
      html += fmt::format("{}{} = {}", &value == &scene.robot->variables.front().second ? "" : ", ",
                          html_text(variable), number_text(value));
    html += "</span>";
  }
  html += "</header>\n";
  if (!scene.pictures.empty()) {
    html += "<figure class=\"strip\">";
    html += linked ? fmt::format("<a href=\"{}\">", link) : std::string();
    html += fmt::format("<img src=\"{}\" alt=\"{} at a few instants\">", scene.pictures, name);
    html += std::string(linked ? "</a>" : "") + "</figure>\n";
  }
  return html + numbers_of(scene) + "</article>\n";
}

}  // namespace

void report_scenes(Stage& stage) {
  std::vector<ListedScene> scenes;
  int gels = 0, passed = 0;
  std::vector<std::string> kinds;
  bool robots = false;
  for (const fs::path& folder : stage.inputs("--scene")) {
    ListedScene& scene = scenes.emplace_back(read_listed(folder));
    write_pictures(stage, scene, fmt::format("scene-{}.png", scenes.size()));
    gels += scene.gels;
    passed += scene.passed;
    kinds.insert(kinds.end(), scene.report.bodies.kinds.begin(), scene.report.bodies.kinds.end());
    robots = robots || scene.robot;
  }
  const std::string& title = stage.option("--title");
  std::string cards;
  for (const ListedScene& scene : scenes) cards += card_of(scene, stage.out());
  write_file(stage.output("index.html"),
             page_head(title, "<style>" + page_style() + "</style>") +
                 fmt::format(kScenesPage, fmt::arg("title", html_text(title)),
                             fmt::arg("key", picture_key(kinds, robots)), fmt::arg("cards", cards)));
  stage.summarize({{"scenes", scenes.size()}, {"samples", gels}, {"passed", passed}, {"failed", gels - passed}});
}

}  // namespace tacipc

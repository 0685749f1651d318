#include "stages/dataset/report/scene_part.h"

#include <fmt/core.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/format/html_text.h"
#include "common/sample/press_record.h"
#include "stages/dataset/report/chart.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/view/view_page.h"

namespace tacipc {
namespace {

constexpr std::size_t kMostCurves = 4;
constexpr double kSmallestForceN = 1e-3;  // a pair that never pushes more than this is not drawn

/// Indices of the items with the largest numbers, in descending order, at most as many as a chart can show.
std::vector<std::size_t> largest(const std::vector<double>& sizes, double least) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (sizes[i] > least) order.push_back(i);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  order.resize(std::min(order.size(), kMostCurves));
  return order;
}

/// Two bodies and the force between them in each frame, N.
struct PushingPair {
  std::string names;
  Curve force_n;
};

std::vector<PushingPair> strongest_pairs(const SceneBodies& scene) {
  std::vector<PushingPair> pairs;
  std::vector<double> most;
  const std::size_t count = scene.bodies.size();
  for (std::size_t a = 0; a < count; ++a) {
    for (std::size_t b = a + 1; b < count; ++b) {
      PushingPair& pair = pairs.emplace_back(PushingPair{scene.bodies[a] + " and " + scene.bodies[b], {}});
      double& top = most.emplace_back(0.0);
      for (const std::vector<Wrench>& frame : scene.per_frame) {
        const double force = frame[a * count + b].force_n.norm();
        pair.force_n.values.emplace_back(force);
        top = std::max(top, force);
      }
    }
  }
  std::vector<PushingPair> strongest;
  for (const std::size_t i : largest(most, kSmallestForceN)) strongest.push_back(std::move(pairs[i]));
  return strongest;
}

/// Names of curves with the lines that represent them, starting with colour `first`.
std::string keys(const std::vector<std::string>& names, int first) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i > 0 ? ", " : "") + curve_key(first + static_cast<int>(i)) + html_text(names[i]);
  return text;
}

std::string force_figure(const SceneReport& scene) {
  const std::vector<PushingPair> pairs = strongest_pairs(scene.bodies);
  if (pairs.empty()) return "";
  Chart chart = over_time(scene.frames, "forces between bodies");
  chart.left_label = "force (N)";
  std::vector<std::string> names;
  for (const PushingPair& pair : pairs) {
    chart.left.push_back(pair.force_n);
    names.push_back(pair.names);
  }
  return figure(chart, "<b>Forces</b> between " + keys(names, 1));
}

/// Rise of a body's origin since the start, m.
double risen_m(const SceneBodies& scene, std::size_t body, std::size_t frame) {
  return scene.body_pose[frame][body](2, 3) - scene.body_pose[0][body](2, 3);
}

double turned_rad(const SceneBodies& scene, std::size_t body, std::size_t frame) {
  const Matrix3 now = scene.body_pose[frame][body].topLeftCorner<3, 3>(),
                first = scene.body_pose[0][body].topLeftCorner<3, 3>();
  return Eigen::AngleAxisd(Matrix3(now * first.transpose())).angle();
}

/// Figure of the two rigid bodies that move most: their heights and rotations need all colours.
std::string motion_figure(const SceneReport& scene) {
  const SceneBodies& bodies = scene.bodies;
  std::vector<double> most;
  for (std::size_t b = 0; b < bodies.bodies.size(); ++b) {
    double& top = most.emplace_back(0.0);
    if (bodies.kinds[b] != "rigid") continue;
    for (std::size_t f = 0; f < scene.frames.size(); ++f)
      top = std::max(top, (bodies.body_pose[f][b] - bodies.body_pose[0][b]).topRightCorner<3, 1>().norm());
  }
  std::vector<std::size_t> shown = largest(most, 0.0);
  if (shown.empty()) return "";
  shown.resize(std::min<std::size_t>(shown.size(), kMostCurves / 2));
  Chart chart = over_time(scene.frames, "heights and turns of rigid bodies");
  chart.left_label = "higher by (mm)";
  chart.right_label = "turned by (°)";
  std::vector<std::string> names;
  for (const std::size_t b : shown) {
    names.push_back(bodies.bodies[b]);
    Curve& height = chart.left.emplace_back();
    Curve& turn = chart.right.emplace_back();
    for (std::size_t f = 0; f < scene.frames.size(); ++f) {
      height.values.emplace_back(1e3 * risen_m(bodies, b, f));
      turn.values.emplace_back(turned_rad(bodies, b, f) / kDegree);
    }
  }
  return figure(chart, "<b>Rigid bodies</b>: height of " + keys(names, 1) + "; turn of " +
                           keys(names, 1 + static_cast<int>(names.size())) + ", both since frame 0");
}

/// Displacement of a rigid body along the front of a gel since contact began, m; nothing without contact.
Curve slip_curve(const SceneBodies& scene, std::size_t gel, std::size_t body) {
  Curve curve;
  Vector3 first = Vector3::Zero();
  bool touched = false;
  for (std::size_t f = 0; f < scene.per_frame.size(); ++f) {
    const auto& poses = scene.body_pose[f];
    if (scene.per_frame[f][gel * scene.bodies.size() + body].force_n.norm() < kSmallestForceN) {
      touched = false;
      curve.values.emplace_back();
      continue;
    }
    const Vector3 in_gel = (poses[gel].inverse() * poses[body]).topRightCorner<3, 1>();
    if (!touched) first = in_gel;
    touched = true;
    curve.values.emplace_back((in_gel - first).head<2>().norm());
  }
  return curve;
}

std::string slip_figure(const SceneReport& scene) {
  Chart chart = over_time(scene.frames, "slip of rigid bodies on gels");
  chart.left_label = "gone by (mm)";
  std::vector<std::string> names;
  const std::size_t count = scene.bodies.bodies.size();
  for (std::size_t pair = 0; pair < count * count && names.size() < kMostCurves; ++pair) {
    const std::size_t gel = pair / count, body = pair % count;
    if (scene.bodies.kinds[gel] != "gel" || scene.bodies.kinds[body] != "rigid") continue;
    Curve curve = slip_curve(scene.bodies, gel, body);
    if (std::none_of(curve.values.begin(), curve.values.end(), [](const auto& value) { return value.has_value(); }))
      continue;
    for (auto& value : curve.values) {
      if (value) *value *= 1e3;
    }
    chart.left.push_back(std::move(curve));
    names.push_back(scene.bodies.bodies[body] + " on " + scene.bodies.bodies[gel]);
  }
  if (names.empty()) return "";
  return figure(chart, "<b>Along the front</b> since they touch: " + keys(names, 1) +
                           ". The origin of the body's own frame; what the gel gives way counts");
}

std::string energy_figure(const SceneReport& scene) {
  Chart chart = over_time(scene.frames, "energies");
  chart.left_label = "energy (mJ)";
  chart.left.resize(kMostCurves);
  for (const std::array<double, 8>& e : scene.bodies.energy_j) {
    const double lost = e[5] + e[6] + e[7], weight = e[3] - scene.bodies.energy_j.front()[3];
    const std::array<double, kMostCurves> shown{e[0], e[1], weight, lost};
    for (std::size_t i = 0; i < kMostCurves; ++i) chart.left[i].values.emplace_back(1e3 * shown[i]);
  }
  return figure(chart, "<b>Energies</b> of all that is free, and the height of what is held: " +
                           keys({"kinetic", "elastic", "gravitational, since frame 0",
                                 "lost by friction, damping and the time integration"},
                                1));
}

std::string body_list(const SceneBodies& scene) {
  std::string text;
  for (std::size_t b = 0; b < scene.bodies.size(); ++b)
    text += fmt::format("{}<b>{}</b> ({})", b > 0 ? ", " : "", html_text(scene.bodies[b]), html_text(scene.kinds[b]));
  return text;
}

}  // namespace

SceneReport read_scene(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "press.yaml";
  if (!std::filesystem::is_regular_file(file)) throw DataError("{}: has no press.yaml", folder.string());
  const auto summary = summary_of<SceneSummary>(Record::from_file(file));
  if (!summary.has(&SceneSummary::bodies)) throw DataError("{}: is not the record of a scene", file.string());
  SceneReport scene{.frames = {}, .bodies = read_scene_bodies(folder)};
  for (const auto& frame : summary.sections(&SceneSummary::per_frame)) {
    const double phase = frame.number(&SceneFrameLines::phase);
    scene.frames.push_back({frame.required(&SceneFrameLines::time_s),
                            phase < 0.0 ? "reference" : fmt::format("phase {:.0f}", phase + 1.0)});
  }
  if (scene.frames.size() != scene.bodies.per_frame.size())
    throw DataError("{}: has {} frames, its arrays {}", file.string(), scene.frames.size(),
                    scene.bodies.per_frame.size());
  return scene;
}

PageWords scene_words(const SceneReport& scene) {
  return {.intro = "Simulated touch: gels of camera-based tactile sensors among other bodies.",
          .thing = "gel",
          .heading = "Gels",
          .first = fmt::format("<section id=\"{}\">\n<h2>Scene</h2>\n<p>{}.{}</p>\n"
                               "<figure class=\"strip\"><a href=\"{}\"><img src=\"{}\" alt=\"tactile images of the "
                               "gels, one above the other, over time\"></a></figure>\n<div class=\"pictures\">\n",
                               kSceneId, body_list(scene.bodies), scene.has_view ? " " + view_link(kSceneId) + "." : "",
                               kSceneStrip, kSceneStrip) +
                   force_figure(scene) + motion_figure(scene) + slip_figure(scene) + energy_figure(scene) +
                   "</div>\n</section>\n"};
}

std::vector<std::string> scene_texts(const SceneReport& scene, const SceneView& view) {
  const std::vector<PushingPair> pairs = strongest_pairs(scene.bodies);
  std::vector<std::string> texts;
  for (const int frame : view.frames) {
    const Instant& now = scene.frames.at(static_cast<std::size_t>(frame));
    std::string text =
        fmt::format("frame {} of {} · {} · {} s", frame, scene.frames.size() - 1, now.phase, number_text(now.time_s));
    for (const PushingPair& pair : pairs)
      text += fmt::format(" · {} {} N", pair.names, number_text(pair.force_n.values[static_cast<std::size_t>(frame)]));
    texts.push_back(std::move(text));
  }
  return texts;
}

}  // namespace tacipc

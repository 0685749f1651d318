#include "stages/dataset/report/robot_part.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/format/html_text.h"
#include "common/sample/scene_hold.h"
#include "stages/dataset/report/chart.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/view/scene_pictures.h"

namespace tacipc {
namespace {

std::string header(const RobotReport& robot) {
  std::string html = fmt::format("<section id=\"robot\">\n<h2>Task: {}</h2>\n", html_text(robot.task));
  if (robot.variables.empty()) return html;
  html += fmt::format("<p class=\"quiet\">Drawn for this run, with seed {}:</p>\n<ul class=\"tiles\">\n",
                      html_text(robot.seed));
  for (const auto& [name, value] : robot.variables) html += tile(number_text(value), html_text(name));
  return html + "</ul>\n";
}

std::string pad_figure(const PadForces& pad, const std::vector<Instant>& frames, bool coupled) {
  Chart chart = over_time(frames, "forces on pad " + pad.pad);
  chart.left_label = "force (N)";
  for (const bool felt : {false, true}) {
    Curve normal{.values = {}, .titles = {}, .broad = !felt}, tangential{.values = {}, .titles = {}, .broad = !felt};
    for (const PadForce& force : felt ? pad.felt : pad.answered) {
      normal.values.emplace_back(force.normal_n);
      tangential.values.emplace_back(force.tangential_n);
    }
    chart.left.push_back(std::move(normal));
    chart.left.push_back(std::move(tangential));
  }
  return figure(chart, fmt::format("<b>Force on pad {}</b>: {}into it and {}along its front, as the gel answers; "
                                   "{}and {}as the robot felt it{}. They differ by at most {} N",
                                   html_text(pad.pad), curve_key(1, true), curve_key(2, true), curve_key(3),
                                   curve_key(4), coupled ? "" : " by MuJoCo's own contacts", number_text(pad.apart_n)));
}

std::string actuator_figure(const RobotFolder& motion, std::size_t actuator, const std::vector<Instant>& frames) {
  const std::string& name = motion.parts.actuators[actuator];
  Chart chart = over_time(frames, "actuator " + name);
  // For a small machine, numbers in metres have more digits than fit at a tick.
  constexpr double kSmall = 0.1, kThousand = 1e3;
  const auto is_small = [&](const RobotFrame& now) { return std::abs(now.control[actuator]) < kSmall; };
  const bool small = std::all_of(motion.frames.begin(), motion.frames.end(), is_small);
  chart.left_label = small ? "control × 1000" : "control";
  chart.right_label = "force (N or N m)";
  Curve &control = chart.left.emplace_back(), &force = chart.right.emplace_back();
  for (const RobotFrame& frame : motion.frames) {
    control.values.emplace_back((small ? kThousand : 1.0) * frame.control[actuator]);
    force.values.emplace_back(frame.actuator_force[actuator]);
  }
  return figure(chart,
                fmt::format("<b>Actuator {}</b>: {}what it was told (m, rad, or what the model says), {}the force "
                            "that it exerted",
                            html_text(name), curve_key(1), curve_key(2)));
}

bool changes(const RobotFolder& motion, std::size_t actuator) {
  const auto other = [&](const RobotFrame& now) {
    return now.control[actuator] != motion.frames.front().control[actuator];
  };
  return std::any_of(motion.frames.begin(), motion.frames.end(), other);
}

/// Value rounded to a tenth, without a minus before a zero.
double tenths(double value) { return std::round(10.0 * value) / 10.0 + 0.0; }

/// Sentence for each body with an outcome.
std::string outcomes(const std::vector<HeldBodyLines>& held) {
  std::string html;
  for (const HeldBodyLines& body : held) {
    if (!body.outcome) continue;
    html += fmt::format(
        "<p>{}: <b>{}</b>. Since it was free it slipped by {:.2f} mm in the hand{} and turned by {:.1f}°; it rose by "
        "{:.1f} mm, the hand by {:.1f} mm.</p>\n",
        html_text(body.body), html_text(*body.outcome), 1e3 * body.slip_m,
        body.creep_m ? fmt::format(" ({:.2f} mm of it by creep)", 1e3 * *body.creep_m) : "", body.turn_rad / kDegree,
        tenths(1e3 * body.rise_m), tenths(1e3 * body.hand_rise_m));
  }
  return html;
}

/// Figure of slip and rotation of the first bodies that the gels hold, relative to the pads.
std::string hold_figure(const std::vector<HeldBodyLines>& held, const SceneBodies& scene,
                        const std::vector<Instant>& frames) {
  if (held.empty()) return "";
  const std::size_t shown = std::min<std::size_t>(held.size(), 2);
  Chart chart = over_time(frames, "slip and turn in the hand");
  chart.left_label = "gone by (mm)";
  chart.right_label = "turned by (°)";
  std::string slips, turns;
  for (std::size_t i = 0; i < shown; ++i) {
    const auto body = static_cast<std::size_t>(std::find(scene.bodies.begin(), scene.bodies.end(), held[i].body) -
                                               scene.bodies.begin());
    if (body == scene.bodies.size()) throw DataError("scene: its record holds {}, which is no body", held[i].body);
    Curve slip, turn;
    for (std::size_t f = 0; f < frames.size(); ++f) {
      const bool free = f >= held[i].freed_frame;
      const HeldMotion motion = free ? held_motion(scene, body, held[i].freed_frame, f) : HeldMotion{};
      slip.values.push_back(free ? std::optional(1e3 * motion.slip_m) : std::nullopt);
      turn.values.push_back(free ? std::optional(motion.turn_rad / kDegree) : std::nullopt);
    }
    chart.left.push_back(std::move(slip));
    chart.right.push_back(std::move(turn));
    const std::string name = html_text(held[i].body), comma = i > 0 ? ", " : "";
    slips += comma + curve_key(static_cast<int>(1 + i)) + name;
    turns += comma + curve_key(static_cast<int>(1 + shown + i)) + name;
  }
  return figure(chart, "<b>As seen from the pads</b>, since all touch and it is free: way of " + slips + "; turn of " +
                           turns + ". Of the point that was gripped; that the gels give way counts");
}

/// Figure of the coupling iterations in order; a line for each time window, or for a part that was repeated with fewer
/// frames.
std::string residual_figure(const RobotReport& robot) {
  constexpr std::size_t kMostMarks = 100;
  Chart chart;
  chart.what = "residual of every try";
  chart.x_label = "try, all windows one after another";
  chart.left_label = "residual";
  chart.logarithmic = true;
  chart.limit = Rule{fmt::format("tolerance {:g}", robot.tolerance), robot.tolerance};
  Curve& curve = chart.left.emplace_back();
  const bool marks = robot.tries.size() <= kMostMarks;
  for (std::size_t i = 0; i < robot.tries.size(); ++i) {
    const CouplingTry& now = robot.tries[i];
    const double x = static_cast<double>(i + 1);
    const bool first = i == 0 || !now.of_one_window(robot.tries[i - 1]);
    if (first) chart.bands.push_back({"", x - 0.5, x + 0.5});
    chart.bands.back().to = x + 0.5;
    const auto add = [&](double at, std::optional<double> value) {
      chart.x.push_back(at);
      curve.values.push_back(value);
      if (marks)
        curve.titles.push_back(fmt::format("window {} of {} frames, try {}: {:.2g}", now.window, now.frames, now.number,
                                           now.residual_relative));
    };
    if (first) add(x - 0.5, std::nullopt);  // ends the line of the previous window
    add(x, now.residual_relative);
  }
  chart.x.push_back(static_cast<double>(robot.tries.size()) + 0.5);
  curve.values.emplace_back();
  if (marks) curve.titles.emplace_back();
  return figure(chart,
                "<b>Residual</b> of every try: the largest difference between what the robot felt and what the "
                "press answered, over the largest answer. A shade and a line for each window; without contact "
                "it is 0 and not drawn");
}

std::string window_figure(const RobotReport& robot) {
  Chart chart;
  chart.what = "tries and stiffness of every window";
  chart.x_label = "window";
  chart.left_label = "tries";
  chart.right_label = "stiffness (kN/m)";
  chart.whole_x = true;
  Curve &tries = chart.left.emplace_back(), &stiffness = chart.right.emplace_back();
  for (const CouplingTry& now : robot.tries) {
    if (chart.x.empty() || chart.x.back() != now.window) {
      chart.x.push_back(now.window);
      tries.values.emplace_back(0.0);
      stiffness.values.emplace_back();
    }
    *tries.values.back() += 1.0;
    stiffness.values.back() = 1e-3 * now.stiffness_n_m;
  }
  return figure(chart, "<b>Every window</b>: " + curve_key(1) + "tries that it took, " + curve_key(2) +
                           "stiffness of the gels that the robot had learnt by then");
}

std::string coupling_section(const RobotReport& robot) {
  if (robot.tries.empty())
    return "<section id=\"coupling\">\n<h2>Robot and press</h2>\n<p>The robot moved by MuJoCo's own contacts, and the "
           "gels followed: it did not feel what they answer.</p>\n</section>\n";
  return "<section id=\"coupling\">\n<h2>How robot and press came to agree</h2>\n<p>The robot (MuJoCo) moves the gels "
         "through a window of frames, the press (finite elements) answers with forces, and both go over the window "
         "again until the forces that the robot felt are those that the gels answer. " +
         coupling_text(robot) + "</p>\n<div class=\"pictures\">\n" + residual_figure(robot) + window_figure(robot) +
         "</div>\n</section>\n";
}

std::string swatch(const Color& color, const char* what) {
  return fmt::format("<span><i class=\"swatch\" style=\"background: rgb({:g} {:g} {:g})\"></i>{}</span>", color[0],
                     color[1], color[2], what);
}

}  // namespace

std::vector<Instant> steps_over_time(const RobotReport& robot, std::vector<Instant> frames) {
  const std::vector<RobotFrame>& moved = robot.motion.frames;
  if (moved.size() != frames.size())
    throw DataError("robot: has {} frames, and its scene {}", moved.size(), frames.size());
  if (robot.steps.empty()) throw DataError("robot: its task has no steps");
  for (std::size_t f = 0; f < frames.size(); ++f) {
    // After the last step there may be one more frame.
    const auto number = std::min(static_cast<std::size_t>(std::max(0, moved[f].step)), robot.steps.size() - 1);
    frames[f].phase = robot.steps[number];
  }
  return frames;
}

PadForce pad_force(const Matrix4& world_from_gel, const Vector3& force_n) {
  const Vector3 outwards = world_from_gel.block<3, 1>(0, 2);
  const double along = force_n.dot(outwards);
  return {0.0 - along, (force_n - along * outwards).norm()};
}

std::vector<PadForces> pad_forces(const RobotReport& robot, const SceneBodies& scene) {
  std::vector<PadForces> all;
  const std::size_t count = scene.bodies.size();
  for (std::size_t p = 0; p < robot.motion.parts.pads.size(); ++p) {
    PadForces& pad = all.emplace_back(PadForces{robot.motion.parts.pads[p], {}, {}});
    const auto body =
        static_cast<std::size_t>(std::find(scene.bodies.begin(), scene.bodies.end(), pad.pad) - scene.bodies.begin());
    if (body == count) throw DataError("robot: its pad {} is no body of the scene", pad.pad);
    for (std::size_t f = 0; f < scene.per_frame.size(); ++f) {
      Vector3 answer = Vector3::Zero();
      for (std::size_t by = 0; by < count; ++by) answer += scene.per_frame[f][body * count + by].force_n;
      const Vector3& felt = robot.motion.frames.at(f).pad_wrench.at(p).force_n;
      const Matrix4& pose = robot.motion.frames.at(f).pad_pose.at(p);
      pad.answered.push_back(pad_force(pose, answer));
      pad.felt.push_back(pad_force(pose, felt));
      pad.apart_n = std::max(pad.apart_n, (felt - answer).norm());
    }
  }
  return all;
}

std::optional<int> first_contact(const SceneBodies& scene) {
  const std::size_t count = scene.bodies.size();
  for (std::size_t f = 0; f < scene.per_frame.size(); ++f) {
    for (std::size_t pair = 0; pair < count * count; ++pair) {
      if (scene.kinds[pair / count] == "gel" && scene.per_frame[f][pair].force_n.norm() > kGelTouches_n)
        return static_cast<int>(f);
    }
  }
  return std::nullopt;
}

CouplingSum sum_of(const std::vector<CouplingTry>& tries) {
  CouplingSum sum{.tries = static_cast<int>(tries.size())};
  int of_window = 0;
  for (std::size_t i = 0; i < tries.size(); ++i) {
    const bool same = i > 0 && tries[i].window == tries[i - 1].window;
    if (!same) of_window = 0;
    if (same && tries[i].frames < tries[i - 1].frames) ++sum.cut;
    sum.windows += same ? 0 : 1;
    sum.most_tries = std::max(sum.most_tries, ++of_window);
    if (i + 1 < tries.size() && tries[i + 1].window == tries[i].window) continue;
    if (tries[i].apart_m) {
      ++sum.by_position;
      sum.apart_m = std::max(sum.apart_m, *tries[i].apart_m);
    } else {
      sum.residual = std::max(sum.residual, tries[i].residual_relative);
    }
  }
  return sum;
}

std::string coupling_text(const RobotReport& robot) {
  const CouplingSum sum = sum_of(robot.tries);
  std::string text = fmt::format(
      "All {} windows converged, with {} tries in all and {} in one at most, to a residual of {:.1e} or less; the "
      "tolerance is {:g}.",
      sum.windows, sum.tries, sum.most_tries, sum.residual, robot.tolerance);
  if (sum.by_position > 0)
    text += fmt::format(
        " In {} of them the gels' answers jump, so that no force agrees; there the robot felt an answer as it is, and "
        "went at most {:.1f} µm from where the gels were.",
        sum.by_position, 1e6 * sum.apart_m);
  if (sum.cut > 0)
    text += " A window had to be halved " + (sum.cut == 1 ? std::string("once.") : fmt::format("{} times.", sum.cut));
  return text;
}

std::string picture_key(const std::vector<std::string>& kinds, bool robot) {
  using namespace picture_colors;
  std::string key = "<span class=\"swatches\">" + swatch(kGel, "gel");
  for (const auto& [kind, color, words] :
       {std::tuple{"rigid", kObject, "free body"}, {"soft", kSoft, "soft body"}, {"fixed", kFixed, "fixed body"}}) {
    if (std::find(kinds.begin(), kinds.end(), kind) != kinds.end()) key += swatch(color, words);
  }
  return key + (robot ? swatch(kRobot, "robot") : "") + "</span>";
}

std::string robot_sections(const RobotReport& robot, const SceneBodies& scene, const std::vector<Instant>& frames,
                           bool pictures) {
  std::string html = header(robot);
  if (pictures)
    html += fmt::format(
        "<figure class=\"strip\"><a href=\"{0}\"><img src=\"{0}\" alt=\"the robot with its gels at a few "
        "instants\"></a><figcaption>{1}</figcaption></figure>\n",
        kRobotStrip, picture_key(scene.kinds, true));
  const std::vector<PadForces> pads = pad_forces(robot, scene);
  html += outcomes(robot.held) + "<div class=\"pictures\">\n";
  for (const PadForces& pad : pads) html += pad_figure(pad, frames, !robot.tries.empty());
  html += hold_figure(robot.held, scene, frames);
  for (std::size_t a = 0; a < robot.motion.parts.actuators.size(); ++a) {
    if (changes(robot.motion, a)) html += actuator_figure(robot.motion, a, frames);
  }
  return html + "</div>\n<p class=\"quiet\">Shaded: the steps of the task.</p>\n</section>\n" + coupling_section(robot);
}

}  // namespace tacipc

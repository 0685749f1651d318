#include "stages/dataset/report/grasp_part.h"

#include <fmt/core.h>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/format/html_text.h"
#include "stages/dataset/report/chart.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/timeline.h"
#include "stages/dataset/report/view/view_page.h"
#include "tacipc_report_texts.h"

namespace tacipc {
namespace {

std::vector<Instant> instants_of(const std::vector<GraspMoment>& moments) {
  std::vector<Instant> instants;
  for (const GraspMoment& moment : moments) instants.push_back({moment.time_s, moment.phase});
  return instants;
}

Curve curve_of(const std::vector<GraspMoment>& moments, double GraspMoment::*number, double unit) {
  Curve curve;
  for (const GraspMoment& moment : moments) curve.values.push_back(moment.*number / unit);
  return curve;
}

std::string force_figure(const std::vector<GraspMoment>& moments) {
  Chart chart = over_time(instants_of(moments), "forces");
  chart.left_label = "force (N)";
  for (const auto number : {&GraspMoment::grip_left_n, &GraspMoment::grip_right_n, &GraspMoment::carried_n})
    chart.left.push_back(curve_of(moments, number, 1.0));
  return figure(chart, "<b>Forces</b>: grip of the " + curve_key(1) + "left and the " + curve_key(2) +
                           "right finger, " + curve_key(3) + "carried by both, upwards");
}

/// Figure of slip up to the judged frame; later frames show the released object.
std::string slip_figure(const GraspReport& grasp) {
  const std::vector<GraspMoment>& moments = grasp.moments;
  Chart chart = over_time(instants_of(moments), "slip and turn");
  chart.left_label = "slip (mm)";
  chart.right_label = "turn (°)";
  chart.left.push_back(curve_of(moments, &GraspMoment::slip_m, 1e-3));
  chart.right.push_back(curve_of(moments, &GraspMoment::turn_rad, kDegree));
  for (auto* curves : {&chart.left, &chart.right}) {
    for (std::size_t i = grasp.judged_frame + 1; i < moments.size(); ++i) curves->front().values[i].reset();
  }
  return figure(chart, "<b>In the hand</b>: " + curve_key(1) + "slip and " + curve_key(2) +
                           "turn of the object from when it was freed to when it is judged");
}

/// Figure of the fingers: fraction of the normal force on slipping vertices, up to the judged frame.
std::string share_figure(const GraspReport& grasp) {
  Chart chart = over_time(instants_of(grasp.moments), "share that slips");
  chart.left_label = "share";
  for (const std::size_t side : {0, 1}) {
    Curve& curve = chart.left.emplace_back();
    for (std::size_t i = 0; i < grasp.moments.size(); ++i)
      curve.values.push_back(i <= grasp.judged_frame ? grasp.moments[i].slip_share[side] : std::nullopt);
  }
  return figure(chart, "<b>Slip</b>: part of the normal force of the " + curve_key(1) + "left and the " + curve_key(2) +
                           "right finger on vertices that slip");
}

/// Text such as "dropped (weight)".
std::string outcome_text(const GraspReport& grasp) {
  return html_text(grasp.outcome) + (grasp.reason ? " (" + html_text(*grasp.reason) + ")" : "");
}

std::string times_text(const SlipLines& slip) {
  const auto time = [](const std::optional<double>& time_s) {
    return time_s ? "from " + number_text(time_s) + " s on" : std::string("never");
  };
  return "slips " + time(slip.first_slip_s) + ", as a whole " + time(slip.gross_slip_s);
}

}  // namespace

GraspReport read_grasp(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "press.yaml";
  if (!std::filesystem::is_regular_file(file)) throw DataError("{}: has no press.yaml", folder.string());
  using Lines = GraspSummary;
  const auto summary = summary_of<Lines>(Record::from_file(file));
  if (!summary.has(&Lines::outcome)) throw DataError("{}: is the record of a press, not of a grasp", file.string());
  const auto pose = summary.section(&Lines::pose);
  GraspReport grasp{.outcome = summary.required(&Lines::outcome),
                    .mass_kg = summary.required(&Lines::object_mass_kg),
                    .grip_n = summary.required(&Lines::grip_n),
                    .friction_margin = summary.find(&Lines::friction_margin),
                    .judged_frame = static_cast<std::size_t>(summary.required(&Lines::judged_frame)),
                    .grip_m = pose.required(&HeldPoseLines::grip_m),
                    .lever_m = pose.required(&HeldPoseLines::lever_m),
                    .width_m = pose.find(&HeldPoseLines::width_m),
                    .moments = {}};
  grasp.reason = summary.find(&Lines::reason);
  grasp.creep_m = summary.find(&Lines::creep_m);
  grasp.creep_rad = summary.find(&Lines::creep_rad);
  grasp.friction = summary.find(&Lines::friction_coefficient);
  grasp.center_shift_m = summary.find(&Lines::center_of_mass_shift_m);
  grasp.slips = {summary.section(&Lines::slip_left).all(), summary.section(&Lines::slip_right).all()};
  for (const auto& frame : summary.sections(&Lines::per_frame)) {
    using F = GraspFrameLines;
    grasp.moments.push_back({.time_s = frame.required(&F::time_s),
                             .phase = frame.required(&F::phase),
                             .grip_left_n = frame.required(&F::grip_left_n),
                             .grip_right_n = frame.required(&F::grip_right_n),
                             .carried_n = frame.required(&F::carried_n),
                             .slip_m = frame.required(&F::slip_m),
                             .turn_rad = frame.required(&F::turn_rad),
                             .slip_share = {frame.find(&F::slip_share_left), frame.find(&F::slip_share_right)}});
  }
  if (grasp.judged_frame >= grasp.moments.size()) throw DataError("{}: has no frame that was judged", file.string());
  return grasp;
}

ByteImage grasp_strip(const std::vector<SceneGel>& gels, const std::vector<GraspMoment>& frames) {
  return picture_strip(gels, instants_of(frames));
}

PageWords grasp_words(const GraspReport& grasp) {
  const std::string margin = grasp.friction_margin
                                 ? fmt::format(" Friction of both fingers could carry {} times its weight.",
                                               number_text(grasp.friction_margin))
                                 : "";
  const GraspMoment& judged = grasp.moments[grasp.judged_frame];
  const Vector3 grip_mm = 1e3 * grasp.grip_m;
  const std::string creep = grasp.creep_m
                                ? fmt::format(", {} mm and {}° of it by creep", number_text(1e3 * *grasp.creep_m),
                                              number_text(grasp.creep_rad.value_or(0.0) / kDegree))
                                : "";
  const std::string width =
      grasp.width_m ? fmt::format(", where it is {} mm wide", number_text(1e3 * *grasp.width_m)) : "";
  using fmt::arg;
  return {.intro = "Simulated touch: two camera-based tactile sensors grip one object between their soft gels.",
          .thing = "finger",
          .heading = "Fingers",
          .first = fmt::format(
              kGraspSection, arg("id", kGraspId), arg("outcome", outcome_text(grasp)),
              arg("mass", number_text(1e3 * grasp.mass_kg)), arg("grip", number_text(grasp.grip_n)),
              arg("x", number_text(grip_mm.x())), arg("y", number_text(grip_mm.y())),
              arg("z", number_text(grip_mm.z())), arg("width", width), arg("lever", number_text(1e3 * grasp.lever_m)),
              arg("margin", margin), arg("frame", grasp.judged_frame), arg("slip", number_text(1e3 * judged.slip_m)),
              arg("turn", number_text(judged.turn_rad / kDegree)), arg("creep", creep),
              arg("left", times_text(grasp.slips[0])), arg("right", times_text(grasp.slips[1])),
              arg("view", grasp.has_view ? " " + view_link(kGraspId) + "." : ""), arg("strip", kGraspStrip),
              arg("figures", force_figure(grasp.moments) + slip_figure(grasp) + share_figure(grasp)))};
}

std::string grasp_article(const GraspReport& grasp, std::size_t side, const std::string& strip) {
  const GraspMoment& judged = grasp.moments[grasp.judged_frame];
  std::string shift;
  if (grasp.center_shift_m) {
    for (const double part_m : *grasp.center_shift_m) shift += (shift.empty() ? "" : ", ") + number_text(1e3 * part_m);
  }
  const std::pair<const char*, std::string> lines[] = {
      {"outcome", outcome_text(grasp)},
      {"this finger", times_text(grasp.slips[side])},
      {"slip, turn", number_text(1e3 * judged.slip_m) + " mm, " + number_text(judged.turn_rad / kDegree) + "°"},
      {"of it creep", grasp.creep_m ? number_text(1e3 * *grasp.creep_m) + " mm, " +
                                          number_text(grasp.creep_rad.value_or(0.0) / kDegree) + "°"
                                    : "–"},
      {"mass", number_text(1e3 * grasp.mass_kg) + " g"},
      {"grip", number_text(grasp.grip_n) + " N"},
      {"friction", number_text(grasp.friction)},
      {"friction over weight", number_text(grasp.friction_margin)},
      {"lever", number_text(1e3 * grasp.lever_m) + " mm"},
      {"centre of mass shifted by", shift.empty() ? "–" : "(" + shift + ") mm"}};
  std::string html = "<article class=\"card\">\n<header><h3>Grasp</h3></header>\n";
  if (!strip.empty())
    html += fmt::format(
        "<figure class=\"strip\"><a href=\"{0}\"><img src=\"{0}\" alt=\"tactile images of both fingers, "
        "one above the other, over time\"></a></figure>\n",
        strip);
  html += "<div class=\"pictures\">\n" + force_figure(grasp.moments) + slip_figure(grasp) + share_figure(grasp) +
          "</div>\n<div class=\"facts\"><div><dl>";
  for (const auto& [name, value] : lines) html += fmt::format("<dt>{}</dt><dd>{}</dd>", name, value);
  return html + "</dl></div></div>\n</article>\n";
}

std::vector<std::string> grasp_texts(const GraspReport& grasp, const SceneView& view) {
  std::vector<std::string> texts;
  for (const int frame : view.frames) {
    const GraspMoment& moment = grasp.moments.at(static_cast<std::size_t>(frame));
    texts.push_back(fmt::format("frame {} of {} · {} · {} s · grip left {} N, right {} N · carried {} N", frame,
                                grasp.moments.size() - 1, moment.phase, number_text(moment.time_s),
                                number_text(moment.grip_left_n), number_text(moment.grip_right_n),
                                number_text(moment.carried_n)));
  }
  return texts;
}

}  // namespace tacipc

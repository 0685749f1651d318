#include "stages/dataset/report/grasp_part.h"

#include <fmt/core.h>

#include <algorithm>
#include <numbers>

#include "common/base/error.h"
#include "common/image/plot.h"
#include "common/stage/record.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/scaled_picture.h"

namespace tacipc {
namespace {

constexpr std::size_t kMostPictures = 10;
constexpr int kWidth = 160, kHeight = 120, kGap = 4;

}  // namespace

GraspReport read_grasp(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "press.yaml";
  if (!std::filesystem::is_regular_file(file)) throw DataError("{}: has no press.yaml", folder.string());
  const Record summary = Record::from_file(file).section("summary");
  if (!summary.has("outcome")) throw DataError("{}: is the record of a press, not of a grasp", file.string());
  const Record pose = summary.section("pose");
  const auto grip = pose.numbers("grip_m", 3);
  if (!grip) throw DataError("{}: summary.pose.grip_m is missing", file.string());
  GraspReport grasp{.outcome = summary.required_text("outcome"),
                    .mass_kg = summary.required_number("object_mass_kg"),
                    .grip_n = summary.required_number("grip_n"),
                    .friction_margin = summary.number("friction_margin"),
                    .judged_frame = summary.required_count("judged_frame"),
                    .slip_m = summary.required_number("slip_m"),
                    .turn_rad = summary.required_number("turn_rad"),
                    .grip_m = Eigen::Map<const Vector3>(grip->data()),
                    .lever_m = pose.required_number("lever_m"),
                    .width_m = pose.number("width_m"),
                    .moments = {}};
  for (const Record& frame : summary.sections("per_frame")) {
    grasp.moments.push_back({.time_s = frame.required_number("time_s"),
                             .phase = frame.required_text("phase"),
                             .grip_left_n = frame.required_number("grip_left_n"),
                             .grip_right_n = frame.required_number("grip_right_n"),
                             .carried_n = frame.required_number("carried_n")});
  }
  if (grasp.moments.empty()) throw DataError("{}: has no frames", file.string());
  return grasp;
}

std::string grasp_plot(const GraspReport& grasp) {
  Plot plot{.title = "Forces", .x_label = "time, s", .y_label = "N"};
  plot.curves = {{.label = "grip, left"}, {.label = "grip, right"}, {.label = "carried by both"}};
  for (const GraspMoment& m : grasp.moments) {
    plot.curves[0].points.emplace_back(m.time_s, m.grip_left_n);
    plot.curves[1].points.emplace_back(m.time_s, m.grip_right_n);
    plot.curves[2].points.emplace_back(m.time_s, m.carried_n);
  }
  return to_svg(plot);
}

ByteImage grasp_strip(const std::filesystem::path& folder, std::size_t frames) {
  const std::size_t count = std::min(kMostPictures, frames);
  const int width = static_cast<int>(count) * (kWidth + kGap) - kGap, height = 2 * kHeight + kGap;
  ByteImage strip(width, height, 3, 255);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t frame = count == 1 ? 0 : (k * (frames - 1) + (count - 1) / 2) / (count - 1);
    for (int side = 0; side < 2; ++side) {
      const ByteImage picture = fitted_picture(read_png(folder / (side == 0 ? "left" : "right") / "render" /
                                                            fmt::format("frame_{:04d}", frame) / "tactile.png",
                                                        3),
                                               kWidth, kHeight);
      for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
          for (int c = 0; c < 3; ++c)
            strip.at(static_cast<int>(k) * (kWidth + kGap) + x, side * (kHeight + kGap) + y, c) = picture.at(x, y, c);
        }
      }
    }
  }
  return strip;
}

std::string grasp_section(const GraspReport& grasp) {
  const std::string margin = grasp.friction_margin
                                 ? fmt::format(" Friction of both fingers could carry {} times its weight.",
                                               number_text(grasp.friction_margin))
                                 : "";
  const Vector3 grip_mm = 1e3 * grasp.grip_m;
  const std::string width =
      grasp.width_m ? fmt::format(", where it is {} mm wide", number_text(1e3 * *grasp.width_m)) : "";
  return fmt::format(
      "<section id=\"grasp\">\n<h2>Grasp: {}</h2>\n"
      "<p>{} g gripped with {} N at ({}, {}, {}) mm from its centre of mass, in its own axes{}; the lever of the "
      "centre of mass about the line of the grip is {} mm.{} When judged (frame {}), the object had slipped {} mm and "
      "turned {}° relative to "
      "the "
      "hand.</p>\n"
      "<p><img src=\"{}\" alt=\"tactile images of the left finger above those of the right one, over time\"></p>\n"
      "<p><img src=\"{}\" alt=\"forces over time\"></p>\n</section>\n",
      grasp.outcome, number_text(1e3 * grasp.mass_kg), number_text(grasp.grip_n), number_text(grip_mm.x()),
      number_text(grip_mm.y()), number_text(grip_mm.z()), width, number_text(1e3 * grasp.lever_m), margin,
      grasp.judged_frame, number_text(1e3 * grasp.slip_m), number_text(grasp.turn_rad * 180.0 / std::numbers::pi),
      kGraspStrip, kGraspPlot);
}

}  // namespace tacipc

#include "common/benchmark/benchmark_cases.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "common/base/error.h"
#include "common/base/file_name.h"
#include "common/mesh/triangle_mesh.h"

namespace tacipc {
namespace {

ObjectCase read_object(ConfigReader& in, std::set<std::string>& names) {
  ObjectCase object;
  object.name = in.file_name("name");
  if (!names.insert(object.name).second) in.fault("name", "is given twice");
  if (const auto radius = in.optional_number("ball_radius_mm", Range::positive()))
    object.ball_radius_m = 1e-3 * *radius;
  if (in.has("mesh")) {
    object.mesh = plain(in, "mesh");
    object.unit = in.choice("unit", kLengthUnits);
    object.edge_radius_m = 1e-3 * in.number("edge_radius_mm", Range::non_negative());
  }
  if (object.ball_radius_m.has_value() != object.mesh.empty()) in.fault("mesh", "give either ball_radius_mm or mesh");
  const auto center = in.numbers("center_px", 2);
  object.center_px = {center[0], center[1]};
  object.box_px = pixel_box(in, "box_px");
  ConfigReader fit = in.section("fit");
  object.fit_image = fit.text("image");
  object.fit_yaw = fit.flag("yaw");
  for (ConfigReader& item : in.one_or_more_sections("images")) {
    object.images.push_back(
        {.name = plain(item, "name"), .depth_m = 1e-3 * item.number("depth_mm", Range::positive())});
    object.images.back().box_px = object.box_px;
    if (!names.insert(object.images.back().name).second) item.fault("name", "is given twice");
    if (object.images.size() > 1 && !(object.images.back().depth_m > object.images[object.images.size() - 2].depth_m))
      item.fault("depth_mm", "must be deeper than the image before");
  }
  const auto is_image = [&](const std::string& name) {
    return std::ranges::count(object.images, name, &PhotographCase::name) > 0;
  };
  if (!is_image(object.fit_image)) fit.fault("image", "is not one of the images");
  if (in.has("calibrates")) {
    object.calibrates = in.text("calibrates");
    if (!is_image(object.calibrates)) in.fault("calibrates", "is not one of the images");
    if (object.images.size() == 1) in.fault("calibrates", "leaves no image of the object to test");
  }
  return object;
}

}  // namespace

std::string plain(ConfigReader& in, const std::string& key) {
  const std::string text = in.text(key);
  const bool fine = is_plain_path(text);
  if (!fine) in.fault(key, std::string(kPlainPathRule));
  return fine ? text : "x";
}

Eigen::Vector2d pair_of(ConfigReader& in, const std::string& key, std::vector<double> fallback) {
  const auto values = fallback.empty() ? in.numbers(key, 2) : in.numbers_or(key, std::move(fallback));
  return {values[0], values[1]};
}

std::array<int, 4> pixel_box(ConfigReader& in, const std::string& key) {
  const auto values = in.numbers(key, 4, Range::between(0.0, 1e6));
  std::array<int, 4> box{};
  for (std::size_t i = 0; i < 4; ++i) box[i] = static_cast<int>(values[i]);
  if (!std::ranges::equal(values, box) || box[2] < 1 || box[3] < 1)
    in.fault(key, "expected whole pixels, at least one wide and high");
  return box;
}

BenchmarkCases BenchmarkCases::read(ConfigReader& in) {
  BenchmarkCases cases;
  cases.title = in.text("title");
  cases.data = plain(in, "data");
  cases.photographs = plain(in, "photographs");
  if (in.has("circles")) {
    cases.circles = plain(in, "circles");
    cases.circle_table = in.read<CircleTable>("circle_table");
  } else {
    cases.background = plain(in, "background");
    cases.labels = plain(in, "labels");
  }
  cases.ending = plain(in, "ending");
  cases.sensor = plain(in, "sensor");
  cases.mesh = plain(in, "mesh");
  cases.press = plain(in, "press");
  cases.calibrate = plain(in, "calibrate");
  cases.baseline = plain(in, "baseline");
  ConfigReader ball = in.section("calibration_ball");
  cases.ball_radius_m = 1e-3 * ball.number("radius_mm", Range::positive());
  cases.ball_depth_m = 1e-3 * ball.number("deepest_mm", Range::positive());
  cases.ball_steps = ball.integer("steps", 1, 10000);
  cases.ball_edge_m = 1e-3 * in.number("ball_edge_mm", Range::positive());
  cases.mesh_spacing_m = 1e-3 * in.number("mesh_spacing_mm", Range::positive());
  if (auto must = in.optional_section("must"))
    cases.must = {must->number("ssim_s"), must->number("mae"), must->number("psnr_db")};
  std::set<std::string> names;
  if (!cases.circle_table)
    for (ConfigReader& item : in.one_or_more_sections("objects")) cases.objects.push_back(read_object(item, names));
  for (ObjectCase& object : cases.objects)
    for (PhotographCase& image : object.images) image.photograph = image.name + cases.ending;
  return cases;
}

void add_circles(BenchmarkCases& cases, const std::optional<std::filesystem::path>& path) {
  if (path.has_value() != cases.circle_table.has_value())
    throw UsageError(path ? "--circles: the benchmark names no circles"
                          : "--circles: the benchmark names a table of circles, give it");
  if (!path) return;
  const CircleTable& table = *cases.circle_table;
  ObjectCase object;
  object.name = "ball";
  object.ball_radius_m = cases.ball_radius_m;
  int row = 0;
  for (const BallLabel& circle : read_contact_circles(*path, table, cases.ball_radius_m)) {
    if (row++ % table.calibrate_every == 0) {
      cases.labels_of_circles.push_back(circle);
      cases.labels_of_circles.back().image += cases.ending;
      continue;
    }
    PhotographCase image{.name = circle.image, .photograph = circle.image + cases.ending, .circle = circle};
    std::ranges::replace(image.name, '/', '_');
    const double half = table.box_radii * circle.radius_px;
    const auto low = [&](double middle) { return std::max(0, static_cast<int>(std::lround(middle - half))); };
    const auto high = [&](double middle, int size) {
      return std::min(size, static_cast<int>(std::lround(middle + half)) + 1);
    };
    const int left = low(circle.x_px), top = low(circle.y_px);
    image.box_px = {left, top, high(circle.x_px, table.image_px[0]) - left, high(circle.y_px, table.image_px[1]) - top};
    if (image.box_px[2] < 1 || image.box_px[3] < 1)
      throw DataError("{}: the circle of {} lies outside the photograph", path->string(), circle.image);
    object.images.push_back(image);
  }
  if (object.images.empty()) throw DataError("{}: leaves no photograph to test", path->string());
  cases.objects = {object};
}

}  // namespace tacipc

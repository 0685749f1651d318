#include "stages/dataset/report/dataset/dataset_facts.h"

#include <fmt/core.h>

#include "common/sample/press_record.h"
#include "stages/dataset/report/html.h"
#include "stages/dataset/report/motion.h"
#include "stages/dataset/report/press_report.h"

namespace tacipc {
namespace {

namespace fs = std::filesystem;

std::string range_text(const std::pair<double, double>& range, const char* unit) {
  return range.first == range.second ? fmt::format("{:g}{}", range.first, unit)
                                     : fmt::format("{:g} to {:g}{}", range.first, range.second, unit);
}

std::string placement_text(const Record& placement) {
  std::string words;
  const auto add = [&](const std::string& more) { words += (words.empty() ? "" : ", ") + more; };
  const Record center = placement.section("center_mm");
  if (const auto x = center.range("x")) add("x " + range_text(*x, " mm"));
  if (const auto y = center.range("y")) add("y " + range_text(*y, " mm"));
  if (const auto turn = placement.range("rotate_deg")) add("turned by " + range_text(*turn, "°"));
  if (const auto face = placement.text("face")) add("side " + *face);
  return words;
}

MotionFacts motion_facts(const Record& motion) {
  MotionFacts facts{.name = motion.text("name").value_or("motion"), .words = "", .placement = ""};
  if (const auto file = motion.text("file")) {
    facts.words = "as in " + *file;
    return facts;
  }
  facts.words = motion_text(motion);
  facts.placement = placement_text(motion.section("placement"));
  return facts;
}

}  // namespace

GelFacts read_gel_facts(const fs::path& sample_folder) {
  const Record press = Record::from_file(sample_folder / "press/press.yaml");
  const Record config = press.section("config"), sensor = config.section("sensor");
  GelFacts facts;
  const auto add = [&](const char* name, const std::string& value) { facts.lines.emplace_back(name, value); };
  const Record camera = sensor.section("camera"), gel = sensor.section("gel"), material = sensor.section("material");
  if (const auto width = camera.count("width_px"), height = camera.count("height_px"); width && height)
    add("image", fmt::format("{} × {} px", *width, *height));
  if (const auto window = camera.numbers("window_mm", 2))
    add("window on the gel", fmt::format("{:g} × {:g} mm", (*window)[0], (*window)[1]));
  if (const auto model = camera.text("model")) add("camera", *model);
  if (const auto thickness = gel.number("thickness_mm")) add("gel thickness", fmt::format("{:g} mm", *thickness));
  if (const auto modulus = material.number("youngs_modulus_pa")) {
    add("gel stiffness",
        fmt::format("E {:g} kPa, ν {:g}", 1e-3 * *modulus, material.number("poissons_ratio").value_or(0.0)));
  }
  if (const auto law = material.text("law")) add("gel law", *law);
  std::string relaxation;
  for (const Record& member : material.sections("relaxation"))
    relaxation += fmt::format("{}{:g} % in {:g} s", relaxation.empty() ? "" : ", ",
                              100.0 * member.required_number("part"), member.required_number("time_s"));
  if (!relaxation.empty()) add("gel relaxation, of the instantaneous stiffness", relaxation);
  const auto summary = summary_of<PressSummary>(press);
  if (const auto vertices = summary.find(&PressSummary::gel_vertices)) add("mesh", count_text(*vertices) + " vertices");
  if (const auto friction = summary.find(&PressSummary::friction_coefficient))
    add("friction coefficient", fmt::format("{:g}", *friction));
  const Record markers = sensor.section("markers");
  if (const auto rows = markers.count("rows"), columns = markers.count("columns"); rows && columns) {
    add("markers", fmt::format("{} × {}, {:g} mm apart{}", *rows, *columns, markers.number("pitch_mm").value_or(1.0),
                               markers.has("radius_mm") ? ", printed" : ", followed but not printed"));
  }
  const Record render = Record::from_file(sample_folder / "render/render.yaml");
  if (const auto reference = render.text("reference")) {
    add("image noise", *reference == "synthetic" ? "synthetic: no photograph of the real sensor without contact"
                                                 : "of a photograph of the real sensor without contact");
  }
  SampleReport sample;
  read_press_record(press, sample);
  for (const CheckReport& check : sample.checks) facts.checks.emplace_back(check.name, check.limit);
  return facts;
}

DatasetFacts read_dataset_facts(const std::string& name, const fs::path& dataset_yaml) {
  const Record dataset = Record::from_file(dataset_yaml);
  DatasetFacts facts;
  facts.name = name;
  facts.seed = dataset.text("seed");
  facts.sampling = dataset.text("sampling").value_or("");
  for (const Record& motion : dataset.one_or_many("motions")) facts.motions.push_back(motion_facts(motion));
  facts.packed = fs::exists(dataset_yaml.parent_path().parent_path() / "pack/card.yaml");
  return facts;
}

}  // namespace tacipc

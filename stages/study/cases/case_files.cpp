#include "stages/study/cases/case_files.h"

#include <fmt/format.h>

#include <algorithm>

#include "stages/study/cases/make_variables.h"

namespace tacipc {
namespace {

std::string ball_indenter(double radius_m, double edge_m) {
  return fmt::format("ball: {{radius_mm: {}, edge_mm: {}}}\n", 1e3 * radius_m, 1e3 * edge_m);
}

std::string indenter(const ObjectCase& object, const BenchmarkCases& cases) {
  if (object.ball_radius_m) return ball_indenter(*object.ball_radius_m, cases.ball_edge_m);
  // Relief twice as deep as the deepest press, so that the gel never touches the cut.
  const double relief_m = 2.0 * object.images.back().depth_m + 2.0 * object.edge_radius_m;
  return fmt::format("mesh: {{unit: {}, edge_radius_mm: {}, spacing_mm: {}, relief_mm: {}}}\n", object.unit,
                     1e3 * object.edge_radius_m, 1e3 * cases.mesh_spacing_m, 1e3 * relief_m);
}

/// One frame per image.
std::string motion(const ObjectCase& object) {
  std::string text = "motion:\n";
  for (const PhotographCase& image : object.images)
    text += fmt::format("  - {{kind: press, depth_mm: {}, steps: 1, substeps: 2}}\n", 1e3 * image.depth_m);
  return text;
}

std::string shade(const ObjectCase& object) {
  std::string text = "images:\n";
  if (!object.images.empty() && object.images.front().circle) {
    for (const PhotographCase& image : object.images)
      text += fmt::format("  - {{name: {}, center_px: [{}, {}], contact_px: {}}}\n", image.name, image.circle->x_px,
                          image.circle->y_px, image.circle->radius_px);
    return text + fmt::format("ball: {{radius_mm: {}}}\n", 1e3 * object.ball_radius_m.value());
  }
  int frame = 0;
  for (const PhotographCase& image : object.images)
    text += fmt::format("  - {{name: {}, frame: {}}}\n", image.name, ++frame);
  return text + fmt::format("place: {{center_px: [{}]}}\nfit: {{image: {}, box_px: [{}], yaw: {}}}\n",
                            fmt::join(object.center_px, ", "), object.fit_image, fmt::join(object.box_px, ", "),
                            object.fit_yaw);
}

/// Known objects that calibrate, as input of calibrate; empty if there are none.
std::string known_objects(const BenchmarkCases& cases) {
  std::string text;
  for (const ObjectCase& object : cases.objects) {
    int frame = 0;
    for (const PhotographCase& image : object.images) {
      ++frame;
      if (image.name != object.calibrates) continue;
      text += fmt::format("  - {{name: {}, photograph: {}, frame: {}, center_px: [{}], box_px: [{}], yaw: {}}}\n",
                          object.name, image.photograph, frame, fmt::join(object.center_px, ", "),
                          fmt::join(object.box_px, ", "), object.fit_yaw);
    }
  }
  return text.empty() ? text : "objects:\n" + text;
}

std::string metrics(const BenchmarkCases& cases) {
  std::string text = "kind: images\noffset_outside_box: true\nboxes:\n";
  // The metrics name images below their common folder, which for a single object is the object's.
  for (const ObjectCase& object : cases.objects)
    for (const PhotographCase& image : object.images)
      for (const std::string& name : {object.name + "/" + image.name + ".png", image.name + ".png"})
        text += fmt::format("  - {{starts_with: {}, px: [{}]}}\n", name, fmt::join(image.box_px, ", "));
  return text;
}

std::string labels(const std::vector<BallLabel>& circles) {
  std::string text;
  for (const BallLabel& circle : circles)
    text += fmt::format("{} ({}, {}) {}\n", circle.image, circle.x_px, circle.y_px, circle.radius_px);
  return text;
}

std::string variables(const BenchmarkCases& cases, const std::string& folder) {
  MakeVariables make("CASES", folder);
  make.set("DATA", cases.data);
  make.set("CIRCLES", cases.circle_table ? cases.data + "/" + cases.circles : "");
  if (!cases.circle_table) {
    make.set("BACKGROUND", cases.data + "/" + cases.background);
    make.set("LABELS", cases.data + "/" + cases.labels);
  }
  make.set("PHOTOGRAPHS", cases.data + "/" + cases.photographs);
  for (const auto& [name, path] : {std::pair{"SENSOR", cases.sensor},
                                   {"MESH", cases.mesh},
                                   {"PRESS", cases.press},
                                   {"CALIBRATE", cases.calibrate},
                                   {"BASELINE", cases.baseline}})
    make.set_path(name, path);
  std::string objects, known;
  for (const ObjectCase& object : cases.objects) {
    objects += (objects.empty() ? "" : " ") + object.name;
    std::string images;
    for (const PhotographCase& image : object.images) {
      images += (images.empty() ? "" : " ") + image.name;
      make.set("PHOTOGRAPH_" + image.name, cases.data + "/" + cases.photographs + "/" + image.photograph);
    }
    make.set("IMAGES_" + object.name, images);
    make.set("FIT_" + object.name, object.fit_image);
    if (!object.calibrates.empty()) {
      known += (known.empty() ? "" : " ") + object.name;
      const auto at = std::ranges::find(object.images, object.calibrates, &PhotographCase::name);
      make.set("KNOWN_FRAME_" + object.name, fmt::format("{}", at - object.images.begin() + 1));
    }
    make.set("MESH_" + object.name, object.mesh.empty() ? "" : cases.data + "/" + object.mesh);
  }
  make.set("OBJECTS", objects);
  make.set("KNOWN", known);
  return make.text();
}

}  // namespace

CaseFiles case_files(const BenchmarkCases& cases, const std::string& folder) {
  CaseFiles files{{"cases.mk", variables(cases, folder)},
                  {"metrics.yaml", metrics(cases)},
                  {"ball/indenter.yaml", ball_indenter(cases.ball_radius_m, cases.ball_edge_m)},
                  {"ball/motion.yaml", fmt::format("motion: {{kind: press, depth_mm: {}, steps: {}}}\n",
                                                   1e3 * cases.ball_depth_m, cases.ball_steps)}};
  if (cases.circle_table) {
    files.emplace_back("labels.txt", labels(cases.labels_of_circles));
    files.emplace_back("background.yaml", fmt::format("contact_radii: {}\n", cases.circle_table->background_radii));
  }
  if (const std::string known = known_objects(cases); !known.empty()) files.emplace_back("known_objects.yaml", known);
  for (const ObjectCase& object : cases.objects) {
    if (!cases.circle_table) {  // otherwise the press for calibration serves
      files.emplace_back("objects/" + object.name + "/indenter.yaml", indenter(object, cases));
      files.emplace_back("objects/" + object.name + "/motion.yaml", motion(object));
    }
    files.emplace_back("objects/" + object.name + "/shade.yaml", shade(object));
  }
  return files;
}

}  // namespace tacipc

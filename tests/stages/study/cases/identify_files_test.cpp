#include "stages/study/cases/case_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <map>

#include "tests/config_text.h"

namespace tacipc {
namespace identify_files_test {

const std::string kHead =
    "title: gel\nsensor: ../s.yaml\nmesh: m.yaml\npress: p.yaml\nchanges: [+gel.dome_radius_mm=145]\n";
const std::string kParameters =
    "parameters:\n  youngs_modulus_pa: {mean: 1.0e+5, factor: 2}\n  thickness_mm: {mean: 3, sigma: 1, nodes: [2, 4]}\n"
    "  poissons_ratio: {mean: 0.47, sigma: 0.02, nodes: [0.45, 0.47, 0.49]}\n";
const std::string kPress =
    "  - {name: ball, kind: press, ball: {radius_mm: 4, edge_mm: 0.2}, file: a.csv, columns: {depth_mm: d, force_n: "
    "f}, sigma: "
    "{force_n: 0.01}, simulate: {to_mm: 1.2, press_frames: 6}}\n";
const std::string kDrag =
    "  - {name: key, kind: shear, mesh: {file: k.stl, edge_radius_mm: 0.2, spacing_mm: 0.1}, center_mm: [1, -2], file: "
    "b.csv, "
    "depth_mm: 0.5, columns: {travel_mm: x, force_n: f}, sigma: {force_n: 0.01}, simulate: {depths_mm: [0.4, 0.6], "
    "press_frames: 4, travel_mm: 1, shear_frames: 5, direction_deg: 90}}\n";
const std::string kChecks =
    "checks:\n  - {name: finer, mesh: f.yaml}\n  - {name: law, changes: [material.law=stvk_hencky]}\n";

IdentifySpec spec(const std::string& text) { return config_from_text<IdentifySpec>(text, "i.yaml"); }

TEST(IdentifyFiles, NameEveryRunAtEveryNode) {
  std::map<std::string, std::string> files;
  for (const auto& [name, content] :
       identify_files(spec(kHead + kParameters + "measurements:\n" + kPress + kDrag + kChecks), "configs/study"))
    files[name] = content;
  EXPECT_EQ(files["ball/indenter.yaml"], "ball: {radius_mm: 4, edge_mm: 0.2}\n");
  EXPECT_EQ(files["key/indenter.yaml"], "mesh: {unit: mm, edge_radius_mm: 0.2, spacing_mm: 0.1, relief_mm: 1.2}\n");
  EXPECT_EQ(files["motion_ball.yaml"],
            "placement: {center_mm: [0, 0]}\nmotion:\n  - {kind: press, depth_mm: 1.2, steps: 6}\n");
  EXPECT_EQ(files["motion_key_0400um.yaml"],
            "placement: {center_mm: [1, -2]}\nmotion:\n  - {kind: press, depth_mm: 0.4, steps: 4}\n"
            "  - {kind: shear, direction_deg: 90, distance_mm: 1, steps: 5}\n");
  const std::string& made = files["cases.mk"];
  for (const char* line :
       {"IDENTIFY_SENSOR := configs/s.yaml\n", "IDENTIFY_MESH := configs/study/m.yaml\n",
        "IDENTIFY_CHANGES := +gel.dome_radius_mm=145\n", "IDENTIFY_RUNS := ball key_0400um key_0600um\n",
        "IDENTIFY_MEASUREMENT_key_0600um := key\n", "IDENTIFY_OBJECT_key := k.stl\n",
        "IDENTIFY_NODES := n00 n01 n02 n03 n04 n05\n",
        "IDENTIFY_SET_n03 := material.poissons_ratio=0.47 gel.thickness_mm=4\n", "IDENTIFY_GEL_n03 := gel1\n",
        "IDENTIFY_GELS := gel0 gel1\n", "IDENTIFY_MIDDLE := n02\n", "IDENTIFY_CHECKED_ball := yes\n",
        "IDENTIFY_CHECKS := finer law\n", "IDENTIFY_CHECK_MESH_finer := configs/study/f.yaml\n",
        "IDENTIFY_CHECK_CHANGES_law := material.law=stvk_hencky\n"})
    EXPECT_THAT(made, testing::HasSubstr(line));
  EXPECT_THAT(made, testing::Not(testing::HasSubstr("IDENTIFY_CHECKED_key")));
}

std::string faults(const std::string& text) {
  return fmt::format("{}", fmt::join(faults_of([&] { spec(text); }), "\n"));
}

TEST(IdentifySpec, TellsWhatIsWrong) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  const std::string whole = kHead + kParameters + "measurements:\n" + kPress + kDrag + kChecks;
  EXPECT_EQ(faults(whole), "");
  for (const auto& [from, to, said] :
       {std::tuple{"nodes: [2, 4]", "nodes: [2]", "nodes: needs at least 2 values"},
        {"nodes: [2, 4]", "nodes: [2, 4], bounds: [1, 4]", "bounds: must lie between the first node and the last"},
        {"mean: 3,", "mean: 5,", "mean: must lie between the first node and the last"},
        {"factor: 2", "factor: 1", "factor"},
        {"factor: 2", "sigma: 2, factor: 2", "there is a factor already"},
        {"name: key", "name: ball", "is given twice"},
        {"kind: press", "kind: relaxation", "has no term to fit to it"},
        {"depths_mm: [0.4, 0.6]", "depths_mm: [0.6, 0.4]", "depths_mm: must ascend"},
        {"depth_mm: 0.5, col", "depth_mm: 0.7, col", "depth_mm"},
        {"to_mm: 1.2", "to_mm: 1.2}, predict_mm: [1.3], x: {y: 1", "predict_mm: is deeper than simulate.to_mm"},
        {"mesh: f.yaml", "mesh: ''", "needs a mesh, a press or changes"},
        {"[+gel.dome_radius_mm=145]", "['a b']", "has a blank"},
        {"[+gel.dome_radius_mm=145]", "x", "changes"}})
    EXPECT_THAT(faults(with(whole, from, to)), testing::HasSubstr(said)) << to;
  EXPECT_THAT(faults(kHead + "parameters: {}\nmeasurements:\n" + kPress),
              testing::HasSubstr("names nothing to identify"));
}

}  // namespace identify_files_test
}  // namespace tacipc

// Compares our straight rendering of a press with POV-Ray's of the same triangles, normals and point lights.
#include <fmt/core.h>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/optics/trace.h"
#include "common/stage/stage.h"
#include "stages/image/render/pressed_gel.h"
#include "tests/common/optics/test_surfaces.h"
#include "tests/stages/image/render/third_party/agreement.h"
#include "tests/stages/image/render/third_party/flat_start.h"
#include "tests/stages/image/render/third_party/povray_scene.h"

using namespace tacipc;

namespace {

constexpr double kLimit = 5e-3;      // of the relative RMSE
constexpr double kFlatLimit = 5e-4;  // of that with shadow rays that start alike
constexpr double kSpan = 0.02;       // of the difference's picture

const StageSpec kCheck{.name = "render_check",
                       .summary = "Compare straight light from point lights with POV-Ray's.",
                       .inputs = {{.flag = "--sensor", .help = "the sensor: camera and ring of LEDs (YAML)"},
                                  {.flag = "--gel", .help = "gel.msh of tetmesh"},
                                  {.flag = "--press", .help = "folder of a press"}}};

struct Comparison {
  FloatImage ours, theirs;
  double relative_rmse = 0.0;
  double flat_start = 0.0;  // the same with shadow rays that start alike
};

/// Both renderings with `subpixels` (1 or 2) rays per pixel edge. POV-Ray sends one ray through each pixel's centre:
/// four per pixel are a picture of twice the size, halved.
Comparison compare(Stage& stage, const Membrane& membrane, const Sensor& sensor, int subpixels) {
  const PovrayScene scene = povray_scene(membrane, sensor);
  const auto scene_file = stage.output(fmt::format("scene_{}.pov", subpixels));
  const auto picture = stage.output(fmt::format("povray_{}.ppm", subpixels));
  write_file(scene_file, scene.text);
  Sensor fine = sensor;
  fine.camera.width_px *= subpixels;
  fine.camera.height_px *= subpixels;
  run_povray(scene_file, picture, fine.camera, stage.threads());
  const auto pixels = [&](const FloatImage& image) { return subpixels == 2 ? halved(image) : image; };
  const TraceResult traced = trace(membrane, sensor, {.subpixels = subpixels, .refract = false});
  Comparison out{.ours = color_image(traced.basis, sensor), .theirs = pixels(read_ppm16(picture))};
  if (out.theirs.width != out.ours.width || out.theirs.height != out.ours.height)
    throw DataError("povray made a picture of another size");
  for (float& value : out.theirs.pixels) value = static_cast<float>(value * scene.white);
  out.relative_rmse = relative_rmse(out.ours, out.theirs);
  out.flat_start = relative_rmse(pixels(flat_start_image(membrane, fine)), out.theirs);
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kCheck, argc, argv, [](Stage& stage) {
    if (!povray_is_there()) throw DataError("there is no program povray (Debian package povray)");
    const Sensor sensor = comparable_sensor(stage.read_config<Sensor>("--sensor"));
    const TetMesh gel = read_tet_mesh(stage.input("--gel"));
    const PressedGel press(stage.input("--press"), gel);
    const Membrane membrane = make_membrane(gel, press.positions(press.num_frames() - 1));
    const Comparison one = compare(stage, membrane, sensor, 1), four = compare(stage, membrane, sensor, 2);
    write_exr(stage.output("ours.exr"), four.ours, {"R", "G", "B"});
    write_exr(stage.output("povray.exr"), four.theirs, {"R", "G", "B"});
    write_png(stage.output("render_check.png"), side_by_side(four.ours, four.theirs, kSpan));
    write_file(
        stage.output("render_check.md"),
        fmt::format(
            "| Rays per pixel | Relative RMSE (must, with 4: below {:g} %) | shadow rays started as POV-Ray's |\n"
            "|---|---|---|\n| 1 | {:.2f} % | {:.3f} % |\n| 4 | {:.2f} % | {:.3f} % |\n",
            100.0 * kLimit, 100.0 * one.relative_rmse, 100.0 * one.flat_start, 100.0 * four.relative_rmse,
            100.0 * four.flat_start));
    stage.summarize(
        {{"relative_rmse_1_ray", one.relative_rmse},
         {"relative_rmse_4_rays", four.relative_rmse},
         {"flat_start_1_ray", one.flat_start},
         {"flat_start_4_rays", four.flat_start},
         {"holds", four.relative_rmse < kLimit && one.flat_start < kFlatLimit && four.flat_start < kFlatLimit}});
  });
}

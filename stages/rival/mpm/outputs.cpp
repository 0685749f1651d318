#include "stages/rival/mpm/outputs.h"

#include <algorithm>
#include <functional>

#include "common/base/files.h"
#include "common/image/picture.h"
#include "common/sample/press_folder.h"
#include "common/sample/render_folder.h"
#include "common/sensor/markers.h"
#include "stages/rival/mpm/height_map.h"
#include "stages/rival/mpm/seen_map.h"

namespace tacipc {
namespace {

std::vector<Marker> bind(const Sensor& sensor, const MpmScene& scene) {
  const Positions rest = front_at_rest(scene.lattice);
  return bind_markers(sensor.markers, rest, triangulate(scene.lattice, rest));
}

void write_arrays(Stage& stage, const Sensor& sensor, const MpmScene& scene, const MpmRun& run,
                  const std::vector<Positions>& markers, std::optional<std::size_t> press_end) {
  const ArrayWriter writer(stage,
                           {{kFrames, run.frames.size()}, {kMarkers, static_cast<std::size_t>(markers[0].rows())}});
  writer.write(PressArray::object_pose, run.frames, [](const MpmFrame& f) { return f.gel_from_object; });
  writer.write(PressArray::time, run.frames, [](const MpmFrame& f) { return f.time_s; });
  writer.write(PressArray::phase, run.frames, [](const MpmFrame& f) { return f.phase; });
  writer.write(PressArray::markers, markers, std::identity());
  writer.write(PressArray::marker_displacement, marker_displacements(markers, press_end));
  write_file(stage.output(kMarkersCsv), markers_csv(bind(sensor, scene)));
}

void write_maps(Stage& stage, const Sensor& sensor, const MpmScene& scene, const MpmRun& run) {
  const auto places = scene.config.pixels_at_ends ? PixelPlaces::ends : PixelPlaces::centres;
  for (std::size_t f = 0; f < run.frames.size(); ++f) {
    const std::string folder = frame_folder(f);
    const FloatImage indentation = indentation_map(scene.lattice, run.frames[f].front_m, sensor.camera, places);
    FloatImage depth = indentation;
    for (float& value : depth.pixels) value = static_cast<float>(-sensor.camera.position_m.z()) - value;
    write_frame(stage, folder, FrameFile::indentation, indentation);
    write_frame(stage, folder, FrameFile::seen_indentation, seen_along_rays(indentation, sensor, places));
    write_frame(stage, folder, FrameFile::depth, depth);
    write_frame(stage, folder, FrameFile::indentation_picture, picture_of_height(indentation));
  }
}

Value vector(const Vector3& v) { return std::vector<double>{v.x(), v.y(), v.z()}; }

}  // namespace

std::vector<Positions> markers_of_frames(const Sensor& sensor, const MpmScene& scene, const MpmRun& run) {
  const std::vector<Marker> markers = bind(sensor, scene);
  std::vector<Positions> frames;
  for (const MpmFrame& frame : run.frames) frames.push_back(marker_positions(markers, frame.front_m));
  return frames;
}

void write_outputs(Stage& stage, const Sensor& sensor, const MpmScene& scene, const MpmRun& run,
                   const std::vector<Positions>& markers, const std::optional<SpeedEffect>& effect) {
  std::vector<int> phases;
  Value::List per_frame;
  for (const MpmFrame& frame : run.frames) {
    phases.push_back(frame.phase_index);
    per_frame.emplace_back(Value::Map{{"time_s", frame.time_s},
                                      {"phase", name_of(frame.phase)},
                                      {"substeps", frame.steps},
                                      {"gel_depth_m", frame.gel_depth_m},
                                      {"object_depth_m", frame.object_depth_m},
                                      {"momentum_kg_m_s", vector(frame.momentum_kg_m_s)},
                                      {"kinetic_energy_j", frame.kinetic_energy_j}});
  }
  const auto press_end = press_end_frame(scene.sample, phases);
  write_arrays(stage, sensor, scene, run, markers, press_end);
  if (scene.config.height_maps) write_maps(stage, sensor, scene, run);

  const MpmSetup& setup = scene.setup;
  const MpmFrame& last = run.frames.back();
  const double wave_speed = setup.wave_speed_m_s();
  Value::Map summary{{"frames", run.frames.size()},
                     {"face", scene.face},
                     {"particles", static_cast<std::int64_t>(scene.lattice.rest_m.rows())},
                     {"columns", scene.lattice.num_columns()},
                     {"layers", scene.lattice.layers},
                     {"object_points", static_cast<std::int64_t>(scene.object_points_m.rows())},
                     {"object_points_per_mm2", scene.points_per_m2() * 1e-6},
                     {"grid_nodes", run.grid_nodes},
                     {"substeps", last.steps},
                     {"substep_s", setup.step_s},
                     {"courant", wave_speed * setup.step_s / setup.grid_spacing_m},
                     {"wave_speed_m_s", wave_speed},
                     {"object_speed_m_s", run.object_speed_m_s},
                     {"particle_speed_m_s", run.particle_speed_m_s},
                     {"largest_mach", std::max(run.object_speed_m_s, run.particle_speed_m_s) / wave_speed},
                     {"sorts", run.sorts},
                     {"density_kg_m3", setup.density_kg_m3},
                     {"lame_mu_pa", setup.mu_pa},
                     {"lame_lambda_pa", setup.lambda_pa},
                     {"particle_mass_kg", setup.particle_mass_kg()},
                     {"gel_mass_kg", setup.particle_mass_kg() * static_cast<double>(scene.lattice.rest_m.rows())},
                     {"gel_depth_m", last.gel_depth_m},
                     {"object_depth_m", last.object_depth_m},
                     {"momentum_kg_m_s", vector(last.momentum_kg_m_s)},
                     {"kinetic_energy_j", last.kinetic_energy_j}};
  if (press_end) summary.emplace_back("press_end_frame", *press_end);
  if (effect) {
    summary.emplace_back("marker_change_at_half_speed", effect->change);
    summary.emplace_back("marker_change_of_last_frame", effect->last_frame);
    summary.emplace_back("marker_change_of_worst_frame", effect->worst_frame);
  }
  summary.emplace_back("per_frame", std::move(per_frame));
  stage.summarize(summary);
}

}  // namespace tacipc

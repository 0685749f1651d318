#include "stages/gel/press/drive/scene_bodies.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/base/error.h"
#include "common/mesh/mass_properties.h"
#include "common/sample/placement.h"

namespace tacipc {
namespace {

constexpr std::size_t kMostBodies = 200;

/// Checks the settings. \throw UsageError if the press file or the sensor does not support scenes
void check_settings(const Sensor& sensor, const std::vector<SceneBody>& bodies, const PressConfig& config,
                    const SceneSpec& spec) {
  require_rigid_mount(sensor);
  if (config.augmented_lagrangian)
    throw UsageError("constraints: augmented_lagrangian holds one gel and one object; a scene needs elimination");
  if (config.gravity_m_s2 != Vector3::Zero())
    throw UsageError("gravity_m_s2 is along the axes of one gel; a scene has it in the sample");
  if (spec.time_step_s && *spec.time_step_s != config.time_step_s)
    throw UsageError(
        fmt::format("time_step_s: the paths of the scene are made for steps of {:g} s, the press file has {:g} s",
                    *spec.time_step_s, config.time_step_s));
  if (config.mass_damping_per_s > 0.0) throw UsageError("damping.mass_per_s would hold back bodies that move");
  if (config.quasi_static && spec.count(BodyKind::soft) > 0)
    throw UsageError("dynamics: quasi_static holds only what a mount holds; soft bodies need inertia");
  if (bodies.size() > kMostBodies) throw UsageError(fmt::format("a scene has at most {} bodies", kMostBodies));
}

/// Body of a world. \throw DataError that names a rigid or fixed body whose surface is not closed
Body body_of(const BodySpec& spec, const SceneBody& files, const PressConfig& config) {
  Body body{.name = spec.name,
            .tets = files.tets,
            .material = files.material,
            .surface = files.surface,
            .start = files.path.empty() ? spec.world_from_body : files.path.front(),
            .velocity_m_s = spec.velocity_m_s,
            .spin_rad_s = spec.spin_rad_s};
  if (body.deformable()) return body;
  body.affine_pose = body.start;
  try {
    if (!check_object(body.surface, config)) throw DataError("the object is not closed");
    require_solid(mass_properties(body.surface.positions, body.surface.triangles).second_moment_m2);
  } catch (const DataError& error) {
    throw DataError("body {}: {}", spec.name, error.what());
  }
  if (spec.kind == BodyKind::rigid) {
    const Positions at = transformed(body.start, body.surface.positions);
    const MassProperties mass = mass_properties(at, body.surface.triangles);
    body.affine = make_affine_body(at, body.surface.triangles, spec.mass.density_of(mass.volume_m3));
  }
  return body;
}

}  // namespace

std::vector<Body> scene_bodies(const Sensor& sensor, const std::vector<SceneBody>& files, const PressConfig& config,
                               const SceneSpec& spec) {
  check_settings(sensor, files, config, spec);
  int time_steps = 0;
  for (const ScenePhase& phase : spec.motion) time_steps += phase.steps * phase.substeps;
  for (std::size_t b = 0; b < files.size(); ++b) {
    if (!files[b].path.empty()) check_path(spec.bodies[b].name, files[b].path, time_steps);
  }
  std::vector<Body> bodies;
  for (std::size_t b = 0; b < files.size(); ++b) bodies.push_back(body_of(spec.bodies[b], files[b], config));
  return bodies;
}

PairContact scene_contact(const Sensor& sensor, const PressConfig& config, const SceneSpec& spec) {
  PairContact contact{.gel_friction = config.with_friction_of(sensor).coefficient_of_friction(), .pairs = spec.contact};
  for (const ScenePhase& phase : spec.motion) {
    for (const auto& load : phase.load_n) contact.load_n = std::max(contact.load_n, load.second.norm());
  }
  return contact;
}

}  // namespace tacipc

// configs/rivals/mpm/*.yaml
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/config/config.h"

namespace tacipc {

/// Particles of the gel on a regular lattice.
struct LatticeConfig {
  std::optional<std::array<int, 3>> counts =
      {};  // a block of its own with its front at z = 0; absent: the sensor's gel
  double spacing_m = 0.0;
  bool on_faces = false;                 // the outermost particles lie on the gel's faces, else half a spacing inside
  std::optional<double> volume_m3 = {};  // of a particle; absent: spacing³
  std::optional<int> fixed_layers =
      {};  // the lowest layers of particles do not move; absent: the nodes of the glued face

  static LatticeConfig read(ConfigReader& in);
};

/// The rigid object as points of its surface.
struct ObjectPointsConfig {
  double samples_per_m2 = 0.0;   // of its whole surface
  double mass_ratio = 0.0;       // of a point over a particle of the gel
  double press_speed_m_s = 0.0;  // of presses and releases
  double move_speed_m_s = 0.0;   // of everything else, at the fastest point of its surface
  double start_gap_m = 0.0;      // between the object's lowest point and z = 0 in frame 0
  std::uint64_t seed = 1;

  static ObjectPointsConfig read(ConfigReader& in);
};

struct MpmConfig {
  LatticeConfig gel = {};
  std::optional<double> density_kg_m3 = {};  // absent: the sensor's, as the next two
  std::optional<double> youngs_modulus_pa = {};
  std::optional<double> poissons_ratio = {};
  double grid_spacing_m = 0.0;
  std::optional<Vector3> grid_origin_m = {};  // where a node lies; absent: below the origin of S on the glued face
  std::optional<double> step_s = {};          // or
  double courant = 0.0;                       // wave speed × step / grid spacing
  double damping_per_s = 0.0;
  ObjectPointsConfig object = {};
  bool depth_of_gel = false;    // a press is as deep as the gel's front is, else as the object's lowest point
  double frame_within_m = 0.0;  // of the gel: a frame is the first look at which the front lacks at most that much
  int check_every = 1;          // steps between looks at the front's depth
  double hold_frame_s = 0.0;    // a frame in which nothing moves
  bool height_maps = true;      // of every frame; else markers only
  bool pixels_at_ends = false;  // the first and last pixel look at the window's edges, else at half a pixel inside
  std::optional<double> largest_change = {};  // of the markers when the object moves half as fast; absent: not tried

  static MpmConfig read(ConfigReader& in);
};

}  // namespace tacipc

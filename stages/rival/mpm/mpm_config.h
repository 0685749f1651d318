// Content of configs/rivals/mpm/*.yaml.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/config/config.h"

namespace tacipc {

/// Particles of the gel on a regular lattice.
struct LatticeConfig {
  std::optional<std::array<int, 3>> counts =
      {};  // particles of a separate block with its front at z = 0; absent: the sensor's gel
  double spacing_m = 0.0;
  bool on_faces = false;  // true: the outermost particles lie on the gel's faces; false: half a spacing inside
  std::optional<double> volume_m3 = {};  // volume of a particle; absent: spacing³
  std::optional<int> fixed_layers =
      {};  // number of lowest particle layers that do not move; absent: the nodes of the glued face do not move

  static LatticeConfig read(ConfigReader& in);
};

/// The rigid object as points of its surface.
struct ObjectPointsConfig {
  double samples_per_m2 = 0.0;   // points per area of the whole surface
  double mass_ratio = 0.0;       // mass of a point over that of a particle of the gel
  double press_speed_m_s = 0.0;  // speed of presses and releases
  double move_speed_m_s = 0.0;   // speed of all other motions, at the fastest point of the surface
  double start_gap_m = 0.0;      // gap between the object's lowest point and z = 0 in frame 0
  std::uint64_t seed = 1;

  static ObjectPointsConfig read(ConfigReader& in);
};

/// Configuration of mpm.
struct MpmConfig {
  LatticeConfig gel = {};
  std::optional<double> density_kg_m3 = {};  // absent: from the sensor, like the next two
  std::optional<double> youngs_modulus_pa = {};
  std::optional<double> poissons_ratio = {};
  double grid_spacing_m = 0.0;
  std::optional<Vector3> grid_origin_m =
      {};                             // position of a grid node; absent: below the origin of S on the glued face
  std::optional<double> step_s = {};  // step length; otherwise `courant` gives it
  double courant = 0.0;               // wave speed × step / grid spacing
  double damping_per_s = 0.0;
  ObjectPointsConfig object = {};
  bool depth_of_gel =
      false;  // true: the depth of a press is that of the gel's front; false: that of the object's lowest point
  double frame_within_m = 0.0;  // tolerance of the front's depth: a frame is saved at the first check within it
  int check_every = 1;          // steps between checks of the front's depth
  double hold_frame_s = 0.0;    // duration of a frame in which nothing moves
  bool height_maps = true;      // write a height map of every frame; false: markers only
  bool pixels_at_ends =
      false;  // true: the first and last pixel lie on the edges of the field of view; false: half a pixel inside
  std::optional<double> largest_change =
      {};  // largest permitted change of the markers at half the object's speed; absent: not tested

  static MpmConfig read(ConfigReader& in);
};

}  // namespace tacipc

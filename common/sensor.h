// A sensor as one file: gel, material, light, camera. Frame S: origin at the centre of the undeformed front face, x to
// image right, y to image down, z out of the gel towards the object; the camera looks along +z from behind. Values are
// SI here.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config.h"
#include "common/types.h"

namespace tacipc {

/// Outline and thickness of the gel. A flat gel fills −thickness ≤ z ≤ 0; a domed one has its apex at the origin, its
/// front lies on the sphere of radius `dome_radius_m` below it, and its thickness is measured at the apex.
struct GelShape {
  enum class Outline { disc, rectangle };
  Outline outline = Outline::disc;
  double radius_m = 0.0;  // disc
  double width_m = 0.0;   // rectangle, along x
  double height_m = 0.0;  // rectangle, along y
  double thickness_m = 0.0;
  std::optional<double> dome_radius_m;  // absent: flat front

  static GelShape read(ConfigReader& in);
  /// Height of the undeformed front face at (x, y): 0 for a flat gel, −(R − √(R² − x² − y²)) for a dome.
  double front_z(double x, double y) const;
};

/// Isotropic elastic material.
struct Material {
  std::string law;  // "neo_hookean" or "stvk_hencky"
  double density_kg_m3 = 0.0;
  double youngs_modulus_pa = 0.0;
  double poissons_ratio = 0.0;

  static Material read(ConfigReader& in);
  /// Lamé parameters: λ = E ν / ((1 + ν)(1 − 2ν)), μ = E / (2(1 + ν)), in Pa.
  double lame_lambda_pa() const;
  double lame_mu_pa() const;
};

/// One light. Colour is linear sRGB times intensity, in the renderer's radiometric unit (only ratios show after
/// exposure).
struct Led {
  Vector3 position_m = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit, the direction of its maximum
  std::array<double, 3> rgb{};        // linear radiant intensity along the normal
  std::array<double, 2> size_m{};     // edge lengths of the square emitter; zero for a point
  bool lambertian = true;             // I(θ) = I0 cos θ, else isotropic

  /// Every LED of a sensor's `leds` section: a ring pattern or a list.
  static std::vector<Led> read_all(ConfigReader& in);
};

/// Pinhole camera at `position_m` looking along +z; the image plane is given by the window it sees of the plane z = 0.
struct Camera {
  Vector3 position_m = Vector3::Zero();
  int width_px = 0;
  int height_px = 0;
  double window_width_m = 0.0;
  double window_height_m = 0.0;

  static Camera read(ConfigReader& in);
};

/// What turns radiance into 8-bit codes.
struct Response {
  double mean_level = 0.0;  // exposure makes the no-contact image's mean this fraction of full scale (after the curve)
  std::string curve;        // "srgb" or "linear"

  static Response read(ConfigReader& in);
};

/// Markers printed on the front face, in rows along x and columns along y.
struct MarkerGrid {
  int rows = 19;
  int columns = 19;
  double pitch_m = 1e-3;
  double center_x_m = 0.0;  // of the whole grid, frame S
  double center_y_m = 0.0;
  bool given = false;  // the sensor file has a section `markers`: then each must lie on the front face

  static MarkerGrid read(ConfigReader& in);
  /// Marker of a row (0 at the smallest y) and a column (0 at the smallest x) on the undeformed gel, frame S.
  double x_m(int column) const { return center_x_m + (column - 0.5 * (columns - 1)) * pitch_m; }
  double y_m(int row) const { return center_y_m + (row - 0.5 * (rows - 1)) * pitch_m; }
};

struct Sensor {
  std::string name;
  GelShape gel;
  Material material;
  std::array<double, 3> coating_albedo{};
  std::array<double, 3> ambient_rgb{};  // radiance added everywhere: the veil of internal reflections and housing
  std::vector<Led> leds;
  Camera camera;
  MarkerGrid markers;
  Response response;
  std::optional<std::filesystem::path>
      reference_image;  // a real photograph without contact, relative to the sensor file

  static Sensor read(ConfigReader& in);
};

/// Linear sRGB of a black body at `kelvin`, largest channel 1 (Planck × CIE 1931, fit of Wyman et al. 2013).
std::array<double, 3> color_of_temperature(double kelvin);

}  // namespace tacipc

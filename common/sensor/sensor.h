// Sensor: contents of a sensor file (gel, material, light, camera), in SI units.
// Frame S: origin at the centre of the undeformed front face, x to image right, y to image down, z out of the gel
// towards the object. The camera looks along +z from behind.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/sensor/layered_path.h"
#include "common/sensor/light_field.h"

namespace tacipc {

/// Outline and thickness of the gel. A flat gel fills −thickness ≤ z ≤ 0. A domed gel has its apex at the origin and
/// its front on the sphere of radius `dome_radius_m` below it; its thickness is measured at the apex.
struct GelShape {
  enum class Outline { disc, rectangle };
  Outline outline = Outline::disc;
  double radius_m = 0.0;  // radius of a disc
  double width_m = 0.0;   // size of a rectangle along x
  double height_m = 0.0;  // size of a rectangle along y
  double thickness_m = 0.0;
  std::optional<double> dome_radius_m = std::nullopt;  // absent: flat front

  static GelShape read(ConfigReader& in);
  /// Returns whether (x, y) lies within the outline.
  bool contains(double x, double y) const;
  /// Returns the height of the undeformed front face at (x, y): 0 for a flat gel, −(R − √(R² − x² − y²)) for a dome.
  double front_z(double x, double y) const;
};

/// One term of a Prony series: a fraction of the instantaneous modulus that relaxes.
struct Relaxation {
  double part = 0.0;    // g, fraction of the instantaneous modulus
  double time_s = 0.0;  // τ, time after which 1/e of it remains
};

/// Isotropic material, elastic or viscoelastic.
struct Material {
  std::string law = {};  // "neo_hookean" or "stvk_hencky"
  double density_kg_m3 = 0.0;
  double youngs_modulus_pa = 0.0;  // long-term modulus, of a relaxed gel
  double poissons_ratio = 0.0;
  std::vector<Relaxation> relaxation = {};  // empty: elastic; the fractions sum to less than 1

  /// Reads the section `material` of a sensor, or a file of its own with the same keys. Values may state their source
  /// (ConfigReader::accept_sources).
  static Material read(ConfigReader& in);
  /// Return Lamé's parameters: λ = E ν / ((1 + ν)(1 − 2ν)), μ = E / (2(1 + ν)), in Pa, long-term like E.
  double lame_lambda_pa() const;
  double lame_mu_pa() const;
};

/// A planar layer behind the gel, such as the acrylic plate.
struct Layer {
  std::string name = {};
  double thickness_m = 0.0;
  double ior = 1.0;  // refractive index
};

/// Media between membrane and camera, in order of falling z: the gel, the layers, then air.
struct OpticalStack {
  double gel_thickness_m = 0.0;                  // thickness at z = 0
  std::optional<double> gel_ior = std::nullopt;  // absent: light travels straight between any two points
  std::vector<Layer> layers = {};                // ordered from the gel towards the camera

  /// Returns whether light bends at the layers.
  bool refracts() const { return gel_ior.has_value(); }
  /// Returns z of the last interface, towards air.
  double back_z_m() const;
  static OpticalStack read(ConfigReader& sensor, ConfigReader& gel, double gel_thickness_m);
  /// Returns the media from height `z_m` to the gel's front, beginning with the one that contains z_m.
  /// \pre z_m < −gel_thickness_m
  LayerStack from(double z_m) const;
};

/// Mount of the gel's glued face: a massless spring along z and one along x and y. It moves by compliance × force
/// against the housing and takes frame S along.
struct Mount {
  double compliance_m_per_n = 0.0;        // compliance along z; 0: rigid
  double shear_compliance_m_per_n = 0.0;  // compliance along x and y

  /// Returns whether the mount is compliant.
  bool gives_way() const { return compliance_m_per_n > 0.0 || shear_compliance_m_per_n > 0.0; }
  /// Returns the compliances along x, y, z.
  Vector3 compliance() const { return {shear_compliance_m_per_n, shear_compliance_m_per_n, compliance_m_per_n}; }
  static Mount read(ConfigReader& in);
};

/// Paint on the front face as seen from inside: a Lambertian part and a glossy lobe (GGX microfacets of roughness
/// `ggx_alpha`, Schlick's Fresnel term from `specular_f0`).
struct Coating {
  std::array<double, 3> albedo{};
  double specular_f0 = 0.0;  // 0: no glossy lobe
  double ggx_alpha = 1.0;

  static Coating read(ConfigReader& in);
};

/// Angular emission: how a light's intensity falls with the angle θ from its normal.
enum class Emission { lambertian, isotropic, cosine_power };

/// One light. The colour is linear sRGB of the group; the intensity is relative within the group, in the renderer's
/// radiometric unit (after exposure only ratios matter).
struct Led {
  Vector3 position_m = Vector3::Zero();
  Vector3 normal = Vector3::UnitZ();  // unit, direction of maximum intensity
  std::array<double, 3> rgb{};        // linear radiant intensity along the normal, at `intensity` 1
  std::array<double, 2> size_m{};     // edge lengths, radial and tangential about the sensor's axis; zero for a point
  Emission emission = Emission::lambertian;
  double emission_exponent = 1.0;  // m of cosine_power: I = I0 cos^m θ
  double intensity = 1.0;
  std::string group = {};  // LEDs with the same name are driven together and share a colour; empty: a group of one

  /// Reads all LEDs of a sensor's section `leds`: a ring pattern or a list. No LED may lie in the gel nor, if light is
  /// refracted, in front of it.
  static std::vector<Led> read_all(ConfigReader& in, const GelShape& gel, const OpticalStack& stack);
};

/// LEDs that are always driven together: one basis image, one colour.
struct LightGroup {
  std::string name = {};  // empty for a single LED
  std::array<double, 3> rgb{};
  std::vector<int> leds = {};
};

/// Returns the groups in the order of their first LEDs.
std::vector<LightGroup> light_groups(const std::vector<Led>& leds);

/// A scattering ring between LEDs and gel: transmitted light leaves its face as from a Lambertian emitter.
struct Diffuser {
  double inner_radius_m = 0.0;
  double outer_radius_m = 0.0;
  double z_m = 0.0;            // height of the face towards the gel
  double transmittance = 1.0;  // fraction of the light

  static Diffuser read(ConfigReader& in, const OpticalStack& stack, const std::vector<Led>& leds);
};

/// Camera at `position_m`. With rotation zero it looks along +z, columns grow with x and rows with y. Models:
/// `pinhole`: x_d = f tan θ; `fisheye`: r = f θ (equidistant); `rectified`: each pixel is a point of the undeformed
/// plane z = 0 on a linear grid, seen through the layers along the refracted path (a real image after rectification).
struct Camera {
  enum class Model { pinhole, fisheye, rectified };
  Vector3 position_m = Vector3::Zero();
  int width_px = 0;
  int height_px = 0;
  double window_width_m = 0.0;  // field of view: what the middle row and column show of the plane z = 0
  double window_height_m = 0.0;
  Model model = Model::pinhole;
  Vector3 rotation_rad = Vector3::Zero();                             // rotation about x, then y, then z of S
  std::optional<std::array<double, 4>> intrinsics_px = std::nullopt;  // fx, fy, cx, cy; absent: from the field of view
  std::array<double, 3> radial{};      // k1, k2, k3 of Brown's distortion (fisheye: of θ)
  std::array<double, 2> tangential{};  // p1, p2
  std::array<double, 2> vignetting{};  // v2, v4: 1 + v2 ρ² + v4 ρ⁴, ρ = 1 in the corner

  static Camera read(ConfigReader& in, const GelShape& gel, const OpticalStack& stack);
};

/// Response: conversion of radiance to 8-bit values.
struct Response {
  double mean_level = 0.0;  // mean of the no-contact image as a fraction of full scale, set by the exposure
  std::string curve = {};   // "srgb", "linear" or "gamma"
  double gamma = 2.2;       // exponent of "gamma": value = v^(1/gamma)
  std::optional<double> exposure = std::nullopt;                  // fixed exposure; absent: computed from mean_level
  std::array<double, 3> white_balance{1.0, 1.0, 1.0};             // gains of the channels
  std::array<double, 9> color_matrix{1, 0, 0, 0, 1, 0, 0, 0, 1};  // camera from scene colours, by rows, after the gains

  static Response read(ConfigReader& in);
};

/// Noise of the photosites.
struct SensorNoise {
  double full_well_e = 0.0;  // full well: electrons at full scale
  double read_e = 0.0;       // standard deviation of the read noise, electrons

  static SensorNoise read(ConfigReader& in);
};

/// Markers printed on the front face, in rows along x and columns along y.
struct MarkerGrid {
  int rows = 19;
  int columns = 19;
  double pitch_m = 1e-3;
  double center_x_m = 0.0;  // centre of the grid, frame S
  double center_y_m = 0.0;
  bool given = false;  // the sensor file has a section `markers`, so that each marker must lie on the front face
  std::optional<double> radius_m = std::nullopt;  // radius of the printed dots; absent: positions only
  std::array<double, 3> albedo{};                 // albedo of the dots

  static MarkerGrid read(ConfigReader& in);
  /// Returns whether a point of the undeformed gel lies on a dot.
  /// \pre radius_m
  bool covers(double x, double y) const;
  /// Return the position of a marker's column (0 at the smallest x) and row (0 at the smallest y) on the undeformed
  /// gel, frame S.
  double x_m(int column) const { return center_x_m + (column - 0.5 * (columns - 1)) * pitch_m; }
  double y_m(int row) const { return center_y_m + (row - 0.5 * (rows - 1)) * pitch_m; }
};

/// Source of one value of a sensor file: `known`, `derived`, `guess`, or `unstated`.
struct ValueSource {
  std::string path = {};
  std::string source = {};
};

/// Reads a light's colour: exactly one of `rgb_linear`, `cct_k`, and `wavelength_nm` with `fwhm_nm`; the last two with
/// largest channel 1 and no negative channel.
std::array<double, 3> read_light_color(ConfigReader& in);

/// Contents of a sensor file.
struct Sensor {
  std::string name = {};
  GelShape gel;
  std::optional<double> friction = std::nullopt;  // coefficient of the gel's surface; absent: as in the press file
  Material material;
  Mount mount = {};
  OpticalStack stack;
  Coating coating;
  std::array<double, 3> ambient_rgb{};  // radiance added everywhere: internal reflections and housing
  std::vector<Led> leds = {};
  std::optional<Diffuser> diffuser = std::nullopt;
  /// Light calibrated on photographs, as changes of 8-bit values against the reference image. It replaces leds,
  /// coating, ambient and response, which stay empty.
  std::optional<LightField> light_field = std::nullopt;
  Camera camera;
  MarkerGrid markers;
  Response response;
  std::optional<SensorNoise> noise = std::nullopt;
  std::optional<std::filesystem::path>
      reference_image;  // a real photograph without contact, relative to the sensor file
  std::vector<ValueSource> sources = {};

  static Sensor read(ConfigReader& in);
};

}  // namespace tacipc

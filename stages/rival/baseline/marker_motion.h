// Moves markers under an object by the formulas of FOTS or by Taxim's superposition.
#pragma once

#include <filesystem>
#include <vector>

#include "common/base/types.h"
#include "common/config/config.h"
#include "common/sensor/sensor.h"

namespace tacipc {

/// FOTS [Zhao2024]: every motion of the object moves markers by a Gaussian of their distance.
struct FotsMotion {
  double press_per_m2 = 0.0;  // λ_d
  double shear_per_m2 = 0.0;  // λ_s
  double twist_per_m2 = 0.0;  // λ_t
  /// FOTS's own marker grid; its markers in contact push the others.
  Eigen::Vector2d first_px = Eigen::Vector2d::Zero(), pitch_px = Eigen::Vector2d::Zero();
  int columns = 0, rows = 0;
};

/// Section `markers` of a configuration: marker motion without a gel.
struct MarkerMotionConfig {
  enum class Model { fots, superposition };
  Model model = Model::fots;
  FotsMotion fots;

  static MarkerMotionConfig read(ConfigReader& in);
};

/// Marker or node in contact, and the object's depth there, m > 0.
struct ContactPoint {
  Eigen::Vector2d place_m;
  double depth_m = 0.0;
};

/// Motion of the object since the end of the press.
struct ObjectMotion {
  Eigen::Vector2d center_m = Eigen::Vector2d::Zero();  // centre of the contact at the end of the press
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();
  double turn_rad = 0.0;  // rotation from x towards y
};

/// Displacement of a marker at rest at M [Zhao2024]:
///   press M' = M + Σ_i h_i (M − C_i) exp(−λ_d |M − C_i|²), h_i the depth of contact marker C_i in mm;
///   shear M'' = M' + s exp(−λ_s |M' − G|²);
///   twist M''' = M'' + (Rot(θ) − 1)(M'' − G) exp(−λ_t |M'' − G|²), θ within ± 50°.
Eigen::Vector2d fots_displacement(const Eigen::Vector2d& marker_m, const std::vector<ContactPoint>& contact,
                                  const ObjectMotion& motion, const FotsMotion& model);

/// Solves min |A x − b|, x ≥ 0, by coordinate descent on the normal equations to 1e-10 of the largest entry.
/// \pre no column of A is zero
Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// Displacement of the nodes of a square lattice around a node that moves by 1: into the gel, along x, along y.
struct UnitResponse {
  int reach_x = 0, reach_y = 0;          // number of nodes on either side
  Positions pressed = {}, sheared = {};  // displacements row by row, for unit motion along z and along x

  /// Displacement (x, y, into the gel) of the node `dx`, `dy` away from the loaded one; 0 beyond the lattice.
  Vector3 press(int dx, int dy) const;
  Vector3 shear_x(int dx, int dy) const;
  /// Response to motion along y: shear_x turned by 90°.
  Vector3 shear_y(int dx, int dy) const;

  /// Reads a press folder: a small object pressed on the middle of the lattice, then moved along x.
  /// \throw DataError if the motion differs, or the markers are not the sensor's whole lattice with one in the middle
  static UnitResponse read(const std::filesystem::path& folder, const MarkerGrid& grid);
};

/// Taxim's superposition [SiYuan2022] on that lattice. Loads f ≥ 0 are found whose normal displacements give the depth
/// at the nodes in contact. Loads s ≥ 0 along an axis are found that move all these nodes by the object's travel; each
/// is then multiplied by depth / largest depth.
class Superposition {
 public:
  /// \param depth_m depth of every node, 0 where it is not in contact
  Superposition(const UnitResponse& response, const MarkerGrid& grid, const std::vector<double>& depth_m);
  /// In-plane displacement of every node, m.
  std::vector<Eigen::Vector2d> displacement(const Eigen::Vector2d& shift_m) const;

 private:
  std::vector<Eigen::Vector2d> press_, along_x_,
      along_y_;  // nodes' in-plane displacements by the press, and by a travel of 1 m along x and along y
};

}  // namespace tacipc

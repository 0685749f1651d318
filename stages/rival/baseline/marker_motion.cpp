#include "stages/rival/baseline/marker_motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/base/units.h"
#include "common/sample/press_folder.h"

namespace tacipc {

MarkerMotionConfig MarkerMotionConfig::read(ConfigReader& file) {
  ConfigReader in = file.section("markers");
  MarkerMotionConfig config;
  if (in.choice("model", {"fots", "superposition"}) == "superposition") {
    config.model = Model::superposition;
    return config;
  }
  constexpr double kPerMm2 = 1e6;
  config.fots.press_per_m2 = kPerMm2 * in.number("press_per_mm2", Range::positive());
  config.fots.shear_per_m2 = kPerMm2 * in.number("shear_per_mm2", Range::positive());
  config.fots.twist_per_m2 = kPerMm2 * in.number("twist_per_mm2", Range::positive());
  const auto first = in.numbers("first_px", 2), pitch = in.numbers("pitch_px", 2, Range::positive());
  config.fots.first_px = {first[0], first[1]};
  config.fots.pitch_px = {pitch[0], pitch[1]};
  config.fots.columns = in.integer("columns", 1, 1000);
  config.fots.rows = in.integer("rows", 1, 1000);
  return config;
}

Eigen::Vector2d fots_displacement(const Eigen::Vector2d& marker_m, const std::vector<ContactPoint>& contact,
                                  const ObjectMotion& motion, const FotsMotion& model) {
  Eigen::Vector2d at = marker_m;
  for (const ContactPoint& point : contact) {
    const Eigen::Vector2d apart = marker_m - point.place_m;
    at += point.depth_m / kMillimetre * std::exp(-model.press_per_m2 * apart.squaredNorm()) * apart;
  }
  at += std::exp(-model.shear_per_m2 * (at - motion.center_m).squaredNorm()) * motion.shift_m;
  constexpr double kLargestTurn = 50.0 * std::numbers::pi / 180.0;
  const double turn = std::clamp(motion.turn_rad, -kLargestTurn, kLargestTurn);
  const Eigen::Vector2d arm = at - motion.center_m;
  at += std::exp(-model.twist_per_m2 * arm.squaredNorm()) * (Eigen::Rotation2Dd(turn) * arm - arm);
  return at - marker_m;
}

Eigen::VectorXd non_negative_least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::MatrixXd gram = a.transpose() * a;
  const Eigen::VectorXd moment = a.transpose() * b;
  Eigen::VectorXd x = Eigen::VectorXd::Zero(gram.cols());
  constexpr int kSweeps = 100000;
  constexpr double kTolerance = 1e-10;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    double largest = 0.0;
    for (Eigen::Index i = 0; i < x.size(); ++i) {
      const double before = x[i];
      x[i] = std::max(0.0, before + (moment[i] - gram.row(i).dot(x)) / gram(i, i));
      largest = std::max(largest, std::abs(x[i] - before));
    }
    if (largest <= kTolerance * x.maxCoeff()) break;
  }
  return x;
}

namespace {

Vector3 entry(const Positions& rows, int dx, int dy, int reach_x, int reach_y) {
  if (std::abs(dx) > reach_x || std::abs(dy) > reach_y) return Vector3::Zero();
  return rows.row((dy + reach_y) * (2 * reach_x + 1) + dx + reach_x).transpose();
}

}  // namespace

Vector3 UnitResponse::press(int dx, int dy) const { return entry(pressed, dx, dy, reach_x, reach_y); }

Vector3 UnitResponse::shear_x(int dx, int dy) const { return entry(sheared, dx, dy, reach_x, reach_y); }

Vector3 UnitResponse::shear_y(int dx, int dy) const {
  const Vector3 u = shear_x(dy, -dx);
  return {-u.y(), u.x(), u.z()};
}

UnitResponse UnitResponse::read(const std::filesystem::path& folder, const MarkerGrid& grid) {
  PressFolder press(folder);
  const std::vector<PhaseKind> phases = press.phases();
  if (press.markers(0).rows() != grid.rows * grid.columns || grid.rows % 2 == 0 || grid.columns % 2 == 0)
    throw DataError("{}: its markers are not the sensor's lattice of {} x {} with one in the middle", folder.string(),
                    grid.columns, grid.rows);
  const auto last_of = [&](PhaseKind kind) {
    const auto found = std::find(phases.rbegin(), phases.rend(), kind);
    if (found == phases.rend())
      throw DataError("{}: has no phase {}, which unit responses are made of", folder.string(), name_of(kind));
    return static_cast<std::size_t>(phases.rend() - found) - 1;
  };
  const std::size_t press_end = last_of(PhaseKind::press), shear_end = last_of(PhaseKind::shear);
  UnitResponse out{.reach_x = grid.columns / 2, .reach_y = grid.rows / 2};
  out.pressed = press.marker_displacements(press_end).since_rest;
  out.sheared = press.marker_displacements(shear_end).since_rest - out.pressed;
  const Eigen::Index middle = out.pressed.rows() / 2;
  const double depth = -out.pressed(middle, 2), way = out.sheared(middle, 0);
  if (!(depth > 0.0) || !(way > 0.0))
    throw DataError("{}: does not press the middle marker and move it along x", folder.string());
  out.pressed /= depth;
  out.pressed.col(2) *= -1.0;
  out.sheared /= way;
  return out;
}

Superposition::Superposition(const UnitResponse& response, const MarkerGrid& grid, const std::vector<double>& depth_m) {
  struct Node {
    int column, row;
  };
  const auto columns = static_cast<std::size_t>(grid.columns);
  std::vector<Node> nodes, touched;
  std::vector<double> depths;
  for (std::size_t i = 0; i < depth_m.size(); ++i) {
    nodes.push_back({static_cast<int>(i % columns), static_cast<int>(i / columns)});
    if (!(depth_m[i] > 0.0)) continue;
    touched.push_back(nodes.back());
    depths.push_back(depth_m[i]);
  }
  press_.assign(nodes.size(), Eigen::Vector2d::Zero());
  along_x_ = along_y_ = press_;
  if (touched.empty()) return;
  const Eigen::Index size = std::ssize(touched);
  Eigen::MatrixXd normal(size, size), along_x(size, size), along_y(size, size);
  for (Eigen::Index q = 0; q < size; ++q) {
    for (Eigen::Index k = 0; k < size; ++k) {
      const Node &at = touched[q], &from = touched[k];
      const int dx = at.column - from.column, dy = at.row - from.row;
      normal(q, k) = response.press(dx, dy).z();
      along_x(q, k) = response.shear_x(dx, dy).x();
      along_y(q, k) = response.shear_y(dx, dy).y();
    }
  }
  const Eigen::Map<const Eigen::VectorXd> depth(depths.data(), size);
  const Eigen::VectorXd share = depth / depth.maxCoeff();
  const Eigen::VectorXd f = non_negative_least_squares(normal, depth);
  const Eigen::VectorXd one = Eigen::VectorXd::Ones(size);
  Eigen::Index deepest = 0;
  depth.maxCoeff(&deepest);
  const auto loads = [&](const Eigen::MatrixXd& along) -> Eigen::VectorXd {
    const Eigen::VectorXd s = non_negative_least_squares(along, one).cwiseProduct(share);
    return s / along.row(deepest).dot(s);
  };
  const Eigen::VectorXd sx = loads(along_x), sy = loads(along_y);
  for (std::size_t q = 0; q < nodes.size(); ++q) {
    for (Eigen::Index k = 0; k < size; ++k) {
      const Node& from = touched[k];
      const int dx = nodes[q].column - from.column, dy = nodes[q].row - from.row;
      press_[q] += f[k] * response.press(dx, dy).head<2>();
      along_x_[q] += sx[k] * response.shear_x(dx, dy).head<2>();
      along_y_[q] += sy[k] * response.shear_y(dx, dy).head<2>();
    }
  }
}

std::vector<Eigen::Vector2d> Superposition::displacement(const Eigen::Vector2d& shift_m) const {
  std::vector<Eigen::Vector2d> out;
  for (std::size_t q = 0; q < press_.size(); ++q)
    out.emplace_back(press_[q] + shift_m.x() * along_x_[q] + shift_m.y() * along_y_[q]);
  return out;
}

}  // namespace tacipc

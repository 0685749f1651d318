#include "verification/measure.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numbers>

#include "common/base/error.h"
#include "common/sample/placement.h"

namespace tacipc::verify {
namespace {

using std::numbers::pi;

const Frame& frame_of(const Outcome& outcome, int frame) { return outcome.simulation.frames[frame]; }

Vector3 box_centre(const TriangleMesh& object) {
  return 0.5 * (object.positions.colwise().minCoeff() + object.positions.colwise().maxCoeff()).transpose();
}

/// Contact of a frame: deformed area, force-weighted second moment around the centre of force, heights.
struct Touch {
  double area_m2 = 0.0;
  double force_n = 0.0;
  double mean_square_radius_m2 = 0.0;
  double height_spread_m = 0.0;
  double peak_pressure_pa = 0.0;
};

Touch touch(const Outcome& outcome, int index) {
  const Frame& frame = frame_of(outcome, index);
  const FrontSurface& front = outcome.simulation.front;
  const Positions x = on_front(front, frame.positions);
  const std::vector<double> area = lumped_areas(front, x);
  Touch out;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double force = frame.normal_force_n.row(v).norm();
    if (force <= 0.0) continue;
    out.area_m2 += area[v];
    out.force_n += force;
    middle += force * x.row(v).head<2>();
    low = std::min(low, x(v, 2));
    high = std::max(high, x(v, 2));
    if (area[v] > 0.0) out.peak_pressure_pa = std::max(out.peak_pressure_pa, force / area[v]);
  }
  if (out.force_n <= 0.0) return out;
  middle /= out.force_n;
  out.height_spread_m = high - low;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const Eigen::Vector2d arm = x.row(v).head<2>().transpose() - middle;
    out.mean_square_radius_m2 += frame.normal_force_n.row(v).norm() * arm.squaredNorm() / out.force_n;
  }
  return out;
}

/// The frame at which the first press ends; 0 if there is none.
int press_end(const Outcome& outcome) {
  const auto& frames = outcome.simulation.frames;
  int last = 0;
  for (std::size_t f = 1; f < frames.size(); ++f) {
    const auto phase = static_cast<std::size_t>(frames[f].phase_index);
    const bool pressing = outcome.spec.sample.motion[phase].kind == PhaseKind::press;
    if (pressing && (last == 0 || frames[f].phase_index == frames[last].phase_index)) last = static_cast<int>(f);
  }
  return last;
}

/// Mean speed of the touching front vertices relative to the object in a frame, weighted by normal force, m/s.
double creep_m_s(const Outcome& outcome, int index) {
  if (index == 0) return 0.0;
  const Frame &now = frame_of(outcome, index), &before = frame_of(outcome, index - 1);
  const Positions x = on_front(outcome.simulation.front, now.positions);
  const Positions old = transformed(now.gel_from_object * before.gel_from_object.inverse(),
                                    on_front(outcome.simulation.front, before.positions));
  double force = 0.0, sum = 0.0;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double f = now.normal_force_n.row(v).norm();
    force += f;
    sum += f * (x.row(v) - old.row(v)).head<2>().norm();
  }
  return force > 0.0 ? sum / force / (now.time_s - before.time_s) : 0.0;
}

}  // namespace

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> list{
      {"press_force_n", "N", "force of the object on the gel against z"},
      {"tangential_force_n", "N", "its part in the plane of x and y"},
      {"friction_ratio", "", "tangential over press force"},
      {"force_x_n", "N", "force on the gel along x"},
      {"force_y_n", "N", "force on the gel along y"},
      {"torque_z_n_m", "N m", "torque on the gel about z through the object's centre"},
      {"contact_radius_m", "m", "of the circle with the area of the vertices that touch"},
      {"hertz_radius_m", "m", "of the Hertz pressure with the same second moment: √(5/2 ⟨r²⟩)"},
      {"contact_area_m2", "m2", "deformed front that belongs to vertices that touch"},
      {"mean_pressure_pa", "Pa", "press force over contact area"},
      {"peak_pressure_pa", "Pa", "largest force over area of a front vertex"},
      {"height_spread_m", "m", "highest minus lowest front vertex that touches"},
      {"height_spread_d_hat", "", "the same in units of the barrier's reach"},
      {"indentation_m", "m", "depth of the lowest front vertex below z = 0"},
      {"balance_relative", "", "residual of the force balance over contact force"},
      {"coulomb_ratio", "", "Σ |friction force| over Σ |normal force| of the front vertices"},
      {"creep_relative", "", "mean speed of touching vertices over the object in units of the threshold ε_v"},
      {"sticking", "", "front vertices that stick"},
      {"slipping", "", "front vertices that slip"},
      {"depth_m", "m", "of the object's lowest point below z = 0"},
      {"sideways_m", "m", "travel of the object's centre in x and y since the press ended"},
      {"turned_rad", "rad", "turn of the object about z since the press ended"},
      {"standoff_m", "m", "distance that the barrier keeps, weighted by normal force (sphere, punch, plate, block)"},
      {"min_gap_m", "m", "smallest distance between gel and object"},
      {"min_volume_ratio", "", "smallest volume of a tetrahedron over its rest volume"},
      {"newton_iterations", "", "of the frame"}};
  return list;
}

double depth_m(const Outcome& outcome, int frame) {
  const Matrix4& pose = frame_of(outcome, frame).gel_from_object;
  const Eigen::VectorXd z = outcome.object.positions * pose.block<1, 3>(2, 0).transpose();
  return -(z.minCoeff() + pose(2, 3));
}

double sideways_m(const Outcome& outcome, int frame) {
  const Eigen::Vector4d centre = box_centre(outcome.object).homogeneous();
  const Eigen::Vector4d way = frame_of(outcome, frame).gel_from_object * centre -
                              frame_of(outcome, press_end(outcome)).gel_from_object * centre;
  return way.head<2>().norm();
}

double turned_rad(const Outcome& outcome, int frame) {
  const Matrix3 turn = frame_of(outcome, frame).gel_from_object.topLeftCorner<3, 3>() *
                       frame_of(outcome, press_end(outcome)).gel_from_object.topLeftCorner<3, 3>().transpose();
  return std::atan2(turn(1, 0) - turn(0, 1), turn(0, 0) + turn(1, 1));
}

double standoff_m(const Outcome& outcome, int index) {
  using Kind = ObjectShape::Kind;
  const ObjectShape& shape = outcome.spec.object;
  const bool round = shape.kind == Kind::sphere;
  if (!round && shape.kind != Kind::punch && shape.kind != Kind::plate && shape.kind != Kind::block)
    throw UsageError("the stand-off is measured of sphere, punch, plate and block only");
  const Frame& frame = frame_of(outcome, index);
  const Positions x = on_front(outcome.simulation.front, frame.positions);
  const Vector3 centre = (frame.gel_from_object * Eigen::Vector4d(0.0, 0.0, shape.radius_m, 1.0)).head<3>();
  double force = 0.0, sum = 0.0;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double f = frame.normal_force_n.row(v).norm();
    const double gap =
        round ? (x.row(v).transpose() - centre).norm() - shape.radius_m : -depth_m(outcome, index) - x(v, 2);
    force += f;
    sum += f * gap;
  }
  return force > 0.0 ? sum / force : 0.0;
}

double measure(const Outcome& outcome, const std::string& quantity, int index) {
  const Frame& frame = frame_of(outcome, index);
  const double press = 0.0 - frame.force_n.z(), tangential = frame.force_n.head<2>().norm();
  if (quantity == "press_force_n") return press;
  if (quantity == "tangential_force_n") return tangential;
  if (quantity == "friction_ratio") return press > 0.0 ? tangential / press : 0.0;
  if (quantity == "torque_z_n_m") {
    const Vector3 centre = (frame.gel_from_object * box_centre(outcome.object).homogeneous()).head<3>();
    return (frame.torque_n_m - centre.cross(frame.force_n)).z();
  }
  if (quantity == "contact_radius_m") return std::sqrt(touch(outcome, index).area_m2 / pi);
  if (quantity == "hertz_radius_m") return std::sqrt(2.5 * touch(outcome, index).mean_square_radius_m2);
  if (quantity == "contact_area_m2") return touch(outcome, index).area_m2;
  if (quantity == "mean_pressure_pa") {
    const double area = touch(outcome, index).area_m2;
    return area > 0.0 ? press / area : 0.0;
  }
  if (quantity == "peak_pressure_pa") return touch(outcome, index).peak_pressure_pa;
  if (quantity == "height_spread_m") return touch(outcome, index).height_spread_m;
  if (quantity == "height_spread_d_hat") return touch(outcome, index).height_spread_m / outcome.simulation.d_hat_m;
  if (quantity == "indentation_m") {
    double lowest = 0.0;
    for (const int v : outcome.gel.vertices(BoundaryTag::front)) {
      const double pushed = outcome.gel.positions(v, 2) - frame.positions(v, 2);
      lowest = std::max(lowest, pushed);
    }
    return lowest;
  }
  if (quantity == "balance_relative") return frame.balance.relative;
  if (quantity == "force_x_n") return frame.force_n.x();
  if (quantity == "force_y_n") return frame.force_n.y();
  if (quantity == "sticking" || quantity == "slipping") {
    const ContactState state = quantity == "sticking" ? ContactState::stick : ContactState::slip;
    return static_cast<double>(std::ranges::count(frame.contact_state, state));
  }
  if (quantity == "coulomb_ratio") {
    const double normal = frame.normal_force_n.rowwise().norm().sum();
    return normal > 0.0 ? frame.friction_force_n.rowwise().norm().sum() / normal : 0.0;
  }
  if (quantity == "creep_relative") {
    const Vector3 extent = outcome.gel.positions.colwise().maxCoeff() - outcome.gel.positions.colwise().minCoeff();
    const auto& friction = outcome.spec.press.friction;
    return friction ? creep_m_s(outcome, index) / (friction->relative_speed_threshold * extent.norm()) : 0.0;
  }
  if (quantity == "depth_m") return depth_m(outcome, index);
  if (quantity == "sideways_m") return sideways_m(outcome, index);
  if (quantity == "turned_rad") return turned_rad(outcome, index);
  if (quantity == "standoff_m") return standoff_m(outcome, index);
  if (quantity == "min_gap_m") return frame.min_gap_m.value_or(std::nan(""));
  if (quantity == "min_volume_ratio") return frame.min_volume_ratio;
  if (quantity == "newton_iterations") return frame.solver.newton_iterations;
  throw UsageError("there is no quantity '" + quantity + "'");
}

int find_frame(const Outcome& outcome, const FrameChoice& choice) {
  const int last = static_cast<int>(outcome.simulation.frames.size()) - 1;
  if (choice.index) {
    if (*choice.index > last) throw DataError("frame {} is expected, but the last one is {}", *choice.index, last);
    return *choice.index;
  }
  if (choice.depth_m) {
    for (int f = 0; f <= last; ++f)
      if (std::abs(depth_m(outcome, f) - *choice.depth_m) < 1e-9) return f;
    throw DataError("no frame is {:g} mm deep; let a press phase end there", 1e3 * *choice.depth_m);
  }
  if (choice.phase) {
    // Last frame of the phase given by its kind, or of the n-th phase of that kind: "press", "press 2".
    const std::string name = choice.phase->substr(0, choice.phase->find(' '));
    int wanted = choice.phase->size() > name.size() ? std::atoi(choice.phase->c_str() + name.size()) : 1;
    const auto& motion = outcome.spec.sample.motion;
    for (std::size_t p = 0; p < motion.size(); ++p) {
      if (name_of(motion[p].kind) != name || --wanted > 0) continue;
      for (int f = last; f > 0; --f)
        if (frame_of(outcome, f).phase_index == static_cast<int>(p)) return f;
    }
    throw DataError("the motion has no phase '{}'", *choice.phase);
  }
  return last;
}

}  // namespace tacipc::verify

#include "stages/study/identify/model.h"

#include <algorithm>

#include "common/base/error.h"

namespace tacipc {
namespace {

/// Coordinate of a parameter on the grid. Forces and displacements approach those of a sticking contact as friction
/// grows, nearly linearly in 1/μ; a polynomial in μ would overshoot between the nodes.
double place_on_axis(const std::string& name, double value) { return name == kFriction ? 1.0 / value : value; }

NodeGrid grid_of(const IdentifySpec& spec) {
  std::vector<std::vector<double>> axes;
  for (const MechanicsParameter* axis : spec.axes()) {
    std::vector<double> places;
    for (const double node : axis->nodes) places.push_back(place_on_axis(axis->name, node));
    axes.push_back(std::move(places));
  }
  return NodeGrid(std::move(axes));
}

}  // namespace

MechanicsModel::MechanicsModel(const IdentifySpec& spec, std::vector<MeasurementData> data, const Sensor& held)
    : sigma_factor(spec.measurements.size(), 1.0),
      spec_(spec),
      unknowns_(spec_),
      grid_(grid_of(spec_)),
      data_(std::move(data)),
      held_(held) {
  for (const Measurement& m : spec_.measurements)
    if (m.markers && !camera_) camera_.emplace(held_.camera, held_.stack);
}

Mounting MechanicsModel::mounting(const Eigen::VectorXd& u) const {
  return {.modulus_pa = unknowns_.value(u, kModulus, {}, held_.material.youngs_modulus_pa),
          .compliance_mm_per_n = unknowns_.value(u, kMount, {}, 1e3 * held_.mount.compliance_m_per_n),
          .shear_compliance_mm_per_n = unknowns_.value(u, kShearMount, {}, 1e3 * held_.mount.shear_compliance_m_per_n)};
}

Eigen::VectorXd MechanicsModel::node_weights(const Eigen::VectorXd& u) const {
  std::vector<double> at;
  for (const MechanicsParameter* axis : spec_.axes())
    at.push_back(place_on_axis(axis->name, unknowns_.value(u, axis->name, {}, 0.0)));
  return grid_.weights(at);
}

double MechanicsModel::zero_mm(std::size_t measurement, const Eigen::VectorXd& u) const {
  return unknowns_.value(u, "depth_zero_mm", spec_.measurements[measurement].name, 0.0);
}

double MechanicsModel::press_force_n(std::size_t measurement, const Eigen::VectorXd& u, double depth_mm) const {
  return pressed_force_n(data_[measurement].force->press.blend(node_weights(u)), mounting(u),
                         depth_mm + zero_mm(measurement, u));
}

std::pair<Eigen::Matrix2Xd, Eigen::Matrix2Xd> MechanicsModel::marker_px(std::size_t measurement,
                                                                        const Eigen::VectorXd& u) const {
  const Measurement& m = spec_.measurements[measurement];
  const MarkerData& data = *data_[measurement].markers;
  const auto own = [&](const std::string& name) { return unknowns_.value(u, name, m.name, 0.0); };
  const auto on_front = [&](const Eigen::Vector2d& px) -> Eigen::Vector2d {
    const auto place = camera_->on_plane(px.x(), px.y());
    if (!place) throw DataError("{}: the camera does not see the front at ({:g}, {:g}) px", m.name, px.x(), px.y());
    return *place;
  };
  const Eigen::Vector2d axis_m = on_front({own("contact_x_px"), own("contact_y_px")});
  const Eigen::VectorXd weights = node_weights(u);
  const double depth_m = 1e-3 * own("depth_mm"), travel_m = 1e-3 * own("travel_mm");
  const auto seen = [&](const MarkerField& field, const std::string& name, bool dragged) {
    Eigen::Matrix2Xd rest_m(2, field.rest_px.cols());
    for (Eigen::Index i = 0; i < rest_m.cols(); ++i) rest_m.col(i) = on_front(field.rest_px.col(i));
    const Eigen::Matrix2Xd from_axis = rest_m.colwise() - axis_m;
    Eigen::Matrix3Xd moved = Eigen::Matrix3Xd::Zero(3, rest_m.cols());
    for (std::size_t n = 0; n < data.runs.size(); ++n) {
      const PressedRuns& runs = data.runs[n];
      moved += weights[n] * (dragged ? runs.sheared(from_axis, depth_m, travel_m) : runs.pressed(from_axis, depth_m));
    }
    const Eigen::Vector2d shift(own(name + "_shift_x_px"), own(name + "_shift_y_px"));
    const Eigen::Vector2d middle = 0.5 * camera_px();
    Eigen::Matrix2Xd out(2, rest_m.cols());
    for (Eigen::Index i = 0; i < rest_m.cols(); ++i) {
      const Vector3 point = moved.col(i) + Vector3(rest_m(0, i), rest_m(1, i), 0.0);
      const auto px = camera_->project(point);
      if (!px) throw DataError("{}: the camera does not see one of the simulated markers", m.name);
      out.col(i) = *px + shift + own(name + "_scale") * (*px - middle) - field.rest_px.col(i);
    }
    return out;
  };
  return {seen(data.press, "press", false), seen(data.shear, "shear", true)};
}

Eigen::VectorXd MechanicsModel::fitted_coordinates(const Eigen::Matrix2Xd& press, const Eigen::Matrix2Xd& shear) const {
  std::vector<double> out;
  for (const Eigen::Matrix2Xd* vectors : {&press, &shear})
    for (Eigen::Index i = 0; i < vectors->cols(); ++i)
      if (fits_marker(i)) out.insert(out.end(), {(*vectors)(0, i), (*vectors)(1, i)});
  return Eigen::Map<const Eigen::VectorXd>(out.data(), out.size());
}

Eigen::VectorXd MechanicsModel::predicted(std::size_t measurement, const Eigen::VectorXd& u) const {
  const Measurement& m = spec_.measurements[measurement];
  if (m.markers) {
    const auto [press, shear] = marker_px(measurement, u);
    return fitted_coordinates(press, shear);
  }
  const ForceData& data = *data_[measurement].force;
  Eigen::VectorXd out(data.fitted.size());
  const auto each = [&](auto&& force) {
    for (std::size_t i = 0; i < data.fitted.size(); ++i) out[i] = force(data.fitted[i].at);
  };
  const Mounting mount = mounting(u);
  const Eigen::VectorXd weights = node_weights(u);
  const Curve press = data.press.blend(weights);
  const double zero = zero_mm(measurement, u);
  if (m.kind == MeasurementKind::press) {
    each([&](double depth) { return pressed_force_n(press, mount, depth + zero); });
  } else if (m.kind == MeasurementKind::shear) {
    const double depth = std::max(0.0, m.depth_mm + zero);
    const double reached = depth - mount.compliance_mm_per_n * pressed_force_n(press, mount, depth);
    const Eigen::VectorXd of_depth = NodeGrid({m.depths_mm}).weights({reached});
    CurveTable table = data.shears.front();
    table.y.setZero();
    for (std::size_t k = 0; k < data.shears.size(); ++k) table.y += of_depth[k] * data.shears[k].y;
    const Curve shear = table.blend(weights);
    each([&](double travel) { return sheared_force_n(shear, mount, travel); });
  } else {
    std::vector<Relaxation> terms;
    for (const auto& [part, time] : spec_.relaxation)
      terms.push_back(
          {.part = unknowns_.value(u, part.name, {}, 0.0), .time_s = unknowns_.value(u, time.name, {}, 1.0)});
    std::vector<double> times;
    for (const MeasuredForce& row : data.fitted) times.push_back(row.at);
    const auto forces = relaxing_force_n(press, mount, terms, m.depth_mm + zero, m.ramp_s, times);
    std::ranges::copy(forces, out.begin());
  }
  return out;
}

Eigen::VectorXd MechanicsModel::measured(std::size_t measurement) const {
  const MeasurementData& data = data_[measurement];
  if (data.markers) return fitted_coordinates(data.markers->press.moved_px, data.markers->shear.moved_px);
  Eigen::VectorXd out(data.force->fitted.size());
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = data.force->fitted[i].force_n;
  return out;
}

Eigen::VectorXd MechanicsModel::sigma(std::size_t measurement) const {
  const MeasurementData& data = data_[measurement];
  const double factor = sigma_factor[measurement];
  if (data.markers) {
    return Eigen::VectorXd::Constant(measured(measurement).size(),
                                     factor * spec_.measurements[measurement].markers->sigma_px);
  }
  Eigen::VectorXd out(data.force->fitted.size());
  for (Eigen::Index i = 0; i < out.size(); ++i) out[i] = factor * data.force->fitted[i].sigma_n;
  return out;
}

Eigen::Index MechanicsModel::rows() const {
  Eigen::Index rows = 0;
  for (std::size_t m = 0; m < data_.size(); ++m) rows += sigma(m).size();
  return rows;
}

Eigen::VectorXd MechanicsModel::residuals(const Eigen::VectorXd& u) const {
  Eigen::VectorXd out(rows() + unknowns_.size());
  Eigen::Index row = 0;
  for (std::size_t m = 0; m < data_.size(); ++m) {
    const Eigen::VectorXd r = off(m, u);
    out.segment(row, r.size()) = r;
    row += r.size();
  }
  for (Eigen::Index i = 0; i < unknowns_.size(); ++i)
    out[row + i] = (u[i] - unknowns_[i].u_mean()) / unknowns_[i].prior.sigma;
  return out;
}

}  // namespace tacipc

// Within a time step: objects that go where they are told, and those that move freely.
#include <algorithm>
#include <cmath>

#include "stages/gel/press/energy/orthogonality.h"
#include "stages/gel/press/solve/step_under_way.h"

namespace tacipc {

Positions way_of(const Matrix4& motion, const Positions& from) {
  const Matrix3 turn = motion.topLeftCorner<3, 3>() - Matrix3::Identity();
  return (from * turn.transpose()).rowwise() + motion.topRightCorner<3, 1>().transpose();
}

void TimeStepper::add_bodies(Step& step, const State& state) {
  const StepGoal& goal = step.goal;
  for (Step::Body& free : step.bodies) {
    const auto i = static_cast<std::size_t>(free.body);
    const AffineBody& body = bodies_[i];
    const Vector3 load_n = goal.body_load_n.empty() ? goal.load_n : goal.body_load_n[i];
    const int first = mesh_.control_row(free.body);
    free.acceleration_m_s2 = settings_.gravity_m_s2 + load_n / body.mass_kg;
    free.weight_n = body.mass_kg * std::max(settings_.gravity_m_s2.norm(), load_n.norm() / body.mass_kg);
    free.predicted =
        predicted(body, state.x.middleRows<4>(first), state.object_motion[i], free.acceleration_m_s2, goal.h_s);
    step.terms.bodies.push_back(
        {std::make_shared<Inertia>(Eigen::VectorXd::Constant(4, 0.25 * body.mass_kg), Positions(free.predicted), first),
         std::make_shared<Orthogonality>(first, body, orthogonality_pa(body))});
  }
}

template <typename Use>
void TimeStepper::for_each_held(const Step& step, Use&& use) const {
  std::size_t next = 0;
  for (std::size_t object = 0; object < mesh_.objects.size(); ++object) {
    if (next < step.bodies.size() && step.bodies[next].body == static_cast<int>(object)) {
      ++next;
    } else {
      use(mesh_.objects[object]);
    }
  }
}

bool TimeStepper::objects_arrived(const Step& step) const {
  bool arrived = true;
  for_each_held(step, [&](const ObjectPart& object) {
    const Positions target =
        step.goal.object_target.middleRows(object.first_vertex - mesh_.num_gel_vertices, object.num_vertices);
    arrived = arrived && (object.rows(step.x) - target).cwiseAbs().maxCoeff() == 0.0;
  });
  return arrived;
}

void TimeStepper::place_held_objects(const Step& step, Positions& x) const {
  for_each_held(step, [&](const ObjectPart& object) {
    object.rows(x) =
        step.goal.object_target.middleRows(object.first_vertex - mesh_.num_gel_vertices, object.num_vertices)
            .rowwise() +
        step.object_shift.transpose();
  });
}

Positions TimeStepper::way_of_held_objects(const Step& step, const Positions& x) const {
  Positions way = Positions::Zero(x.rows(), 3);
  for_each_held(step, [&](const ObjectPart& object) {
    object.rows(way) =
        (step.goal.object_target.middleRows(object.first_vertex - mesh_.num_gel_vertices, object.num_vertices) -
         object.rows(x))
            .rowwise() +
        step.object_shift.transpose();
  });
  return way;
}

std::optional<Positions> TimeStepper::way_with_gels(const Step& step, const ObjectPart& object,
                                                    const Positions& points) {
  const StepGoal& goal = step.goal;
  std::vector<bool> touched(static_cast<std::size_t>(mesh_.num_gels()), false);
  for (const ContactPair& pair : pairs_at(step.start)) {
    const int first = pair.vertices[0], second = pair.vertices[3];
    if (!object.has(first) && !object.has(second)) continue;
    const int other = object.has(first) ? second : first;
    if (other >= mesh_.num_gel_vertices) continue;
    const auto gel = static_cast<std::size_t>(mesh_.body_of(other));
    if (touched[gel] || (goal.gel_motion.row(other).array() == 0.0).all()) continue;
    touched[gel] = closest_feature(pair, gather(step.start, pair)).squared_distance <
                   settings_.laws.reach_m() * settings_.laws.reach_m();
  }
  Positions sum = Positions::Zero(points.rows(), 3);
  int count = 0;
  for (std::size_t gel = 0; gel < touched.size(); ++gel) {
    if (!touched[gel]) continue;
    sum += way_of(goal.mount_motion.empty() ? goal.hand_motion : goal.mount_motion[gel], points);
    ++count;
  }
  if (count == 0) return std::nullopt;
  return Positions(sum / count);
}

void TimeStepper::start_ahead(Step& step, const State& state) {
  const StepGoal& goal = step.goal;
  Positions p = Positions::Zero(state.x.rows(), 3);
  const bool mounts = goal.gel_motion.size() > 0;
  for (const Step::Body& free : step.bodies) {
    const auto i = static_cast<std::size_t>(free.body);
    const ControlPoints before = state.x.middleRows<4>(mesh_.control_row(free.body));
    auto points = p.middleRows<4>(mesh_.control_row(free.body));
    if (const auto way = mounts ? way_with_gels(step, mesh_.objects[i], before) : std::nullopt) {
      // Gaps are far smaller than what a held object and its fingers would slide past each other otherwise.
      points = *way;
    } else {
      // Without its weight, which contact mostly carries.
      points = predicted(bodies_[i], before, state.object_motion[i], Vector3::Zero(), goal.h_s) - before;
    }
  }
  for (const CarriedBody& body : newton_->free().carried) body.carry(p);
  if (mounts) p.topRows(mesh_.num_gel_vertices) = goal.gel_motion;
  // Piece by piece: a search for pairs along a long way would find too many.
  const double pieces = std::ceil(relative_way(p) / longest_way());
  const Positions piece = p / std::max(1.0, pieces);
  double part = 0.0;
  for (double made = 1.0; part < 1.0 && made == 1.0;) {
    made = step_limit(pairs_along(step.x, piece), step, piece, kMovingSlack);
    step.x += made * piece;
    part = std::min(1.0, part + made / std::max(1.0, pieces));
    if (made == 1.0 && part > 1.0 - 0.5 / std::max(1.0, pieces)) part = 1.0;
  }
  if (!mounts) return;
  step.gel_way_left = 1.0 - part;
  if (part < 1.0) return;
  arrive_at_mounts(step);
  step.arrived = objects_arrived(step);
}

void TimeStepper::finish_bodies(Step& step, State& state) const {
  const double h = step.goal.h_s;
  const int count = mesh_.num_bodies();
  double worst = -1.0;
  std::size_t next = 0;
  for (const CarriedBody& body : newton_->free().carried) body.carry(step.x);
  for (int b = 0; b < static_cast<int>(bodies_.size()); ++b) {
    const auto i = static_cast<std::size_t>(b);
    const AffineBody& body = bodies_[i];
    const int first = mesh_.control_row(b);
    if (next == step.bodies.size() || step.bodies[next].body != b) {
      // Whoever moves it gives it the momentum of its rigid motion.
      const ControlPoints before = state.x.middleRows<4>(first);
      const ControlPoints now =
          ControlPoints(step.goal.control_target.middleRows<4>(4 * b)).rowwise() + step.object_shift.transpose();
      state.object_motion[i] = after_step(body, before, now, {}, Vector3::Zero(), h);
      step.x.middleRows<4>(first) = now;
      continue;
    }
    const Step::Body& free = step.bodies[next++];
    const ControlPoints now = step.x.middleRows<4>(first);
    state.object_motion[i] = after_step(body, free.predicted, now, state.object_motion[i], free.acceleration_m_s2, h);
    const Wrench inertia = wrench_of(now, 0.25 * body.mass_kg / (h * h) * (now - free.predicted));
    const Vector3 center = center_of(now);
    Vector3 force = -inertia.force_n, torque = -inertia.torque_n_m;
    for (int other = 0; other < count; ++other) {
      const Wrench& of_contact = forces_.between[static_cast<std::size_t>((mesh_.num_gels() + b) * count + other)];
      force += of_contact.force_n;
      torque += of_contact.torque_n_m - center.cross(of_contact.force_n);
    }
    const double part = force.norm() / std::max(free.weight_n, kLeastWeight);
    if (part <= worst) continue;
    worst = part;
    step.report.body_residual_n = force.norm();
    step.report.body_residual_n_m = torque.norm();
    step.report.body_load_n = free.weight_n;
  }
}

}  // namespace tacipc

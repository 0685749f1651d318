#include "stages/gel/press/solve/held_objects.h"

namespace tacipc {
namespace {

/// Calls use(object, its rows of the target) for each held object.
template <typename Use>
void for_each_held(const ContactMesh& mesh, const Step& step, Use&& use) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < mesh.objects.size(); ++i) {
    if (next < step.bodies.size() && step.bodies[next].body == static_cast<int>(i)) {
      ++next;
    } else {
      const ObjectPart& object = mesh.objects[i];
      use(object, step.goal.object_target.middleRows(object.first_vertex - mesh.num_gel_vertices, object.num_vertices));
    }
  }
}

}  // namespace

Positions way_of(const Matrix4& motion, const Positions& from) {
  const Matrix3 turn = motion.topLeftCorner<3, 3>() - Matrix3::Identity();
  return (from * turn.transpose()).rowwise() + motion.topRightCorner<3, 1>().transpose();
}

bool objects_arrived(const ContactMesh& mesh, const Step& step) {
  bool arrived = true;
  for_each_held(mesh, step, [&](const ObjectPart& object, const auto& target) {
    arrived = arrived && (object.rows(step.x) - target).cwiseAbs().maxCoeff() == 0.0;
  });
  return arrived;
}

Positions way_of_held_objects(const ContactMesh& mesh, const Step& step, const Positions& x) {
  Positions way = Positions::Zero(x.rows(), 3);
  for_each_held(mesh, step, [&](const ObjectPart& object, const auto& target) {
    object.rows(way) = (target - object.rows(x)).rowwise() + step.object_shift.transpose();
  });
  return way;
}

void place_held_objects(const ContactMesh& mesh, const Step& step, Positions& x) {
  for_each_held(mesh, step, [&](const ObjectPart& object, const auto& target) {
    object.rows(x) = target.rowwise() + step.object_shift.transpose();
  });
}

void place_glued_vertices(const GelModel& gel, const StepGoal& goal, Positions& x) {
  for (std::size_t i = 0; i < gel.glued.size(); ++i)
    x.row(gel.glued[i]) = goal.glued_target.row(static_cast<Eigen::Index>(i));
}

}  // namespace tacipc

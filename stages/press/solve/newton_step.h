// One linear solve: the Newton step of the incremental potential while the object moves as told or yields to a load.
#pragma once

#include <memory>

#include "stages/press/solve/contact_assembly.h"
#include "stages/press/solve/elastic_assembly.h"
#include "stages/press/solve/linear_solver.h"
#include "stages/press/solve/solver_times.h"
#include "stages/press/solve/volume_assembly.h"

namespace tacipc {

/// A Newton step and what was learnt on the way to it.
struct NewtonDirection {
  Positions p;                      // all vertices
  Vector3 yield = Vector3::Zero();  // the object's part of it beyond its prescribed motion
  double slope = 0.0;               // gᵀp over everything free
  double gradient_sum = 0.0;        // Σ over free vertices (and the yielding object) of |gradient|
  /// What residual forces are measured by: |Σ contact's gradient| over free vertices of the gel, with friction or
  /// without, whichever is less (friction may carry most of the normal force, and what is left must balance too).
  double contact_sum = 0.0;
  double blend = 0.0;  // the largest share of the contact Hessian's stand-in: 0 exact, 1 all of it somewhere
};

class NewtonStepper {
 public:
  /// \param pattern of everything but contact between parts of the gel
  NewtonStepper(FreeVertices free, int first_object_vertex, std::shared_ptr<const BlockPattern> pattern,
                LinearSolverKind solver);

  /// Solves for the Newton step with H = H_exact + blend (H_positive − H_exact), where H_positive has each contact's
  /// Hessian replaced by its positive stand-in, and each contact's blend is that of its vertices. It is raised about
  /// those vertices where H is not positive definite until it is; if even 1 there fails, elasticity is projected too.
  /// Frictionless contact slides along the object's edges: a stand-in alone is too stiff that way, and Newton creeps.
  /// `motion` (rows like x) is how prescribed vertices move; `yielding` are the axes along which the object as a whole
  /// is free besides. A step by which a vertex goes farther than `longest_m` counts as a sign of a Hessian that is all
  /// but indefinite. The last term of the potential must be the barrier.
  NewtonDirection direction(const IncrementalPotential& potential, const Positions& x, const Positions& motion,
                            const std::vector<int>& yielding, double longest_m, Blend& blend);

  /// Forgets couplings that contacts have added, so that the next step does not depend on steps before.
  void reset_pattern() { pattern_ = own_pattern_; }

  /// Of the linear solver, where it is iterative.
  void set_tolerance(double relative) { solver_->set_tolerance(relative); }

  /// Of derivatives and linear systems.
  SolverTimes times() const;

  const FreeVertices& free() const { return free_; }
  const LinearSolver& solver() const { return *solver_; }

 private:
  bool solve(const NewtonSystem& system, const std::vector<int>& yielding, const Positions& motion,
             NewtonDirection& out);

  /// Adds a term in packs; false for one that has none.
  bool assemble_packs(const WeightedTerm& part, const Positions& x);
  void assemble_all(const IncrementalPotential& potential, const Positions& x, Order elastic, const Blend& blend,
                    const ObjectMotion& object);
  Vector3 gel_gradient() const;
  /// Makes the contact Hessians of the system those of another blend.
  void reblend(const IncrementalPotential& potential, const Positions& x, const Blend& before, const Blend& after,
               const ObjectMotion& object);
  /// Vertices about which the Hessian is not positive definite, or that go too far, which it all but is not then; none
  /// if the direction will do.
  std::vector<int> solve_or_blame(const std::vector<int>& yielding, const Positions& motion, double longest_m,
                                  NewtonDirection& out);

  FreeVertices free_;
  int first_object_vertex_;
  std::shared_ptr<const BlockPattern> own_pattern_, pattern_;
  ElasticAssembly elastic_;
  VolumeAssembly volume_;
  NewtonSystem system_;                   // of the last call; its storage is used again
  double contact_sum_ = 0.0;              // of NewtonDirection
  std::vector<std::vector<int>> active_;  // of each contact term, in order
  SolverTimes times_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace tacipc

// One linear solve: the Newton step of the incremental potential while the object moves as prescribed, or freely along
// some axes.
#pragma once

#include <limits>
#include <memory>
#include <optional>

#include "stages/gel/press/solve/contact_assembly.h"
#include "stages/gel/press/solve/elastic_assembly.h"
#include "stages/gel/press/solve/linear_solver.h"
#include "stages/gel/press/solve/solver_times.h"
#include "stages/gel/press/solve/volume_assembly.h"

namespace tacipc {

/// Which Newton step is asked for.
struct NewtonProblem {
  const IncrementalPotential& potential;
  const Positions& x;
  /// Rows like x: displacements of the prescribed vertices. Where free vertices of the gel have some, these are carried
  /// along with their mounts, without strain, and the solution is what they do besides.
  const Positions& motion;
  std::vector<int> free_axes = {};  // along which the object as a whole is free besides
  /// A step by which a vertex in contact goes farther than this counts as a sign of a Hessian that is almost
  /// indefinite; it is taken nevertheless once the PSD approximation does not shorten it.
  double longest_m = std::numeric_limits<double>::infinity();
  const std::vector<int>* active_barrier = nullptr;  // the barrier's active pairs at x, if known
};

/// A Newton step and what was learnt on the way to it.
struct NewtonDirection {
  Positions p;                             // all vertices
  Vector3 object_shift = Vector3::Zero();  // the object's part of it beyond its prescribed motion
  double slope = 0.0;                      // gᵀp over everything free
  double gradient_sum = 0.0;  // Σ of |gradient| over free vertices of gels, and over the object's free axes
  /// What residual forces are measured by: |Σ gradient of contact| over the free vertices of the gel that is touched
  /// least (bodies without a mount count where no other is touched, free bodies after them), of the barrier alone or
  /// with friction, whichever is smaller (friction may carry most of the normal force, and the rest must balance, too).
  double contact_sum = 0.0;
  /// |Σ residual force| and |Σ residual torque| about its centre, of each body that moves freely.
  struct Body {
    double force, torque;
  };
  std::vector<Body> bodies;
  /// gradient_sum and contact_sum of each of several gels, for each is measured by its own.
  struct Gel {
    double gradient_sum = 0.0, contact_sum = 0.0;
  };
  std::vector<Gel> gels;
  double largest_share = 0.0;  // of the contact Hessian's PSD approximation: 0 exact, 1 nothing else somewhere
};

class NewtonStepper {
 public:
  /// \param elasticity over every tetrahedron with a free vertex, of one body or joined of several: its stencils are
  /// the matrix's pattern, but for contact between parts of the gel
  NewtonStepper(FreeVertices free, int first_object_vertex, std::shared_ptr<const EnergyTerm> elasticity,
                LinearSolverKind solver);
  NewtonStepper(const NewtonStepper&) = delete;
  NewtonStepper& operator=(const NewtonStepper&) = delete;

  /// Solves for the Newton step with H = (1 − share) H_exact + share H_psd for each contact, H_psd the PSD
  /// approximation of its Hessian and the share that of its vertices. Shares are raised about those vertices where H is
  /// not positive definite until it is; if it is not even with 1 there, elasticity is projected, too. Frictionless
  /// contact slides along the object's edges: the PSD approximation alone is too stiff that way, and Newton takes many
  /// short steps.
  NewtonDirection direction(const NewtonProblem& problem, Blend& blend);

  /// Forgets the last system and couplings that contacts have added, so that the next step does not depend on steps
  /// before.
  void reset() {
    pattern_ = own_pattern_;
    held_.clear();
  }

  /// Of the linear solver, where it is iterative.
  void set_tolerance(double relative) {
    tolerance_ = relative;
    solver_->set_tolerance(relative);
  }

  /// Of derivatives and linear systems.
  SolverTimes times() const;

  const FreeVertices& free() const { return free_; }

 private:
  /// One call of direction().
  struct Call {
    const NewtonProblem& problem;
    ObjectMotion object;
    std::vector<int> active_friction, active_barrier;  // stencils

    /// Calls use(contact, active stencils) for friction and then for the barrier, where there are such.
    template <typename Use>
    void for_each_contact(Use&& use) const {
      if (problem.potential.friction.term) use(problem.potential.friction, active_friction);
      if (problem.potential.barrier.term) use(problem.potential.barrier, active_barrier);
    }
  };

  /// Finds the contacts that count, and extends the pattern by what they couple.
  Call start(const NewtonProblem& problem);
  /// Assembles the whole system, with elasticity to the given order. \return |Σ gradient of contact|, of the barrier
  /// alone or with friction, whichever is smaller, on each gel and on each free body behind them
  std::vector<double> assemble_all(const Call& call, Order elastic, const Blend& blend);
  /// A part of the elasticity that comes in packs.
  struct PackedPart {
    const EnergyTerm* term;
    ElasticAssembly packs;
    const AveragedElasticity* averaged = nullptr;  // what it is besides, where volumes are averaged
    std::optional<VolumeAssembly> volumes = std::nullopt;

    void add(double weight, const Positions& x, NewtonSystem& system);
    /// Marks the rows that it changes.
    void update(const Positions& x, NewtonSystem& system, std::vector<char>& changed_rows);
  };
  /// Null for a term that is no such part.
  PackedPart* packed(const EnergyTerm* term);
  /// Where the matrix of the last call can be kept but for its contacts and elements that have changed since: makes it
  /// that at x without contacts, with all of its gradient.
  bool update_packs(const Call& call);
  /// Keeps what the columns of the contacts' vertices hold before contacts are added.
  void hold_columns(const Call& call);
  /// Marks the columns that contacts have been added to as changed.
  void mark_held();
  /// Makes the contact Hessians of the system those of another blend.
  void reblend(const Call& call, const Blend& before, const Blend& after);
  int num_gels() const { return free_.gel_of_vertex.empty() ? 1 : free_.gel_of_vertex.back() + 1; }
  /// Σ of the system's gradient over each gel's free vertices, and over each free body's points.
  Eigen::Matrix3Xd gradient_sums() const;
  /// The motion of the problem's free vertices; empty if they have none.
  Eigen::VectorXd free_motion(const NewtonProblem& problem) const;
  /// Solves the system; false if it is not positive definite, or no solution descends where nothing is driven.
  bool solve(const NewtonProblem& problem, NewtonDirection& out);
  /// Solves it to the tolerance set; false if it is not positive definite.
  bool solve_once(const NewtonProblem& problem, NewtonDirection& out);
  /// Vertices about which the system was just found not to be positive definite, and those that contact makes likely to
  /// be the next: a solver finds one place at a time. All if nothing is known.
  std::vector<int> indefinite_vertices() const;
  Eigen::Index num_object_rows(const Positions& x) const {
    return x.rows() - first_object_vertex_ - free_.num_control_points;
  }
  /// Of bodies without a mount: half of Σ |gradient of contact| over their vertices, for those that squeeze one cancel
  /// in its sum. \param gradient_before the system's without contact
  void measure_squeezed(const Eigen::VectorXd& gradient_before, std::vector<double>& touches) const;
  /// Sums of NewtonDirection over the gels' part of the system's gradient.
  void measure_gels(const std::vector<double>& touches, NewtonDirection& out) const;
  /// NewtonDirection::bodies, of the system's gradient.
  void measure_bodies(const Positions& x, NewtonDirection& out) const;
  /// Free vertices in contact that go farther than `longest_m`.
  std::vector<int> too_long(const NewtonDirection& direction, double longest_m) const;

  FreeVertices free_;
  int first_object_vertex_;
  std::shared_ptr<const EnergyTerm> elasticity_;
  std::vector<PackedPart> packed_;  // of the elasticity
  std::shared_ptr<const BlockPattern> own_pattern_, pattern_;
  NewtonSystem system_;             // of the last call
  std::vector<WeightedTerm> held_;  // terms in the matrix of the last call; none where it cannot be used again
  std::vector<char> changed_;       // marks the rows whose blocks have changed since the solver last prepared them
  std::vector<int> held_columns_;   // that contacts have been added to, and what these were without
  std::vector<double> held_values_;
  std::vector<int> carried_alone_;  // vertices of bodies in contacts without a gel, ascending
  SolverTimes times_;
  std::unique_ptr<LinearSolver> solver_;
  double tolerance_ = 1e-3;  // of the solver
};

}  // namespace tacipc

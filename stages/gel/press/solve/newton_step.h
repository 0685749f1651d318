// One Newton step of the incremental potential: assembles the linear system, makes it positive definite and solves it.
// Held objects move as prescribed; along free axes their translation is an unknown.
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

/// Input of one Newton step.
struct NewtonProblem {
  const IncrementalPotential& potential;
  const Positions& x;
  /// Prescribed displacements, rows like x. If free vertices of a gel have some, they move rigidly with their mount
  /// without strain, and the solution is their additional displacement.
  const Positions& motion;
  std::vector<int> free_axes = {};  // axes of S along which the object as a whole may translate
  /// Length, m, above which the step of a vertex in contact indicates a nearly indefinite Hessian. The shares of that
  /// vertex are then raised, and the step is taken once they cannot rise further.
  double longest_m = std::numeric_limits<double>::infinity();
  const std::vector<int>* active_barrier = nullptr;  // active pairs of the barrier at x; null: not computed yet
};

/// A Newton step and the sums that its convergence is judged by.
struct NewtonDirection {
  Positions p;  // displacement of every vertex
  /// Translation of the object along free axes, in addition to its prescribed motion.
  Vector3 object_shift = Vector3::Zero();
  double slope = 0.0;         // gᵀp over all free unknowns
  double gradient_sum = 0.0;  // Σ |gradient| over the free vertices of gels and the object's free axes
  /// Scale of the residual forces: |Σ contact gradient| over the free vertices of the gel in lightest contact. It is
  /// taken with and without friction, and the smaller value counts: friction may transmit most of the normal force, and
  /// the rest must balance by itself. If no gel is touched, soft bodies without a mount count, then free bodies.
  double contact_sum = 0.0;
  /// |Σ residual force| and |Σ residual torque| about the centre of mass, for each free body.
  struct Body {
    double force, torque;
  };
  std::vector<Body> bodies;
  /// gradient_sum and contact_sum of each gel if there are several: each gel is judged by its own contact force.
  struct Gel {
    double gradient_sum = 0.0, contact_sum = 0.0;
  };
  std::vector<Gel> gels;
  /// Largest PSD share of the contact Hessian at any vertex; 0: exact, 1: PSD approximation only.
  double largest_share = 0.0;
};

/// Assembles and solves the Newton systems of the steps in which the same bodies are free.
class NewtonStepper {
 public:
  /// \param elasticity over every tetrahedron with a free vertex, of one body or joined of several. Its stencils are
  /// the pattern of the matrix, apart from contact between parts of the gel
  NewtonStepper(FreeVertices free, int first_object_vertex, std::shared_ptr<const EnergyTerm> elasticity,
                LinearSolverKind solver);
  NewtonStepper(const NewtonStepper&) = delete;
  NewtonStepper& operator=(const NewtonStepper&) = delete;

  /// Solves for the Newton step. The Hessian of each contact is (1 − share) H_exact + share H_psd, where H_psd is its
  /// PSD approximation and `share` is the share of its vertices. Shares are raised at vertices where the system is not
  /// positive definite, until it is. If shares of 1 do not suffice, elasticity is also replaced by its PSD
  /// approximation. The blend matters for frictionless contact that slides along edges of the object: there the PSD
  /// approximation is too stiff, and Newton's method takes many short steps.
  NewtonDirection direction(const NewtonProblem& problem, Blend& blend);

  /// Forgets the last system and the couplings that contacts have added, so that the next step does not depend on
  /// earlier ones.
  void reset() {
    pattern_ = own_pattern_;
    held_.clear();
  }

  /// Sets the relative tolerance of the linear solver; ignored by a direct solver.
  void set_tolerance(double relative) {
    tolerance_ = relative;
    solver_->set_tolerance(relative);
  }

  /// Time and work of derivatives and linear systems since construction.
  SolverTimes times() const;

  const FreeVertices& free() const { return free_; }

 private:
  /// Data of one call of direction().
  struct Call {
    const NewtonProblem& problem;
    ObjectMotion object;
    std::vector<int> active_friction, active_barrier;  // active stencils of each term at x

    /// Calls use(contact, active stencils) for friction, then for the barrier, if the potential has them.
    template <typename Use>
    void for_each_contact(Use&& use) const {
      if (problem.potential.friction.term) use(problem.potential.friction, active_friction);
      if (problem.potential.barrier.term) use(problem.potential.barrier, active_barrier);
    }
  };

  /// Finds the active contacts and extends the pattern by the vertex pairs that they couple.
  Call start(const NewtonProblem& problem);
  /// Assembles the whole system, with elasticity to the given order.
  /// \return |Σ contact gradient| on each gel, then on each free body: of the barrier alone or with friction, whichever
  /// is smaller
  std::vector<double> assemble_all(const Call& call, Order elastic, const Blend& blend);
  /// A part of the elasticity that is evaluated in packs.
  struct PackedPart {
    const EnergyTerm* term;
    ElasticAssembly packs;
    const AveragedElasticity* averaged = nullptr;  // the term that averages volumes, if the element does; else null
    std::optional<VolumeAssembly> volumes = std::nullopt;

    void add(double weight, const Positions& x, NewtonSystem& system);
    /// Updates the Hessian where it has changed, and marks the rows of these blocks.
    void update(const Positions& x, NewtonSystem& system, std::vector<char>& changed_rows);
  };
  /// The packed part that belongs to a term; null if there is none.
  PackedPart* packed(const EnergyTerm* term);
  /// Updates the matrix of the last call to x, without contacts and with the full gradient, if only contacts and
  /// elements have changed since.
  /// \return false if the whole matrix must be assembled
  bool update_packs(const Call& call);
  /// Saves the columns of the contacts' vertices before contacts are added.
  void hold_columns(const Call& call);
  /// Marks the columns to which contacts have been added as changed.
  void mark_held();
  /// Replaces the contact Hessians of one blend by those of another.
  void reblend(const Call& call, const Blend& before, const Blend& after);
  int num_gels() const { return free_.gel_of_vertex.empty() ? 1 : free_.gel_of_vertex.back() + 1; }
  /// Σ of the system's gradient over the free vertices of each gel, and over the points of each free body.
  Eigen::Matrix3Xd gradient_sums() const;
  /// Prescribed displacement of the free vertices; empty if they have none.
  Eigen::VectorXd free_motion(const NewtonProblem& problem) const;
  /// Solves the system; if there are free axes and this fails, again to full accuracy.
  /// \return false if the system is not positive definite, or if nothing is driven and the solution does not descend
  bool solve(const NewtonProblem& problem, NewtonDirection& out);
  /// Solves the system to the current tolerance. \return false if it is not positive definite
  bool solve_once(const NewtonProblem& problem, NewtonDirection& out);
  /// Vertices at which the system was just found not to be positive definite, and contact vertices that are likely to
  /// be next, because a solver finds one location at a time. All vertices if nothing is known.
  std::vector<int> indefinite_vertices() const;
  Eigen::Index num_object_rows(const Positions& x) const {
    return x.rows() - first_object_vertex_ - free_.num_control_points;
  }
  /// Adds to `touches` half of Σ |contact gradient| over the vertices of each body without a mount: opposite forces
  /// that squeeze such a body cancel in the plain sum.
  /// \param gradient_before gradient of the system without contact
  void measure_squeezed(const Eigen::VectorXd& gradient_before, std::vector<double>& touches) const;
  /// Sets the sums of NewtonDirection for the gels.
  void measure_gels(const std::vector<double>& touches, NewtonDirection& out) const;
  /// Sets NewtonDirection::bodies from the system's gradient.
  void measure_bodies(const Positions& x, NewtonDirection& out) const;
  /// Free vertices in contact whose step is longer than `longest_m`.
  std::vector<int> too_long(const NewtonDirection& direction, double longest_m) const;

  FreeVertices free_;
  int first_object_vertex_;
  std::shared_ptr<const EnergyTerm> elasticity_;
  std::vector<PackedPart> packed_;  // packed parts of the elasticity
  std::shared_ptr<const BlockPattern> own_pattern_, pattern_;
  NewtonSystem system_;              // system of the last call
  std::vector<WeightedTerm> held_;   // terms in the matrix of the last call; empty if it cannot be reused
  std::vector<char> changed_;        // per row: its blocks have changed since the solver's last prepare()
  std::vector<int> held_columns_;    // columns to which contacts have been added
  std::vector<double> held_values_;  // values of these columns without contacts
  std::vector<int> carried_alone_;   // vertices of bodies in contacts without a gel, ascending
  SolverTimes times_;
  std::unique_ptr<LinearSolver> solver_;
  double tolerance_ = 1e-3;  // relative tolerance of the linear solver
};

}  // namespace tacipc

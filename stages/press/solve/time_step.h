// One implicit Euler step: brings the object to its prescribed pose and the gel to the minimum of the incremental
// potential.
#pragma once

#include <functional>
#include <memory>

#include "stages/press/solve/assembly.h"
#include "stages/press/solve/cholmod_solver.h"

namespace tacipc {

/// When a step counts as solved, and what it may cost.
struct NewtonSettings {
  double velocity_tolerance_m_s = 0.0;  // max |p| / h of the Newton step p, below which it has converged …
  double relative_force_tolerance =
      5e-4;                         // … if the residual forces also sum to less than this part of the contact force
  double force_tolerance_n = 1e-5;  // … or to less than this
  int max_iterations = 500;         // per step; reaching it is a failure
};

/// What a step took and where it ended.
struct StepReport {
  int newton_iterations = 0;  // linear systems solved, those that moved the object included
  int moving_iterations = 0;  // those that moved the object
  int factorizations = 0;
  double velocity_residual_m_s = 0.0;
  double force_residual_n = 0.0;  // Σ over free vertices of |residual force|
  double contact_force_n = 0.0;   // |Σ contact forces|
};

/// The gel as the solver sees it; constant during a simulation.
struct GelModel {
  Tetrahedra tets;
  std::shared_ptr<const Elasticity> elasticity;
  Eigen::VectorXd mass_kg;
  FreeVertices free;
};

/// Called after each Newton iteration, for progress lines.
using IterationObserver = std::function<void(int iteration, double velocity_residual_m_s)>;

class TimeStepper {
 public:
  TimeStepper(const ContactMesh& mesh, GelModel gel, double h_s, double d_hat_m, double kappa,
              const NewtonSettings& settings);

  /// Advances gel and object rows of `x` by one step; `velocity` (gel rows, m/s) becomes (x_new − x_old)/h. The object
  /// rows end bit-equal to `object_target`. \throw SolverError with the numbers if the step does not converge.
  StepReport advance(Positions& x, Positions& velocity, const Positions& object_target,
                     const IterationObserver& observe);

  /// Forces on the gel by contact at x, N: −κ/h² ∂B/∂x, gel rows only.
  Positions contact_forces(const Positions& x);
  /// Forces of the mount on the gel's prescribed vertices that hold them against elasticity and contact at x, N; others
  /// zero.
  Positions mount_forces(const Positions& x);
  /// Smallest gap between gel and object (not counting gel–gel), at most `none`.
  double smallest_gap(const Positions& x, double none);

  int num_analyses() const { return solver_.num_analyses(); }

 private:
  struct Direction;
  /// Solves for the Newton step with H = H_exact + blend (H_positive − H_exact), where H_positive has each contact's
  /// Hessian replaced by its positive stand-in. The smallest blend that factorises is looked for from `blend` upwards,
  /// and `blend` is left where the next search should begin; if even 1 fails, elasticity is projected too. Frictionless
  /// contact slides along the object's edges: a stand-in alone is too stiff that way, and Newton creeps.
  Direction newton_direction(const IncrementalPotential& potential, const ContactBarrier& barrier, const Positions& x,
                             const Positions& motion, double& blend, StepReport& report);
  IncrementalPotential potential(const Positions& x_hat, std::vector<ContactPair> pairs) const;

  const ContactMesh& mesh_;
  GelModel gel_;
  double h_s_;
  double d_hat_m_;
  double kappa_;
  NewtonSettings settings_;
  ContactSearch search_;
  std::shared_ptr<const BlockPattern> pattern_;
  CholmodSolver solver_;
};

}  // namespace tacipc

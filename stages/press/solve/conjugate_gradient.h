// Conjugate gradients with the inverse diagonal blocks as preconditioner.
#pragma once

#include <cstdint>
#include <vector>

#include "stages/press/solve/cholmod_solver.h"

namespace tacipc {

/// Preconditioned conjugate gradients from x = 0 until √(rᵀM⁻¹r) is below `tolerance` times its start, M the 3 × 3
/// blocks on the diagonal. On the way xᵀAx = xᵀb, so an unfinished solution still points downhill. A gel is thin and
/// glued at the back: forces reach about a thickness far, and some fifty products are enough whatever its size. Sums
/// run in a fixed order. Where the products do not suffice, the system is factorised.
class ConjugateGradient final : public LinearSolver {
 public:
  explicit ConjugateGradient(double tolerance = 1e-3, int max_products = 1000)
      : tolerance_(tolerance), max_products_(max_products) {}

  bool prepare(const BlockMatrix& matrix) override;
  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b) override;
  void set_tolerance(double relative) override { tolerance_ = relative; }
  int num_analyses() const override { return direct_.num_analyses(); }
  /// Matrix–vector products so far.
  std::int64_t num_products() const override { return products_; }
  /// Systems that had to be factorised.
  int num_factorized() const { return factorized_; }

 private:
  std::optional<Eigen::VectorXd> factorize(const Eigen::VectorXd& b);

  double tolerance_;
  int max_products_;
  const BlockMatrix* matrix_ = nullptr;
  std::vector<double> inverse_diagonal_;  // blocks as BlockMatrix has them
  CholmodSolver direct_;
  std::int64_t products_ = 0;
  int factorized_ = 0;
};

}  // namespace tacipc

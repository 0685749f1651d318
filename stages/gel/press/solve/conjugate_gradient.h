// Conjugate gradients, preconditioned by symmetric block Gauss–Seidel sweeps.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "stages/gel/press/solve/body_blocks.h"
#include "stages/gel/press/solve/cholmod_solver.h"
#include "stages/gel/press/solve/sweep_order.h"

namespace tacipc {

/// Conjugate gradients from x = 0 until √(rᵀM⁻¹r) is below `tolerance` times its start. A = L + D + Lᵀ, with D the 3 ×
/// 3 diagonal blocks (12 × 12 for a body), and the preconditioner is M = (D + L) D⁻¹ (D + Lᵀ).
///
/// After scaling by the Cholesky factors of D, so that D = I, the preconditioned matrix is
///   Â = (I + L)⁻¹ A (I + Lᵀ)⁻¹,   Â p = t + (I + L)⁻¹ (p − t),   t = (I + Lᵀ)⁻¹ p   [Eisenstat 1981].
/// A product with Â takes two sweeps over L, as many operations as a product with A. It needs less than half of the
/// iterations that M = D would need. In every iteration xᵀAx = xᵀb, so an unfinished solution is also a descent
/// direction. A gel is thin and glued at the back: forces reach about one thickness far, and some twenty iterations
/// suffice for any size.
///
/// L is stored in single precision, because sweeps are bound by memory and Newton steps need only two or three digits.
/// For a finer tolerance, solutions are refined with the matrix itself. Sweeps and sums run in a fixed order. If the
/// iterations do not suffice, the system is factorised.
class ConjugateGradient final : public LinearSolver {
 public:
  explicit ConjugateGradient(double tolerance = 1e-3, int max_products = 1000)
      : tolerance_(tolerance), max_products_(max_products) {}

  bool prepare(const BlockMatrix& matrix, const std::vector<char>* changed = nullptr) override;
  std::optional<Eigen::VectorXd> solve(const Eigen::VectorXd& b) override;
  /// Rows whose diagonal block is not positive definite; or, if pᵀÂp ≤ 0, the rows that contribute most to it. A body
  /// has all of its rows in the list or none.
  std::vector<int> indefinite_rows() const override { return indefinite_rows_; }
  void set_tolerance(double relative) override { tolerance_ = relative; }
  /// Number of products with Â so far.
  std::int64_t num_products() const override { return products_; }
  /// Number of systems that had to be factorised.
  int num_factorized() const override { return factorized_; }

 private:
  static constexpr int kParts = 4;

  template <typename Part>
  double over_parts(Part&& part);
  double forward(const double* t, const double* p, double* y);
  void find_indefinite_rows();
  std::optional<Eigen::VectorXd> iterate(const Eigen::VectorXd& b, double tolerance);
  std::optional<Eigen::VectorXd> factorize(const Eigen::VectorXd& b);

  double tolerance_;
  int max_products_;
  const BlockMatrix* matrix_ = nullptr;
  std::shared_ptr<const BlockPattern> pattern_;  // pattern of order_
  SweepOrder order_;
  std::vector<char> stale_;                 // per row in this order: its blocks have changed since they were scaled
  std::vector<float> lower_;                // scaled L, nine numbers per block, in the order of order_
  AlignedVector<double> inverse_cholesky_;  // C⁻¹ of the diagonal blocks C Cᵀ, blocks as in BlockMatrix; without bodies
  BodyBlocks bodies_;
  AlignedVector<double> x_, r_, p_, t_, q_;                 // vectors of the last solve; their storage is reused
  std::array<AlignedVector<double>, kParts> to_separator_;  // contributions of each part in a sweep
  std::optional<CholmodSolver> direct_;                     // created when first needed
  std::int64_t products_ = 0;
  int factorized_ = 0;
  std::vector<int> indefinite_rows_;
};

}  // namespace tacipc

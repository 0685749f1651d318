#include "stages/gel/press/solve/cholmod_solver.h"

#include <omp.h>

#include <Eigen/CholmodSupport>

#include "common/base/blas.h"
#include "common/base/error.h"

extern "C" void openblas_set_num_threads(int);

namespace tacipc {

struct CholmodSolver::State {
  Eigen::SparseMatrix<double> matrix;  // lower triangle; of a diagonal block only its lower half
  Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>> factor;
  std::shared_ptr<const BlockPattern> pattern;

  void check(const char* what) {
    const int status = factor.cholmod().status;
    if (status == CHOLMOD_OUT_OF_MEMORY) throw SolverError("CHOLMOD ran out of memory during {}", what);
    if (status < 0) throw SolverError("CHOLMOD failed during {} (status {})", what, status);
  }

  void lay_out() {
    const BlockPattern& p = *pattern;
    const Eigen::Index n = 3 * static_cast<Eigen::Index>(p.size());
    matrix.resize(n, n);
    matrix.resizeNonZeros(9 * static_cast<Eigen::Index>(p.num_blocks()) - n);
    int* start = matrix.outerIndexPtr();
    int* rows = matrix.innerIndexPtr();
    int at = 0;
    for (int c = 0; c < p.size(); ++c) {
      for (int k = 0; k < 3; ++k) {
        start[3 * c + k] = at;
        for (int b = p.column_start[c]; b < p.column_start[c + 1]; ++b) {
          for (int r = p.row[b] == c ? k : 0; r < 3; ++r) rows[at++] = 3 * p.row[b] + r;
        }
      }
    }
    start[n] = at;
  }

  void copy_values(const BlockMatrix& source) {
    const BlockPattern& p = *pattern;
    double* values = matrix.valuePtr();
    for (int c = 0; c < p.size(); ++c) {
      for (int k = 0; k < 3; ++k) {
        for (int b = p.column_start[c]; b < p.column_start[c + 1]; ++b) {
          const double* block = source.values.data() + BlockMatrix::kStride * static_cast<std::size_t>(b) + 4 * k;
          for (int r = p.row[b] == c ? k : 0; r < 3; ++r) *values++ = block[r];
        }
      }
    }
  }
};

CholmodSolver::CholmodSolver() : state_(std::make_unique<State>()) {
  // Debian's CHOLMOD opens four OpenMP threads whatever number is set; without an active level they run as one.
  omp_set_max_active_levels(0);
  openblas_set_num_threads(1);
  reserve_blas_memory(1);
  state_->factor.setMode(Eigen::CholmodAuto);
  cholmod_common& common = state_->factor.cholmod();
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.postorder = 1;
  common.final_ll = 1;
  common.try_catch = 1;  // no error messages: a matrix that is not positive definite is an expected result here
}

CholmodSolver::~CholmodSolver() = default;

bool CholmodSolver::prepare(const BlockMatrix& matrix, const std::vector<char>* /*changed*/) {
  State& s = *state_;
  if (s.pattern != matrix.pattern) {
    s.pattern = matrix.pattern;
    s.lay_out();
    s.factor.analyzePattern(s.matrix);
    s.check("analysis");
  }
  s.copy_values(matrix);
  s.factor.factorize(s.matrix);
  s.check("factorisation");
  return s.factor.cholmod().status != CHOLMOD_NOT_POSDEF && s.factor.info() == Eigen::Success;
}

std::optional<Eigen::VectorXd> CholmodSolver::solve(const Eigen::VectorXd& b) {
  Eigen::VectorXd x = state_->factor.solve(b);
  state_->check("solution");
  return x;
}

}  // namespace tacipc

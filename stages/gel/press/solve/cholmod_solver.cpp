#include "stages/gel/press/solve/cholmod_solver.h"

#include <cholmod.h>
#include <omp.h>

#include <algorithm>
#include <vector>

#include "common/base/error.h"

extern "C" void openblas_set_num_threads(int);

namespace tacipc {

struct CholmodSolver::State {
  cholmod_common common{};
  std::shared_ptr<const BlockPattern> pattern;
  cholmod_sparse* matrix = nullptr;
  cholmod_factor* factor = nullptr;
  int num_analyses = 0;

  void release() {
    cholmod_free_sparse(&matrix, &common);
    cholmod_free_factor(&factor, &common);
  }

  void check(const char* what) const {
    if (common.status == CHOLMOD_OUT_OF_MEMORY) throw SolverError("CHOLMOD ran out of memory during {}", what);
    if (common.status < 0) throw SolverError("CHOLMOD failed during {} (status {})", what, common.status);
  }

  /// Scalar lower triangle in compressed columns: of a diagonal block only its lower half.
  void lay_out() {
    const BlockPattern& p = *pattern;
    const std::size_t n = 3 * static_cast<std::size_t>(p.size());
    const std::size_t entries = 9 * static_cast<std::size_t>(p.num_blocks()) - 3 * static_cast<std::size_t>(p.size());
    matrix = cholmod_allocate_sparse(n, n, entries, 1, 1, -1, CHOLMOD_REAL, &common);
    check("allocation");
    auto* start = static_cast<int*>(matrix->p);
    auto* rows = static_cast<int*>(matrix->i);
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
    auto* values = static_cast<double*>(matrix->x);
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
  // Debian's CHOLMOD opens four OpenMP threads whatever is asked for; with no active level left it runs them as one.
  omp_set_max_active_levels(0);
  openblas_set_num_threads(1);
  cholmod_common& common = state_->common;
  cholmod_start(&common);
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.postorder = 1;
  common.final_ll = 1;
  common.try_catch = 1;  // a matrix that is not positive definite is an answer here, not an error to print
}

CholmodSolver::~CholmodSolver() {
  state_->release();
  cholmod_finish(&state_->common);
}

int CholmodSolver::num_analyses() const { return state_->num_analyses; }

bool CholmodSolver::prepare(const BlockMatrix& matrix, const std::vector<char>* /*changed*/) {
  State& s = *state_;
  if (s.pattern != matrix.pattern) {
    s.release();
    s.pattern = matrix.pattern;
    s.lay_out();
    s.factor = cholmod_analyze(s.matrix, &s.common);
    s.check("analysis");
    ++s.num_analyses;
  }
  s.copy_values(matrix);
  cholmod_factorize(s.matrix, s.factor, &s.common);
  s.check("factorisation");
  return s.common.status != CHOLMOD_NOT_POSDEF && s.factor->minor == s.factor->n;
}

std::optional<Eigen::VectorXd> CholmodSolver::solve(const Eigen::VectorXd& b) {
  State& s = *state_;
  cholmod_dense rhs{};
  rhs.nrow = rhs.d = rhs.nzmax = static_cast<std::size_t>(b.size());
  rhs.ncol = 1;
  rhs.xtype = CHOLMOD_REAL;
  rhs.dtype = CHOLMOD_DOUBLE;
  rhs.x = const_cast<double*>(b.data());  // CHOLMOD only reads it
  cholmod_dense* x = cholmod_solve(CHOLMOD_A, s.factor, &rhs, &s.common);
  s.check("solution");
  const Eigen::VectorXd out = Eigen::Map<const Eigen::VectorXd>(static_cast<const double*>(x->x), b.size());
  cholmod_free_dense(&x, &s.common);
  return out;
}

}  // namespace tacipc

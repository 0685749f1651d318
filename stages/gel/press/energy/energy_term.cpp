#include "stages/gel/press/energy/energy_term.h"

#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <vector>

namespace tacipc {

double ordered_sum(int count, const std::function<double(int first, int last)>& part) {
  constexpr int kChunk = 1024;
  std::vector<double> partial(static_cast<std::size_t>((count + kChunk - 1) / kChunk));
  tbb::parallel_for(std::size_t{0}, partial.size(), [&](std::size_t chunk) {
    const int first = static_cast<int>(chunk) * kChunk;
    partial[chunk] = part(first, std::min(count, first + kChunk));
  });
  double sum = 0.0;
  for (const double one : partial) sum += one;
  return sum;
}

double EnergyTerm::value(const Positions& x) const {
  return ordered_sum(num_stencils(), [&](int first, int last) {
    Local local;
    Eigen::VectorXd local_x;
    double sum = 0.0;
    for (int i = first; i < last; ++i) {
      gather(x, stencil(i), local_x);
      evaluate(i, local_x, Order::value, local);
      sum += local.value;
    }
    return sum;
  });
}

void project_psd(Matrix12& matrix) {
  const Eigen::SelfAdjointEigenSolver<Matrix12> eigen(matrix);
  if (eigen.eigenvalues()[0] >= 0.0) return;
  const Matrix12& q = eigen.eigenvectors();
  matrix = q * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() * q.transpose();
}

}  // namespace tacipc

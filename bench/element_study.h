// Cost of accuracy with either element: error of the press force over CPU seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/bench_run.h"

namespace tacipc::bench {

/// Limit F₀ and order p of F(h) = F₀ + c hᵖ through three meshes, h = N^(−1/3).
struct Limit {
  double value = 0.0, order = 0.0;
};
/// \return nothing if the three forces do not approach a limit with an order between 0.2 and 6
/// \pre vertices ascend
std::optional<Limit> extrapolate(const std::vector<int>& vertices, const std::vector<double>& forces);

/// Section on presses of the sphere by the routes fast (linear element) and averaged, with three meshes or more each.
/// Their forces are compared with the limit of the averaged element's three finest meshes.
/// \return an empty text if there are fewer meshes
std::string element_section(const std::vector<Run>& runs);
/// Log–log plot of the relative error of the press force over CPU seconds.
std::string element_svg(const std::vector<Run>& runs);

}  // namespace tacipc::bench

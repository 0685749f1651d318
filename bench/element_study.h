// What accuracy costs with either element: the press force against its limit, over CPU seconds.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/bench_run.h"

namespace tacipc::bench {

/// F(h) = F₀ + c hᵖ through three meshes, h = N^(−1/3).
struct Limit {
  double value = 0.0, order = 0.0;
};
/// Nothing where the three forces do not approach a limit with an order between 0.2 and 6. \pre vertices ascend
std::optional<Limit> extrapolate(const std::vector<int>& vertices, const std::vector<double>& forces);

/// Presses of the sphere by the routes fast (linear element) and averaged, of three meshes or more each; their force is
/// compared with the limit of the averaged element's three finest. Empty where there are not as many.
std::string element_section(const std::vector<Run>& runs);
/// Relative error of the press force over CPU seconds, logarithmic.
std::string element_svg(const std::vector<Run>& runs);

}  // namespace tacipc::bench

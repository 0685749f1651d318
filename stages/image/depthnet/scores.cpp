#include "stages/image/depthnet/scores.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <numeric>

namespace tacipc {

std::vector<std::pair<double, double>> roc_of(const std::vector<double>& probabilities,
                                              const std::vector<bool>& truth) {
  assert(probabilities.size() == truth.size());
  std::vector<std::size_t> order(truth.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return probabilities[a] > probabilities[b]; });
  const auto all_yes = static_cast<double>(std::ranges::count(truth, true));
  const double all_no = static_cast<double>(truth.size()) - all_yes;
  std::vector<std::pair<double, double>> roc{{0.0, 0.0}};
  double yes = 0.0, no = 0.0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    (truth[order[k]] ? yes : no) += 1.0;
    if (k + 1 < order.size() && probabilities[order[k + 1]] == probabilities[order[k]]) continue;
    roc.emplace_back(no / all_no, yes / all_yes);
  }
  return roc;
}

double height_of(const std::vector<std::pair<double, double>>& roc, double share) {
  const auto right =
      std::ranges::find_if(roc, [&](const std::pair<double, double>& point) { return point.first > share; });
  if (right == roc.end()) return roc.back().second;
  const auto left = std::prev(right);
  return left->second + (right->second - left->second) * (share - left->first) / (right->first - left->first);
}

Scores scores_of(const std::vector<double>& probabilities, const std::vector<bool>& truth) {
  assert(probabilities.size() == truth.size());
  double right[2] = {0.0, 0.0}, count[2] = {0.0, 0.0};
  for (std::size_t i = 0; i < truth.size(); ++i) {
    count[truth[i]] += 1.0;
    if ((probabilities[i] >= 0.5) == truth[i]) right[truth[i]] += 1.0;
  }
  Scores scores{.accuracy = (right[0] + right[1]) / (count[0] + count[1]),
                .balanced_accuracy = 0.5 * (right[0] / count[0] + right[1] / count[1])};
  const auto roc = roc_of(probabilities, truth);
  for (std::size_t k = 1; k < roc.size(); ++k)
    scores.auc += 0.5 * (roc[k].first - roc[k - 1].first) * (roc[k].second + roc[k - 1].second);
  return scores;
}

}  // namespace tacipc

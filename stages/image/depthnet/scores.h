// How good probabilities of a yes are where the answers are known.
#pragma once

#include <utility>
#include <vector>

namespace tacipc {

struct Scores {
  double accuracy = 0.0;           // share that is right, yes from a probability of ½ on
  double balanced_accuracy = 0.0;  // mean of that share among the yes and among the no
  double auc = 0.0;                // area under the ROC curve: how often a yes has a higher probability than a no
};

/// \pre as many of both, some yes and some no
Scores scores_of(const std::vector<double>& probabilities, const std::vector<bool>& truth);

/// The ROC curve: shares of the no and of the yes that are at or above a probability, as it falls: from (0, 0) to
/// (1, 1), one point per different probability. \pre as of scores_of
std::vector<std::pair<double, double>> roc_of(const std::vector<double>& probabilities, const std::vector<bool>& truth);

/// Its height at a share of the no, between two points in proportion; where it rises the upper end.
double height_of(const std::vector<std::pair<double, double>>& roc, double share);

}  // namespace tacipc

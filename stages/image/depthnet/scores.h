// Scores predicted probabilities of a binary label against the true labels.
#pragma once

#include <utility>
#include <vector>

namespace tacipc {

/// Scores of predicted probabilities.
struct Scores {
  double accuracy = 0.0;           // fraction of correct predictions; positive from a probability of ½ on
  double balanced_accuracy = 0.0;  // mean of that fraction among the positives and among the negatives
  double auc = 0.0;  // area under the ROC curve: fraction of pairs in which the positive has the higher probability
};

/// Computes the scores.
/// \pre equal lengths, at least one positive and one negative
Scores scores_of(const std::vector<double>& probabilities, const std::vector<bool>& truth);

/// ROC curve from (0, 0) to (1, 1): fractions of the negatives and of the positives at or above a falling probability,
/// one point per different probability.
/// \pre equal lengths, at least one positive and one negative
std::vector<std::pair<double, double>> roc_of(const std::vector<double>& probabilities, const std::vector<bool>& truth);

/// Height of the curve at a fraction of the negatives, linear between two points; at a vertical part its upper end.
double height_of(const std::vector<std::pair<double, double>>& roc, double share);

}  // namespace tacipc

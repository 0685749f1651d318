// Reports a study of grasp outcomes.
#pragma once

#include <string>

#include "common/base/value.h"
#include "stages/image/depthnet/outcome_study.h"

namespace tacipc {

/// CSV with a row per test grasp: name, object, outcome, held or not, grip, and the probabilities of the baseline and
/// of each training.
std::string outcome_csv(const OutcomeStudy& study);
/// CSV with a row per training and epoch: rate, loss, accuracy on the training's examples and on the validation.
std::string outcome_history_csv(const OutcomeStudy& study);
/// Plot of ROC curves: each seed's network and control, their means at equal false alarm rates, and the baseline.
std::string roc_svg(const OutcomeStudy& study);
/// Page with the numbers; it links the picture `roc.svg`.
std::string outcome_page(const OutcomeStudy& study, int frames);
/// Lines of the record: grasps and objects of each split, scores by kind with mean, deviation and the values of the
/// seeds.
Value::Map outcome_summary(const OutcomeStudy& study);

}  // namespace tacipc

// What is written down of a study of outcomes.
#pragma once

#include <string>

#include "common/base/value.h"
#include "stages/image/depthnet/outcome_study.h"

namespace tacipc {

/// Per test grasp: name, object, outcome, whether it held, grip, and the probabilities of the baseline and of each
/// training.
std::string outcome_csv(const OutcomeStudy& study);
/// Per training and epoch: rate, loss, share told right of the training's examples and of the validation.
std::string outcome_history_csv(const OutcomeStudy& study);
/// ROC curves: of each seed's network and control, their means at equal shares of false alarms, and the baseline's.
std::string roc_svg(const OutcomeStudy& study);
/// A page with the figures, beside the picture `roc.svg`.
std::string outcome_page(const OutcomeStudy& study, int frames);
/// Lines of the record: grasps and objects of each split, scores by kind with mean, deviation and those of the seeds.
Value::Map outcome_summary(const OutcomeStudy& study);

}  // namespace tacipc

#include "stages/image/depthnet/outcome_report.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "common/base/statistics.h"
#include "common/format/csv.h"
#include "stages/image/depthnet/scores.h"

namespace tacipc {
namespace {

constexpr std::array<std::pair<const char*, double Scores::*>, 3> kScores{
    {{"accuracy", &Scores::accuracy}, {"balanced_accuracy", &Scores::balanced_accuracy}, {"auc", &Scores::auc}}};

/// Scores of the trainings of one kind, by seed.
std::vector<Scores> scores_of_kind(const OutcomeStudy& study, bool shuffled) {
  std::vector<Scores> all;
  const std::vector<bool> held = held_of(study.test);
  for (const OutcomeTraining& training : study.trainings)
    if (training.shuffled == shuffled) all.push_back(scores_of(training.probabilities, held));
  return all;
}

std::vector<double> by_seed(const std::vector<Scores>& scores, double Scores::*kind) {
  std::vector<double> values;
  for (const Scores& of_seed : scores) values.push_back(of_seed.*kind);
  return values;
}

/// Scores of a constant prediction: the outcome that is more frequent in the training.
Scores scores_of_constant(const OutcomeStudy& study) {
  const std::vector<bool> trained = held_of(study.train);
  const bool more_held = 2 * std::ranges::count(trained, true) >= static_cast<long>(trained.size());
  return scores_of(std::vector<double>(study.test.size(), more_held ? 1.0 : 0.0), held_of(study.test));
}

std::size_t held_in(const std::vector<GraspItem>& items) {
  const std::vector<bool> held = held_of(items);
  return static_cast<std::size_t>(std::ranges::count(held, true));
}

/// Times of the test's last images, and the slip of the objects until then.
struct Seen {
  double median_s = 0.0, largest_s = 0.0, median_slip_mm = 0.0, largest_slip_mm = 0.0;
};

Seen seen_in(const std::vector<GraspItem>& items) {
  std::vector<double> times_s, slips_mm;
  for (const GraspItem& item : items) {
    times_s.push_back(item.seen_s);
    slips_mm.push_back(item.slip_mm);
  }
  const auto largest = [](const std::vector<double>& values) { return *std::ranges::max_element(values); };
  return {.median_s = median(times_s),
          .largest_s = largest(times_s),
          .median_slip_mm = median(slips_mm),
          .largest_slip_mm = largest(slips_mm)};
}

Value::Map split_lines(const std::vector<GraspItem>& items) {
  return {{"grasps", items.size()}, {"objects", objects_of(items).size()}, {"held", held_in(items)}};
}

Value::Map score_lines(const std::vector<Scores>& scores) {
  Value::Map lines;
  for (const auto& [name, kind] : kScores) {
    const std::vector<double> values = by_seed(scores, kind);
    const auto [mean, deviation] = mean_and_deviation(values);
    lines.emplace_back(name, Value::Map{{"mean", mean}, {"deviation", deviation}, {"seeds", values}});
  }
  return lines;
}

Value::Map score_lines(const Scores& scores) {
  Value::Map lines;
  for (const auto& [name, kind] : kScores) lines.emplace_back(name, scores.*kind);
  return lines;
}

std::string score_row(const std::string& who, const std::vector<Scores>& scores) {
  std::string row = "| " + who;
  for (const auto& [name, kind] : kScores) {
    const auto [mean, deviation] = mean_and_deviation(by_seed(scores, kind));
    row += fmt::format(" | {:.3f} ± {:.3f}", mean, deviation);
  }
  return row + " |\n";
}

std::string score_row(const std::string& who, const Scores& scores) {
  return fmt::format("| {} | {:.3f} | {:.3f} | {:.3f} |\n", who, scores.accuracy, scores.balanced_accuracy, scores.auc);
}

/// Table of the test's outcomes: number of grasps, and the fraction that the networks predict as held.
std::string outcome_table(const OutcomeStudy& study) {
  struct Row {
    std::size_t grasps = 0, asked = 0, said_held = 0;
  };
  std::map<std::string, Row> rows;
  for (std::size_t i = 0; i < study.test.size(); ++i) {
    Row& row = rows[study.test[i].outcome];
    ++row.grasps;
    for (const OutcomeTraining& training : study.trainings) {
      if (training.shuffled) continue;
      ++row.asked;
      row.said_held += training.probabilities[i] >= 0.5;
    }
  }
  std::string table = "| outcome | test grasps | foretold as held |\n|---|---|---|\n";
  for (const auto& [outcome, row] : rows)
    table += fmt::format("| {} | {} | {:.0f} % |\n", outcome, row.grasps,
                         100.0 * static_cast<double>(row.said_held) / static_cast<double>(row.asked));
  return table;
}

}  // namespace

std::string outcome_csv(const OutcomeStudy& study) {
  std::vector<std::string> names{"grasp", "object", "outcome", "held", "grip_N", "seen_s", "slip_mm", "grip_only"};
  for (const OutcomeTraining& training : study.trainings) names.push_back(training.name());
  std::string text = csv_line(names);
  for (std::size_t i = 0; i < study.test.size(); ++i) {
    const GraspItem& item = study.test[i];
    std::vector<std::string> fields{item.name,
                                    item.object,
                                    item.outcome,
                                    item.held ? "1" : "0",
                                    fmt::format("{}", item.grip_n),
                                    fmt::format("{}", item.seen_s),
                                    fmt::format("{}", item.slip_mm),
                                    fmt::format("{}", study.grip_only[i])};
    for (const OutcomeTraining& training : study.trainings)
      fields.push_back(fmt::format("{}", training.probabilities[i]));
    text += csv_line(fields);
  }
  return text;
}

std::string outcome_history_csv(const OutcomeStudy& study) {
  std::string text = csv_line({"training", "epoch", "learning_rate", "loss", "accuracy", "validation_accuracy"});
  for (const OutcomeTraining& training : study.trainings)
    for (const LearntEpoch& row : training.history) {
      std::vector<std::string> fields = history_fields(training.history, row);
      fields.insert(fields.begin(), training.name());
      text += csv_line(fields);
    }
  return text;
}

std::string outcome_page(const OutcomeStudy& study, int frames) {
  const std::size_t seeds = study.trainings.size() / 2;
  const std::vector<Scores> network = scores_of_kind(study, false);
  const double accuracy = mean_and_deviation(by_seed(network, &Scores::accuracy)).mean;
  std::string text = fmt::format(
      "# Outcomes of grasps, foretold from touch\n\nFrom the first {} images of both fingers after they have closed: "
      "will the object be held? Trained on {} grasps of {} objects ({} held), judged by {} of {} others ({} held).\n\n",
      frames, study.train.size(), objects_of(study.train).size(), held_in(study.train), study.test.size(),
      objects_of(study.test).size(), held_in(study.test));
  const Seen seen = seen_in(study.test);
  text += fmt::format(
      "The last of these images is of {:.3g} s after closing (median of the test; at most {:.3g} s). By then the "
      "objects had slipped by {:.3g} mm (at most {:.3g} mm).\n\n",
      seen.median_s, seen.largest_s, seen.median_slip_mm, seen.largest_slip_mm);
  text += "| | accuracy | balanced accuracy | area under the ROC curve |\n|---|---|---|---|\n";
  text += score_row("network", network);
  text += score_row("the same, outcomes shuffled in the training", scores_of_kind(study, true));
  text += score_row("force of the grip alone", scores_of(study.grip_only, held_of(study.test)));
  text += score_row("always the more frequent one of the training", scores_of_constant(study));
  text += fmt::format(
      "\nMean ± standard deviation of {} seeds. Besides, {} test grasps are few: the standard error of an accuracy of "
      "{:.3f} is {:.3f} if they are independent.\n\n![ROC curves](roc.svg)\n\n",
      seeds, study.test.size(), accuracy,
      std::sqrt(accuracy * (1.0 - accuracy) / static_cast<double>(study.test.size())));
  return text + outcome_table(study);
}

Value::Map outcome_summary(const OutcomeStudy& study) {
  Value::Map lines{
      {"train", split_lines(study.train)}, {"val", split_lines(study.val)}, {"test", split_lines(study.test)}};
  const Seen seen = seen_in(study.test);
  lines.emplace_back("seen", Value::Map{{"median_s", seen.median_s},
                                        {"largest_s", seen.largest_s},
                                        {"median_slip_mm", seen.median_slip_mm},
                                        {"largest_slip_mm", seen.largest_slip_mm}});
  lines.emplace_back("weights", count_weights(study.network));
  Value::List seeds;
  for (const OutcomeTraining& training : study.trainings)
    if (!training.shuffled) seeds.emplace_back(static_cast<std::int64_t>(training.seed));
  lines.emplace_back("seeds", seeds);
  lines.emplace_back("network", score_lines(scores_of_kind(study, false)));
  lines.emplace_back("shuffled", score_lines(scores_of_kind(study, true)));
  Value::Map grip = score_lines(scores_of(study.grip_only, held_of(study.test)));
  grip.emplace_back("intercept", study.baseline.intercept);
  grip.emplace_back("slope_per_N", study.baseline.slope);
  lines.emplace_back("grip_only", grip);
  lines.emplace_back("constant", score_lines(scores_of_constant(study)));
  return lines;
}

}  // namespace tacipc

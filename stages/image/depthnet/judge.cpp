#include "stages/image/depthnet/judge.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "common/base/each_in_threads.h"
#include "common/base/error.h"
#include "common/base/log.h"
#include "common/benchmark/depth_error.h"

namespace tacipc {
namespace {

constexpr std::size_t kTogether = 32;  // images evaluated together
constexpr std::size_t kFewest = 6;  // least number of rows of a sheet, if there are as many; at most twice this number

/// Height above the front of the gel, m.
FloatImage height_of(FloatImage depth_mm) {
  for (float& depth : depth_mm.pixels) depth *= -1e-3F;
  return depth_mm;
}

}  // namespace

void Judge::keep_picture(DepthRow row) {
  if (!pictures_.empty() &&
      (row.image.width != pictures_.front().image.width || row.image.height != pictures_.front().image.height))
    return;
  if (offered_++ % stride_ != 0) return;
  pictures_.push_back(std::move(row));
  if (pictures_.size() < 2 * kFewest) return;
  stride_ *= 2;
  for (std::size_t i = 1; i < kFewest; ++i) pictures_[i] = std::move(pictures_[2 * i]);
  pictures_.resize(kFewest);
}

void Judge::add(const DepthImage& image) {
  waiting_.push_back(image);
  if (waiting_.size() == kTogether) answer();
}

void Judge::answer() {
  std::vector<FloatImage> answers(waiting_.size());
  std::vector<std::optional<LookComparison>> looks(waiting_.size());
  each_in_threads(waiting_.size(), [&](std::size_t i) {
    stay_in_this_thread();
    answers[i] = network_.depth_mm(waiting_[i].name, waiting_[i].image, waiting_[i].reference);
    looks[i] = compare(network_, waiting_[i].image, waiting_[i].reference);
  });
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    if (looks[i]) unlike_.add(waiting_[i].name, *looks[i]);
    take(waiting_[i], answers[i]);
  }
  waiting_.clear();
  show_progress(0.0, fmt::format("judged: {} images", rows_.size() / 2));
}

void Judge::take(const DepthImage& image, const FloatImage& depth_mm) {
  const auto touches = [](float depth) { return depth > static_cast<float>(kContactMm); };
  if (std::ranges::none_of(image.depth_mm.pixels, touches)) {
    double sum = 0.0;
    for (const float depth : depth_mm.pixels) sum += std::abs(depth);
    seen_untouched_mm_ += sum / static_cast<double>(depth_mm.pixels.size());
    ++untouched_;
    return;
  }
  const FloatImage rest(depth_mm.width, depth_mm.height, 1);
  try {
    const DepthErrors errors =
        depth_errors(height_of(depth_mm), height_of(image.depth_mm), rest, {.pressed_m = 1e-3 * kContactMm});
    rows_.push_back(row_of(image.name, "full", errors.full));
    rows_.push_back(row_of(image.name, "pressed", errors.pressed));
  } catch (const DataError& error) {
    throw DataError("{}: {}", image.name, error.what());
  }
  keep_picture({.image = image.image, .truth_mm = image.depth_mm, .depth_mm = depth_mm});
}

}  // namespace tacipc

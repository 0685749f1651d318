#include "common/benchmark/look_spread.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/each_in_threads.h"

namespace tacipc {
namespace {

constexpr double kLeastDeviation = 0.2;  // smallest deviation of a direction, units
constexpr Eigen::Index kMostDirections = 32;
constexpr double kLeastAlong = 3.0;
constexpr std::size_t kLeftOut = 48;  // groups left out at most, spread over all groups

}  // namespace

struct LookSpread::Sums {
  double count = 0.0;
  Eigen::VectorXd sum;
  Eigen::MatrixXd products;

  explicit Sums(Eigen::Index size) : sum(Eigen::VectorXd::Zero(size)), products(Eigen::MatrixXd::Zero(size, size)) {}
  void add(const Eigen::MatrixXd& rows, double sign) {
    count += sign * static_cast<double>(rows.rows());
    sum += sign * rows.colwise().sum().transpose();
    products += sign * (rows.transpose() * rows);
  }
};

LookSpread LookSpread::fitted(const Sums& sums) {
  LookSpread spread;
  spread.mean_ = sums.sum / sums.count;
  const Eigen::MatrixXd covariance = sums.products / sums.count - spread.mean_ * spread.mean_.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> axes(covariance);  // smallest variances first
  const Eigen::Index size = spread.mean_.size();
  Eigen::Index kept = 0;
  while (kept < std::min(size, kMostDirections) &&
         axes.eigenvalues()[size - 1 - kept] > kLeastDeviation * kLeastDeviation)
    ++kept;
  spread.directions_ = axes.eigenvectors().rightCols(kept);
  spread.deviations_ = axes.eigenvalues().tail(kept).cwiseSqrt();
  return spread;
}

LookSpread::Parts LookSpread::parts_of(const Eigen::VectorXd& numbers) const {
  const Eigen::VectorXd off = numbers - mean_, along = directions_.transpose() * off;
  // A unit is added to each variance, because differences below a unit are irrelevant in every direction.
  return {.along = std::sqrt((along.array().square() / (deviations_.array().square() + 1.0)).sum()),
          .beside = std::sqrt(std::max(0.0, off.squaredNorm() - along.squaredNorm()))};
}

LookSpread LookSpread::of(const std::vector<Eigen::MatrixXd>& groups, const Limits& limits) {
  assert(!groups.empty());
  Sums all(groups.front().cols());
  for (const Eigen::MatrixXd& rows : groups) all.add(rows, 1.0);
  LookSpread spread = fitted(all);
  const std::size_t left_out = std::min(groups.size(), kLeftOut);
  std::vector<Parts> farthest(left_out, {0.0, 0.0});
  each_in_threads(left_out, [&](std::size_t k) {
    const Eigen::MatrixXd& rows = groups[k * groups.size() / left_out];
    const auto go_as_far = [&](const LookSpread& from) {
      for (Eigen::Index row = 0; row < rows.rows(); ++row) {
        const Parts parts = from.parts_of(rows.row(row).transpose());
        farthest[k] = {std::max(farthest[k].along, parts.along), std::max(farthest[k].beside, parts.beside)};
      }
    };
    // A direction in which one group alone varies is off the directions of the others, and far along once it is
    // included.
    go_as_far(spread);
    if (groups.size() == 1) return;
    Sums others = all;
    others.add(rows, -1.0);
    go_as_far(fitted(others));
  });
  spread.along_limit_ = kLeastAlong;
  spread.beside_limit_ = limits.least_beside;
  for (const Parts& far : farthest) {
    spread.along_limit_ = std::max(spread.along_limit_, limits.margin * far.along);
    spread.beside_limit_ = std::max(spread.beside_limit_, limits.margin * far.beside);
  }
  return spread;
}

double LookSpread::distance(const Eigen::VectorXd& numbers) const {
  const Parts parts = parts_of(numbers);
  return std::max(parts.along / along_limit_, parts.beside / beside_limit_);
}

Value::Map LookSpread::to_value() const {
  // Six digits are more than enough, and shorter.
  const auto list = [](const auto& numbers) {
    Value::List out;
    for (const double number : numbers.reshaped()) out.emplace_back(std::stod(fmt::format("{:.6g}", number)));
    return out;
  };
  return {{"mean", list(mean_)},
          {"deviations", list(deviations_)},
          {"directions", list(directions_)},
          {"along_limit", along_limit_},
          {"beside_limit", beside_limit_}};
}

LookSpread LookSpread::read(ConfigReader& in, Eigen::Index size) {
  const auto column = [](const std::vector<double>& numbers) {
    return Eigen::VectorXd(
        Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size())));
  };
  // Far beyond the values of images, and small enough for finite distances.
  constexpr double kMost = 1e6;
  LookSpread spread;
  spread.mean_ = column(in.numbers("mean", static_cast<std::size_t>(size), Range::between(-kMost, kMost)));
  spread.deviations_ = column(in.any_numbers("deviations", {.low = 0.0, .high = kMost, .open_low = true}));
  const Eigen::Index count = spread.deviations_.size();
  if (count > std::min(size, kMostDirections)) in.fault("deviations", "are too many");
  spread.directions_ =
      column(in.numbers("directions", static_cast<std::size_t>(size * count), Range::between(-1.01, 1.01)))
          .reshaped(size, count);
  spread.along_limit_ = in.number("along_limit", Range::between(1.0, kMost));
  spread.beside_limit_ = in.number("beside_limit", Range::between(1.0, kMost));
  return spread;
}

}  // namespace tacipc

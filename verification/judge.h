// Compares measured with expected numbers, giving the rows of the table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verification/measure.h"

namespace tacipc::verify {

/// Name that `formula` of a case may take, and its meaning.
struct Formula {
  std::string name;
  std::string meaning;
};
const std::vector<Formula>& formulas();

/// Value of a formula for the case at the depth, shift and turn of a frame, in SI units.
/// \param with_standoff evaluate for the object enlarged by the barrier's stand-off, and deeper by the same amount
/// \throw UsageError if the formula does not apply to this kind of gel or object
double evaluate(const std::string& formula, const Outcome& outcome, int frame, bool with_standoff);

/// One row of the table: a measured and an expected value.
struct Row {
  std::string label;
  std::string unit;
  double measured = 0.0;
  std::optional<double> expected = {};  // absent if only bounds are given
  std::string limit = {};               // limit as text, such as "within 3 %"
  double deviation = 0.0;               // measured − expected, in the limit's unit: percent, or absolute
  bool pass = false;
};

/// All rows of a case, after applying the fitted modulus. `fitted_modulus_pa` is set if the case fits one.
struct Judgement {
  std::vector<Row> rows;
  std::optional<double> fitted_modulus_pa;
  bool pass() const;
};
Judgement judge(const Outcome& outcome, const std::filesystem::path& shared);

}  // namespace tacipc::verify

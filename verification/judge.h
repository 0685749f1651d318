// Measured against expected: the rows of the table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "verification/measure.h"

namespace tacipc::verify {

/// Names that `formula` of a case may take, with their meaning.
struct Formula {
  std::string name;
  std::string meaning;
};
const std::vector<Formula>& formulas();

/// The value a formula gives for the case at the depth, shift and turn of a frame, SI; `with_standoff`: for the object
/// enlarged by the barrier's stand-off, and so much deeper. \throw UsageError if the gel or
/// object is not of the kind the formula is for
double evaluate(const std::string& formula, const Outcome& outcome, int frame, bool with_standoff);

struct Row {
  std::string label;
  std::string unit;
  double measured = 0.0;
  std::optional<double> expected = {};  // absent for mere bounds
  std::string limit = {};               // in words: "within 3 %"
  double deviation = 0.0;               // measured − expected over the limit's unit: percent, or absolute
  bool pass = false;
};

/// All rows of a case, the fitted modulus applied. `fitted_modulus_pa` is set if the case fits one.
struct Judgement {
  std::vector<Row> rows;
  std::optional<double> fitted_modulus_pa;
  bool pass() const;
};
Judgement judge(const Outcome& outcome, const std::filesystem::path& shared);

}  // namespace tacipc::verify

// The cases of configs/verification that take less than a minute each, as the goal runs them; the long ones in small.
#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/shared_data.h"
#include "tests/verification/run_case.h"

namespace tacipc::verify {
namespace {

class CaseFile : public ::testing::TestWithParam<std::string> {};

TEST_P(CaseFile, HoldsItsLimits) {
  const std::filesystem::path file = std::filesystem::path(TACIPC_SOURCE_DIR) / (GetParam() + ".yaml");
  const CaseResult result = run_case(read_config<CaseSpec>(file), shared_root(), [](int, int, int, double) {});
  if (result.skipped) GTEST_SKIP() << *result.skipped;
  ASSERT_FALSE(result.failed) << *result.failed;
  for (const Row& row : result.judgement.rows) {
    EXPECT_TRUE(row.pass) << row.label << ": " << row.measured << " " << row.unit << ", expected "
                          << (row.expected ? std::to_string(*row.expected) : "a bound") << ", " << row.limit;
  }
}

INSTANTIATE_TEST_SUITE_P(All, CaseFile,
                         ::testing::Values("configs/verification/compression_contact",
                                           "configs/verification/layer_shear", "configs/verification/disc_twist",
                                           "configs/verification/friction_plate", "configs/verification/friction_punch",
                                           "configs/verification/reference_small_press",
                                           "configs/verification/reference_small_shear",
                                           "tests/verification/hertz_reduced", "tests/verification/flat_punch_reduced"),
                         [](const auto& test) { return std::filesystem::path(test.param).filename().string(); });

}  // namespace
}  // namespace tacipc::verify

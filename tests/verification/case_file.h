// A case of the verification as a test: every row must hold.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "common/config/config.h"
#include "tests/shared_data.h"
#include "verification/run_case.h"

namespace tacipc::verify {

/// Runs the case of this file (below the sources, without `.yaml`) and expects its rows to hold; skips where it needs
/// measured data that are not there.
inline void expect_case_holds(const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(TACIPC_SOURCE_DIR) / (name + ".yaml");
  const CaseResult result = run_case(read_config<CaseSpec>(file), shared_root(), [](int, int, int, double) {});
  if (result.skipped) GTEST_SKIP() << *result.skipped;
  ASSERT_FALSE(result.failed) << *result.failed;
  for (const Row& row : result.judgement.rows) {
    EXPECT_TRUE(row.pass) << row.label << ": " << row.measured << " " << row.unit << ", expected "
                          << (row.expected ? std::to_string(*row.expected) : "a bound") << ", " << row.limit;
  }
}

/// The case's name alone, for the name of the test.
inline std::string case_name(const ::testing::TestParamInfo<std::string>& info) {
  return std::filesystem::path(info.param).filename().string();
}

}  // namespace tacipc::verify

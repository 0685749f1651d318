// A part of the stress campaign, from a seed of its own.
#include <gtest/gtest.h>

#include "verification/stress_case.h"

namespace tacipc::verify {
namespace stress_case_slow_test {

TEST(StressSlow, TwentyFiveCasesConverge) {
  const auto ranges = read_config<StressConfig>(TACIPC_SOURCE_DIR "/configs/studies/stress/stress.yaml");
  for (std::uint64_t index = 0; index < 25; ++index) {
    const StressCase stress = draw_case(ranges, 2, index);
    const StressResult result = run_stress_case(stress, [](int, int, int, double) {});
    EXPECT_EQ(result.outcome, StressOutcome::converged) << "case " << index << ": " << result.reason << "\n"
                                                        << to_yaml(stress.description());
    EXPECT_EQ(result.frames, result.frames_asked);
  }
}

}  // namespace stress_case_slow_test
}  // namespace tacipc::verify

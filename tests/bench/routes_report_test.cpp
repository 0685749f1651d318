// Samples by two routes: what counts as agreeing, and what the page says.
#include "bench/routes_report.h"

#include <gmock/gmock.h>

#include "common/base/error.h"
#include "tests/config_text.h"
#include "tests/scratch_folder.h"

namespace tacipc::bench {
namespace routes_report_test {

using ::testing::HasSubstr;
using ::testing::Not;

const RouteLimits kLimits{.rms_m = 1e-7, .force = 1e-4, .largest_m = 1e-6};

Run run(double shift_m, double force_n, double cpu_s) {
  Run out;
  out.gel_vertices = 4;
  out.last = Positions::Zero(4, 3);
  out.last(2, 1) = shift_m;
  out.press_force_n = force_n;
  out.processor_s = cpu_s;
  out.frames = {{.press = true, .newton = 7}};
  return out;
}

RoutePair sample(const std::string& object, const std::string& pose, double shift_m, double force_n) {
  return {object, pose, {run(shift_m, force_n, 2.0), ""}, {run(0.0, 1.0, 10.0), ""}};
}

TEST(Routes, AnswersAgreeWithinEveryLimit) {
  EXPECT_TRUE(sample("a", "p", 1e-7, 1.00005).agrees(kLimits));
  EXPECT_FALSE(sample("a", "p", 1e-7, 0.9998).agrees(kLimits));  // force
  EXPECT_FALSE(sample("a", "p", 5e-7, 1.0).agrees(kLimits));     // rms 2.5e-7
  EXPECT_TRUE(sample("a", "p", 1.1e-6, 1.0).agrees({.rms_m = 1.0, .force = 1.0, .largest_m = 1e-6}));
  EXPECT_FALSE(sample("a", "p", 1.1e-6, 1.0).agrees_at_every_vertex({.rms_m = 1.0, .force = 1.0, .largest_m = 1e-6}));
}

TEST(Routes, ARunThatFailedAgreesWithNothingAndIsNamed) {
  std::vector<RoutePair> pairs{sample("a", "p", 0.0, 1.0), sample("b", "p", 0.0, 1.0), sample("b", "q", 1e-5, 1.0)};
  pairs[1].direct = {std::nullopt, "Newton did not converge"};
  const RouteSummary sum = summarize(pairs, kLimits);
  EXPECT_EQ(sum.samples, 3);
  EXPECT_EQ(sum.fast_converged, 3);
  EXPECT_EQ(sum.direct_converged, 2);
  EXPECT_EQ(sum.agree, 1);
  EXPECT_FALSE(sum.holds());
  EXPECT_DOUBLE_EQ(sum.fast_s, 4.0);
  EXPECT_DOUBLE_EQ(sum.direct_s, 20.0);
  const std::string page = routes_page(pairs, kLimits);
  EXPECT_THAT(page, HasSubstr("| a | 1 of 1 | 1 of 1 | 1 of 1 |"));
  EXPECT_THAT(page, HasSubstr("| b | 2 of 2 | 1 of 2 | 0 of 2 |"));
  EXPECT_THAT(page, HasSubstr("- b, p: by factorisation: Newton did not converge\n"));
  EXPECT_THAT(page, HasSubstr("- b, q: 10 µm largest, 5 µm rms"));
  EXPECT_THAT(page, Not(HasSubstr("- a, p")));
  EXPECT_TRUE(summarize({pairs[0]}, kLimits).holds());
}

TEST(Routes, PairsAreFoundByTheNamesOfTheirFolders) {
  const ScratchFolder scratch;
  std::vector<std::filesystem::path> folders;
  for (const char* name : {"12k-cone-tilted-direct", "12k-cone-tilted-fast"}) {
    folders.push_back(scratch / name);
    std::filesystem::create_directories(folders.back());
    write_file(folders.back() / "press.failed.yaml", "stage: press\nmessage: \"too flat\"\n");
  }
  const std::vector<RoutePair> pairs = read_route_pairs(folders);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].object, "cone");
  EXPECT_EQ(pairs[0].pose, "tilted");
  EXPECT_EQ(pairs[0].fast.failure, "too flat");
  EXPECT_THROW(read_route_pairs({folders[0]}), DataError);
  EXPECT_THROW(read_route_pairs({scratch / "cone-fast"}), DataError);
}

TEST(Routes, LimitsAreGivenInMillimetresAndPercent) {
  const auto limits = config_from_text<RouteLimits>("largest_mm: 2\nrms_mm: 0.5\nforce_percent: 3\n", "x.yaml");
  EXPECT_DOUBLE_EQ(limits.largest_m, 2e-3);
  EXPECT_DOUBLE_EQ(limits.rms_m, 0.5e-3);
  EXPECT_DOUBLE_EQ(limits.force, 0.03);
}

}  // namespace routes_report_test
}  // namespace tacipc::bench

#include "stages/study/tabulate/stage_costs.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include "tests/config_text.h"
#include "tests/program_test.h"

namespace tacipc {
namespace stage_costs_test {

using ::testing::HasSubstr;

const char* const kConfig = R"(title: Stage
rows:
  - {name: ours, stage: press, folder: tacipc, per: sample}
  - {name: all presses, stage: press, per: sample}
  - {name: gel, stage: tetmesh, folder: coarse, per: sensor}
sums:
  - {name: both, per: sample, of: [ours, gel]}
caption: One thread.
)";

class StageCosts : public ProgramTest {
 protected:
  void SetUp() override {
    write("star/tacipc/press/press", 10.0, 200.0);
    write("gear/tacipc/press/press", 14.0, 150.0);
    write("star/fine/press/press", 60.0, 900.0);
    write("gels/mctac-coarse/tetmesh", 1.5, 80.0);
    write_file(scratch_ / "config.yaml", std::string("kind: costs\n") + kConfig);
  }
  void write(const std::string& record, double seconds, double megabytes) {
    const std::filesystem::path file = scratch_ / (record + ".timings.yaml");
    write_file(file, fmt::format("stage: {}\nthreads: 1\nwall_s: 99.0\nprocessor_s: {}\npeak_memory_mb: {}\n",
                                 std::filesystem::path(record).filename().string(), seconds, megabytes));
    files_.push_back(file);
  }
  std::vector<std::filesystem::path> files_;
};

TEST_F(StageCosts, MeansOfWhatBelongsToARow) {
  const auto config = config_from_text<StageCostsConfig>(kConfig, "c.yaml");
  const std::vector<Cost> costs = costs_of(files_, config);
  ASSERT_EQ(costs.size(), 3u);
  EXPECT_EQ(costs[0].runs, 2u);
  EXPECT_DOUBLE_EQ(costs[0].processor_s.mean, 12.0);
  EXPECT_DOUBLE_EQ(costs[0].processor_s.deviation, 2.0);
  EXPECT_EQ(costs[0].largest_s, 14.0);
  EXPECT_EQ(costs[0].peak_memory_mb, 200.0);
  EXPECT_EQ(costs[1].runs, 3u);
  EXPECT_DOUBLE_EQ(costs[1].processor_s.mean, 28.0);
  EXPECT_EQ(costs[2].runs, 1u) << "the folder's name ends so";
  const std::string table = to_markdown(costs, config);
  EXPECT_THAT(table, HasSubstr("| ours | sample | 2 | 12.0 ± 2.0 | 14.0 | 0.20 |\n"));
  EXPECT_THAT(table, HasSubstr("| **both** | sample | | 13.5 | | 0.20 |\n\nOne thread.\n"));
  EXPECT_THAT(to_csv(costs), HasSubstr("gel,sensor,1,1.5,0,1.5,80\n"));
}

TEST_F(StageCosts, FoldersAboveAllTimingsTellNothingApart) {
  const auto config = config_from_text<StageCostsConfig>(
      "title: t\nrows: [{name: ours, stage: press, folder: tacipc, per: sample}]\n", "one.yaml");
  files_.clear();
  write("my-tacipc/star/tacipc/press/press", 10.0, 200.0);
  write("my-tacipc/star/fine/press/press", 60.0, 900.0);
  EXPECT_EQ(costs_of(files_, config)[0].runs, 1u);
}

TEST_F(StageCosts, ASumIsOfRows) {
  EXPECT_THAT(faults_in<StageCostsConfig>(
                  "title: t\nrows: [{name: a, stage: press, per: x}]\nsums: [{name: s, per: x, of: [b]}]\n", "c.yaml"),
              ::testing::ElementsAre("c.yaml:3:30: sums[0].of: 'b' is not one of the rows"));
}

TEST_F(StageCosts, ARowNeedsTimings) {
  const auto run = [&](const std::string& files) {
    return run_command(
        fmt::format("cd '{}' && {}/tabulate --config config.yaml --timings {} --log-level error --out out",
                    (scratch_ / "").string(), TACIPC_BIN_DIR, files));
  };
  EXPECT_EQ(run("star/fine/press/press.timings.yaml"), 1);
  EXPECT_EQ(said_, "tabulate: error: no timings of press in tacipc were given for 'ours'\n");
  ASSERT_EQ(run("*/*/press/*.timings.yaml gels/*/*.timings.yaml"), 0) << said_;
  EXPECT_THAT(read_file(scratch_ / "out/tabulate.yaml"), HasSubstr("rows: 3"));
  write_file(scratch_ / "broken.timings.yaml", "stage: press\nprocessor_s: 1\n");
  EXPECT_EQ(run("broken.timings.yaml"), 1);
  EXPECT_THAT(said_, HasSubstr("broken.timings.yaml"));
}

}  // namespace stage_costs_test
}  // namespace tacipc

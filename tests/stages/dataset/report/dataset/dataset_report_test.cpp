#include <fmt/core.h>
#include <gmock/gmock.h>

#include <regex>

#include "common/image/picture.h"
#include "common/stage/record.h"
#include "tests/program_test.h"
#include "tests/stages/dataset/report/dataset/dataset_folder.h"

namespace tacipc {
namespace dataset_report_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class DatasetReportTest : public ProgramTest {
 protected:
  int report(const DatasetFolder& data, const std::string& more = "") {
    return run_command(fmt::format(
        "{}/report --plan {} --dataset {} --config {} --title set --out {} {}", TACIPC_BIN_DIR, data.plan().string(),
        (data.dataset() / "plan/dataset.yaml").string(), config_.string(), (data.dataset() / "report").string(), more));
  }
  std::string page(const DatasetFolder& data, const std::string& name) const {
    return read_file(data.dataset() / "report" / name);
  }

  fs::path config_ =
      scratch_.file("report.yaml", "{made: 2, failed: 5, rows: 10, sheet: 2, picture_px: 32, thumb_px: 16}\n");
};

/// Everything that a page names and that is not there, without places in pages.
std::vector<std::string> dead_links(const fs::path& site) {
  std::vector<std::string> dead;
  const std::regex pattern("(?:href|src)=\"([^\"#]+)[^\"]*\"");
  for (const auto& entry : fs::recursive_directory_iterator(site)) {
    if (entry.path().extension() != ".html") continue;
    const std::string html = read_file(entry.path());
    for (std::sregex_iterator it(html.begin(), html.end(), pattern), end; it != end; ++it) {
      const std::string link = (*it)[1];
      if (!link.starts_with("data:") && !fs::exists(entry.path().parent_path() / link))
        dead.push_back(entry.path().filename().string() + ": " + link);
    }
  }
  return dead;
}

TEST_F(DatasetReportTest, AnOddPlanIsRefusedWithItsLine) {
  const DatasetFolder data(scratch_ / "", 3);
  const std::string plan = read_file(data.plan()), second = DatasetFolder::folder_name(1);
  const auto refused = [&](const std::string& folder, const std::string& shown) {
    std::string odd = plan;
    write_file(data.plan(), odd.replace(odd.find(second), second.size(), folder));
    EXPECT_EQ(report(data), 1) << folder;
    EXPECT_EQ(said_, fmt::format("report: error: {}:3: '{}' is not a folder below the dataset's\n",
                                 data.plan().string(), shown));
  };
  refused("samples/" + std::string(300, 'x'), "samples/" + std::string(72, 'x') + "… (308 bytes)");
  refused("../../etc", "../../etc");
  refused("samples/\x1b[31m", "samples/\\x1b[31m");
  refused("", "");
}

TEST_F(DatasetReportTest, ShowsWhatIsThereInMidRun) {
  const DatasetFolder data(scratch_ / "", 25);
  for (const int i : {0, 1, 4, 7}) data.make(i);
  data.fail(2);
  ASSERT_EQ(report(data), 0) << said_;
  EXPECT_THAT(said_, HasSubstr("25 samples: 4 made, 1 failed, 0 running, 20 not made; 3 have pages"));
  const std::string index = page(data, "index.html");
  EXPECT_THAT(index, HasSubstr("<li class=\"\"><b>25</b>planned samples</li>"));
  EXPECT_THAT(index, HasSubstr("Not complete: 4 of 25 samples are made"));
  EXPECT_THAT(index, HasSubstr("3 of 5 finished samples, spread evenly over the plan, have a page"));
  EXPECT_THAT(index, HasSubstr("<td class=\"wrap\">frame 2: &lt;no way&gt; on</td>"));
  EXPECT_THAT(index, HasSubstr("1 × press: force balance"));
  EXPECT_THAT(index, HasSubstr("x -2 to 2 mm, y 0 mm, turned by 0 to 90°"));
  EXPECT_THAT(index, HasSubstr("as in along.yaml"));
  EXPECT_THAT(index, HasSubstr("4 samples, median 0.700"));  // shear ratio
  EXPECT_THAT(index, Not(HasSubstr("<script")));
  EXPECT_TRUE(dead_links(data.dataset() / "report").empty())
      << ::testing::PrintToString(dead_links(data.dataset() / "report"));
  // The first and third of the four that are made, and the failed one, in the order of the plan.
  EXPECT_TRUE(fs::exists(data.dataset() / "report/samples" / (data.id(0) + ".html")));
  EXPECT_FALSE(fs::exists(data.dataset() / "report/samples" / (data.id(1) + ".html")));
  const std::string failed = page(data, "samples/" + data.id(2) + ".html");
  EXPECT_THAT(failed, HasSubstr("rel=\"prev\" accesskey=\"p\" href=\"" + data.id(0) + ".html\""));
  EXPECT_THAT(failed, HasSubstr("rel=\"next\" accesskey=\"n\" href=\"" + data.id(4) + ".html\""));
  EXPECT_THAT(failed, HasSubstr("press: frame 2: &lt;no way&gt; on"));
  const Record summary = Record::from_file(data.dataset() / "report/report.yaml").section("summary");
  EXPECT_EQ(summary.required_count("made"), 4);
  EXPECT_EQ(summary.required_count("sample_pages"), 3);
}

TEST_F(DatasetReportTest, PicturesAreSmallCopiesSoThatThePagesCanGoAlone) {
  const DatasetFolder data(scratch_ / "", 1);
  data.make(0);
  ASSERT_EQ(report(data), 0) << said_;
  const fs::path pictures = data.dataset() / "report/pictures" / data.id(0);
  EXPECT_EQ(read_png(pictures / "tactile.jpg", 3).width, 32);
  EXPECT_EQ(read_png(pictures / "thumb.jpg", 3).height, 12);
  const std::string html = page(data, "samples/" + data.id(0) + ".html");
  EXPECT_THAT(html, HasSubstr("<img src=\"../pictures/" + data.id(0) + "/indentation.jpg\" alt=\"indentation map of "));
  EXPECT_THAT(html, HasSubstr(">normal.png</a>"));  // the whole one, among the data
  // A map without preview is drawn from its numbers: flat, so everywhere at the light end of the colours.
  EXPECT_THAT(html, HasSubstr(">indentation.exr</a>"));
  EXPECT_THAT(html, Not(HasSubstr(">indentation.png</a>")));
  const ByteImage drawn = read_png(pictures / "indentation.jpg", 3);
  const auto lightest = perceptual_color(1.0);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(drawn.at(5, 5, c), lightest[static_cast<std::size_t>(c)], 3);
}

TEST_F(DatasetReportTest, SaysWhatWasDroppedAfterPacking) {
  const DatasetFolder data(scratch_ / "", 2);
  data.make(0);
  data.make(1);
  for (const char* name : {"positions.npy", "object_pose.npy", "markers.npy", "marker_displacement.npy",
                           "contact_state.npy", "front_vertices.npy", "wrench.npy"})
    fs::remove(data.sample(0) / "press" / name);
  write_file(data.sample(0) / "press/.dropped", "");
  fs::remove_all(data.sample(1) / "render/frame_0004");
  write_file(data.sample(1) / "render/.dropped", "");
  ASSERT_EQ(report(data), 0) << said_;
  EXPECT_THAT(page(data, "index.html"), HasSubstr("Of 2 samples files were removed after packing"));
  const std::string first = page(data, "samples/" + data.id(0) + ".html");
  EXPECT_THAT(first, HasSubstr(">passed</span>"));
  EXPECT_THAT(first, HasSubstr("its arrays were dropped after packing"));
  // A sample without images has a page only where none has images.
  EXPECT_FALSE(fs::exists(data.dataset() / "report/samples" / (data.id(1) + ".html")));
  fs::remove_all(data.sample(0) / "render/frame_0004");
  write_file(data.sample(0) / "render/.dropped", "");
  ASSERT_EQ(report(data), 0) << said_;
  const std::string second = page(data, "samples/" + data.id(1) + ".html");
  EXPECT_THAT(second, HasSubstr(">passed</span>"));
  EXPECT_THAT(second, HasSubstr("its images were dropped after packing"));
  EXPECT_THAT(page(data, "sheet-001.html"), HasSubstr("no image left"));
}

TEST_F(DatasetReportTest, ListsManySamplesOverManyPagesInLittleMemory) {
  const DatasetFolder few(scratch_ / "few", 25), many(scratch_ / "many", 5'000);
  few.make(11);
  many.make(11);
  ASSERT_EQ(report(few), 0) << said_;
  EXPECT_TRUE(fs::exists(few.dataset() / "report/list-003.html"));
  EXPECT_FALSE(fs::exists(few.dataset() / "report/list-004.html"));
  ASSERT_EQ(report(many), 0) << said_;
  EXPECT_THAT(page(many, "list-500.html"), HasSubstr("<a rel=\"prev\" accesskey=\"p\" href=\"list-499.html\">"));
  EXPECT_THAT(page(many, "list-500.html"), HasSubstr("</b> </nav>"));  // there is no next one
  EXPECT_THAT(page(many, "samples/" + many.id(11) + ".html"), HasSubstr("href=\"../list-002.html\""));
  const auto peak_mb = [&](const DatasetFolder& data) {
    return Record::from_file(data.dataset() / "report/report.timings.yaml").required_number("peak_memory_mb");
  };
  EXPECT_LT(peak_mb(many), peak_mb(few) + 10.0);
}

TEST_F(DatasetReportTest, TheSameSamplesGiveTheSameBytesWithAnyNumberOfThreads) {
  const DatasetFolder data(scratch_ / "", 40);
  for (int i = 0; i < 40; i += 3) data.make(i);
  ASSERT_EQ(report(data, "--threads 1"), 0) << said_;
  const std::string record = page(data, "report.yaml");
  ASSERT_EQ(report(data, "--threads 4"), 0) << said_;
  EXPECT_EQ(page(data, "report.yaml"), record);  // it has the hashes of all pages
}

TEST_F(DatasetReportTest, SamplesAndADatasetAreNotMixed) {
  const DatasetFolder data(scratch_ / "", 1);
  data.make(0);
  EXPECT_EQ(report(data, "--sample " + data.sample(0).string()), 2);
  EXPECT_THAT(said_, HasSubstr("give either --sample, once per sample, or --grasp, or --scene, or --plan, --dataset "
                               "and --config of a dataset"));
  EXPECT_EQ(run_command(fmt::format("{}/report --out {}", TACIPC_BIN_DIR, (scratch_ / "out").string())), 2);
  write_file(config_, "{made: 2, faled: 5, rows: 10, sheet: 2, picture_px: 32, thumb_px: 16}\n");
  EXPECT_EQ(report(data), 2);
  EXPECT_THAT(said_, HasSubstr("faled: unknown key (did you mean failed?)"));
}

}  // namespace dataset_report_test
}  // namespace tacipc

#include "stages/dataset/report/page.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <regex>

#include "common/image/picture.h"
#include "tests/scratch_folder.h"
#include "tests/stages/dataset/report/sheared_folder.h"

namespace tacipc {
namespace page_test {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class PageTest : public ::testing::Test {
 protected:
  std::string page(const std::vector<fs::path>& folders, const std::string& title = "Title") const {
    std::vector<SampleReport> samples;
    for (const fs::path& folder : folders) samples.push_back(read_sample(folder));
    return report_page(title, samples, out_);
  }

  ScratchFolder scratch_;
  fs::path star_ = write_sample(scratch_ / "", "star");
  fs::path gear_ = write_sample(scratch_ / "", "gear & co <1>");
  fs::path out_ = scratch_ / "out/demo/report";
};

/// Text between `from` and the next `to`.
std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const auto begin = text.find(from);
  EXPECT_NE(begin, std::string::npos) << from;
  return text.substr(begin, text.find(to, begin) - begin);
}

std::string decoded(const std::string& link) {
  std::string path;
  for (std::size_t i = 0; i < link.size(); ++i) {
    path += link[i] == '%' ? static_cast<char>(std::stoi(link.substr(i + 1, 2), nullptr, 16)) : link[i];
    if (link[i] == '%') i += 2;
  }
  return path;
}

std::vector<std::string> links(const std::string& html) {
  std::vector<std::string> found;
  const std::regex pattern("(?:href|src)=\"([^\"]*)\"");
  for (std::sregex_iterator it(html.begin(), html.end(), pattern), end; it != end; ++it) found.push_back((*it)[1]);
  return found;
}

TEST_F(PageTest, EveryLinkLeadsToAFileOrACard) {
  const std::string html = page({star_, gear_});
  int files = 0, cards = 0;
  for (const std::string& link : links(html)) {
    if (link.starts_with("#")) {
      EXPECT_THAT(html, HasSubstr("id=\"" + link.substr(1) + "\""));
      ++cards;
    } else if (link != "contact_sheet.png" && link != "report.yaml") {  // which the stage writes beside the page
      EXPECT_TRUE(fs::path(link).is_relative()) << link;
      EXPECT_TRUE(fs::is_regular_file((out_ / decoded(link)).lexically_normal())) << link;
      ++files;
    }
  }
  EXPECT_EQ(cards, 2);
  EXPECT_EQ(files, 2 * (3 * 2 + 1 + 8));  // three pictures, each linked, the one without contact, records and data
}

TEST_F(PageTest, TheSummaryHasTheNumbersOfEachSample) {
  const std::string row = between(page({star_}), "<tbody>", "</tbody>");
  EXPECT_EQ(row,
            "<tbody>\n<tr><td class=\"word\"><a href=\"#sample-1\">star-007</a></td><td class=\"word\">star</td>"
            "<td class=\"word\"><span class=\"verdict passed\">passed</span></td><td>0.500</td><td>1.25</td>"
            "<td>–</td><td>25</td><td>35.0</td><td>0.750</td><td>23\u202f512</td><td>123\u202f456 → 8\u202f000</td>"
            "<td>0.0123</td><td class=\"word\">synthetic</td></tr>\n");
}

TEST_F(PageTest, CardsTellPlacementMeshAndRange) {
  const std::string card = between(page({star_}), "<article", "</article>");
  EXPECT_THAT(card, HasSubstr("<dt>side that presses</dt><dd>+z <span class=\"quiet\">(opposite of the object&#39;s up "
                              "side -z)</span></dd>"));
  EXPECT_THAT(card, HasSubstr("<dt>turned about z</dt><dd>30°</dd>"));
  EXPECT_THAT(card, HasSubstr("<dt>centre on the gel</dt><dd>x 1.5 mm, y -2 mm</dd>"));
  EXPECT_THAT(card, HasSubstr("<dt>holes filled</dt><dd>2</dd>"));
  EXPECT_THAT(card, HasSubstr("<dt>Hausdorff distance</dt><dd>0.0123 mm</dd>"));
  EXPECT_THAT(card, HasSubstr("<div class=\"bar\">0<i></i>0.534 mm</div>"));
  EXPECT_THAT(card, HasSubstr("<p class=\"note warn\">Synthetic reference image"));
  EXPECT_THAT(card, HasSubstr("<polyline points="));
  EXPECT_THAT(card, HasSubstr("<tr><td>1</td><td>0.250</td><td>0.500</td><td>11</td><td>40.0</td><td>0.875</td></tr>"));
}

TEST_F(PageTest, TheColourBarHasTheColoursOfThePicture) {
  const std::string bar = between(page({star_}), ".bar i { background: linear-gradient", ")); }");
  for (const double t : {0.0, 0.5, 1.0}) {
    const auto [r, g, b] = perceptual_color(t);
    EXPECT_THAT(bar, HasSubstr(fmt::format("rgb({} {} {}) {:g}%", r, g, b, 100 * t)));
  }
}

TEST_F(PageTest, WhatUsersWroteCannotBecomeMarkup) {
  const std::string evil = "<script>alert('&\"')</script>";
  write_file(star_ / "press/press.yaml", replaced(kPressRecord, "star-007", "\"<b>star</b>\""));
  fs::remove(gear_ / "press/press.yaml");
  write_file(gear_ / "press/press.log", "2024-06-07 12:34:56.789 error: press: error: " + evil + "\n");
  const std::string html = page({star_, gear_}, evil);
  const std::string safe = "&lt;script&gt;alert(&#39;&amp;&quot;&#39;)&lt;/script&gt;";
  EXPECT_THAT(html, HasSubstr("<title>" + safe + "</title>"));
  EXPECT_THAT(html, HasSubstr("<h1>" + safe + "</h1>"));
  EXPECT_THAT(html, HasSubstr("<p class=\"note bad\">press: " + safe + "</p>"));
  EXPECT_THAT(html, HasSubstr("<h3>&lt;b&gt;star&lt;/b&gt;</h3>"));
  EXPECT_THAT(html, HasSubstr("<h3>gear &amp; co &lt;1&gt;</h3>"));
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("<b>star")));
}

TEST_F(PageTest, ASampleInPhasesShowsForcesMarkersAndSlip) {
  const fs::path drag = write_sheared_sample(scratch_ / "", "drag");
  const std::string html = page({drag});
  const std::string card = between(html, "<article", "</article>");
  EXPECT_THAT(card, HasSubstr("<dt>motion</dt><dd>press 0.5 mm, shear 0.4 mm towards 90°</dd>"));
  EXPECT_THAT(card, HasSubstr("<dt>tangential force</dt><dd>0.840 N</dd>"));
  EXPECT_THAT(card, HasSubstr("<dt>at the end of the press</dt><dd>1.25 N (frame 2)</dd>"));
  EXPECT_THAT(
      card,
      HasSubstr(
          "<dt>coefficient</dt><dd>0.7</dd><dt>first slip</dt><dd>0.0250 s</dd><dt>gross slip</dt><dd>0.0400 s</dd>"));
  EXPECT_THAT(card, HasSubstr("<dt>elements</dt><dd>averaged_volume</dd>"));
  EXPECT_THAT(card, HasSubstr("<b>Tactile image</b>, frame 2 (end of press)"));
  EXPECT_THAT(card, HasSubstr("<b>Markers</b> since rest, frame 2 (end of press), at most 0.0100 mm<br>"));
  EXPECT_THAT(card, HasSubstr("<b>Markers</b> since the end of the press, frame 4 (end of shear), at most 0.400 mm<br>"
                              "<i class=\"dot stuck\"></i>0 contacts stick, <i class=\"dot slipping\"></i>2 slip"));
  EXPECT_THAT(card,
              HasSubstr("✓</span>force imbalance</td><td class=\"word\">0.0200 % of the contact force (frame 2)</td>"));
  EXPECT_THAT(card, Not(HasSubstr("press force over indentation depth")));  // most frames have one depth
  EXPECT_THAT(html, HasSubstr("<li class=\"\"><b>0.0200 %</b>largest force imbalance</li>"));
  EXPECT_THAT(between(html, "<tbody>", "</tbody>"), HasSubstr("<td>1.20</td><td>0.840</td><td>40</td>"));
}

TEST_F(PageTest, LongMotionsMakeNoLongPages) {
  const fs::path drag = write_sheared_sample(scratch_ / "", "drag");
  SampleReport sample = read_sample(drag);
  const FrameReport last = sample.frames.back();
  for (int i = 0; i < 300; ++i) sample.frames.push_back(last);
  EXPECT_LT(report_page("Title", {sample}, out_).size(), 100'000u);
}

TEST_F(PageTest, TheCheckThatFailedStandsOnTheCard) {
  fs::remove(gear_ / "press/press.yaml");
  write_file(gear_ / "press/press.failed.yaml",
             "stage: press\nname: gear\nmessage: \"frame 2: imbalance of 0.002\"\nframe: 2\ncheck: balance_relative\n"
             "value: 0.002\nlimit: 0.001\n");
  const std::string card = between(page({gear_}), "<article", "</article>");
  EXPECT_THAT(card, HasSubstr("<p class=\"note bad\">press: frame 2: imbalance of 0.002</p>"));
  EXPECT_THAT(card, HasSubstr("✗</span>balance_relative</td><td class=\"word\">0.002 (frame 2)</td>"
                              "<td class=\"word quiet\">limit: 0.001</td>"));
}

TEST_F(PageTest, AFailedSampleIsShownAsFailedWithItsReason) {
  fs::remove(gear_ / "press/press.yaml");
  write_file(gear_ / "press/press.log", "2024-06-07 12:34:56.789 error: press: error: frame 2: no convergence\n");
  const std::string html = page({star_, gear_});
  EXPECT_THAT(html, HasSubstr("<li class=\"good\"><b>1</b>passed</li>\n<li class=\"bad\"><b>1</b>failed</li>"));
  const std::string card = between(html, "<article class=\"card\" id=\"sample-2\"", "</article>");
  EXPECT_THAT(card, HasSubstr("<span class=\"verdict failed\">FAILED</span>"));
  EXPECT_THAT(card, HasSubstr("<p class=\"note bad\">press: frame 2: no convergence</p>"));
  EXPECT_THAT(card, Not(HasSubstr("<img")));
}

TEST_F(PageTest, NeedsNeitherScriptsNorTheNetwork) {
  const std::string html = page({star_, write_sheared_sample(scratch_ / "", "drag")});
  EXPECT_THAT(html, Not(HasSubstr("<script")));
  EXPECT_THAT(html, Not(HasSubstr("//")));
  EXPECT_THAT(html, Not(HasSubstr("@import")));
  EXPECT_THAT(html, Not(HasSubstr("url(")));
}

TEST_F(PageTest, ElementsAreClosed) {
  const std::string html = page({star_, gear_, write_sheared_sample(scratch_ / "", "drag")});
  const std::regex tag("<(/?)([a-z0-9]+)[^>]*?(/?)>");
  std::vector<std::string> open;
  for (std::sregex_iterator it(html.begin(), html.end(), tag), end; it != end; ++it) {
    const std::string name = (*it)[2];
    if ((*it)[3] == "/" || name == "meta" || name == "img" || name == "br") continue;
    if ((*it)[1] == "") {
      open.push_back(name);
      continue;
    }
    ASSERT_FALSE(open.empty()) << name;
    ASSERT_EQ(open.back(), name) << html.substr(static_cast<std::size_t>(it->position()), 120);
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
}

}  // namespace page_test
}  // namespace tacipc

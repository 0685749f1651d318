#include "stages/dataset/report/dataset/overview.h"

#include <fmt/core.h>

#include "common/format/html_text.h"
#include "stages/dataset/report/dataset/site.h"
#include "stages/dataset/report/html.h"
#include "tacipc_report_texts.h"

namespace tacipc {
namespace {

std::string tiles(const DatasetTally& tally) {
  const StatusCounts& all = tally.all;
  std::string html = "<ul class=\"tiles\">\n" + tile(count_text(all.total()), "planned samples") +
                     tile(count_text(all[SampleStatus::made]), "made", all[SampleStatus::made] > 0 ? "good" : "") +
                     tile(count_text(all[SampleStatus::failed]), "failed", all[SampleStatus::failed] > 0 ? "bad" : "");
  if (all[SampleStatus::running] > 0) html += tile(count_text(all[SampleStatus::running]), "running");
  if (all[SampleStatus::unmade] > 0) html += tile(count_text(all[SampleStatus::unmade]), "not made yet");
  for (const auto& [column, words] : {std::pair{"object", "objects"}, {"motion", "motions"}, {"gel", "gels"}}) {
    const auto rows = tally.counts.find(column);
    if (rows != tally.counts.end()) html += tile(count_text(rows->second.size()), words);
  }
  return html + "</ul>\n";
}

/// Progress of the dataset, and removed or packed files.
std::string state(const Overview& o) {
  const StatusCounts& all = o.tally.all;
  std::string html;
  if (all[SampleStatus::made] < all.total()) {
    html += fmt::format(
        "<p class=\"note warn\">Not complete: {} of {} samples are made. These pages show what was "
        "there when they were written.</p>\n",
        count_text(all[SampleStatus::made]), count_text(all.total()));
  }
  if (o.facts.packed) {
    html += fmt::format(
        "<p>Packed to give away: <a href=\"{}\">pack/README.md</a> is the dataset card, with the lines that load "
        "it.</p>\n",
        html_link(o.dataset / "pack/README.md", o.folder));
  }
  if (o.tally.dropped > 0) {
    html += fmt::format(
        "<p class=\"note warn\">Of {} samples files were removed after packing (<code>drop</code>): their numbers are "
        "here, their data are in the shards of <code>pack/</code>.</p>\n",
        count_text(o.tally.dropped));
  }
  return html;
}

std::string shown_samples(const Overview& o) {
  constexpr std::size_t kOnFirstPage = 14;
  if (o.shots.empty()) return "";
  std::vector<SampleShot> some;
  for (const std::size_t i : evenly_chosen(o.shots.size(), kOnFirstPage)) some.push_back(o.shots[i]);
  const StatusCounts& all = o.tally.all;
  const std::size_t finished = all[SampleStatus::made] + all[SampleStatus::failed];
  const std::string which = o.shots.size() == finished
                                ? fmt::format("All {} finished samples have", count_text(finished))
                                : fmt::format("{} of {} finished samples, spread evenly over the plan, have",
                                              count_text(o.shots.size()), count_text(finished));
  return fmt::format(
             "<section id=\"samples\">\n<h2>A look at it</h2>\n<p>{} a page with images, normals, curves and checks: "
             "<a href=\"{}\">contact sheets</a>. Numbers of every sample are in the <a href=\"{}\">list</a>.</p>\n",
             which, sheet_page_name(0), list_page_name(0)) +
         shots_list(some, 0, some.size()) + "</section>\n";
}

std::string definition(const std::string& heading, const std::vector<std::pair<std::string, std::string>>& lines) {
  std::string html = "<div><h3>" + html_text(heading) + "</h3><dl>";
  for (const auto& [name, value] : lines)
    html += fmt::format("<dt>{}</dt><dd>{}</dd>", html_text(name), html_text(value));
  return html + "</dl></div>\n";
}

std::string contents(const Overview& o) {
  std::string html = "<section id=\"contents\">\n<h2>What is in it</h2>\n";
  if (o.facts.seed) {
    html += fmt::format(
        "<p>Each gel meets each object in each motion; depths, directions and places are drawn {} "
        "(seed {}).</p>\n",
        o.facts.sampling == "random" ? "at random" : "evenly over their ranges by Sobol's sequence",
        html_text(*o.facts.seed));
  }
  html += "<h3 class=\"over\">Motions</h3>\n" + scroll_start("Motions") +
          "<table>\n<thead><tr><th class=\"word\">motion</th><th class=\"word\">what the object does</th><th "
          "class=\"word\">where it stands on the gel</th></tr></thead>\n<tbody>\n";
  for (const MotionFacts& motion : o.facts.motions)
    html += fmt::format("<tr><td class=\"word\">{}</td><td class=\"wrap\">{}</td><td class=\"wrap\">{}</td></tr>\n",
                        html_text(motion.name), html_text(motion.words), html_text(motion.placement));
  html += "</tbody></table></div>\n";
  if (!o.facts.gels.empty()) html += "<h3 class=\"over\">Sensors and gels</h3>\n<div class=\"facts facts-list\">\n";
  for (const auto& [gel, facts] : o.facts.gels) html += definition(gel, facts.lines);
  if (!o.facts.gels.empty()) html += "</div>\n";
  const auto objects = o.tally.counts.find("object");
  if (objects != o.tally.counts.end()) {
    constexpr std::size_t kNamed = 60;
    html += "<h3 class=\"over\">Objects</h3>\n<p class=\"files\">";
    std::size_t named = 0;
    for (const auto& [object, counts] : objects->second) {
      if (named == kNamed) break;
      html += (named++ > 0 ? ", " : "") + html_text(object);
    }
    html += objects->second.size() > kNamed
                ? fmt::format(" and {} more (<a href=\"#counts\">all</a>)", count_text(objects->second.size() - kNamed))
                : "";
    html += "</p>\n";
  }
  return html + "</section>\n";
}

std::string checks_table(const DatasetFacts& facts) {
  if (facts.gels.empty()) return "";
  std::string table =
      scroll_start("Checks of the verdict") +
      "<table>\n<thead><tr><th class=\"word\">check</th><th class=\"word\">limit</th></tr></thead>\n<tbody>\n";
  for (const auto& [name, limit] : facts.gels.begin()->second.checks)
    table += fmt::format("<tr><td class=\"word\">{}</td><td class=\"word\">{}</td></tr>\n", html_text(name),
                         html_text(limit));
  return table +
         "</tbody></table></div>\n<p class=\"quiet\">Limits as in a made sample of the first gel; the page of each "
         "sample has its own.</p>\n";
}

std::string trust(const Overview& o) {
  const DatasetTally& tally = o.tally;
  std::string html =
      std::string("<section id=\"trust\">\n<h2>What the checks prove</h2>\n") + kTrust + checks_table(o.facts);
  const std::pair<const char*, std::string> worst[] = {
      {"largest force imbalance, of the contact force", number_text(tally.worst_balance, 100) + " %"},
      {"smallest distance between gel and object", number_text(tally.smallest_distance_m, 1e6) + " µm"},
      {"smallest volume ratio of an element", number_text(tally.smallest_volume_ratio)}};
  if (tally.all[SampleStatus::made] == 0) return html + "</section>\n";
  html += "<h3 class=\"over\">The worst of all frames of all made samples</h3>\n<dl class=\"worst\">";
  for (const auto& [name, value] : worst) html += fmt::format("<dt>{}</dt><dd>{}</dd>", name, value);
  return html + "</dl>\n</section>\n";
}

}  // namespace

std::string overview_page(const Overview& o) {
  std::string main = kLead + tiles(o.tally) + state(o) + shown_samples(o) + contents(o) + coverage_section(o.tally) +
                     counts_section(o.tally) + failures_section(o) + costs_section(o.tally, o.others) +
                     kUnitsAndFrames + trust(o) + legend();
  return site_page({.dataset = o.facts.name, .heading = o.facts.name, .up = "", .main = std::move(main)});
}

}  // namespace tacipc

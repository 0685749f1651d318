#include "stages/dataset/card/readme.h"

#include <fmt/ranges.h>

#include <ranges>

#include "common/sample/press_record.h"
#include "tacipc_card_texts.h"

namespace tacipc {
namespace {

std::string joined(const auto& words) { return fmt::format("{}", fmt::join(words, ", ")); }

std::string joined_keys(const auto& map) { return joined(std::views::keys(map)); }

int at_or_zero(const std::map<std::string, int>& counts, const std::string& key) {
  const auto found = counts.find(key);
  return found == counts.end() ? 0 : found->second;
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", bytes / 1e3);
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

/// Counts of the labels of grasps; empty without grasps.
std::string outcomes_text(const DatasetCounts& counts) {
  if (counts.outcomes.empty()) return "";
  std::string text =
      "\nA finger of a grasp is a sample of its own: `grasp` and `finger` say which, `outcome` what became of the "
      "object between both, and `reason` why it was not held. `check_labels.py` recomputes these and the times of slip "
      "from "
      "the poses, forces and contact states in `series/`.\n\n| Outcome of a grasp | samples | train | val | test "
      "|\n|---|---|---|---|---|\n";
  for (const auto& [outcome, splits] : counts.outcomes) {
    int all = 0;
    for (const auto& [split, count] : splits) all += count;
    text += fmt::format("| {} | {} | {} | {} | {} |\n", outcome, all, at_or_zero(splits, "train"),
                        at_or_zero(splits, "val"), at_or_zero(splits, "test"));
  }
  std::string rows;
  for (const auto& [reason, count] : counts.made.at("reason"))
    if (!reason.empty()) rows += fmt::format("| {} | {} |\n", reason, count);
  return rows.empty() ? text : text + "\n| Why it was not held | samples |\n|---|---|\n" + rows;
}

std::string ensemble_text(const ShardRecords& shards) {
  if (shards.ensemble.empty()) return "";
  return fmt::format(
      "\nLabels in `ensemble/` tell how sure they are, by the ensemble \"{}\": `<label>_sigma` is their standard "
      "deviation over presses by sensors that fit measurements of this one alike, `<label>_mesh` what a coarser gel "
      "changes. Of these presses {} by members are there; {} presses are missing, and samples with fewer members "
      "say so (`num_members`, `missing`).\n",
      shards.ensemble, shards.members_pressed, shards.presses_missing);
}

/// Rows of each split with its made and unmade samples.
std::string split_rows(const DatasetCounts& counts) {
  const auto of = [](const auto& all, const std::string& word) {
    const auto found = all.find("split");
    return found == all.end() ? 0 : at_or_zero(found->second, word);
  };
  std::string rows;
  for (const char* split : {"train", "val", "test"})
    rows += fmt::format("| {} | {} | {} |\n", split, of(counts.made, split), of(counts.not_made, split));
  return rows;
}

std::string extents_text(const DatasetCounts& counts) {
  if (counts.extents.empty()) return "";
  std::string text = "\n| Of a sample | from | to |\n|---|---|---|\n";
  for (const auto& [column, extent] : counts.extents)
    text += fmt::format("| `{}` | {:.4g} | {:.4g} |\n", column, extent.low, extent.high);
  return text + "\n`manifest.csv` has these of every sample (forces are those of the last frame).\n";
}

std::string field_rows(const Record& schema) {
  std::string rows;
  for (const Record& field : schema.sections("fields")) {
    if (!field.required_flag("packed")) continue;
    const std::string sign = field.required_text("sign"), codes = field.text("codes").value_or("");
    rows += fmt::format("| `{}` | {} | {} | {} | {} | {}{}{} |\n", field.required_text("path"),
                        field.required_text("dtype"), field.required_text("shape"), field.required_text("unit"),
                        field.required_text("frame"), field.required_text("meaning"), sign == "none" ? "" : "; " + sign,
                        codes.empty() ? "" : " (" + codes + ")");
  }
  return rows;
}

std::string limit_rows(const std::vector<Record>& all) {
  using L = PressLimits;
  const std::map<std::string, std::string> kMeanings{
      {key_of(&L::intersections),
       "pairs of triangles that may intersect, object with gel or gel with itself, by an exact test"},
      {key_of(&L::inverted_tets), "tetrahedra of the gel that may be inverted, by an exact test"},
      {key_of(&L::smallest_distance_m), "m; the gap between gel and object must be larger"},
      {key_of(&L::volume_ratio), "the smallest deformed over undeformed volume of a tetrahedron must be larger"},
      {key_of(&L::balance_relative),
       "contact, inertia, damping, gravity and mount forces must sum to zero within this fraction of the contact "
       "force"},
      {key_of(&L::smallest_contact_n), "N; lower bound of the contact force in that check"},
      {key_of(&L::pose_error_m), "m; largest distance of the object from its prescribed pose"}};
  std::string rows;
  for (const Record& limits : all) {
    for (const std::string& name : limits.keys()) {
      const auto meaning = kMeanings.find(name);
      rows += fmt::format("| `{}` | {} | {} |\n", name, limits.required_text(name),
                          meaning == kMeanings.end() ? "" : meaning->second);
    }
  }
  if (all.size() > 1) rows += "\n(Samples were made by programs with different limits: all are listed.)\n";
  return rows;
}

}  // namespace

std::string dataset_card(const CardContent& c) {
  int samples = 0, frames = 0;
  double bytes = 0.0;
  for (const PackedShard& shard : c.shards.shards) {
    samples += shard.samples;
    frames += shard.frames;
    bytes += shard.bytes;
  }
  std::string conventions, letters;
  const Record convention = c.schema.section("conventions"), letter = c.schema.section("letters");
  for (const std::string& name : convention.keys())
    conventions += fmt::format("- `{}`: {}\n", name, convention.required_text(name));
  for (const std::string& name : letter.keys())
    letters += fmt::format("{}{} {}", letters.empty() ? "" : ", ", name, letter.required_text(name));
  const auto made_motions = c.counts.made.find("motion");
  using fmt::arg;
  std::string text = fmt::format(
      kCard, arg("name", c.name), arg("purpose", c.config.purpose), arg("samples", samples), arg("frames", frames),
      arg("shards", c.shards.shards.size()), arg("size", size_text(bytes)),
      arg("sensors", joined_keys(c.shards.sensors)), arg("objects", joined_keys(c.shards.objects)),
      arg("motions", made_motions == c.counts.made.end() ? "" : joined_keys(made_motions->second)),
      arg("versions", joined(c.shards.versions)), arg("splits", split_rows(c.counts)),
      arg("outcomes", outcomes_text(c.counts)), arg("ensemble", ensemble_text(c.shards)),
      arg("failed", at_or_zero(c.counts.status, "failed")), arg("unmade", at_or_zero(c.counts.status, "unmade")),
      arg("extents", extents_text(c.counts)), arg("loader", c.loader),
      arg("first_sensor", c.shards.sensors.empty() ? "<id>" : c.shards.sensors.begin()->first),
      arg("check_labels",
          c.counts.outcomes.empty()
              ? ""
              : "| `check_labels.py` | recomputes the labels of grasps: `python3 check_labels.py shards/*.h5` |\n"),
      arg("conventions", conventions), arg("letters", letters), arg("fields", field_rows(c.schema)),
      arg("limits", limit_rows(c.shards.limits)),
      arg("notes", c.config.notes.empty() ? "" : "\n" + c.config.notes + "\n"), arg("licence", c.config.licence));
  if (!c.config.contact.empty()) text += fmt::format("\nContact: {}\n", c.config.contact);
  if (!c.citation.empty())
    text += "\n## Citation\n\nThe method is that of the paper in `CITATION.cff`:\n\n```yaml\n" + c.citation + "```\n";
  return text;
}

}  // namespace tacipc

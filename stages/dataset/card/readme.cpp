#include "stages/dataset/card/readme.h"

#include <fmt/core.h>

#include <algorithm>

#include "common/sample/press_record.h"

namespace tacipc {
namespace {

std::string joined(const auto& words) {
  std::string text;
  for (const auto& word : words) text += (text.empty() ? "" : ", ") + std::string(word);
  return text;
}

std::vector<std::string> keys_of(const auto& map) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : map) keys.push_back(key);
  return keys;
}

int at_or_zero(const std::map<std::string, int>& counts, const std::string& key) {
  const auto found = counts.find(key);
  return found == counts.end() ? 0 : found->second;
}

std::string size_text(double bytes) {
  if (bytes < 1e6) return fmt::format("{:.0f} kB", bytes / 1e3);
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.1f} GB", bytes / 1e9);
}

/// Labels of grasps counted; nothing where there are none.
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

std::string contents_text(const CardContent& c) {
  int samples = 0, frames = 0;
  double bytes = 0.0;
  for (const PackedShard& shard : c.shards.shards) {
    samples += shard.samples;
    frames += shard.frames;
    bytes += shard.bytes;
  }
  std::string text = fmt::format(
      "An object is pressed into the soft gel of an optical tactile sensor, and then moved. Each *sample* is one such "
      "contact, "
      "a sequence of *frames*. For each frame there are the image that the sensor's camera takes and what no sensor "
      "measures: indentation at each pixel, forces, sticking and slipping contact, positions of markers and object.\n\n"
      "| | |\n|---|---|\n| Samples | {} |\n| Frames | {} |\n| Shards | {}, {} |\n| Sensors | {} |\n| Objects | {} |\n"
      "| Motions | {} |\n| Made with | TacIPC: {} |\n",
      samples, frames, c.shards.shards.size(), size_text(bytes), joined(keys_of(c.shards.sensors)),
      joined(keys_of(c.shards.objects)),
      c.counts.made.contains("motion") ? joined(keys_of(c.counts.made.at("motion"))) : "", joined(c.shards.versions));
  text += "\n| Split | samples | not made |\n|---|---|---|\n";
  const auto of = [](const auto& all, const std::string& word) {
    const auto found = all.find("split");
    return found == all.end() ? 0 : at_or_zero(found->second, word);
  };
  for (const char* split : {"train", "val", "test"})
    text += fmt::format("| {} | {} | {} |\n", split, of(c.counts.made, split), of(c.counts.not_made, split));
  text += outcomes_text(c.counts);
  if (!c.shards.ensemble.empty())
    text += fmt::format(
        "\nLabels in `ensemble/` tell how sure they are, by the ensemble \"{}\": `<label>_sigma` is their standard "
        "deviation over presses by sensors that fit measurements of this one alike, `<label>_mesh` what a coarser gel "
        "changes. Of these presses {} by members are there; {} presses are missing, and samples with fewer members "
        "say so (`num_members`, `missing`).\n",
        c.shards.ensemble, c.shards.members_pressed, c.shards.presses_missing);
  text += fmt::format(
      "\nSplits are by object: no object of `test` is in `train`. `splits/pose/` has a second division, by pose alone. "
      "Samples that could not be made ({} failed, {} never tried) are in no shard; `failures.csv` has the reason of "
      "each, "
      "so that gaps in the coverage are visible.\n",
      at_or_zero(c.counts.status, "failed"), at_or_zero(c.counts.status, "unmade"));
  if (!c.counts.extents.empty()) {
    text += "\n| Of a sample | from | to |\n|---|---|---|\n";
    for (const auto& [column, extent] : c.counts.extents)
      text += fmt::format("| `{}` | {:.4g} | {:.4g} |\n", column, extent.low, extent.high);
    text += "\n`manifest.csv` has these of every sample (forces are those of the last frame).\n";
  }
  return text;
}

std::string fields_text(const CardContent& c) {
  std::string text;
  for (const std::string& name : c.schema.section("conventions").keys())
    text += fmt::format("- `{}`: {}\n", name, c.schema.section("conventions").required_text(name));
  text += "\nLetters of shapes: ";
  const Record letters = c.schema.section("letters");
  for (const std::string& letter : letters.keys())
    text += fmt::format("{}{} {}", letter == letters.keys().front() ? "" : ", ", letter, letters.required_text(letter));
  text += ".\n\n| Field | type | shape | unit | frame | what it is |\n|---|---|---|---|---|---|\n";
  for (const Record& field : c.schema.sections("fields")) {
    if (!field.required_flag("packed")) continue;
    const std::string sign = field.required_text("sign"), codes = field.text("codes").value_or("");
    text += fmt::format("| `{}` | {} | {} | {} | {} | {}{}{} |\n", field.required_text("path"),
                        field.required_text("dtype"), field.required_text("shape"), field.required_text("unit"),
                        field.required_text("frame"), field.required_text("meaning"), sign == "none" ? "" : "; " + sign,
                        codes.empty() ? "" : " (" + codes + ")");
  }
  return text + "\nThe same lines are in `schema.json` and as attributes of every dataset in the shards.\n";
}

std::string limits_text(const CardContent& c) {
  std::string text =
      "Every frame of every sample has passed these checks; a sample of which one frame misses one is not in the data "
      "(`failures.csv` has it). The numbers of each frame are in the group `check`.\n\n"
      "| Limit | value | means |\n|---|---|---|\n";
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
  for (const Record& limits : c.shards.limits) {
    for (const std::string& name : limits.keys()) {
      const auto meaning = kMeanings.find(name);
      text += fmt::format("| `{}` | {} | {} |\n", name, limits.required_text(name),
                          meaning == kMeanings.end() ? "" : meaning->second);
    }
  }
  if (c.shards.limits.size() > 1) text += "\n(Samples were made by programs with different limits: all are listed.)\n";
  return text +
         "\nA passed check says that the equations were solved, not that the gel, the paint and the lamps are those of "
         "a "
         "sensor on your desk. Limitations:\n\n"
         "- Gel: one homogeneous hyperelastic material, no hysteresis, and no viscosity unless its sensor file has a "
         "`relaxation`; stiffness and friction are those "
         "of the "
         "attributes `E_Pa`, `nu`, `mu`. Finer meshes still change forces by a few percent: `mesh` names what was "
         "used.\n"
         "- Contact: a barrier keeps the surfaces apart by `check/stand_off_mm` (5 to 9 um at smooth parts with the "
         "default settings); friction is "
         "smoothed "
         "Coulomb friction, so sticking contacts creep slowly, and slip is judged vertex by vertex.\n"
         "- Objects are rigid.\n"
         "- Light: rays from the lamps through the sensor's layers, shadows included; values of each sensor file are "
         "marked "
         "known, derived or guess in `sensors/<id>/sensor.yaml`. Guessed lamps give plausible, not calibrated, "
         "images.\n"
         "- Noise: `image_reference` of a sample says whether it comes from a photograph of a real sensor or is "
         "synthetic.\n"
         "- Images carry no noise of the renderer (fixed rays, no random numbers).\n";
}

std::string citation_text(const CardContent& c) {
  if (c.citation.empty()) return "";
  return "\n## Citation\n\nThe method is that of the paper in `CITATION.cff`:\n\n```yaml\n" + c.citation + "```\n";
}

}  // namespace

std::string dataset_card(const CardContent& c) {
  std::string first_sensor = c.shards.sensors.empty() ? "<id>" : c.shards.sensors.begin()->first;
  std::string text = fmt::format("# {}\n\n{}\n\n## What is in it\n\n{}", c.name, c.config.purpose, contents_text(c));
  text += fmt::format(
      "\n## How to load it\n\nThe shards are HDF5 files: `data/<sample id>/obs/<field>`, the first axis counts "
      "frames.\n\n"
      "```python\n{}```\n\n```python\nframes = Tactile(\"shards/train-*.h5\")\nprint(len(frames), "
      "frames[0][\"rgb\"].shape)\n"
      "```\n\nSample ids are `<sensor>__<object>__<motion>__<index>`. Any HDF5 library reads the files (1.8 or later, "
      "no "
      "plug-in); each frame of an image is a chunk of its own.\n",
      c.loader);
  text += fmt::format(
      "\n## Files\n\n| | |\n|---|---|\n| `shards/*.h5` | the samples |\n| `schema.json` | every field: type, shape, "
      "unit, "
      "frame, sign, meaning |\n| `manifest.csv` | one row per planned sample: split, shard, place in it, status, "
      "numbers, "
      "hashes |\n| `failures.csv` | samples that could not be made, and why |\n| `splits/` | ids of each split, and by "
      "pose "
      "|\n| `sensors/{}/` … | sensor file, gel mesh, markers, camera.json |\n| `objects/<id>/` | the mesh that was "
      "pressed |\n"
      "| `dataset.yaml` | the plan's configuration |\n{}| `timings.csv` | seconds and memory of each sample |\n"
      "| `checksums.sha256` | of all other files except `timings.csv`: `sha256sum -c checksums.sha256` |\n",
      first_sensor,
      c.counts.outcomes.empty()
          ? ""
          : "| `check_labels.py` | recomputes the labels of grasps: `python3 check_labels.py shards/*.h5` |\n");
  text += "\n## Fields, units and frames\n\n" + fields_text(c);
  text += "\n## What the checks prove\n\n" + limits_text(c);
  if (!c.config.notes.empty()) text += "\n" + c.config.notes + "\n";
  text += fmt::format("\n## Licence\n\n{}\n", c.config.licence);
  if (!c.config.contact.empty()) text += fmt::format("\nContact: {}\n", c.config.contact);
  return text + citation_text(c);
}

}  // namespace tacipc

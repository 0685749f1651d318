#include "stages/dataset/card/shard_records.h"

#include <algorithm>

#include "common/base/error.h"
#include "common/base/file_name.h"
#include "common/base/files.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

void add_files(const Record& summary, const std::string& key, const fs::path& record,
               std::map<std::string, std::map<std::string, OriginFile>>& all) {
  for (const Record& item : summary.sections(key)) {
    const std::string id = require_file_name(item.required_text("id"), record.string() + ": " + key);
    for (const Record& file : item.sections("files")) {
      const std::string role = require_file_name(file.required_text("role"), record.string() + ": " + id);
      const OriginFile origin{(record.parent_path() / file.required_text("path")).lexically_normal(),
                              file.required_text("hash")};
      const auto [known, added] = all[id].emplace(role, origin);
      if (!added && known->second.hash != origin.hash)
        throw DataError("{} '{}' is two different files, of samples made at different times: {} and {}", role, id,
                        known->second.path.string(), origin.path.string());
    }
  }
}

std::string text_of(const Record& numbers) {
  std::string text;
  for (const std::string& name : numbers.keys()) text += name + " " + numbers.required_text(name) + "\n";
  return text;
}

}  // namespace

ShardRecords read_shard_records(const std::vector<fs::path>& records) {
  ShardRecords all;
  std::string schema_hash;
  std::set<std::string> limits;
  for (const fs::path& path : records) {
    const Record record = Record::from_file(path);
    const Record summary = record.section("summary"), outputs = record.section("outputs");
    const std::string name = require_file_name(record.required_text("shard"), path.string() + ": shard");
    all.shards.push_back({.name = name,
                          .folder = path.parent_path(),
                          .file_hash = outputs.required_text(name + ".h5"),
                          .sha256 = summary.required_text("sha256"),
                          .samples = summary.required_count("samples"),
                          .planned = summary.required_count("samples") + summary.required_count("not_made"),
                          .frames = summary.required_count("frames"),
                          .bytes = summary.required_number("bytes")});
    const std::string schema = outputs.required_text("schema.json");
    if (!schema_hash.empty() && schema != schema_hash)
      throw DataError("{}: packed with other fields than {}", path.string(), records.front().string());
    schema_hash = schema;
    if (summary.has("ensemble")) {
      const Record ensemble = summary.section("ensemble");
      all.ensemble = ensemble.required_text("title");
      all.members_pressed += static_cast<std::size_t>(ensemble.required_count("members_pressed"));
      all.presses_missing += static_cast<std::size_t>(ensemble.required_count("presses_missing"));
    }
    add_files(summary, "sensors", path, all.sensors);
    add_files(summary, "objects", path, all.objects);
    for (std::string& version : summary.texts("versions")) all.versions.insert(std::move(version));
    for (const Record& numbers : summary.sections("limits"))
      if (limits.insert(text_of(numbers)).second) all.limits.push_back(numbers);
  }
  std::sort(all.shards.begin(), all.shards.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  for (std::size_t i = 1; i < all.shards.size(); ++i) {
    if (all.shards[i].name == all.shards[i - 1].name)
      throw DataError("shard {} is given twice: {} and {}", all.shards[i].name, all.shards[i - 1].folder.string(),
                      all.shards[i].folder.string());
  }
  return all;
}

}  // namespace tacipc

#include "common/sample/shard_list.h"

#include <sstream>

#include "common/base/error.h"
#include "common/base/files.h"

namespace tacipc {

namespace fs = std::filesystem;

std::vector<fs::path> listed_records(const fs::path& list) {
  std::vector<fs::path> records;
  std::istringstream lines(read_file(list));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    records.push_back((list.parent_path() / line).lexically_normal());
    if (!fs::is_regular_file(records.back()))
      throw DataError("{}: {} has not been packed: there is no {}", list.string(), line, records.back().string());
  }
  if (records.empty()) throw DataError("{}: names no shard", list.string());
  return records;
}

std::vector<std::pair<std::string, fs::path>> named_by_shard(const std::vector<fs::path>& files) {
  std::vector<std::pair<std::string, fs::path>> named;
  for (const fs::path& file : files) named.emplace_back("shards/" + file.parent_path().filename().string(), file);
  return named;
}

std::vector<std::pair<std::string, fs::path>> listed_shards(const fs::path& list) {
  std::vector<fs::path> files;
  // The HDF5 file next to a shard's record: D/<shard>/<shard>.h5 for D/<shard>/pack.yaml.
  for (const fs::path& record : listed_records(list))
    files.push_back(record.parent_path() / (record.parent_path().filename().string() + ".h5"));
  return named_by_shard(files);
}

}  // namespace tacipc

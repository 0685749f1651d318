#include "common/stage/vouched.h"

#include <algorithm>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/stage/record.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

/// Returns whether a file is a record: it is named after its stage, which its first line states.
bool is_record(const fs::path& path) {
  if (path.extension() != ".yaml") return false;
  std::ifstream file(path);
  std::string line;
  return std::getline(file, line) && line == "stage: " + path.stem().string();
}

std::vector<fs::path> records_in(const fs::path& folder) {
  std::vector<fs::path> records;
  std::error_code error;  // error at a parent folder, which need not be readable
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (is_record(entry.path())) records.push_back(entry.path());
  std::ranges::sort(records);  // gives the same message in every run
  return records;
}

bool lies_in(const fs::path& file, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

}  // namespace

void refuse_changed_outputs(const fs::path& input, const fs::path& but) {
  std::error_code error;
  const fs::path whole = fs::canonical(input, error);
  if (error || is_record(whole)) return;  // the reader reports errors better; no record lists a record
  const fs::path own = fs::weakly_canonical(but, error);
  const fs::path folder = fs::is_directory(whole) ? whole : whole.parent_path();
  std::vector<fs::path> records = records_in(folder);
  for (fs::path& above : records_in(folder.parent_path())) records.push_back(std::move(above));
  for (const fs::path& path : records) {
    if (path == own) continue;
    const Record outputs = Record::from_file(path).section("outputs");
    for (const std::string& name : outputs.keys()) {
      const fs::path file = (path.parent_path() / name).lexically_normal();
      if (!lies_in(file, whole) || !fs::is_regular_file(file, error)) continue;
      const std::string hash = outputs.required_text(name);
      if (hash != "varies" && content_hash(file) != hash)
        throw DataError(
            "{}: has changed since {} was written; make it again, or copy it to another folder if you changed it",
            file.string(), path.string());
    }
  }
}

}  // namespace tacipc

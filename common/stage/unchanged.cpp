#include "common/stage/unchanged.h"

#include <exception>
#include <set>
#include <system_error>

#include "common/base/files.h"
#include "common/stage/record.h"

namespace tacipc {
namespace fs = std::filesystem;

bool is_unchanged(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  const fs::path folder = path.parent_path();
  try {
    const Record record = Record::from_file(path), inputs = record.section("inputs");
    std::set<fs::path> own{path};  // own files, which an input folder may contain by now
    for (const std::string& name : record.section("outputs").keys()) {
      if (!fs::exists(folder / name)) return false;
      own.insert(folder / name);
    }
    for (const std::string& key : inputs.keys())
      for (const Record& input : inputs.one_or_many(key)) {
        const fs::path file = folder / input.required_text("path");
        if (!fs::exists(file) || content_hash(file, own) != input.required_text("hash")) return false;
      }
    return true;
  } catch (const std::exception&) {
    return false;  // unreadable files and files that are no records are made again
  }
}

}  // namespace tacipc

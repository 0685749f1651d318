#include "common/stage/stage_timings.h"

#include <algorithm>

#include "common/stage/record.h"

namespace tacipc {

StageTimings read_timings(const std::filesystem::path& file) {
  const Record record = Record::from_file(file);
  return {.stage = record.required_text("stage"),
          .processor_s = record.required_number("processor_s"),
          .wall_s = record.required_number("wall_s"),
          .peak_memory_mb = record.required_number("peak_memory_mb")};
}

StageTimings read_timings_of(const std::filesystem::path& record) {
  std::filesystem::path file = record;
  return read_timings(file.replace_extension(".timings.yaml"));
}

std::filesystem::path common_folder(const std::vector<std::filesystem::path>& files) {
  if (files.empty()) return {};
  const std::filesystem::path first = files.front().parent_path();
  auto end = first.end();
  for (const std::filesystem::path& file : files) {
    const std::filesystem::path folder = file.parent_path();
    end = std::mismatch(first.begin(), end, folder.begin(), folder.end()).first;
  }
  std::filesystem::path common;
  for (auto part = first.begin(); part != end; ++part) common /= *part;
  return common;
}

bool lies_in(const std::filesystem::path& path, const std::string& folder, const std::filesystem::path& root) {
  const std::filesystem::path folders = path.parent_path();
  const auto below = std::next(folders.begin(), std::distance(root.begin(), root.end()));
  return std::any_of(below, folders.end(), [&](const std::filesystem::path& part) {
    return part == folder || part.string().ends_with("-" + folder);
  });
}

}  // namespace tacipc

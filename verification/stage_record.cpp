#include "verification/stage_record.h"

#include "common/config/config.h"

namespace tacipc::verify {

std::optional<std::string> why_no_record(const std::filesystem::path& folder, const std::string& program) {
  if (std::filesystem::exists(folder / (program + ".yaml"))) return std::nullopt;
  const std::filesystem::path failure = folder / (program + ".failed.yaml");
  if (!std::filesystem::exists(failure)) return "left no record";
  return ConfigReader::from_file(failure).text_or("message", "left no record");
}

}  // namespace tacipc::verify

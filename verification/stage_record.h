// Outcome of a program as its folder shows it, for tables over many folders.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/config/config.h"

namespace tacipc::verify {

/// Reason why a folder has no record of a program: the message in its failure file, otherwise "left no record".
/// \return nothing if the record exists
inline std::optional<std::string> why_no_record(const std::filesystem::path& folder, const std::string& program) {
  if (std::filesystem::exists(folder / (program + ".yaml"))) return std::nullopt;
  const std::filesystem::path failure = folder / (program + ".failed.yaml");
  if (!std::filesystem::exists(failure)) return "left no record";
  return ConfigReader::from_file(failure).text_or("message", "left no record");
}

}  // namespace tacipc::verify

// What a program left in its folder, as tables over many folders read it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/config/config.h"

namespace tacipc::verify {

/// Why a folder has no record of a program: the message of the failure it left, else "left no record". Nothing if there
/// is one.
inline std::optional<std::string> why_no_record(const std::filesystem::path& folder, const std::string& program) {
  if (std::filesystem::exists(folder / (program + ".yaml"))) return std::nullopt;
  const std::filesystem::path failure = folder / (program + ".failed.yaml");
  if (!std::filesystem::exists(failure)) return "left no record";
  return ConfigReader::from_file(failure).text_or("message", "left no record");
}

}  // namespace tacipc::verify

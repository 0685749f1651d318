// What a program left in its folder, as tables over many folders read it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace tacipc::verify {

/// Why a folder has no record of a program: the message of the failure it left, else "left no record". Nothing if there
/// is one.
std::optional<std::string> why_no_record(const std::filesystem::path& folder, const std::string& program);

}  // namespace tacipc::verify

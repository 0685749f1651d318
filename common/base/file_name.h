// Names that become files and folders, or words of make and the shell.
#pragma once

#include <string>
#include <string_view>

namespace tacipc {

inline constexpr std::string_view kFileNameRule =
    "a name has letters, digits and . _ + - alone, does not begin with a point and has at most 200 of them";
/// Whether a name can be that of one file or folder in a folder of ours: kFileNameRule.
bool is_file_name(std::string_view name);

inline constexpr std::string_view kPlainPathRule = "has characters other than letters, digits and . _ / + -";
/// Whether make and the shell take a path as one word. It may lead anywhere, so nothing is written to it.
bool is_plain_path(std::string_view path);

/// The name, if it can be a file's. \param where it was found, for the message \throw DataError
const std::string& require_file_name(const std::string& name, const std::string& where);

}  // namespace tacipc

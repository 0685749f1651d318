// Checks names that become files and folders, or words of Make and the shell.
#pragma once

#include <string>
#include <string_view>

namespace tacipc {

inline constexpr std::string_view kFileNameRule =
    "a name has letters, digits and . _ + - alone, does not begin with a point and has at most 200 of them";
/// Returns whether a name can be that of a file or folder in the project's folders: kFileNameRule.
bool is_file_name(std::string_view name);

inline constexpr std::string_view kPlainPathRule = "has characters other than letters, digits and . _ / + -";
/// Returns whether Make and the shell take a path as one word. It may lead anywhere, so nothing may be written to it.
bool is_plain_path(std::string_view path);

/// Returns the name if it can be a file's.
/// \param where place at which the name was found, for the message
/// \throw DataError if the name breaks kFileNameRule
const std::string& require_file_name(const std::string& name, const std::string& where);

}  // namespace tacipc

// Manners that the commands on files share: flags, messages, exit codes.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

namespace tacipc {

/// Parses the arguments and runs the body; messages begin with `tacipc <name>`. Returns the exit code.
int run_command(const std::string& name, CLI::App& app, const std::vector<std::string>& arguments,
                const std::function<void()>& body);

/// Names that are joined by commas; none for an empty text.
std::vector<std::string> names_of(const std::string& joined);

}  // namespace tacipc

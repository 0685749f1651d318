// A program's description of itself, for the program tacipc and for its manual page.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/stage/man_page.h"

namespace tacipc {

/// Adds two hidden flags: `--summary` prints the program's description, `--help-man` its manual page, which ends with
/// `sections`.
/// \pre all options and subcommands exist when flags are parsed; `app` outlives that
void add_answers(CLI::App& app, std::vector<ManSection> sections);

/// Parses the flags.
/// \param help command that error messages recommend
/// \return an exit code if the program ends here, because it printed a description or a flag is wrong
std::optional<int> parse_flags(CLI::App& app, int argc, char** argv, const std::string& help);

}  // namespace tacipc

// What a program says of itself to the front door tacipc and for its manual page.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "common/stage/man_page.h"

namespace tacipc {

/// Hidden flags: `--summary` answers with the program's description, `--help-man` with its manual page, which ends with
/// `sections`. \pre all options and subcommands are there when flags are parsed; `app` outlives that
void add_answers(CLI::App& app, std::vector<ManSection> sections);

/// Parses the flags. Returns an exit code if the program ends here: its answer is printed, or a flag is wrong; the
/// message then points to `help`.
std::optional<int> parse_flags(CLI::App& app, int argc, char** argv, const std::string& help);

}  // namespace tacipc

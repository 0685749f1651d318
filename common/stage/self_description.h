// What a program says of itself to the front door tacipc and for its manual page.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "common/stage/man_page.h"

namespace tacipc {

/// Thrown while flags are parsed: a question that needs none of the program's other flags. The text goes to standard
/// output, and the program ends with 0.
struct Answer {
  std::string text;
};

/// Hidden flags: `--summary` answers with the program's description, `--help-man` with its manual page, which ends with
/// `sections`. \pre all options and subcommands are there when flags are parsed; `app` outlives that
void add_answers(CLI::App& app, std::vector<ManSection> sections);

/// Prints an answer. Returns the exit code.
int print_answer(const Answer& answer);

}  // namespace tacipc

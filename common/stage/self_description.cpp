#include "common/stage/self_description.h"

#include <fmt/core.h>

#include <cstdio>
#include <functional>
#include <utility>

#include "common/base/printable.h"
#include "common/stage/stage.h"

namespace tacipc {
namespace {

/// Thrown while flags are parsed, for a request that needs none of the program's other flags. The text goes to standard
/// output, and the program ends with 0.
struct Answer {
  std::string text;
};

/// Returns the kind of argument, without CLI11's description of its check; the words of a choice stay.
std::string argument_of(const CLI::Option& option) {
  if (option.get_type_size_max() == 0) return "";
  const std::string type = option.get_type_name();
  const std::size_t choice = type.find(":{");
  return choice == std::string::npos ? type.substr(0, type.find(':')) : type.substr(choice + 1);
}

/// Returns the options that --help lists: all but the hidden ones.
std::vector<ManOption> man_options(const CLI::App& app) {
  std::vector<ManOption> options;
  for (const CLI::Option* option : app.get_options([](const CLI::Option* o) { return !o->get_group().empty(); })) {
    const std::string value = option->get_default_str();
    options.push_back({.flags = option->get_name(true, true),
                       .argument = argument_of(*option),
                       .help = option->get_description(),
                       .note = option->get_required() ? "required"
                               : value.empty()        ? ""
                                                      : "default: " + value});
  }
  return options;
}

ManPage man_page(const CLI::App& app, const std::vector<ManSection>& sections) {
  ManPage page{.name = "tacipc-" + app.get_name(),
               .command = "tacipc " + app.get_name(),
               .version = program_version(),
               .summary = app.get_description(),
               .options = man_options(app),
               .sections = {}};
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    ManSection section{.title = app.get_name() + " " + command->get_name(), .paragraphs = {command->get_description()}};
    for (const ManOption& option : man_options(*command))
      section.paragraphs.push_back(
          fmt::format("{}{}{}: {}", option.flags, option.argument.empty() ? "" : " ", option.argument, option.help));
    page.sections.push_back(std::move(section));
  }
  page.sections.insert(page.sections.end(), sections.begin(), sections.end());
  page.sections.push_back({.title = "SEE ALSO", .paragraphs = {"tacipc(1)"}});
  return page;
}

}  // namespace

void add_answers(CLI::App& app, std::vector<ManSection> sections) {
  const auto ask = [&app](const char* flag, const std::function<std::string()>& answer) {
    app.add_flag_callback(flag, [answer] { throw Answer{answer()}; })->trigger_on_parse()->group("");
  };
  ask("--summary", [&app] { return app.get_description() + "\n"; });
  ask("--help-man", [&app, sections = std::move(sections)] { return to_roff(man_page(app, sections)); });
}

std::optional<int> parse_flags(CLI::App& app, int argc, char** argv, const std::string& help) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const Answer& answer) {
    fmt::print("{}", answer.text);
    return std::fflush(stdout) == 0 ? 0 : 1;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    fmt::print(stderr, "{}: error: {} (see {})\n", app.get_name(), printable(error.what()), help);
    return 2;
  }
}

}  // namespace tacipc

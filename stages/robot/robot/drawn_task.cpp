#include "stages/robot/robot/drawn_task.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

#include "common/base/files.h"
#include "common/base/rng.h"
#include "common/config/config.h"

namespace tacipc {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

}  // namespace

DrawnTask draw_task(const std::filesystem::path& file, std::uint64_t seed) {
  DrawnTask task{.text = read_file(file)};
  ConfigReader in = ConfigReader::from_text(task.text, file.string());
  for (const std::string& key : in.keys()) {
    if (key != "variables") in.ignore(key);
  }
  if (auto variables = in.optional_section("variables")) {
    for (const std::string& name : variables->keys()) {
      if (!std::all_of(name.begin(), name.end(), is_word))
        variables->fault(name, "a name has letters, digits and _ alone");
      double low = 0.0, high = 0.0;
      if (variables->is_list(name)) {
        const auto range = variables->numbers(name, 2);
        low = range[0], high = range[1];
        if (low > high) variables->fault(name, "the range ends before it begins");
      } else {
        low = high = variables->number(name);
      }
      const double part = seed == 0 ? 0.5 : random_uniform(seed, hash_of("robot"), hash_of(name));
      task.variables.emplace_back(name, low + part * (high - low));
    }
  }
  in.finish();
  std::string text;
  for (std::size_t i = 0; i < task.text.size();) {
    if (task.text[i] != '$') {
      text += task.text[i++];
      continue;
    }
    std::size_t end = i + 1;
    while (end < task.text.size() && is_word(task.text[end])) ++end;
    const std::string name = task.text.substr(i + 1, end - i - 1);
    const auto found = std::find_if(task.variables.begin(), task.variables.end(),
                                    [&](const auto& variable) { return variable.first == name; });
    // An unknown name stays in the text; the reader that expects a number there reports it with its location.
    text += found == task.variables.end() ? "$" + name : fmt::format("{}", found->second);
    i = end;
  }
  task.text = text;
  return task;
}

}  // namespace tacipc

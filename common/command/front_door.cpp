#include "common/command/front_door.h"

#include <fmt/core.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>

#include "common/base/instruction_set.h"
#include "common/command/file_commands.h"
#include "common/config/config.h"
#include "common/stage/man_page.h"
#include "common/stage/stage.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

constexpr const char* kSummary = "Tactile sensor data: runs the stages, and asks their files.";
constexpr const char* kNotBuilt = "not built (make -f Makefile.data build)";

fs::path program_of(const std::string& stage) { return fs::read_symlink("/proc/self/exe").parent_path() / stage; }

struct Entry {
  std::string name;
  std::string summary;
};

struct Group {
  std::string title;
  std::vector<Entry> entries;
};

/// Reads the output of a running program.
class Running {
 public:
  explicit Running(const std::string& command) : pipe_(::popen(command.c_str(), "r"), ::pclose) {}
  std::string line() {
    std::array<char, 4096> text{};
    if (!pipe_ || !std::fgets(text.data(), static_cast<int>(text.size()), pipe_.get())) return "";
    return {text.data(), std::strcspn(text.data(), "\n")};
  }

 private:
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe_;
};

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// Returns all commands in groups, with each stage's own summary.
std::vector<Group> all_commands(const BuildFacts& facts) {
  std::vector<Running> running;  // all run at once, because loading libraries takes a moment
  for (const BuildFacts::StageName& stage : facts.stages)
    running.emplace_back(shell_word(program_of(stage.name).string()) + " --summary 2>/dev/null");
  std::vector<Group> groups{{"files", {}}};
  for (const FileCommand& command : file_commands()) groups.back().entries.push_back({command.name, command.summary});
  for (std::size_t i = 0; i < facts.stages.size(); ++i) {
    if (groups.back().title != facts.stages[i].group) groups.push_back({facts.stages[i].group, {}});
    const std::string summary = running[i].line();
    groups.back().entries.push_back({facts.stages[i].name, summary.empty() ? kNotBuilt : summary});
  }
  return groups;
}

std::string list(const std::vector<Group>& groups) {
  std::string text = "tacipc COMMAND [OPTIONS]\n";
  for (const Group& group : groups) {
    text += fmt::format("\n{}\n", group.title);
    for (const Entry& entry : group.entries) text += fmt::format("  {:<14} {}\n", entry.name, entry.summary);
  }
  return text +
         "\nhelp COMMAND says more of one, --version which libraries there are.\n"
         "Goals that run whole chains: make -f Makefile.data help\n";
}

std::string version(const BuildFacts& facts) {
  std::string text = fmt::format("tacipc {}\ninstruction set: compiled for {}, this processor has {}\n",
                                 program_version(), facts.compiled_for, instruction_set());
  for (const std::string& library : facts.libraries) text += library + "\n";
  return text;
}

std::string man_page(const BuildFacts& facts) {
  ManPage page{.name = "tacipc",
               .command = "tacipc COMMAND",
               .version = program_version(),
               .summary = kSummary,
               .options = {{"help", "COMMAND", "what a command does and takes; without one, the list of all", ""},
                           {"--version", "", "version, libraries and instruction set", ""}},
               .sections = {}};
  for (const Group& group : all_commands(facts)) {
    page.sections.push_back({"COMMANDS: " + group.title, {}});
    for (const Entry& entry : group.entries)
      page.sections.back().paragraphs.push_back(entry.name + ": " + entry.summary);
  }
  page.sections.push_back({"SEE ALSO", {"tacipc-press(1) and the pages of the other stages"}});
  return to_roff(page);
}

int print(const std::string& text) {
  fmt::print("{}", text);
  return std::fflush(stdout) == 0 ? 0 : 1;
}

/// Replaces this process by a stage. Returns only if the program cannot be run.
int become_stage(const std::string& name, const std::vector<std::string>& arguments) {
  const std::string path = program_of(name).string();
  std::vector<std::string> words{path};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  ::execv(path.c_str(), argv.data());
  fmt::print(stderr, "tacipc: error: {}: {}\n", path, errno == ENOENT ? kNotBuilt : std::strerror(errno));
  return 1;
}

int run(const std::string& name, const std::vector<std::string>& arguments, const BuildFacts& facts) {
  std::vector<std::string> known{"help"};
  for (const FileCommand& command : file_commands()) {
    if (command.name == name) return command.run(arguments);
    known.emplace_back(command.name);
  }
  for (const BuildFacts::StageName& stage : facts.stages) {
    if (stage.name == name) return become_stage(name, arguments);
    known.push_back(stage.name);
  }
  const auto near = nearest_word(name, known);
  fmt::print(stderr, "tacipc: error: there is no command '{}'{} (see tacipc help)\n", name,
             near ? fmt::format(", did you mean {}?", *near) : "");
  return 2;
}

}  // namespace

int front_door(const std::vector<std::string>& arguments, const BuildFacts& facts) {
  // OpenBLAS would start a thread per core when it is loaded, which no stage needs.
  ::setenv("OPENBLAS_NUM_THREADS", "1", 0);
  if (arguments.empty()) {
    fmt::print(stderr, "{}", list(all_commands(facts)));
    return 2;
  }
  const std::string& first = arguments.front();
  if (first == "--version") return print(version(facts));
  if (first == "--help-man") return print(man_page(facts));
  if (first != "help" && first != "--help") return run(first, {arguments.begin() + 1, arguments.end()}, facts);
  return arguments.size() > 1 ? run(arguments[1], {"--help"}, facts) : print(list(all_commands(facts)));
}

}  // namespace tacipc

// Earlier runs with equal inputs: detects a finished one, and keeps the scratch files of an interrupted one.
#include <algorithm>
#include <system_error>

#include "common/base/checked_file.h"
#include "common/base/error.h"
#include "common/base/files.h"
#include "common/base/instruction_set.h"
#include "common/base/printable.h"
#include "common/stage/record.h"
#include "common/stage/stage.h"
#include "common/stage/unchanged.h"

namespace tacipc {
namespace fs = std::filesystem;
namespace {

// Hidden names, so that no output can have them.
constexpr const char* kScratchFolder = ".scratch";
constexpr const char* kResumeKey = ".resume-key";

void remove_unfinished_outputs(const fs::path& partial) {
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(partial, ignored)) {
    if (entry.path().filename() != kScratchFolder && entry.path().filename() != kResumeKey)
      fs::remove_all(entry.path(), ignored);
  }
}

}  // namespace

bool Stage::is_done() const {
  const fs::path path = out_ / (spec_.name + ".yaml");
  if (!is_unchanged(path)) return false;
  const Record record = Record::from_file(path), inputs = record.section("inputs");
  for (const InputSpec& spec : spec_.inputs) {
    std::vector<NamedPath> given;
    if (spec.named)
      given = named_inputs_.at(spec.flag);
    else if (const auto found = inputs_.find(spec.flag); found != inputs_.end())
      for (const fs::path& file : found->second) given.push_back({.name = "", .path = file});
    // A record names the file behind a link.
    const auto is_same = [&](const NamedPath& one, const Record& input) {
      return one.name == input.text("name").value_or("") &&
             fs::equivalent(one.path, out_ / input.required_text("path"));
    };
    if (!std::ranges::equal(given, inputs.one_or_many(spec.flag.substr(2)), is_same)) return false;
  }
  return std::ranges::all_of(spec_.options, [&](const OptionSpec& option) {
    return record.text(option.flag.substr(2)).value_or("") == printable(options_.at(option.flag));
  });
}

fs::path Stage::scratch(const std::string& name) const {
  open_scratch();
  return partial_ / kScratchFolder / name;
}

void Stage::save_scratch(const std::string& name, std::string_view bytes) {
  if (!scratch_belongs_to_inputs_) refuse_changed_inputs();
  scratch_belongs_to_inputs_ = true;
  write_checked_file(scratch(name), bytes);
}

std::optional<std::string> Stage::load_scratch(const std::string& name) const {
  return read_checked_file(scratch(name));
}

std::string Stage::resume_key() const {
  std::error_code ignored;
  const fs::path program = "/proc/self/exe";
  Value::Map key{{"stage", spec_.name},
                 {"version", program_version()},
                 // Two builds of edited sources have the same version.
                 {"program", fs::is_regular_file(program, ignored) ? content_hash(program) : ""},
                 {"instruction_set", instruction_set()},
                 {"inputs", inputs_at_start_.value()}};
  for (const OptionSpec& option : spec_.options) key.emplace_back(option.flag.substr(2), options_.at(option.flag));
  return to_yaml(key);
}

void Stage::open_scratch() const {
  if (!spec_.resumable || scratch_is_open_) return;
  scratch_is_open_ = true;
  const std::string key = resume_key();
  if (read_checked_file(partial_ / kResumeKey) == key) {
    remove_unfinished_outputs(partial_);
    return;
  }
  std::error_code error;
  fs::remove_all(partial_, error);
  // A new key next to old files would present them as its own.
  if (error) throw DataError("{}: cannot be removed: {}", partial_.string(), error.message());
  write_checked_file(partial_ / kResumeKey, key);
}

bool Stage::keep_scratch_alone() const {
  const bool saved = fs::exists(partial_ / kScratchFolder) && !fs::is_empty(partial_ / kScratchFolder);
  if (!saved || inputs_changed()) return false;
  remove_unfinished_outputs(partial_);
  return true;
}

}  // namespace tacipc

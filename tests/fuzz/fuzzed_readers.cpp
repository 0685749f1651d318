#include "tests/fuzz/fuzzed_readers.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>

#include "common/base/error.h"
#include "common/base/files.h"
#include "tests/fuzz/reader_checks.h"

namespace tacipc {
namespace {

constexpr std::size_t kLongestMessage = 1000;  // of one fault, in bytes

/// A refusal must say which file, in a text that people read. (Control characters are shown escaped where it is
/// printed.)
void check_message(const std::string& message, const std::string& name) {
  const auto wrong = [&](const char* what) { throw std::logic_error(fmt::format("{}: '{}'", what, message)); };
  if (!message.starts_with(name)) wrong("a refusal that does not begin with the file's name");
  if (message.size() > kLongestMessage) wrong("a refusal that is too long");
}

/// Whether the file was read.
bool reads(const FuzzedReader& reader, const std::filesystem::path& file, std::string_view bytes) {
  std::filesystem::remove(file);  // a new file is written faster than an old one is replaced
  write_file(file, bytes);
  try {
    reader.read(file);
    return true;
  } catch (const ConfigError& error) {
    check_refusal(error, file);
  } catch (const DataError& error) {
    check_refusal(error, file);
  }
  return false;
}

}  // namespace

std::span<const FuzzedReader> fuzzed_readers() {
  static const std::vector<FuzzedReader> kReaders{
      {"stl", ".stl", check_triangle_mesh}, {"obj", ".obj", check_triangle_mesh},
      {"off", ".off", check_triangle_mesh}, {"ply", ".ply", check_triangle_mesh},
      {"gltf", ".glb", check_scene},        {"threemf", ".3mf", check_scene, zip_made_whole},
      {"msh", ".msh", check_tet_mesh},      {"yaml", ".yaml", check_yaml},
      {"edit", ".yaml", check_edits},       {"sensor", ".yaml", check_sensor},
      {"motion", ".yaml", check_motion},    {"object", ".yaml", check_object},
      {"record", ".yaml", check_record},    {"npy", ".npy", check_npy},
      {"csv", ".csv", check_csv},           {"plan", ".csv", check_plan},
      {"path", ".csv", check_path},         {"png", ".png", check_image, png_with_checksums},
      {"jpeg", ".jpg", check_image},        {"exr", ".exr", check_exr},
  };
  return kReaders;
}

void check_refusal(const std::exception& error, const std::filesystem::path& file) {
  if (const auto* faults = dynamic_cast<const ConfigError*>(&error))
    for (const std::string& fault : faults->faults()) check_message(fault, file.string());
  else
    check_message(error.what(), file.string());
}

const FuzzedReader& fuzzed_reader(std::string_view name) {
  const auto readers = fuzzed_readers();
  const auto found = std::find_if(readers.begin(), readers.end(), [&](const auto& r) { return r.name == name; });
  if (found == readers.end()) throw std::logic_error(fmt::format("no fuzzed reader '{}'", name));
  return *found;
}

std::filesystem::path input_file(const FuzzedReader& reader) {
  return std::filesystem::temp_directory_path() /
         fmt::format("tacipc-fuzz-{}-{}{}", reader.name, ::getpid(), reader.suffix);
}

bool read_input(const FuzzedReader& reader, std::string_view bytes) {
  const std::filesystem::path file = input_file(reader);
  const struct Removed {
    const std::filesystem::path& path;
    ~Removed() {
      std::error_code ignored;
      std::filesystem::remove(path, ignored);
    }
  } removed{file};  // also where a find is thrown
  bool read = reads(reader, file, bytes);
  if (!read && reader.with_checksums) read = reads(reader, file, reader.with_checksums(bytes));
  return read;
}

}  // namespace tacipc

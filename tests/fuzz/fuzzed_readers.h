// The readers of users' files as a fuzzer calls them: any bytes in, and out comes a value or one clear refusal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <functional>
#include <ostream>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tacipc {

inline constexpr std::size_t kLongestInput = 4096;  // bytes: of one file that a fuzzer makes

struct FuzzedReader {
  std::string name;    // of its program (fuzz_<name>), and of its folders in tests/fuzz/corpus and tests/fuzz/finds
  std::string suffix;  // of its files
  /// Reads a file and checks what it got. \throw std::logic_error if that cannot be right
  std::function<void(const std::filesystem::path&)> read;
  /// Corrects checksums, which no chance hits, so that what lies behind them is read too; empty where there are none.
  std::function<std::string(std::string_view)> with_checksums = {};
};
inline std::ostream& operator<<(std::ostream& out, const FuzzedReader& reader) { return out << reader.name; }

std::span<const FuzzedReader> fuzzed_readers();
/// \throw std::logic_error if there is none of this name
const FuzzedReader& fuzzed_reader(std::string_view name);

/// That an error of our own begins with the file's name and is short. \throw std::logic_error if not
void check_refusal(const std::exception& error, const std::filesystem::path& file);

/// One input through a reader. True if it was read, false if it was refused as files are refused: by an error of our
/// own that begins with the file's name and is short. \throw anything else is a find. The input is left in
/// `input_file(reader)` if the process dies.
bool read_input(const FuzzedReader& reader, std::string_view bytes);
/// Of this process.
std::filesystem::path input_file(const FuzzedReader& reader);

}  // namespace tacipc

/// libFuzzer's entry, for the reader that TACIPC_FUZZED_READER names where this is compiled.
// NOLINTNEXTLINE(readability-identifier-naming): its name is given
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

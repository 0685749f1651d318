// SHA-256 (FIPS 180-4), what `sha256sum -c` checks on the other side.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace tacipc {

/// Takes bytes in parts of any length.
class Sha256 {
 public:
  void add(std::string_view bytes);
  /// The digest of all bytes so far as 64 hex digits. Nothing may be added afterwards.
  std::string hex();

 private:
  void compress(const unsigned char* block);

  // The first 32 bits of the fractional parts of the square roots of the first eight primes.
  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<unsigned char, 64> block_{};
  std::size_t filled_ = 0;
  std::uint64_t length_ = 0;
};

std::string sha256(std::string_view bytes);
/// Of a file of any size. \throw DataError if it cannot be read
std::string sha256_of_file(const std::filesystem::path& path);

}  // namespace tacipc

// Valid files changed at random, the same way every time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace tacipc {

class Mutation {
 public:
  /// \pre a seed that is not empty
  Mutation(std::vector<std::string> seeds, std::size_t longest) : seeds_(std::move(seeds)), longest_(longest) {}

  /// One of the seeds with 1 to 4 changes.
  std::string next() {
    std::string bytes = seeds_[below(seeds_.size())];
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(bytes);
    bytes.resize(std::min(bytes.size(), longest_));
    return bytes;
  }

 private:
  std::size_t below(std::size_t end) { return static_cast<std::size_t>(random_() % end); }

  void change(std::string& bytes) {
    const std::size_t at = below(bytes.size() + 1), count = std::min(1 + below(16), bytes.size() - at);
    switch (below(7)) {
      case 0:
        if (count > 0) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 1:  // numbers of binary files at their ends
        bytes.replace(at, std::min<std::size_t>(count, 8), std::min<std::size_t>(count, 8),
                      "\x00\x7f\x80\xff"[below(4)]);
        break;
      case 2: bytes.erase(at, count); break;
      case 3: bytes.insert(at, bytes.substr(at, count)); break;
      case 4: {  // a part of another file
        const std::string& other = seeds_[below(seeds_.size())];
        bytes.insert(at, other.substr(below(other.size()), 1 + below(64)));
        break;
      }
      case 5: replace_number(bytes, at); break;
      default: bytes.insert(at, 1, "\n \t,:#-[]{}\"'&*\\/\0\r"[below(19)]);
    }
  }

  /// The next number of a text becomes one that few expect.
  void replace_number(std::string& bytes, std::size_t from) {
    constexpr std::string_view kDigits = "0123456789";
    constexpr std::array<std::string_view, 14> kNumbers{"0",
                                                        "-1",
                                                        "1",
                                                        "2147483647",
                                                        "2147483648",
                                                        "4294967295",
                                                        "9223372036854775807",
                                                        "18446744073709551616",
                                                        "1e308",
                                                        "1e-320",
                                                        "nan",
                                                        "-inf",
                                                        "0.1.2",
                                                        "99999999"};
    const std::size_t begin = bytes.find_first_of(kDigits, from);
    if (begin == std::string::npos) return;
    const std::size_t end = std::min(bytes.find_first_not_of(kDigits, begin), bytes.size());
    bytes.replace(begin, end - begin, kNumbers[below(kNumbers.size())]);
  }

  std::vector<std::string> seeds_;
  std::size_t longest_;
  std::mt19937_64 random_{1};
};

}  // namespace tacipc

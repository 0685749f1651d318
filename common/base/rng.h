// Random numbers as a function of (seed, stream, counter). They have no state, so that the order of calls and threads
// do not change them.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string_view>

namespace tacipc {

/// Mixes a 64-bit number: a bijection in which each output bit depends on every input bit (xor-shift-multiply rounds as
/// in Steele et al., Fast Splittable Pseudorandom Number Generators, 2014).
constexpr std::uint64_t mix_bits(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

/// Returns random bits for one counter of one stream. Streams separate uses (noise, jitter, …) of one seed.
constexpr std::uint64_t random_bits(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
  constexpr std::uint64_t kOddStep = 0x9e3779b97f4a7c15ULL;  // 2⁶⁴ / golden ratio: spreads small numbers
  return mix_bits(mix_bits(mix_bits(seed + kOddStep) ^ (stream * kOddStep)) + (counter + 1) * kOddStep);
}

/// Returns the FNV-1a hash of the bytes, mixed: a name's contribution to a seed, equal on every machine. [Fowler, Noll,
/// Vo]
constexpr std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 0xcbf29ce484222325ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
  return mix_bits(hash);
}

/// Returns a uniform number in the open interval (0, 1), 52 bits.
constexpr double random_uniform(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
  return (static_cast<double>(random_bits(seed, stream, counter) >> 12) + 0.5) * 0x1p-52;
}

/// Returns a standard normal number, √(−2 ln u₁) cos(2π u₂) (Box and Muller), from counters 2c and 2c + 1.
inline double random_normal(std::uint64_t seed, std::uint64_t stream, std::uint64_t counter) {
  const double u1 = random_uniform(seed, stream, 2 * counter), u2 = random_uniform(seed, stream, 2 * counter + 1);
  return std::sqrt(-2.0 * std::log(u1)) * std::cos(2.0 * std::numbers::pi * u2);
}

}  // namespace tacipc

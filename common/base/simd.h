// Vector arithmetic on eight doubles, with the instructions of the current processor.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <new>
#include <numbers>
#include <vector>

namespace tacipc {

/// Eight doubles. Arithmetic and comparisons act on each lane, so that results do not depend on the processor's vector
/// width.
using Pack = double __attribute__((vector_size(64), aligned(64)));
constexpr int kLanes = 8;

// Marks a function to be compiled for AVX-512, AVX2 and the baseline (x86-64-v2); the loader selects the version for
// the processor. Functions that it calls on packs must be inlined into it (TACIPC_INLINE). Without contraction into
// fused multiply-adds, all versions give the same bits.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define TACIPC_CLONES __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
#else
#define TACIPC_CLONES
#endif
#define TACIPC_INLINE inline __attribute__((always_inline))

/// Eight vectors.
struct Pack3 {
  Pack x, y, z;
};

TACIPC_INLINE Pack3 operator+(const Pack3& a, const Pack3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
TACIPC_INLINE Pack3 operator-(const Pack3& a, const Pack3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
TACIPC_INLINE Pack3 operator*(const Pack& s, const Pack3& a) { return {s * a.x, s * a.y, s * a.z}; }
TACIPC_INLINE Pack dot(const Pack3& a, const Pack3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
TACIPC_INLINE Pack3 cross(const Pack3& a, const Pack3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// Returns `yes` in the lanes in which key > 0, `no` in others. It is one comparison in place, because compilers split
/// masks that are stored or combined lane by lane.
TACIPC_INLINE Pack choose(const Pack& key, const Pack& yes, const Pack& no) { return key > Pack{} ? yes : no; }
TACIPC_INLINE Pack3 choose(const Pack& key, const Pack3& yes, const Pack3& no) {
  return {choose(key, yes.x, no.x), choose(key, yes.y, no.y), choose(key, yes.z, no.z)};
}
/// Return the smaller or larger value in each lane.
TACIPC_INLINE Pack smaller(const Pack& a, const Pack& b) { return b < a ? b : a; }
TACIPC_INLINE Pack larger(const Pack& a, const Pack& b) { return b > a ? b : a; }

/// Result of comparing packs: −1 in lanes in which the comparison holds.
using PackMask = long long __attribute__((vector_size(64)));

/// Returns whether the comparison holds in all lanes.
TACIPC_INLINE bool all_of(const PackMask& lanes) {
  const auto four =
      __builtin_shufflevector(lanes, lanes, 0, 1, 2, 3) & __builtin_shufflevector(lanes, lanes, 4, 5, 6, 7);
  const auto two = __builtin_shufflevector(four, four, 0, 1) & __builtin_shufflevector(four, four, 2, 3);
  return (two[0] & two[1]) == -1;
}

inline constexpr double kAnInteger = 0x1.8p52;  // one unit in its last place is 1
// ln 2 as a sum of two numbers; the high one has few enough digits for its product with an exponent to be exact.
inline constexpr double kLn2High = 0x1.62e42feep-1, kLn2Low = 0x1.a39ef35793c76p-33;

/// Natural logarithm to within 2 units in the last place; in lanes that are not normal positive numbers, std::log.
TACIPC_INLINE Pack logarithm(const Pack& x) {
  using Bits = unsigned long long __attribute__((vector_size(64)));
  constexpr unsigned long long kMantissa = 52, kOne = 1ULL << kMantissa;
  constexpr auto kRootOfHalf = std::bit_cast<unsigned long long>(0.5 * std::numbers::sqrt2);
  // x = 2^(exponent − 1024) m, √½ ≤ m < √2.
  const Bits bits = std::bit_cast<Bits>(x);
  const Bits exponent = (bits - kRootOfHalf + 1024 * kOne) >> kMantissa;
  const Pack m = std::bit_cast<Pack>(bits - (exponent << kMantissa) + 1024 * kOne);
  const Pack e = std::bit_cast<Pack>(exponent + std::bit_cast<unsigned long long>(kAnInteger)) - (kAnInteger + 1024.0);
  // ln m = 2 artanh s = 2 s (1 + s²/3 + s⁴/5 + …), s = f / (2 + f) and |s| < 0.172; 2 s = f − s f.
  const Pack f = m - 1.0, s = f / (2.0 + f), z = s * s;
  Pack series = 2.0 / 21.0 + z * (2.0 / 23.0);
  for (int k = 19; k >= 3; k -= 2) series = 2.0 / k + z * series;
  Pack out = e * kLn2High + (f - (s * (f - z * series) - e * kLn2Low));
  // The three terms have the sign bit of negative numbers, of numbers below the normal range, and of numbers above it.
  if (all_of(std::bit_cast<PackMask>(bits | (bits - kOne) | (bits + kOne)) >= 0)) return out;
  for (int l = 0; l < kLanes; ++l) {
    if (!(x[l] >= 0x1p-1022 && x[l] <= 0x1.fffffffffffffp1023)) out[l] = std::log(x[l]);
  }
  return out;
}

/// e^x to within 2 units in the last place; x is clamped to ±700.
TACIPC_INLINE Pack exponential(const Pack& of) {
  constexpr double kMost = 700.0;
  // x = k ln 2 + r, |r| < 0.347.
  const Pack x = larger(smaller(of, Pack{} + kMost), Pack{} - kMost);
  const Pack shifted = x * std::numbers::log2e + kAnInteger, k = shifted - kAnInteger;
  const Pack r = (x - k * kLn2High) - k * kLn2Low;
  // e^r = 1 + r (1 + r/2 (1 + r/3 (…)))
  Pack series = Pack{} + 1.0;
  for (int n = 13; n >= 2; --n) series = 1.0 + r * (1.0 / n) * series;
  const PackMask exponent = std::bit_cast<PackMask>(shifted) << 52;
  return std::bit_cast<Pack>(std::bit_cast<PackMask>(1.0 + r * series) + exponent);
}

/// Loads three doubles from each of eight addresses row(0) … row(7), one address per lane.
template <typename RowOf>
TACIPC_INLINE Pack3 load_rows(RowOf&& row) {
  Pack3 out;
  for (int l = 0; l < kLanes; ++l) {
    const double* from = row(l);
    out.x[l] = from[0];
    out.y[l] = from[1];
    out.z[l] = from[2];
  }
  return out;
}

/// Loads eight rows of a table with three columns, one row per lane.
TACIPC_INLINE Pack3 load_rows(const double* table, const std::array<int, kLanes>& rows) {
  return load_rows([&](int lane) __attribute__((always_inline)) {
    return table + 3 * static_cast<std::ptrdiff_t>(rows[static_cast<std::size_t>(lane)]);
  });
}

/// Allocates at cache lines, so that no Pack and no Quad counted from there crosses a line, which would make loads and
/// stores slower.
template <typename T>
struct AlignedAllocator {
  using value_type = T;  // NOLINT(readability-identifier-naming): as std::allocator
  static constexpr std::align_val_t kCacheLine{64};
  AlignedAllocator() = default;
  template <typename U>
  // NOLINTNEXTLINE(google-explicit-constructor): as std::allocator
  AlignedAllocator(const AlignedAllocator<U>& /*other*/) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), kCacheLine)); }
  void deallocate(T* p, std::size_t /*n*/) { ::operator delete(p, kCacheLine); }
  bool operator==(const AlignedAllocator& /*other*/) const { return true; }
};
template <typename T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

/// Four doubles: a vector of three, and a zero.
using Quad = double __attribute__((vector_size(32), aligned(32)));
using UnalignedQuad = double __attribute__((vector_size(32), aligned(8), may_alias));

/// Load and store four doubles at any multiple of 8 bytes.
TACIPC_INLINE Quad load_quad(const double* from) { return *reinterpret_cast<const UnalignedQuad*>(from); }
TACIPC_INLINE void store_quad(double* to, const Quad& value) { *reinterpret_cast<UnalignedQuad*>(to) = value; }

/// Load four floats as a Quad, and store a Quad as four floats.
using UnalignedFloatQuad = float __attribute__((vector_size(16), aligned(4), may_alias));
TACIPC_INLINE Quad load_quad(const float* from) {
  return Quad{from[0], from[1], from[2], from[3]};  // one instruction; GCC 12 makes six of __builtin_convertvector
}
TACIPC_INLINE void store_quad(float* to, const Quad& value) {
  *reinterpret_cast<UnalignedFloatQuad*>(to) = __builtin_convertvector(value, UnalignedFloatQuad);
}

/// Sets out[l] = (rows[0], rows[1], rows[2], 0) of lane l of the lower (half 0) or upper four lanes.
TACIPC_INLINE void transpose(const Pack* rows, int half, Quad* out) {
  const auto four_of = [&](int r) __attribute__((always_inline)) {
    return half == 0 ? __builtin_shufflevector(rows[r], rows[r], 0, 1, 2, 3)
                     : __builtin_shufflevector(rows[r], rows[r], 4, 5, 6, 7);
  };
  const Quad r0 = four_of(0), r1 = four_of(1), r2 = four_of(2), none = {};
  const Quad even01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6), odd01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
  const Quad even2 = __builtin_shufflevector(r2, none, 0, 4, 2, 6),
             odd2 = __builtin_shufflevector(r2, none, 1, 5, 3, 7);
  out[0] = __builtin_shufflevector(even01, even2, 0, 1, 4, 5);
  out[1] = __builtin_shufflevector(odd01, odd2, 0, 1, 4, 5);
  out[2] = __builtin_shufflevector(even01, even2, 2, 3, 6, 7);
  out[3] = __builtin_shufflevector(odd01, odd2, 2, 3, 6, 7);
}

/// Four floats, and the result of comparing them: −1 in lanes in which the comparison holds.
using FloatQuad = float __attribute__((vector_size(16)));
using IntQuad = int __attribute__((vector_size(16)));

/// Return whether the comparison holds in all lanes, or in none.
TACIPC_INLINE bool all_of(const IntQuad& lanes) {
  const auto halves = reinterpret_cast<const long long __attribute__((vector_size(16), may_alias))&>(lanes);
  return (halves[0] & halves[1]) == -1;
}
TACIPC_INLINE bool none_of(const IntQuad& lanes) {
  const auto halves = reinterpret_cast<const long long __attribute__((vector_size(16), may_alias))&>(lanes);
  return (halves[0] | halves[1]) == 0;
}

}  // namespace tacipc

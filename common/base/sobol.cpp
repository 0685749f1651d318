#include "common/base/sobol.h"

#include <array>
#include <cassert>

namespace tacipc {
namespace {

/// A primitive polynomial x^s + a_1 x^(s−1) + … + a_(s−1) x + 1 over two elements, with its inner coefficients as the
/// bits of `a`, and the first s direction numbers m_k (odd, below 2^k).
struct Polynomial {
  int degree;
  unsigned a;
  std::array<unsigned, 6> m;
};

/// Polynomials of dimensions 1, 2, …; dimension 0 has v_k = 2^−k. [Joe and Kuo 2008, table new-joe-kuo-6]
constexpr std::array<Polynomial, kSobolDimensions - 1> kPolynomials{{{1, 0, {1}},
                                                                     {2, 1, {1, 3}},
                                                                     {3, 1, {1, 3, 1}},
                                                                     {3, 2, {1, 1, 1}},
                                                                     {4, 1, {1, 1, 3, 3}},
                                                                     {4, 4, {1, 3, 5, 13}},
                                                                     {5, 2, {1, 1, 5, 5, 17}},
                                                                     {5, 4, {1, 1, 5, 5, 5}},
                                                                     {5, 7, {1, 1, 7, 11, 19}},
                                                                     {5, 11, {1, 1, 5, 1, 1}},
                                                                     {5, 13, {1, 1, 1, 3, 11}},
                                                                     {5, 14, {1, 3, 5, 5, 31}},
                                                                     {6, 1, {1, 3, 3, 9, 7, 49}},
                                                                     {6, 13, {1, 1, 1, 15, 21, 21}},
                                                                     {6, 16, {1, 3, 1, 13, 27, 49}}}};

constexpr int kBits = 32;
using Directions = std::array<std::uint32_t, kBits>;

/// Returns v_k = m_k / 2^k as 32 bits, continued by
///   v_k = a_1 v_(k−1) ⊕ … ⊕ a_(s−1) v_(k−s+1) ⊕ v_(k−s) ⊕ v_(k−s) / 2^s.
constexpr Directions directions_of(const Polynomial& p) {
  Directions v{};
  for (int k = 0; k < kBits; ++k) {
    if (k < p.degree) {
      v[k] = p.m[k] << (kBits - 1 - k);
      continue;
    }
    v[k] = v[k - p.degree] ^ (v[k - p.degree] >> p.degree);
    for (int i = 1; i < p.degree; ++i)
      if ((p.a >> (p.degree - 1 - i) & 1u) != 0) v[k] ^= v[k - i];
  }
  return v;
}

constexpr std::array<Directions, kSobolDimensions> all_directions() {
  std::array<Directions, kSobolDimensions> all{};
  for (int k = 0; k < kBits; ++k) all[0][k] = 1u << (kBits - 1 - k);
  for (int d = 1; d < kSobolDimensions; ++d) all[d] = directions_of(kPolynomials[d - 1]);
  return all;
}

constexpr auto kDirections = all_directions();

}  // namespace

double sobol(std::uint32_t index, int dimension) {
  assert(dimension >= 0 && dimension < kSobolDimensions);
  std::uint32_t x = 0;
  for (int k = 0; k < kBits; ++k)
    if ((index >> k & 1u) != 0) x ^= kDirections[dimension][k];
  return x * 0x1p-32;
}

}  // namespace tacipc

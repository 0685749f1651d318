// Light through plane layers: Snell's and Fresnel's laws, focusing, counted photons.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "common/sensor/layered_path.h"
#include "common/sensor/sensor.h"

namespace tacipc {
namespace layered_path_test {

constexpr double kMm = 1e-3;
constexpr double kDegree = std::numbers::pi / 180.0;

LayerStack stack_of(const std::vector<std::pair<double, double>>& layers) {
  LayerStack stack;
  for (const auto& [thickness, ior] : layers) stack.add(thickness, ior);
  return stack;
}

/// Air 3, acrylic 5, gel 2.
const LayerStack kMcTac = stack_of({{3.0, 1.0}, {5.0, 1.49}, {2.0, 1.41}});

LayeredPath<double> path_to(const LayerStack& stack, double r) {
  return layered_path<double>(stack, stack.thickness_m[static_cast<std::size_t>(stack.count - 1)], r * r);
}

TEST(LayeredPath, MatchesTheTableOfAnglesAndIrradiance) {
  struct Row {
    double r, air_deg, acrylic_deg, gel_deg, transmittance, irradiance;
  };
  for (const Row& row : {Row{5.0, 34.5, 22.4, 23.7, 0.9577, 0.011505}, Row{10.0, 58.9, 35.1, 37.4, 0.9169, 0.004954},
                         Row{15.0, 71.7, 39.6, 42.3, 0.807, 0.001516}}) {
    const auto path = path_to(kMcTac, row.r);
    const double p = row.r * path.sine_over_lateral;
    EXPECT_NEAR(std::asin(p) / kDegree, row.air_deg, 0.05) << row.r;
    EXPECT_NEAR(std::acos(path.cosine_first) / kDegree, row.air_deg, 0.05) << row.r;
    EXPECT_NEAR(std::asin(p / 1.49) / kDegree, row.acrylic_deg, 0.05) << row.r;
    EXPECT_NEAR(std::acos(path.cosine_last) / kDegree, row.gel_deg, 0.05) << row.r;
    EXPECT_NEAR(path.transmittance, row.transmittance, 1e-4 + 4e-4 * (row.r > 12.0)) << row.r;
    EXPECT_NEAR(path.transmittance * path.spread / row.irradiance, 1.0, 1e-4 + 3e-4 * (row.r > 12.0)) << row.r;
  }
}

TEST(LayeredPath, EqualIndicesAreAStraightLine) {
  const LayerStack stack = stack_of({{3.0, 1.3}, {5.0, 1.3}, {2.0, 1.3}});
  for (const double r : {0.0, 1e-9, 0.3, 7.0, 200.0}) {
    const auto path = path_to(stack, r);
    const double distance = std::hypot(10.0, r);
    EXPECT_NEAR(path.cosine_first * distance, 10.0, 1e-11);
    EXPECT_NEAR(path.spread * std::pow(distance, 3.0) / 10.0, 1.0, 1e-12);  // cos θ / d² per area of the plane
    EXPECT_EQ(path.transmittance, 1.0);
  }
}

TEST(LayeredPath, LeadsWhereSnellSendsIt) {
  // Also from a light inside the denser layer, and far to the side.
  for (const LayerStack& stack :
       {kMcTac, stack_of({{4.0, 1.49}, {2.0, 1.41}}), stack_of({{0.5, 1.0}, {9.0, 1.6}, {3.0, 1.2}})}) {
    for (const double r : {0.01, 1.0, 8.0, 25.0, 90.0}) {
      const double p = r * path_to(stack, r).sine_over_lateral;
      double reached = 0.0;
      for (int i = 0; i < stack.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        reached += stack.thickness_m[k] * std::tan(std::asin(p / stack.ior[k]));
      }
      EXPECT_NEAR(reached / r, 1.0, 1e-10) << r;
    }
  }
}

TEST(LayeredPath, PacksSayWhatNumbersSay) {
  Pack squared{}, thickness{};
  for (int l = 0; l < kLanes; ++l) {
    squared[l] = std::pow(0.4 + 2.1 * l, 2.0);
    thickness[l] = 1.0 + 0.1 * l;
  }
  const auto eight = layered_path<Pack>(kMcTac, thickness, squared);
  for (int l = 0; l < kLanes; ++l) {
    const auto one = layered_path<double>(kMcTac, thickness[l], squared[l]);
    EXPECT_NEAR(eight.spread[l] / one.spread, 1.0, 1e-10) << l;
    EXPECT_NEAR(eight.transmittance[l], one.transmittance, 1e-10) << l;
    EXPECT_NEAR(eight.cosine_last[l], one.cosine_last, 1e-10) << l;
  }
}

TEST(LayeredPath, TheStartOfTheSearchDoesNotMatter) {
  for (const LayerStack& stack : {kMcTac, stack_of({{4.0, 1.49}, {2.0, 1.41}}), stack_of({{3.0, 1.3}, {2.0, 1.3}}),
                                  stack_of({{0.5, 1.0}, {4.0, 1.6}, {5.0, 1.5}, {3.0, 1.2}})}) {
    const double last = stack.thickness_m[static_cast<std::size_t>(stack.count - 1)];
    for (const double r : {0.0, 0.01, 1.0, 8.0, 25.0}) {
      const auto cold = layered_path<double>(stack, last, r * r);
      EXPECT_GE(cold.stretch, 1.0 - 1e-12);
      for (const double guess : {1.0 - 1e-3, 1.0 - 1e-4, 1.0, 1.0 + 1e-6, 1.0 + 1.9e-4, 1.0 + 1e-3, 1.05, 1.5}) {
        const auto warm = layered_path<double>(stack, last, r * r, guess * cold.stretch);
        EXPECT_NEAR(warm.sine_over_lateral / cold.sine_over_lateral, 1.0, 1e-10) << r << " " << guess;
        EXPECT_NEAR(warm.cosine_first / cold.cosine_first, 1.0, 1e-9) << r << " " << guess;
        EXPECT_NEAR(warm.secant_last * cold.cosine_last, 1.0, 1e-10) << r << " " << guess;
        EXPECT_NEAR(warm.spread / cold.spread, 1.0, 1e-9) << r << " " << guess;
        EXPECT_NEAR(warm.transmittance / cold.transmittance, 1.0, 1e-9) << r << " " << guess;
      }
    }
  }
}

TEST(LayeredPath, FresnelAtNormalIncidenceAndTheWayBack) {
  // ((1.49 − 1) / (1.49 + 1))² = 0.03873
  EXPECT_NEAR(1.0 - path_to(stack_of({{3.0, 1.0}, {5.0, 1.49}}), 0.0).transmittance, 0.03873, 5e-6);
  const LayerStack back = stack_of({{2.0, 1.41}, {5.0, 1.49}, {3.0, 1.0}});
  for (const double r : {0.0, 4.0, 12.0}) {
    const auto there = path_to(kMcTac, r), returning = path_to(back, r);
    EXPECT_NEAR(there.transmittance, returning.transmittance, 1e-11);
    EXPECT_NEAR(there.sine_over_lateral, returning.sine_over_lateral, 1e-11);
    // Reciprocity of throughput: n² cos θ dω dA is the same from both ends.
    EXPECT_NEAR(there.spread * 1.0 * there.cosine_first / (returning.spread * 1.41 * 1.41 * returning.cosine_first),
                1.0, 1e-12);
  }
}

TEST(LayeredPath, CountedPhotonsAgree) {
  // Photons on a fine grid of cos θ, refracted interface by interface with vectors, counted on rings of the plane.
  constexpr int kPhotons = 2000000;
  constexpr double kHalfWidth = 0.05;
  const std::vector<double> radii = {2.0, 5.0, 10.0, 15.0};
  std::vector<double> power(radii.size(), 0.0);
  for (int k = 0; k < kPhotons; ++k) {
    double cosine = (k + 0.5) / kPhotons, sine = std::sqrt(1.0 - cosine * cosine), r = 0.0, carried = 1.0;
    for (int i = 0; i < kMcTac.count; ++i) {
      const auto layer = static_cast<std::size_t>(i);
      if (i > 0) {
        const double before = kMcTac.ior[layer - 1], after = kMcTac.ior[layer];
        const double bent = sine * before / after;
        const double in = std::asin(sine), out = std::asin(bent);
        const double rs = -std::sin(in - out) / std::sin(in + out), rp = std::tan(in - out) / std::tan(in + out);
        if (sine > 1e-3) carried *= 1.0 - 0.5 * (rs * rs + rp * rp);
        sine = bent;
        cosine = std::sqrt(1.0 - sine * sine);
      }
      r += kMcTac.thickness_m[layer] * sine / cosine;
    }
    for (std::size_t j = 0; j < radii.size(); ++j) power[j] += std::abs(r - radii[j]) < kHalfWidth ? carried : 0.0;
  }
  for (std::size_t j = 0; j < radii.size(); ++j) {
    const double area = 2.0 * std::numbers::pi * radii[j] * 2.0 * kHalfWidth;
    const double irradiance = power[j] * 2.0 * std::numbers::pi / kPhotons / area;  // I = 1: 2π over the half space
    const auto path = path_to(kMcTac, radii[j]);
    EXPECT_NEAR(irradiance / (path.transmittance * path.spread), 1.0, 0.01) << radii[j];
  }
}

OpticalStack mctac_stack() {
  return {.gel_thickness_m = 2.0 * kMm,
          .gel_ior = 1.41,
          .layers = {{.name = "acrylic", .thickness_m = 5.0 * kMm, .ior = 1.49}}};
}

TEST(OpticalStack, StartsInTheMediumThatHoldsTheLight) {
  const OpticalStack stack = mctac_stack();
  const LayerStack from_air = stack.from(-12.0 * kMm), from_acrylic = stack.from(-4.0 * kMm);
  ASSERT_EQ(from_air.count, 3);
  EXPECT_NEAR(from_air.thickness_m[0], 5.0 * kMm, 1e-15);
  EXPECT_EQ(from_air.ior[0], 1.0);
  EXPECT_EQ(from_air.ior[2], 1.41);
  ASSERT_EQ(from_acrylic.count, 2);
  EXPECT_NEAR(from_acrylic.thickness_m[0], 2.0 * kMm, 1e-15);
  EXPECT_EQ(from_acrylic.ior[0], 1.49);
}

}  // namespace layered_path_test
}  // namespace tacipc

// Kernels and height maps equal SciPy's; make_golden.py prints the tables.
#include <gtest/gtest.h>

#include <cmath>

#include "common/config/config.h"
#include "stages/rival/baseline/deformation.h"
#include "stages/rival/baseline/kernel.h"

namespace tacipc {
namespace deformation_golden_test {

struct Profile {
  int size;
  double sigma;
  std::vector<double> weights;
};

const Profile kProfiles[] = {
    {21, 7, {0.03712451905464882,  0.038051215786774444, 0.03982277568619698, 0.04230130759155264, 0.04524363228616621,
             0.048400590546833426, 0.05149204042519486,  0.05424233377045748, 0.05640515536883367, 0.0577860900459463,
             0.05826067887478995,  0.0577860900459463,   0.05640515536883367, 0.05424233377045748, 0.05149204042519486,
             0.048400590546833426, 0.04524363228616621,  0.04230130759155264, 0.03982277568619698, 0.038051215786774444,
             0.03712451905464882}},
    {52,
     9,
     {0.001175494806628691,  0.0012864583044213433, 0.0015129503776180784, 0.0018638777635559898, 0.0023520338943828056,
      0.002993398808262149,  0.003806179974702269,  0.004809586538701827,  0.006022343736058688,  0.00746097610853818,
      0.00912844011286579,   0.011053563357638388,  0.01322045428718704,   0.015618121334982683,  0.018224245024769936,
      0.021004320621163156,  0.023911458759774074,  0.02688696887169599,   0.029861798228324216,  0.03275883199203273,
      0.0354959824072657,    0.03798991588335798,   0.040160194101405325,  0.041933548431719134,  0.04324797375340656,
      0.04405632377783261,   0.04432911748341739,   0.04405632377783261,   0.04324797375340656,   0.041933548431719134,
      0.040160194101405325,  0.03798991588335798,   0.0354959824072657,    0.03275883199203273,   0.029861798228324216,
      0.02688696887169599,   0.023911458759774074,  0.021004320621163156,  0.018224245024769936,  0.015618121334982683,
      0.01322045428718704,   0.011068434119881974,  0.009151490178677106,  0.007481395166768894,  0.006052659721391701,
      0.004854007859435337,  0.003870415007688929,  0.003085060495098543,  0.0024810997476189126, 0.0020431907989637687,
      0.0017587354529176057, 0.0016188152349314354}},
    {3, 1, {0.29609640370191986, 0.4078071925961603, 0.29609640370191986}},
    {5, 4, {0.19999006215637666, 0.20000611860403833, 0.20000763847917033, 0.20000611860403833, 0.19999006215637666}},
};

struct Sample {
  int x, y;
  double value;
};

const Sample kCorrelated[] = {{33, 27, 0.00034051256264528183}, {5, 5, 1.2633489406876865e-06},
                              {50, 30, 0.00011166282994364863}, {70, 40, 0.00015722026262844093},
                              {80, 52, 6.372970010398459e-05},  {99, 79, 0.0},
                              {0, 40, 2.0591615277867585e-06},  {62, 28, 7.337054323033635e-05}};
const Sample kDifference[] = {{33, 27, 0.0008},
                              {5, 5, -0.00027299332302781844},
                              {50, 30, -2.493672695749879e-05},
                              {70, 40, 0.0003852234890466191},
                              {80, 52, 0.00011220132239727492},
                              {99, 79, -6.633858683536765e-05},
                              {0, 40, -0.00025885770546163576},
                              {62, 28, -6.807831524378958e-05}};
const Sample kExponential[] = {{33, 27, 0.029273186270898786}, {5, 5, 0.03000000000000002},
                               {50, 30, 0.029980510114841367}, {70, 40, 0.0297},
                               {80, 52, 0.029945745287826255}, {99, 79, 0.03000000000000002},
                               {0, 40, 0.03000000000000002},   {62, 28, 0.02994006533101761}};

const Sample kTwoGaussians[] = {{33, 27, 0.000784015662488507},
                                {5, 5, 0.0},
                                {50, 30, 3.5491238190078585e-05},
                                {70, 40, 0.00030000000000000046},
                                {80, 52, 0.0001371099133734093},
                                {99, 79, 0.0},
                                {0, 40, 0.0},
                                {62, 28, 0.00013417814288984957}};
const Sample kTaxim[] = {{33, 27, 0.0007983194602474053},  {5, 5, 3.7522630307726725e-05},
                         {50, 30, 0.00016841778051899974}, {70, 40, 0.0001859297346067677},
                         {80, 52, 0.00013551829102885046}, {99, 79, 7.716372640692956e-06},
                         {0, 40, 3.835513927115244e-05},   {62, 28, 9.076412184512202e-05}};
const Sample kFots[] = {{33, 27, 0.0007942037214967924},  {5, 5, 3.40499744117989e-07},
                        {50, 30, 8.829796696720799e-05},  {70, 40, 0.0003},
                        {80, 52, 0.00012245972004571918}, {99, 79, 4.723835317706039e-10},
                        {0, 40, 6.160472621593931e-07},   {62, 28, 0.0001412040584920023}};
const Sample kFotsOwn[] = {{33, 27, 0.0007920000000000002},  {5, 5, 1.3120919973745141e-06},
                           {50, 30, 0.0001015231932599588},  {70, 40, 0.00030000000000000003},
                           {80, 52, 0.00013162857395661139}, {99, 79, 1.2435058857317061e-08},
                           {0, 40, 2.3258796451034373e-06},  {62, 28, 0.0001468282128864203}};

/// The heights that make_golden.py computes too.
Raster object_height() {
  Raster h(100, 80);
  for (int y = 0; y < h.height; ++y) {
    for (int x = 0; x < h.width; ++x) {
      const double ball = 8e-4 - 4e-6 * ((x - 33) * (x - 33) + (y - 27) * (y - 27));
      const double block = std::abs(x - 70) < 9 && std::abs(y - 40) < 12 ? 3e-4 + 1e-5 * (x - 70) : 0.0;
      h.at(x, y) = std::max({ball, block, 0.0});
    }
  }
  return h;
}

DeformationConfig published(const std::string& name = "gomes_2021") {
  return read_config<BaselineConfig>(std::string(TACIPC_SOURCE_DIR) + "/configs/rivals/baseline/" + name + ".yaml")
      .deformation;
}

TEST(Golden, ProfilesAreScipysFoldedGaussians) {
  for (const Profile& golden : kProfiles) {
    const auto profile = folded_gaussian_profile(golden.size, golden.sigma);
    ASSERT_EQ(profile.size(), golden.weights.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < profile.size(); ++i) {
      EXPECT_NEAR(profile[i], golden.weights[i], 1e-12) << golden.size << " at " << i;
      sum += profile[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
  // The wide one has no centre pixel: its ends differ.
  const auto wide = folded_gaussian_profile(52, 9);
  EXPECT_GT(wide.back() - wide.front(), 4e-4);
}

TEST(Golden, ExponentialKernel) {
  const Raster kernel = exponential_kernel();
  EXPECT_NEAR(kernel.at(6, 6), 0.010937773880737038, 1e-15);
  EXPECT_NEAR(kernel.at(0, 0), 0.0004359528071966686, 1e-15);
  EXPECT_NEAR(kernel.at(0, 6), 0.0036433338510463587, 1e-15);
}

TEST(Golden, CorrelationAnchorsAtHalfTheSizeAndMirrors) {
  const Raster out = correlate(object_height(), folded_gaussian(52, 9));
  for (const Sample& s : kCorrelated) EXPECT_NEAR(out.at(s.x, s.y), s.value, 1e-12) << s.x << ", " << s.y;
}

TEST(Golden, DifferenceOfGaussians) {
  const Raster out = membrane_indentation(object_height(), published());
  for (const Sample& s : kDifference) EXPECT_NEAR(out.at(s.x, s.y), s.value, 1e-12) << s.x << ", " << s.y;
}

TEST(Golden, TwoGaussiansOfChen) {
  const Raster out = membrane_indentation(object_height(), published("chen_2022"));
  for (const Sample& s : kTwoGaussians) EXPECT_NEAR(out.at(s.x, s.y), s.value, 1e-12) << s.x << ", " << s.y;
}

TEST(Golden, PyramidsKeepTheirLengthsOnOtherPixels) {
  const Raster taxim = membrane_indentation(object_height(), published("taxim").scaled_to(320, 0.05926e-3));
  for (const Sample& s : kTaxim) EXPECT_NEAR(taxim.at(s.x, s.y), s.value, 1e-12) << s.x << ", " << s.y;
  const Raster fots = membrane_indentation(object_height(), published("fots").scaled_to(320, 0.05926e-3));
  for (const Sample& s : kFots) EXPECT_NEAR(fots.at(s.x, s.y), s.value, 1e-12) << s.x << ", " << s.y;
  const Raster own = membrane_indentation(object_height(), published("fots").scaled_to(320, 0.0510725e-3));
  for (const Sample& s : kFotsOwn) EXPECT_NEAR(own.at(s.x, s.y), s.value, 1e-12) << s.x << ", " << s.y;
}

TEST(Golden, WindowsAreThosePublishedAndScaled) {
  // n on pixels of 0.059259 mm, and σ in mm.
  const auto taxim = published("taxim").scaled_to(320, 0.059259e-3).levels;
  const std::array<double, 6> taxim_mm{0.900, 0.457, 0.236, 0.103, 0.059, 0.0295};
  const std::array<std::size_t, 6> taxim_px{101, 51, 25, 11, 5, 3};
  const auto sigma_px = [](const std::vector<double>& window) {  // from its two middle weights
    const std::size_t middle = window.size() / 2;
    return std::sqrt(0.5 / std::log(window[middle] / window[middle + 1]));
  };
  for (std::size_t i = 0; i < 6; ++i) {
    const auto window = window_profile(taxim[i].size_px, taxim[i].factor);
    EXPECT_NEAR(sigma_px(window) * 0.059259, taxim_mm[i], 5e-4);
    EXPECT_EQ(window.size(), taxim_px[i]);
  }
  const auto fots = published("fots").scaled_to(320, 0.059259e-3).levels;
  const std::array<double, 4> fots_mm{0.409, 0.179, 0.102, 0.0511};
  const std::array<std::size_t, 4> fots_px{45, 19, 9, 5};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto window = window_profile(fots[i].size_px, fots[i].factor);
    EXPECT_NEAR(sigma_px(window) * 0.059259, fots_mm[i], 5e-4);
    EXPECT_EQ(window.size(), fots_px[i]);
  }
}

TEST(Golden, SmallWindowsAreOpenCVsTables) {
  const auto expect = [](int size_px, const std::vector<double>& weights) {
    const auto window = window_profile(size_px, 1.0);
    ASSERT_EQ(window.size(), weights.size());
    for (std::size_t i = 0; i < window.size(); ++i) EXPECT_NEAR(window[i], weights[i], 1e-15) << size_px << " at " << i;
  };
  expect(3, {1.0 / 4, 2.0 / 4, 1.0 / 4});
  expect(5, {1.0 / 16, 4.0 / 16, 6.0 / 16, 4.0 / 16, 1.0 / 16});
  expect(7, {2.0 / 64, 7.0 / 64, 14.0 / 64, 18.0 / 64, 14.0 / 64, 7.0 / 64, 2.0 / 64});
  // 21 pixels: σ = 0.3 · 9 + 0.8 = 3.5.
  const auto large = window_profile(21, 1.0);
  EXPECT_NEAR(large[10] / large[13], std::exp(0.5 * 9 / (3.5 * 3.5)), 1e-9);
}

TEST(Golden, WhatKeepsItsHeightIsAShareOfThePressEvenIfItsDeepestPointIsOutOfView) {
  const Raster seen = membrane_indentation(object_height(), published("taxim").scaled_to(320, 0.05926e-3));
  const Raster deeper = membrane_indentation(object_height(), published("taxim").scaled_to(320, 0.05926e-3), 2.5e-3);
  EXPECT_NEAR(seen.at(33, 27), 8e-4, 1e-5);
  EXPECT_LT(deeper.at(33, 27), 6e-4);  // 0.4 · 2.5 mm is deeper than all of it
}

TEST(Golden, ExponentialMembrane) {
  DeformationConfig config;
  config.method = DeformationConfig::Method::exponential_kernel;
  const Raster out = membrane_indentation(object_height(), config);
  for (const Sample& s : kExponential) EXPECT_NEAR(0.03 - out.at(s.x, s.y), s.value, 1e-12) << s.x << ", " << s.y;
}

}  // namespace deformation_golden_test
}  // namespace tacipc

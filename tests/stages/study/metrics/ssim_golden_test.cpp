// Every metric equals scikit-image's; make_golden.py prints the table.
#include <gtest/gtest.h>

#include <cmath>

#include "common/benchmark/metrics_rows.h"
#include "stages/study/metrics/image_error.h"
#include "stages/study/metrics/ssim.h"
#include "tests/stages/study/metrics/test_images.h"

namespace tacipc {
namespace ssim_golden_test {

struct Golden {
  int width;
  int height;
  const char* kind;
  double mae, mse, psnr_db, ssim_w, ssim_s;
};

constexpr Golden kGolden[] = {
    {64, 48, "noise", 0.02237072780501089, 0.0006694790865692682, 31.742629850887543, 0.9560102524712525,
     0.9719458266330409},
    {64, 48, "fade", 0.0626816959422658, 0.0052444055304583705, 22.803037332994975, 0.9493831930785471,
     0.9529518386906944},
    {64, 48, "shift", 0.10156675517429194, 0.05147684250715537, 12.883880997586015, 0.6845856256379546,
     0.6965824647490386},
    {64, 48, "negative", 0.501334422657952, 0.33534248312614806, 4.745114241479097, -0.5986679750338585,
     -0.6894987025997201},
    {31, 23, "noise", 0.022398225302276125, 0.0006712058637496745, 31.731442581045602, 0.9162810994342129,
     0.9452222984571951},
    {31, 23, "fade", 0.05457562174004712, 0.004226302718467508, 23.740393988474736, 0.9605588785474438,
     0.9573776193176572},
    {31, 23, "shift", 0.08458414688923724, 0.037031019284667545, 14.314343337616762, 0.8154823798336764,
     0.7714001987518494},
    {31, 23, "negative", 0.4356461238071666, 0.26944750814185, 5.69525828416994, -0.5358522525138462,
     -0.6313431569447957},
    {11, 11, "noise", 0.022481499486847082, 0.0006788234658634155, 31.68243153215223, 0.8709989242775033,
     0.9094494883579219},
    {11, 11, "fade", 0.04417436396046021, 0.002888357201034143, 25.393490988983718, 0.9499806013515664,
     0.9437470921481473},
    {11, 11, "shift", 0.04796629395559877, 0.004102681422593344, 23.869322051343275, 0.8670406652615011,
     0.7475618240659143},
    {11, 11, "negative", 0.35850483444066333, 0.18956163289601477, 7.2224955891611415, -0.462062584565313,
     -0.5593352891721932},
};

TEST(Golden, AllMetricsEqualScikitImage) {
  for (const Golden& golden : kGolden) {
    SCOPED_TRACE(testing::Message() << golden.width << " x " << golden.height << " " << golden.kind);
    const ByteImage a = pattern_image(golden.width, golden.height), b = changed(a, golden.kind);
    const ImageError error = image_error(a, b);
    EXPECT_NEAR(error.mae, golden.mae, 1e-14);
    EXPECT_NEAR(error.mse, golden.mse, 1e-14);
    EXPECT_NEAR(psnr_db(error.mse), golden.psnr_db, 1e-11);
    EXPECT_NEAR(psnr_ln(error.mse), golden.psnr_db * std::log(10.0), 1e-11);
    EXPECT_NEAR(ssim(a, b, gaussian_window()), golden.ssim_w, 1e-11);
    EXPECT_NEAR(ssim(a, b, box_window()), golden.ssim_s, 1e-11);
  }
}

}  // namespace ssim_golden_test
}  // namespace tacipc

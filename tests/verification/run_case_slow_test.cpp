// The cases of configs/studies/verification against the reference IPC solver that take less than a minute each.
#include "tests/verification/case_file.h"

namespace tacipc::verify {
namespace {

class ReferenceCase : public ::testing::TestWithParam<std::string> {};

TEST_P(ReferenceCase, HoldsItsLimits) { expect_case_holds(GetParam()); }

INSTANTIATE_TEST_SUITE_P(All, ReferenceCase,
                         ::testing::Values("configs/studies/verification/reference_small_press",
                                           "configs/studies/verification/reference_small_shear"),
                         case_name);

}  // namespace
}  // namespace tacipc::verify

// A case of configs/studies/verification against the reference IPC solver, through the program's own judge. press_test
// compares the small press and the small shear with the same data in the fast tests.
#include "tests/verification/case_file.h"

namespace tacipc::verify {
namespace run_case_slow_test {

TEST(ReferenceCase, SmallShearHoldsItsLimits) {
  expect_case_holds("configs/studies/verification/reference_small_shear");
}

}  // namespace run_case_slow_test
}  // namespace tacipc::verify

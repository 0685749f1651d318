// Contact and friction against closed forms that need no measured data, in seconds: Hertz's sphere, a flat punch, a
// plate, Coulomb's law at a plate and at a punch, torsion, a gel that relaxes.
#include "tests/verification/case_file.h"

namespace tacipc::verify {
namespace run_case_closed_forms_test {

class ClosedFormCase : public ::testing::TestWithParam<std::string> {};

TEST_P(ClosedFormCase, HoldsItsLimits) { expect_case_holds(GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    All, ClosedFormCase,
    ::testing::Values("configs/studies/verification/compression_contact", "configs/studies/verification/layer_shear",
                      "configs/studies/verification/disc_twist", "configs/studies/verification/friction_plate",
                      "configs/studies/verification/friction_punch", "configs/studies/verification/relaxation",
                      "tests/verification/hertz_reduced", "tests/verification/flat_punch_reduced"),
    case_name);

}  // namespace run_case_closed_forms_test
}  // namespace tacipc::verify

#include "stages/object/wrap/wrap_object.h"

#include "common/base/error.h"
#include "tests/scratch_folder.h"
#include "tests/stages/object/decimate/shapes.h"

namespace tacipc {
namespace wrap_object_test {

constexpr double kMillimetre = 1e-3;

TriangleMesh box(const Vector3& low_mm, const Vector3& high_mm) {
  return make_box(low_mm * kMillimetre, high_mm * kMillimetre);
}

double number(const Value::Map& lines, const std::string& key) {
  for (const auto& [name, value] : lines)
    if (name == key) return std::get<double>(value.data());
  ADD_FAILURE() << "no " << key;
  return 0.0;
}

double number(const Value::Map& lines, const std::string& section, const std::string& key) {
  for (const auto& [name, value] : lines)
    if (name == section) return number(std::get<Value::Map>(value.data()), key);
  ADD_FAILURE() << "no " << section;
  return 0.0;
}

TEST(WrapObject, MeasuresWhatItFills) {
  // Two walls on a base, 3 mm high: the groove of 1 mm between them keeps a ball of 0.8 mm out.
  const TriangleMesh grooved =
      joined(joined(box({0, 0, 0}, {5, 6, 1}), box({0, 0, 1}, {2, 6, 4})), box({3, 0, 1}, {5, 6, 4}));
  const Value::Map filled = wrap_object(grooved, {.alpha_m = 0.8 * kMillimetre}).summary;
  EXPECT_DOUBLE_EQ(number(filled, "alpha_mm"), 0.8);
  EXPECT_NEAR(number(filled, "offset_mm"), 0.8 / 15, 1e-12);
  EXPECT_GT(number(filled, "seen_mesh_to_wrap_mm", "max"), 2.0) << "the bottom of the groove is deep below the wrap";
  EXPECT_GT(number(filled, "wrap_to_mesh_mm", "max"), 0.4) << "the middle of the bridge is half the groove away";
  // One of 0.3 mm gets in.
  const Value::Map entered = wrap_object(grooved, {.alpha_m = 0.3 * kMillimetre}).summary;
  EXPECT_LT(number(entered, "seen_mesh_to_wrap_mm", "max"), 0.3);
  EXPECT_LT(number(entered, "wrap_to_mesh_mm", "max"), 0.3);
  EXPECT_LE(number(entered, "wrap_to_mesh_mm", "mean"), number(entered, "wrap_to_mesh_mm", "max"));
  EXPECT_GT(number(entered, "wrap_to_mesh_mm", "mean"), 0.5 * number(entered, "offset_mm"));
}

TEST(WrapObject, TakesAlphaFromTheDiagonalAndOffsetFromAlpha) {
  const TriangleMesh mesh = box({0, 0, 0}, {2, 3, 6});
  const Value::Map lines = wrap_object(mesh, {.relative_alpha = 0.05}).summary;
  EXPECT_NEAR(number(lines, "diagonal_mm"), 7.0, 1e-9);
  EXPECT_NEAR(number(lines, "alpha_mm"), 0.35, 1e-9);
  const Value::Map own = wrap_object(mesh, {.relative_alpha = 0.05, .offset_m = 0.1 * kMillimetre}).summary;
  EXPECT_NEAR(number(own, "offset_mm"), 0.1, 1e-12);
}

TEST(WrapObject, RefusesAnAlphaThatDoesNotFitTheMesh) {
  const TriangleMesh mesh = box({0, 0, 0}, {2, 3, 6});
  const auto refusal = [&](double alpha_mm) {
    return message_of<DataError>([&] { wrap_object(mesh, {.alpha_m = alpha_mm * kMillimetre}); });
  };
  EXPECT_EQ(refusal(0.001),
            "wrap.alpha_mm: 0.001 mm for a mesh of 7 mm from corner to corner, expected 0.0035 mm to 3.5 mm");
  EXPECT_EQ(refusal(4.0), "wrap.alpha_mm: 4 mm for a mesh of 7 mm from corner to corner, expected 0.0035 mm to 3.5 mm");
}

TEST(WrapObject, RefusesAnOffsetThatDoesNotFitTheMesh) {
  const TriangleMesh mesh = box({0, 0, 0}, {2, 3, 6});
  const auto refusal = [&](double offset_mm) {
    return message_of<DataError>(
        [&] { wrap_object(mesh, {.alpha_m = 0.5 * kMillimetre, .offset_m = offset_mm * kMillimetre}); });
  };
  const std::string range =
      " mm for a ball of 0.5 mm and a mesh of 7 mm from corner to corner, expected 0.0005 mm to 3.5 mm";
  EXPECT_EQ(refusal(1e6), "wrap.offset_mm: 1e+06" + range);
  EXPECT_EQ(refusal(1e-4), "wrap.offset_mm: 0.0001" + range);
}

TEST(WrapObject, VerticesWithoutFacesDoNotCount) {
  const TriangleMesh mesh = box({0, 0, 0}, {2, 3, 6});
  TriangleMesh stray = mesh;
  stray.positions.conservativeResize(mesh.num_vertices() + 1, 3);
  stray.positions.bottomRows(1).setConstant(1e9);
  const WrappedObject plain = wrap_object(mesh, {.relative_alpha = 0.1}),
                      found = wrap_object(stray, {.relative_alpha = 0.1});
  EXPECT_EQ(found.mesh.positions, plain.mesh.positions);
  EXPECT_EQ(number(found.summary, "seen_mesh_to_wrap_mm", "max"), number(plain.summary, "seen_mesh_to_wrap_mm", "max"));
}

TEST(WrapObject, TheObjectFileOfAWrapIsInMetresAndAsksForNoOther) {
  EXPECT_EQ(spec_of_wrapped({.unit = "in", .up = "+z", .scale = 2.0, .wrap = WrapConfig{}}).yaml(),
            "unit: m\nup: \"+z\"\n");
  EXPECT_EQ(spec_of_wrapped({.unit = "auto", .up = "-z", .fit_window = true, .height_field = SideConfig{}}).yaml(),
            "unit: m\nup: \"-z\"\nscale: fit\nheight_field: {side: \"-z\", spacing_mm: 0.05}\n");
}

}  // namespace wrap_object_test
}  // namespace tacipc

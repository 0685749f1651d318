#include "common/sample/object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/error.h"

namespace tacipc {
namespace object_test {

ObjectSpec read(const std::string& text) {
  ConfigReader in = ConfigReader::from_text(text, "object.yaml");
  ObjectSpec spec = ObjectSpec::read(in);
  in.finish();
  return spec;
}

TEST(ObjectSpec, ReadsHowAMeshIsTakenAndMended) {
  const ObjectSpec spec =
      read("{unit: cm, up: +x, scale: 2, sheet_thickness_mm: 0.5, height_field: {side: -y, spacing_mm: 0.1}}");
  EXPECT_EQ(spec.unit, "cm");
  EXPECT_EQ(spec.up, "+x");
  EXPECT_EQ(spec.scale, 2.0);
  EXPECT_DOUBLE_EQ(spec.sheet_thickness_m.value(), 0.5e-3);
  EXPECT_EQ(spec.height_field.value().side, "-y");
  EXPECT_DOUBLE_EQ(spec.height_field.value().spacing_m, 1e-4);
}

TEST(ObjectSpec, ReadsHowAMeshIsWrapped) {
  const WrapConfig wrap = read("{unit: mm, wrap: {alpha_mm: 0.1, offset_mm: 0.02}}").wrap.value();
  EXPECT_DOUBLE_EQ(wrap.alpha_m.value(), 1e-4);
  EXPECT_DOUBLE_EQ(wrap.offset_m.value(), 2e-5);
  EXPECT_EQ(read("{unit: mm, wrap: {relative_alpha: 0.01}}").wrap->relative_alpha, 0.01);
  const WrapConfig usual = read("{unit: mm, scale: fit, wrap: {}}").wrap.value();
  EXPECT_EQ(usual.relative_alpha, 0.004);
  EXPECT_FALSE(usual.alpha_m || usual.offset_m);
}

TEST(ObjectSpec, NothingIsMendedUnasked) {
  const ObjectSpec spec = read("unit: mm");
  EXPECT_FALSE(spec.sheet_thickness_m);
  EXPECT_FALSE(spec.height_field);
  EXPECT_FALSE(spec.wrap);
  EXPECT_EQ(spec.scale, 1.0);
  EXPECT_EQ(spec.yaml(), "unit: mm\n");
}

TEST(ObjectSpec, FilesOfItReadTheSame) {
  for (const char* text :
       {"{unit: auto, scale: fit}", "{unit: m, up: -z}", "{unit: in, scale: 0.1, sheet_thickness_mm: 0.3}",
        "{unit: mm, height_field: {side: most_relief}}", "{unit: mm, wrap: {}}",
        "{unit: mm, wrap: {alpha_mm: 0.3, offset_mm: 0.02}}", "{unit: mm, wrap: {relative_alpha: 0.01}}",
        "{unit: mm, height_field: {side: +z, spacing_mm: 0.07}}"}) {
    const ObjectSpec spec = read(text);
    EXPECT_EQ(read(spec.yaml()).yaml(), spec.yaml()) << text;
    EXPECT_EQ(read(spec.yaml()).fit_window, spec.fit_window) << text;
  }
}

TEST(ObjectSpec, RefusesSidesAndThicknessesThatAreNone) {
  EXPECT_THROW(read("{unit: mm, height_field: {side: up}}"), ConfigError);
  EXPECT_THROW(read("{unit: mm, sheet_thickness_mm: 0}"), ConfigError);
  EXPECT_THROW(read("{unit: mm, wrap: {alpha_mm: 0}}"), ConfigError);
  EXPECT_THROW(read("{unit: mm, wrap: {alpha_mm: 1, relative_alpha: 0.1}}"), ConfigError);
  EXPECT_THROW(read("{unit: mm, scale: fit, wrap: {alpha_mm: 1}}"), ConfigError);
  EXPECT_THROW(read("{unit: mm, scale: fit, wrap: {offset_mm: 0.1}}"), ConfigError);
}

}  // namespace object_test
}  // namespace tacipc

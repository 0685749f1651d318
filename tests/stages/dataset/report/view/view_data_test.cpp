#include "stages/dataset/report/view/view_data.h"

#include <gmock/gmock.h>
#include <zlib.h>

#include "common/base/error.h"

namespace tacipc {
namespace view_data_test {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

/// The text behind `"name": ` up to what ends it.
std::string field(const std::string& script, const std::string& name, const std::string& end) {
  const std::size_t at = script.find("\"" + name + "\": ") + name.size() + 4;
  return script.substr(at, script.find_first_of(end, at) - at);
}

std::string unpacked(const std::string& script, std::size_t size) {
  const std::size_t from = script.find("\"packed\": \"") + 11;
  const std::string text = script.substr(from, script.find('"', from) - from);
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string packed;
  unsigned bits = 0, known = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(letters.find(c));
    known += 6;
    if (known >= 8) packed += static_cast<char>(bits >> (known -= 8) & 255u);
  }
  std::string bytes(size + 1, '\0');
  uLongf length = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &length, reinterpret_cast<const Bytef*>(packed.data()),
                       packed.size()),
            Z_OK);
  EXPECT_EQ(length, size);
  return bytes.substr(0, length);
}

/// Reads planes one after the other, as the page does.
class Planes {
 public:
  explicit Planes(std::string bytes) : bytes_(std::move(bytes)) {}
  std::vector<int> next(std::size_t count) {
    std::vector<int> values;
    for (std::size_t i = 0; i < count; ++i) {
      int code = 0;
      for (std::size_t plane = 0; plane < 3; ++plane)
        code |= static_cast<unsigned char>(bytes_[at_ + plane * count + i]) << (8 * plane);
      values.push_back(code % 2 == 0 ? code / 2 : -(code + 1) / 2);
    }
    at_ += 3 * count;
    return values;
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

/// A square of two triangles, at rest and pressed; `deeper` is by what factor.
ViewedGel small_gel(const std::string& name, double deeper, const Matrix4& moved) {
  const Positions rest{{-1e-2, -1e-2, 0}, {1e-2, -1e-2, 0}, {-1e-2, 1e-2, 0}, {1e-2, 1e-2, 0}};
  Positions pressed = rest;
  pressed(0, 2) = deeper * -4.321e-4;
  pressed(3, 0) = 1.0007e-2;
  using enum ContactState;
  return {.name = name,
          .front = Triangles{{0, 1, 2}, {1, 3, 2}},
          .bottom_m = -4e-3,
          .frames = {{rest, Eigen::Vector4d::Zero(), {none, none, none, none}, Matrix4::Identity()},
                     {pressed, Eigen::Vector4d{5e3, 0, 2.5e3, 0}, {stick, none, slip, none}, moved}}};
}

/// Two of them and a triangle that is 3 mm wide.
SceneView small_view() {
  Matrix4 moved = Matrix4::Identity();
  moved(0, 3) = 0.125;
  return {.frames = {0, 4},
          .gels = {small_gel("left", 1.0, moved), small_gel("right", 2.0, Matrix4::Identity())},
          .objects = {{"object",
                       {Positions{{0, 0, 0}, {3e-3, 0, 0}, {0, 1e-3, 0}}, Triangles{{0, 1, 2}}},
                       {Matrix4::Identity(), moved}}}};
}

TEST(ViewData, PlanesHoldValuesOfBothSigns) {
  EXPECT_EQ(byte_planes({0, -1, 1, -300}), (std::string{0, 1, 2, 0x57, 0, 0, 0, 2, 0, 0, 0, 0}));
  Planes planes(byte_planes({(1 << 23) - 1, -(1 << 23)}));
  EXPECT_THAT(planes.next(2), ElementsAre((1 << 23) - 1, -(1 << 23)));
  EXPECT_THROW(byte_planes({1 << 23}), DataError);
}

TEST(ViewData, PositionsComeBackToHalfAStep) {
  const SceneView view = small_view();
  const std::string script = view_script(view, {"rest", "pressed \"hard\""});
  EXPECT_THAT(script, HasSubstr("tacipc_view({"));
  EXPECT_THAT(script, HasSubstr(R"("text": "pressed \"hard\"")"));
  Planes planes(unpacked(script, 3 * (2 * (6 + 2 * (12 + 8)) + 3 + 9)));
  for (const ViewedGel& gel : view.gels) {
    EXPECT_THAT(planes.next(2), ElementsAre(0, 1));
    EXPECT_THAT(planes.next(2), ElementsAre(1, 2));
    EXPECT_THAT(planes.next(2), ElementsAre(2, 1));
    const ViewGrid grid = ViewGrid::around({&gel.frames[0].positions, &gel.frames[1].positions});
    EXPECT_NEAR(grid.step_m, 2.0007e-2 / 65535, 1e-18);
    std::vector<int> steps(12, 0);
    for (std::size_t f = 0; f < 2; ++f) {
      for (int axis = 0; axis < 3; ++axis) {
        const std::vector<int> differences = planes.next(4);
        for (int v = 0; v < 4; ++v) {
          int& here = steps[static_cast<std::size_t>(3 * v + axis)];
          const int from = f > 0 ? here : v > 0 ? steps[static_cast<std::size_t>(3 * (v - 1) + axis)] : 0;
          here = from + differences[static_cast<std::size_t>(v)];
          EXPECT_NEAR(grid.low_m[axis] + grid.step_m * here, gel.frames[f].positions(v, axis), 0.5001 * grid.step_m)
              << gel.name << ", frame " << f << ", vertex " << v << ", axis " << axis;
        }
      }
      EXPECT_THAT(planes.next(4), f == 0 ? ElementsAre(0, 0, 0, 0) : ElementsAre(255, 0, 128, 0));
      EXPECT_THAT(planes.next(4), f == 0 ? ElementsAre(0, 0, 0, 0) : ElementsAre(1, 0, 2, 0));
    }
  }
  for (const int corner : {0, 1, 2}) EXPECT_THAT(planes.next(1), ElementsAre(corner));
  EXPECT_THAT(planes.next(3), ElementsAre(0, 65535, -65535));
  // One bar for all gels: the deeper of both, and 99 % of four pressures, which is the third.
  EXPECT_DOUBLE_EQ(std::stod(field(script, "indentation_m", ",")), 2 * 4.321e-4);
  EXPECT_DOUBLE_EQ(std::stod(field(script, "pressure_pa", ",")), 5e3);
}

TEST(ViewData, PosesAndImagesAreListedPerFrame) {
  SceneView view = small_view();
  EXPECT_THAT(view_script(view, {"a", "b"}), Not(HasSubstr("pictures")));
  view.gels[1].pictures = {"", "../right/render/frame_0004/tactile.png"};
  const std::string script = view_script(view, {"a", "b"});
  EXPECT_THAT(script, HasSubstr(R"("pictures": ["", "../right/render/frame_0004/tactile.png"])"));
  const std::string moved = "[1.0, 0.0, 0.0, 0.125, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0]";
  const std::size_t first = script.find(moved);
  EXPECT_NE(first, std::string::npos);                          // the left gel
  EXPECT_NE(script.find(moved, first + 1), std::string::npos);  // the object
}

TEST(ViewData, TheSameViewGivesTheSameBytes) {
  EXPECT_EQ(view_script(small_view(), {"a", "b"}), view_script(small_view(), {"a", "b"}));
}

}  // namespace view_data_test
}  // namespace tacipc

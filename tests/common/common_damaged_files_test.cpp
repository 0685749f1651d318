// Whatever happens to a file on its way, a reader gives a mesh or one DataError.
#include <functional>

#include "common/base/error.h"
#include "common/format/npy.h"
#include "common/image/image.h"
#include "common/mesh/tet_mesh.h"
#include "common/mesh/triangle_mesh.h"
#include "tests/common/memory_limit.h"
#include "tests/common/sample_files.h"
#include "tests/scratch_folder.h"

namespace tacipc {
namespace common_damaged_files_test {

constexpr std::size_t kMemory = std::size_t{256} << 20;  // bytes

struct Case {
  std::string name;
  std::string bytes;
  std::function<void(const std::filesystem::path&)> read;
};

std::string made_by(const ScratchFolder& scratch, const std::string& name,
                    const std::function<void(const std::filesystem::path&)>& write) {
  write(scratch / name);
  return read_file(scratch / name);
}

std::vector<Case> cases(const ScratchFolder& scratch) {
  const auto mesh = [](const std::filesystem::path& path) { read_triangle_mesh(path, 1e-3); };
  const auto msh = [](const std::filesystem::path& path) { read_msh(path); };
  const auto npy = [](const std::filesystem::path& path) { read_npy(path); };
  const auto exr = [](const std::filesystem::path& path) { read_exr(path, {"R", "B"}); };
  const auto png = [](const std::filesystem::path& path) { read_png(path, 3); };
  const std::vector<double> numbers{1, 2, 3, 4, 5, 6};
  ByteImage bytes(6, 5, 3);
  FloatImage floats(6, 5, 3);
  for (std::size_t i = 0; i < bytes.pixels.size(); ++i) {
    bytes.pixels[i] = static_cast<std::uint8_t>(91 * i);
    floats.pixels[i] = 0.3f * static_cast<float>(i);
  }
  return {
      {"a.obj", tetrahedron_obj(), mesh},
      {"a.off", tetrahedron_off(), mesh},
      {"a.stl", tetrahedron_ascii_stl(), mesh},
      {"b.stl", tetrahedron_binary_stl(), mesh},
      {"a.ply", tetrahedron_ply("ascii"), mesh},
      {"b.ply", tetrahedron_ply("binary_little_endian"), mesh},
      {"c.ply", tetrahedron_ply("binary_big_endian"), mesh},
      {"a.msh", msh22_ascii(), msh},
      {"b.msh", msh22_binary(std::endian::little), msh},
      {"c.msh", msh41_ascii(), msh},
      {"d.msh", msh41_binary(std::endian::big), msh},
      {"a.npy",
       made_by(scratch, "x.npy",
               [&](const auto& p) {
                 write_npy(p, {2, 3}, numbers.data());
               }),
       npy},
      {"a.exr",
       made_by(scratch, "x.exr",
               [&](const auto& p) {
                 write_exr(p, floats, {"R", "G", "B"});
               }),
       exr},
      {"a.png", made_by(scratch, "x.png", [&](const auto& p) { write_png(p, bytes); }), png},
  };
}

/// True if the file could be read, false if it was refused with a message that names it.
bool reads(const ScratchFolder& scratch, const Case& c, const std::string& bytes, const std::string& what) {
  std::filesystem::remove(scratch / c.name);  // a new file is written faster than an old one is replaced
  const std::filesystem::path path = scratch.file(c.name, bytes);
  try {
    const MemoryLimit limit(kMemory);
    c.read(path);
    return true;
  } catch (const DataError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ":")) << error.what();
    EXPECT_LT(std::string(error.what()).size(), 600u) << error.what();
  } catch (const std::exception& error) {
    ADD_FAILURE() << c.name << " " << what << ": " << typeid(error).name() << ": " << error.what();
  }
  return false;
}

TEST(DamagedFiles, TruncationIsRefusedOrHarmless) {
  const ScratchFolder scratch;
  for (const Case& c : cases(scratch)) {
    EXPECT_TRUE(reads(scratch, c, c.bytes, "whole"));
    int refused = 0;
    for (std::size_t size = 0; size < c.bytes.size(); ++size)
      refused += reads(scratch, c, c.bytes.substr(0, size), "cut at " + std::to_string(size)) ? 0 : 1;
    // Text may lose its last line end, and the faces after the cut of an OBJ, unnoticed; a file cut in half may not.
    EXPECT_GT(refused, static_cast<int>(c.bytes.size()) / 2) << c.name;
  }
}

TEST(DamagedFiles, FlippedBytesAreRefusedOrHarmless) {
  const ScratchFolder scratch;
  for (const Case& c : cases(scratch)) {
    for (std::size_t at = 0; at < c.bytes.size(); ++at)
      for (const int mask : {0x01, 0x10, 0x80, 0xff}) {
        std::string bytes = c.bytes;
        bytes[at] = static_cast<char>(bytes[at] ^ mask);
        reads(scratch, c, bytes, "byte " + std::to_string(at) + " flipped by " + std::to_string(mask));
      }
  }
}

TEST(DamagedFiles, EightBytesOfOnesAnywhereAreRefusedOrHarmless) {
  const ScratchFolder scratch;
  for (const Case& c : cases(scratch))
    for (std::size_t at = 0; at + 8 <= c.bytes.size(); ++at)
      for (const char fill : {'\xff', '\x7f', '9'}) {
        std::string bytes = c.bytes;
        bytes.replace(at, 8, 8, fill);
        reads(scratch, c, bytes, "bytes from " + std::to_string(at) + " overwritten");
      }
}

}  // namespace common_damaged_files_test
}  // namespace tacipc

#include "common/base/log.h"
#include "common/stage/stage.h"
#include "stages/object/emboss/emboss.h"

namespace {

using namespace tacipc;

const StageSpec kEmboss{.name = "emboss",
                        .summary = "Make a coin with a relief from letters, polygons, textures or a grey image.",
                        .inputs = {{.flag = "--config", .help = "coin, relief and pattern (YAML)"}}};

constexpr int kPictureWidth = 1000;
/// Strokes narrower than their own walls stay visibly below the requested height.
constexpr double kFullHeightShare = 0.95;

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kEmboss, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<EmbossConfig>("--config");
    if (const auto* picture = std::get_if<PictureSource>(&config.pattern)) stage.add_input("image", picture->path);
    const Height relief = face_relief(config);
    const EmbossedCoin coin = emboss(config, relief);
    if (coin.relief_height_m < kFullHeightShare * config.relief.height_m) {
      log_warning("the relief reaches {:.3f} mm of {:.3f} mm: its parts are narrower than their walls",
                  1e3 * coin.relief_height_m, 1e3 * config.relief.height_m);
    }
    write_ply(stage.output("object.ply"), coin.mesh);
    write_png(stage.output("relief.png"), relief_picture(config, relief, kPictureWidth));

    const Vector3 extents = coin.mesh.positions.colwise().maxCoeff() - coin.mesh.positions.colwise().minCoeff();
    stage.summarize({{"vertices", std::int64_t{coin.mesh.num_vertices()}},
                     {"triangles", std::int64_t{coin.mesh.num_triangles()}},
                     {"spacing_um", 1e6 * coin.spacing_m},
                     {"relief_height_mm", 1e3 * coin.relief_height_m},
                     {"raised_share", coin.raised_share},
                     {"extents_mm", std::vector<double>{1e3 * extents.x(), 1e3 * extents.y(), 1e3 * extents.z()}},
                     {"volume_mm3", 1e9 * signed_volume(coin.mesh)}});
  });
}

#include "common/base/error.h"
#include "common/stage/stage.h"
#include "stages/image/background/median_background.h"

namespace {

using namespace tacipc;

const StageSpec kBackground{
    .name = "background",
    .summary = "Make a photograph without contact from photographs of balls at different places.",
    .inputs = {{.flag = "--config", .help = "distance from a contact beyond which a photograph counts (YAML)"},
               {.flag = "--photographs", .help = "folder of the photographs of balls"},
               {.flag = "--labels", .help = "lines `image.png (x, y) radius`, pixels"}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kBackground, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<BackgroundConfig>("--config");
    const auto labels = read_labels(stage.input("--labels"));
    std::vector<ByteImage> photographs;
    for (const BallLabel& label : labels) {
      const auto path = stage.input("--photographs") / label.image;
      photographs.push_back(read_png(path, 3));
      const ByteImage &image = photographs.back(), &first = photographs.front();
      if (image.width != first.width || image.height != first.height)
        throw DataError("{}: is {} x {} pixels, the first photograph has {} x {}", path.string(), image.width,
                        image.height, first.width, first.height);
    }
    const MedianBackground background = median_background(photographs, labels, config);
    write_png(stage.output("background.png"), background.image);
    stage.summarize({{"photographs", labels.size()},
                     {"fewest_at_a_pixel", background.fewest},
                     {"mean_at_a_pixel", background.mean}});
  });
}

#include "common/files.h"
#include "common/stage.h"
#include "stages/cases/case_files.h"

namespace {

using namespace tacipc;

const StageSpec kCases{.name = "cases",
                       .summary = "From the one file of a photograph benchmark, what its stages need to be told.",
                       .inputs = {{.flag = "--config", .help = "the benchmark (YAML)"},
                                  {.flag = "--circles",
                                   .help = "contact circles of its photographs (CSV), where it names them",
                                   .required = false}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kCases, argc, argv, [](Stage& stage) {
    auto cases = stage.read_config<BenchmarkCases>("--config");
    add_circles(cases, stage.optional_input("--circles"));
    const std::string folder = stage.input("--config").parent_path().generic_string();
    for (const auto& [name, content] : case_files(cases, folder)) write_file(stage.output(name), content);
    std::size_t images = 0;
    for (const ObjectCase& object : cases.objects) images += object.images.size();
    stage.summarize({{"objects", cases.objects.size()}, {"images", images}});
  });
}

#include <optional>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/stage/stage.h"
#include "stages/study/cases/case_files.h"

namespace {

using namespace tacipc;

const StageSpec kCases{
    .name = "cases",
    .summary = "Write the inputs of the stages from the one file of a benchmark or of an identification.",
    .inputs = {{"--config", "the benchmark (YAML)"},
               InputSpec::optional("--circles", "contact circles of its photographs (CSV), where it names them")}};

/// Kinds of benchmarks: photographs, marker vectors measured in them (`fields`), or `measurements` that determine a
/// sensor's mechanics.
struct Benchmark {
  std::optional<BenchmarkCases> photographs;
  std::optional<MarkerBenchmark> markers;
  std::optional<IdentifySpec> identify;

  static Benchmark read(ConfigReader& in) {
    if (in.has("measurements")) return {.photographs = {}, .markers = {}, .identify = IdentifySpec::read(in)};
    if (in.has("fields")) return {.photographs = {}, .markers = MarkerBenchmark::read(in), .identify = {}};
    return {.photographs = BenchmarkCases::read(in), .markers = {}, .identify = {}};
  }
};

/// Checks that the press is quasi-static: only then are forces proportional to the modulus.
void refuse_moving_press(const std::filesystem::path& file) {
  ConfigReader in = ConfigReader::from_file(file);
  const std::string dynamics = in.text_or("dynamics", "implicit_euler");
  if (dynamics != "quasi_static") in.fault("dynamics", "must be quasi_static where mechanics are identified");
  if (in.has("gravity_m_s2")) in.fault("gravity_m_s2", "must not be there where mechanics are identified");
  for (const std::string& key : in.keys())
    if (key != "dynamics" && key != "gravity_m_s2") in.ignore(key);
  in.finish();
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kCases, argc, argv, [](Stage& stage) {
    const auto benchmark = stage.read_config<Benchmark>("--config");
    const std::string folder = stage.input("--config").parent_path().generic_string();
    if ((benchmark.markers || benchmark.identify) && stage.optional_input("--circles"))
      throw UsageError("--circles: the benchmark names no circles");
    if (benchmark.identify) {
      const IdentifySpec& spec = *benchmark.identify;
      refuse_moving_press(std::filesystem::path(folder) / spec.press);
      for (const ModelCheck& check : spec.checks)
        if (!check.press.empty()) refuse_moving_press(std::filesystem::path(folder) / check.press);
      for (const auto& [name, content] : identify_files(spec, folder)) write_file(stage.output(name), content);
      stage.summarize({{"nodes", spec.nodes().size()}, {"measurements", spec.measurements.size()}});
      return;
    }
    if (benchmark.markers) {
      for (const auto& [name, content] : marker_files(*benchmark.markers, folder))
        write_file(stage.output(name), content);
      stage.summarize({{"depths", benchmark.markers->depths}, {"variants", benchmark.markers->variants.size()}});
      return;
    }
    BenchmarkCases cases = *benchmark.photographs;
    add_circles(cases, stage.optional_input("--circles"));
    for (const auto& [name, content] : case_files(cases, folder)) write_file(stage.output(name), content);
    std::size_t images = 0;
    for (const ObjectCase& object : cases.objects) images += object.images.size();
    stage.summarize({{"objects", cases.objects.size()}, {"images", images}});
  });
}

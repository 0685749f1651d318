// Runs one case of the stress campaign; the record is its result.
#include <charconv>

#include "common/base/error.h"
#include "common/base/log.h"
#include "common/stage/stage.h"
#include "verification/stress_case.h"

using namespace tacipc;

namespace {

const StageSpec kStressCase{
    .name = "stress_case",
    .summary = "Press one random object deep into one random gel.",
    .inputs = {{"--config", "ranges to draw from (YAML)"}},
    .options = {{"--seed", "seed of the campaign", "1"}, {"--index", "number of the case", "0"}}};

std::uint64_t whole_number(Stage& stage, const std::string& flag) {
  const std::string& text = stage.option(flag);
  std::uint64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw UsageError(flag + ": '" + text + "' is not a whole number");
  return value;
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kStressCase, argc, argv, [](Stage& stage) {
    const std::uint64_t seed = whole_number(stage, "--seed"), index = whole_number(stage, "--index");
    const auto config = stage.read_config<verify::StressConfig>("--config");
    const verify::StressCase stress = verify::draw_case(config, seed, index);
    const verify::StressResult result =
        verify::run_stress_case(stress, [](int frame, int count, int iteration, double residual) {
          show_progress((frame - 1.0) / count, fmt::format("frame {}/{}, Newton iteration {}, residual {:.1e} m/s",
                                                           frame, count, iteration, residual));
        });
    log_info("{} {}: {}{}{}", stress.object.kind, index, name_of(result.outcome), result.reason.empty() ? "" : ": ",
             result.reason);
    stage.note("case", stress.description());
    stage.summarize(result.lines());
  });
}

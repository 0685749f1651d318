#include "bench/rivals_report.h"

#include <fmt/core.h>

#include "tacipc_bench_texts.h"

namespace tacipc::bench {

std::string rivals_table(const std::vector<ImageSpeed>& speeds, std::size_t frames, const std::string& processor,
                         double load) {
  std::string head = "| CPU ms of a frame |", line = "|---|";
  for (std::size_t i = 0; i < speeds.size(); ++i) {
    if (speeds[i].method != speeds[0].method) continue;
    head += fmt::format(" {} × {}: object | membrane | light | all |", speeds[i].width_px, speeds[i].height_px);
    line += "---|---|---|---|";
  }
  std::string rows;
  for (const ImageSpeed& first : speeds) {
    if (first.width_px != speeds[0].width_px) break;
    rows += fmt::format("| {} |", first.method);
    for (const ImageSpeed& s : speeds)
      if (s.method == first.method)
        rows += fmt::format(" {} | {:.0f} | {:.0f} | {} |", s.object_ms > 0.0 ? fmt::format("{:.0f}", s.object_ms) : "",
                            s.membrane_ms, s.light_ms, s.total());
    rows += "\n";
  }
  return fmt::format(kRivalsTable, head, line, rows, processor, load, frames);
}

}  // namespace tacipc::bench

#include "common/files.h"
#include "common/stage.h"
#include "stages/image_table/method_rows.h"
#include "stages/image_table/picture_sheet.h"
#include "stages/image_table/table_text.h"

namespace {

using namespace tacipc;

const StageSpec kImageTable{
    .name = "image_table",
    .summary = "One table of what metrics measured of several methods, and sheets of their pictures.",
    .inputs = {{.flag = "--config", .help = "rows, columns, printed numbers, sheets (YAML)"},
               {.flag = "--samples", .help = "samples.csv of metrics, each in a folder that a row names", .many = true},
               {.flag = "--pictures",
                .help = "pictures of the sheets, each below a folder that a column names (PNG)",
                .required = false,
                .many = true}}};

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kImageTable, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<ImageTableConfig>("--config");
    const std::vector<MethodRow> rows = read_method_rows(stage.inputs("--samples"), config);
    for (const SheetConfig& sheet : config.sheets) {
      const auto pictures = pictures_of_columns(stage.inputs("--pictures"), sheet);
      const std::string folder = config.link_folder.empty() ? "" : config.link_folder + "/";
      write_png(stage.output(folder + sheet.name + ".png"), picture_sheet(pictures, sheet));
    }
    write_file(stage.output("table.md"), to_markdown(rows, config));
    write_file(stage.output("table.csv"), to_csv(rows, config));
    stage.summarize({{"rows", rows.size()}, {"images", rows.front().images.size()}});
  });
}

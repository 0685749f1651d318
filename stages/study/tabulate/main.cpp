#include <map>
#include <set>
#include <variant>

#include "common/base/error.h"
#include "common/base/files.h"
#include "common/stage/stage.h"
#include "stages/study/tabulate/card.h"
#include "stages/study/tabulate/comparison.h"
#include "stages/study/tabulate/image_table.h"
#include "stages/study/tabulate/markdown.h"
#include "stages/study/tabulate/mesh_costs.h"
#include "stages/study/tabulate/picture_sheet.h"
#include "stages/study/tabulate/stage_costs.h"

namespace {

using namespace tacipc;

const StageSpec kTabulate{
    .name = "tabulate",
    .summary =
        "Tables of what many runs measured: images of several methods, gel meshes, costs of stages, what a sensor was "
        "fitted on.",
    .inputs = {
        {"--config", "kind of table, its rows and columns (YAML)"},
        InputSpec::any_number_named("--samples", "images, comparison: samples.csv of metrics, by the method of a row"),
        InputSpec::any_number_named("--pictures",
                                    "images, comparison: pictures (PNG), by method, in the order of the sheet's rows"),
        InputSpec::optional("--speeds",
                            "images: image_speeds.csv of bench_rivals, what an image costs by the rows' methods"),
        InputSpec::optional("--benchmark", "comparison: the photographs and what is required (YAML)"),
        InputSpec::optional("--circles", "comparison: contact circles, where the benchmark names them"),
        InputSpec::any_number_named("--records",
                                    "meshes: records of tetmesh, press, render and metrics, by the mesh's name"),
        InputSpec::any_number("--timings", "costs: <stage>.timings.yaml of all runs that count"),
        InputSpec::any_number_named("--identified", "card: folders that identify wrote, by the names of their files"),
        InputSpec::any_number_named("--compared", "card: folders that sim2real wrote, by the names of their files")}};

struct TabulateConfig {
  std::string kind;
  std::variant<ImageTableConfig, ComparisonConfig, MeshTableConfig, StageCostsConfig, CardConfig> table;

  static TabulateConfig read(ConfigReader& in) {
    const std::string kind = in.choice("kind", {"images", "comparison", "meshes", "costs", "card"});
    if (kind == "comparison") return {kind, ComparisonConfig::read(in)};
    if (kind == "meshes") return {kind, MeshTableConfig::read(in)};
    if (kind == "card") return {kind, CardConfig::read(in)};
    if (kind == "costs") return {kind, StageCostsConfig::read(in)};
    return {kind, ImageTableConfig::read(in)};
  }
};

struct Flags {
  std::set<std::string> required, optional;
};
const std::map<std::string, Flags> kFlags{{"images", {{"--samples"}, {"--pictures", "--speeds"}}},
                                          {"comparison", {{"--samples", "--pictures", "--benchmark"}, {"--circles"}}},
                                          {"meshes", {{"--records"}, {}}},
                                          {"costs", {{"--timings"}, {}}},
                                          {"card", {{}, {"--identified", "--compared"}}}};

/// \throw UsageError if a flag that this kind of table needs is missing, or a flag is given that it does not use
void check_flags(const Stage& stage, const std::string& kind) {
  const Flags& flags = kFlags.at(kind);
  for (const auto& [flag, help, required, many, named] : kTabulate.inputs) {
    const bool given = named ? !stage.named_inputs(flag).empty() : !stage.inputs(flag).empty();
    if (!given && flags.required.contains(flag))
      throw UsageError(fmt::format("{}: is required for a table of kind {}", flag, kind));
    if (given && !required && !flags.required.contains(flag) && !flags.optional.contains(flag))
      throw UsageError(fmt::format("{}: is not for a table of kind {}", flag, kind));
  }
}

void make(Stage& stage, const ImageTableConfig& config) {
  const auto rows = read_methods(stage.named_inputs("--samples"), config.rows, config.regions, config.columns,
                                 {config.uncounted.begin(), config.uncounted.end()});
  for (const SheetConfig& sheet : config.sheets) {
    const auto pictures = pictures_of_columns(stage.named_inputs("--pictures"), sheet);
    write_png(stage.output(in_folder(config.link_folder, sheet.name + ".png")), picture_sheet(pictures, sheet));
  }
  const auto file = stage.optional_input("--speeds");
  // Times differ from run to run.
  const auto page = file ? stage.varying_output("table.md") : stage.output("table.md");
  write_file(page, to_markdown(rows, config, file ? read_image_speeds(*file) : std::vector<ImageSpeed>{}));
  write_file(stage.output("table.csv"), to_csv(rows, config));
  stage.summarize({{"rows", rows.size()}, {"images", rows.front().images.size()}});
}

void make(Stage& stage, const ComparisonConfig& config) {
  auto cases = stage.read_config<BenchmarkCases>("--benchmark");
  add_circles(cases, stage.optional_input("--circles"));
  const auto methods = read_comparison(stage.named_inputs("--samples"), config, cases);
  const auto pictures =
      compared_pictures(stage.named_inputs("--pictures"), config.rows[0].method, config.rows[1].method, cases);
  write_file(stage.output("table.md"), to_markdown(methods, cases));
  write_png(stage.output("sheet.png"), difference_sheet(pictures));
  stage.summarize(summary_of(methods, cases));
}

void make(Stage& stage, const MeshTableConfig& config) {
  const auto families = read_costs(stage.named_inputs("--records"), config);
  // Times differ from run to run.
  write_file(stage.varying_output("table.md"), to_markdown(families, config));
  write_file(stage.varying_output("table.csv"), to_csv(families));
  write_file(stage.output(in_folder(config.link_folder, kMeshPlot)), error_svg(families, config));
  stage.summarize({{"families", families.size()}});
}

void make(Stage& stage, const StageCostsConfig& config) {
  const std::vector<Cost> costs = costs_of(stage.inputs("--timings"), config);
  write_file(stage.varying_output("table.md"), to_markdown(costs, config));
  write_file(stage.varying_output("table.csv"), to_csv(costs));
  stage.summarize({{"rows", costs.size()}});
}

void make(Stage& stage, const CardConfig& config) {
  const std::vector<NamedPath>& mechanics = stage.named_inputs("--identified");
  std::vector<CardImages> images;
  for (const auto& [name, folder] : stage.named_inputs("--compared")) images.push_back(read_card_images(name, folder));
  const Card card = make_card(config, mechanics, images);
  write_file(stage.output("card.md"), card.page);
  write_file(stage.output("card.yaml"), to_yaml(card.values));
  for (const auto& [name, path] : card.pictures) write_file(stage.output(name), read_file(path));
  stage.summarize({{"mechanics", mechanics.size()}, {"images", images.size()}});
}

}  // namespace

int main(int argc, char** argv) {
  return run_stage(kTabulate, argc, argv, [](Stage& stage) {
    const auto config = stage.read_config<TabulateConfig>("--config");
    check_flags(stage, config.kind);
    std::visit([&](const auto& table) { make(stage, table); }, config.table);
  });
}

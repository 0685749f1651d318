#include "stages/image/calibrate/rival_config.h"

namespace tacipc {

RivalFit RivalFit::read(ConfigReader& in) {
  RivalFit fit;
  const std::string model = in.choice("model", {"table", "network", "metallic_roughness"});
  fit.remove_drift = in.flag_or("remove_drift", true);
  if (model == "table") {
    fit.table.bins = in.integer("bins", 2, 1000);
    fit.table.pooled = in.choice("samples", {"one_of_each_ball", "all"}) == "all";
    fit.table.flat_is_dark = in.flag("flat_is_dark");
    if (!fit.table.pooled) return fit;
    fit.table.smoothing_bins = in.number("smoothing_bins", Range::between(0.0, 100.0));
    fit.table.ridge = in.number("ridge", Range::non_negative());
  } else if (model == "network") {
    fit.model = Model::network;
    fit.network.epochs = in.integer("epochs", 1, 1000000);
    fit.network.batch = in.integer("batch", 1);
    fit.network.rate = in.number("rate", Range::positive());
    fit.network.dropout = in.number("dropout", {.low = 0.0, .high = 1.0, .open_high = true});
    fit.network.seed = static_cast<std::uint64_t>(in.integer("seed", 0));
  } else {
    fit.model = Model::metallic_roughness;
    fit.lamps = MetallicLamps::read(in);
  }
  return fit;
}

}  // namespace tacipc

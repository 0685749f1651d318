// configs/rivals/calibrate/*.yaml: how another simulator's light is fitted to the balls.
#pragma once

#include <cstdint>

#include "common/config/config.h"
#include "common/rival/metallic_lamps.h"

namespace tacipc {

/// Taxim's table [SiYuan2022].
struct TableFit {
  int bins = 0;
  bool pooled = false;          // every pixel counts; else as released: one of each ball in a bin
  double smoothing_bins = 0.0;  // pooled: σ of the Gaussian over bins
  double ridge = 0.0;           // pooled: on all but the constant, as a part of the pixels' number
  bool flat_is_dark = false;    // the first row of inclinations is 0: a flat gel changes nothing
};

/// FOTS' network [Zhao2024].
struct NetworkFit {
  int epochs = 0;
  int batch = 0;
  double rate = 0.0;     // of Adam
  double dropout = 0.0;  // after each hidden layer
  std::uint64_t seed = 0;
};

struct RivalFit {
  enum class Model { table, network, metallic_roughness };
  Model model = Model::table;
  bool remove_drift = true;  // each channel's mean difference far from the contact
  TableFit table;
  NetworkFit network;
  MetallicLamps lamps;  // where they stand; their colours and the factor are where the fit begins

  static RivalFit read(ConfigReader& in);
};

}  // namespace tacipc

// Content of configs/rivals/calibrate/*.yaml: fit of another simulator's light to the balls.
#pragma once

#include <cstdint>

#include "common/config/config.h"
#include "common/rival/metallic_lamps.h"

namespace tacipc {

/// Taxim's table [SiYuan2022].
struct TableFit {
  int bins = 0;
  bool pooled = false;          // true: every pixel counts; false, as released: one pixel per ball and bin
  double smoothing_bins = 0.0;  // pooled: σ of the Gaussian over bins
  double ridge = 0.0;           // pooled: ridge on all weights but the constant, as a fraction of the number of pixels
  bool flat_is_dark = false;    // the first row of inclinations is 0, so a flat gel changes nothing
};

/// FOTS' network [Zhao2024].
struct NetworkFit {
  int epochs = 0;
  int batch = 0;
  double rate = 0.0;     // learning rate of Adam
  double dropout = 0.0;  // after each hidden layer
  std::uint64_t seed = 0;
};

/// Configuration of the fit.
struct RivalFit {
  enum class Model { table, network, metallic_roughness };
  Model model = Model::table;
  bool remove_drift = true;  // remove each channel's mean difference far from the contact
  TableFit table;
  NetworkFit network;
  MetallicLamps lamps;  // positions; its colours and factor are the start of the fit

  static RivalFit read(ConfigReader& in);
};

}  // namespace tacipc

#include "common/rival/shadow_table.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/error.h"
#include "common/format/npy.h"

namespace tacipc {

ShadowTable ShadowTable::read(const std::filesystem::path& path) {
  NpyArray array = read_npy(path);
  constexpr std::size_t kMost = 10000;
  const auto turn = static_cast<std::size_t>(std::ceil(2.0 * std::numbers::pi / kDirectionStep));
  if (array.shape.size() != 4 || array.shape[0] != 3 || array.shape[1] != turn || array.shape[2] == 0 ||
      array.shape[3] == 0 || array.shape[2] > kMost || array.shape[3] > kMost)
    throw DataError("{}: is no table of 3 x {} x depths x steps", path.string(), turn);
  for (const double code : array.data)
    if (!(code <= 0.0 && std::isfinite(code)))
      throw DataError("{}: holds {:g}, expected darkenings of at most 0", path.string(), code);
  return {.directions = static_cast<int>(turn),
          .depths = static_cast<int>(array.shape[2]),
          .steps = static_cast<int>(array.shape[3]),
          .codes = std::move(array.data)};
}

std::vector<double> ShadowTable::list(int channel, int direction, int depth) const {
  const auto begin =
      codes.begin() + ((static_cast<std::ptrdiff_t>(channel) * directions + direction) * depths + depth) * steps;
  return {begin, std::find(begin, begin + steps, 0.0)};
}

}  // namespace tacipc

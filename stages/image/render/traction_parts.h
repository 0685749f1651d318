// The traction that pixels see in two parts: against the front, and along it.
#pragma once

#include "common/image/image.h"

namespace tacipc {

/// t = −p n + s.
struct TractionParts {
  FloatImage pressure;  // p = −n · t
  FloatImage shear;     // s = t + p n
};

/// NaN where traction or normal are. \pre both have three channels and one size
TractionParts parts_of(const FloatImage& traction, const FloatImage& normal);

}  // namespace tacipc

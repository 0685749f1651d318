// A time step that is divided in two where it does not converge.
#pragma once

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/gel/press/solve/time_step.h"

namespace tacipc {

/// Adds to `report` what advance() returns, the StepReport of a step that has been taken over. Where that throws a
/// SolverError, divide(halvings + 1) takes both halves of the step instead. \throw SolverError after `most_halvings`
template <typename Advance, typename Divide>
void advance_or_divide(std::size_t frame, int halvings, int most_halvings, StepReport& report, Advance&& advance,
                       Divide&& divide) {
  try {
    StepReport done = advance();
    done.add_earlier(report);
    report = done;
  } catch (const SolverError& error) {
    if (halvings >= most_halvings) throw;
    log_info("frame {}: {}; dividing the time step", frame, error.what());
    divide(halvings + 1);
  }
}

}  // namespace tacipc

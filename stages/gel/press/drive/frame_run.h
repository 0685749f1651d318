// Frames of a run in order: restored from an interrupted run first, then solved.
#pragma once

#include <optional>
#include <string>

#include "common/base/error.h"
#include "common/base/log.h"
#include "stages/gel/press/world/frame.h"

namespace tacipc {

/// Storage of serialised frames, in order, so that an interrupted run resumes.
class FrameStore {
 public:
  virtual ~FrameStore() = default;
  /// Stores a frame with the state that the next one starts from. Called after each frame, in order.
  virtual void save(const std::string& bytes) = 0;
  /// Loads the next stored frame, in order; nothing if there is none.
  virtual std::optional<std::string> load() = 0;
};

/// Number of frames of a motion of phases, without frame 0.
template <typename Motion>
int num_frames(const Motion& motion) {
  int sum = 0;
  for (const auto& phase : motion) sum += phase.steps;
  return sum;
}

/// Checks the number of gels in a saved frame. \throw DataError if it is not the expected one
inline void require_gels(std::size_t saved, std::size_t expected) {
  if (saved != expected) throw DataError("a saved frame is of {} gels, not {}", saved, expected);
}

/// Sequence of the frames of one run.
class FrameRun {
 public:
  FrameRun(int num_frames, const ProgressObserver& observe, FrameStore* store)
      : num_frames_(num_frames), observe_(observe), store_(store) {}
  FrameRun(const FrameRun&) = delete;
  FrameRun& operator=(const FrameRun&) = delete;

  /// Number of the next frame.
  int next() const { return next_; }
  int num_frames() const { return num_frames_; }

  /// Returns the next frame of an interrupted run; nothing once frames have to be solved.
  std::optional<std::string> restored() {
    if (!store_ || !restoring_) return std::nullopt;
    std::optional<std::string> bytes = store_->load();
    restoring_ = bytes.has_value();
    if (!restoring_) return std::nullopt;
    log_info("frame {}/{} resumed from an interrupted run", next_, num_frames_);
    ++next_;
    return bytes;
  }

  /// Ends a frame that has been solved. \param bytes returns the serialised frame; called only if there is a store
  template <typename Bytes>
  void save(Bytes&& bytes) {
    if (store_) store_->save(bytes());
    ++next_;
  }

  /// Solves the time steps of the next frame. \throw SolverError that names the frame
  template <typename Steps>
  StepReport solve(Steps&& steps) const {
    StepReport report;
    try {
      steps(report);
    } catch (const SolverError& error) {
      throw SolverError("frame {}: {}", next_, error.what());
    }
    return report;
  }

  /// Takes one time step. Adds to `report` the StepReport that advance() returns for an accepted step. If it throws a
  /// SolverError, divide(halvings + 1) takes both halves of the step instead.
  /// \throw SolverError after `most_halvings`
  template <typename Advance, typename Divide>
  void advance_or_divide(int halvings, int most_halvings, StepReport& report, Advance&& advance,
                         Divide&& divide) const {
    try {
      StepReport done = advance();
      done.add_earlier(report);
      report = done;
    } catch (const SolverError& error) {
      if (halvings >= most_halvings) throw;
      log_info("frame {}: {}; dividing the time step", next_, error.what());
      divide(halvings + 1);
    }
  }

  /// Observer that forwards the iterations of a time step to the progress display.
  IterationObserver observer() const {
    return [this](int iteration, double residual) { observe_(next_, num_frames_, iteration, residual); };
  }

 private:
  const int num_frames_;
  const ProgressObserver& observe_;
  FrameStore* store_;
  int next_ = 0;
  bool restoring_ = true;
};

}  // namespace tacipc

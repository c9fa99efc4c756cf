// What a render says while it runs, and what it may be asked.
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <string>

#include "raytrace/xml/diagnostics.h"

namespace raytrace {

enum class MessageLevel {
  error,  ///< something failed; the render goes on if it can
  warning,
  note,  ///< an answer to what was asked
  step,  ///< what was done
};

/// The parts of a render, in their order.
enum class RenderStage { check_outputs, load, build, render };

/// How far a render is.
struct PictureProgress {
  double fraction = 0;               ///< that is done; 1 in the end alone
  std::uint32_t samples = 0;         ///< that pixels have on average
  std::uint32_t all_samples = 0;     ///< that they are to have
  std::optional<double> error = {};  ///< estimated: RenderStatistics::estimated_error so far
  std::optional<int> frame = {};     ///< of the frames that were asked for
};

/// Derive from it what is to be known of a render.
class RenderObserver {
 public:
  virtual ~RenderObserver() = default;

  /// A stage begins.
  virtual void on_stage(RenderStage /*stage*/) {}

  /// A line, without its end. From any thread, at any time.
  virtual void on_message(MessageLevel /*level*/, const std::string& /*text*/) {}

  /// What is wrong or doubtful in the scene's file; after an error the render fails.
  virtual void on_diagnostics(const Diagnostics& /*diagnostics*/) {}

  /// One at a time, from any thread.
  virtual void on_progress(const PictureProgress& /*progress*/) {}
};

/// What is asked of a render while it runs. All may be called from any thread, and from signal handlers.
class RenderControl {
 public:
  /// The render writes the checkpoint and the picture so far, and ends.
  void stop() {
    stop_ = true;
    pause_ = true;
  }
  bool is_stopped() const { return stop_; }

  /// The picture so far is written to its files.
  void request_picture() {
    picture_ = true;
    pause_ = true;
  }
  /// Whether it was asked for since the last call.
  bool take_picture_request() { return picture_.exchange(false); }

  /// The stop flag of a pass over the picture: what is asked for is done between two of them.
  std::atomic<bool>& pause() { return pause_; }

 private:
  // Whoever sees the pause sees why: it is set last.
  std::atomic<bool> stop_ = false, picture_ = false, pause_ = false;
  static_assert(std::atomic<bool>::is_always_lock_free);
};

}  // namespace raytrace

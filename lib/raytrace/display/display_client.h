// Shows a picture in an image viewer while it grows, and never keeps the render waiting for the viewer.
//
// A thread of its own holds the connection. It sends the newest state of what has changed, not every state, and pauses
// 100 times as long as it has worked, at least a fifth of a second: it takes 1 % of a processor. A viewer that is
// absent, slow, gone or none at all is reported once, as a warning, and tried again every 5 seconds, so that one can be
// opened (again) during a long render.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "raytrace/display/display_server.h"
#include "raytrace/film/film.h"

namespace raytrace {

class DisplayClient {
 public:
  /// Is called once at most, from any thread.
  using WarningFunction = std::function<void(const std::string&)>;

  /// Returns at once. image_name: what the viewer calls the picture; an older one of the name is replaced.
  DisplayClient(const DisplayAddress& address, const std::string& image_name, const PictureExtent& extent,
                const WarningFunction& warn);

  /// Sends what the viewer has not yet, for 5 seconds at most, and not at all to a viewer that did not take what came
  /// before.
  ~DisplayClient();
  DisplayClient(const DisplayClient&) = delete;
  DisplayClient& operator=(const DisplayClient&) = delete;

  /// Whether the viewer has taken all that was shown and would show more: a show() between that and the last one of a
  /// render costs a copy for nothing.
  bool is_due() const;

  /// Copies the pixels that have changed since the last call and returns. The film must hold those of `changed` that
  /// lie in the extent's region, and nobody may write them meanwhile. The copies take 16 bytes a pixel of the region;
  /// where that is more than there is, nothing is shown, with a warning.
  void show(const Film& film, const Region& changed);

 private:
  struct Shared;
  std::shared_ptr<Shared> shared_;  ///< with the thread, which may outlive this object when it hangs
  std::thread thread_;
};

}  // namespace raytrace

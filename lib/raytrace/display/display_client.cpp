#include "raytrace/display/display_client.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <mutex>
#include <new>
#include <system_error>
#include <utility>
#include <vector>

#include "raytrace/display/display_server.h"

namespace raytrace {

namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr seconds between_attempts{5};
constexpr milliseconds least_pause{200};
constexpr int pause_for_work = 100;
constexpr seconds longest_end{7};  // longer than DisplayServer takes in a hurry
constexpr int packet_pixels = 1 << 12;

bool is_empty(const Region& region) { return region.width() <= 0 || region.height() <= 0; }

Region intersection(const Region& a, const Region& b) {
  return {std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
}

/// The least rectangle around both.
Region around(const Region& a, const Region& b) {
  if (is_empty(a)) return b;
  if (is_empty(b)) return a;
  return {std::min(a.x0, b.x0), std::min(a.y0, b.y0), std::max(a.x1, b.x1), std::max(a.y1, b.y1)};
}

/// Processor time of the calling thread.
nanoseconds work_time() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

}  // namespace

/// What the render's side and the thread share, and what the thread does.
struct DisplayClient::Shared {
  const DisplayAddress address;
  const std::string image_name;
  const PictureExtent extent;
  const Region view;  ///< what the viewer shows: the picture, and what is rendered beyond it

  std::mutex mutex;  // guards all that follows but the atomics
  std::condition_variable changed;
  WarningFunction warn;       ///< none once it was used
  std::vector<Pixel> pixels;  ///< of the extent's region, once there are any: the newest
  Region shown;               ///< of them, ever
  Region unsent;
  bool finished = false;  ///< the thread's work

  std::atomic<bool> ending{false};
  std::atomic<bool> waits_for_more{false};

  Shared(const DisplayAddress& to, const std::string& name, const PictureExtent& size, WarningFunction warning)
      : address(to),
        image_name(name),
        extent(size),
        view(around({0, 0, size.full_width, size.full_height}, size.region)),
        warn(std::move(warning)) {}

  void copy(const Film& film, const Region& part) {
    pixels.resize(extent.region.pixels());
    for (int y = part.y0; y < part.y1; ++y) {
      Pixel* to = &pixels[extent.region.index(part.x0, y)];
      for (int x = part.x0; x < part.x1; ++x) *to++ = film.pixel(x, y);
    }
  }

  /// In the viewer's image, whose origin is the picture's, or that of what is rendered beyond it.
  std::string packet_of(const Region& rectangle) {
    const Region shifted{rectangle.x0 - view.x0, rectangle.y0 - view.y0, rectangle.x1 - view.x0,
                         rectangle.y1 - view.y0};
    const std::lock_guard lock(mutex);
    return update_image_packet(image_name, shifted, &pixels[extent.region.index(rectangle.x0, rectangle.y0)],
                               static_cast<std::size_t>(extent.region.width()));
  }

  /// In packets of some rows each, so that the render's side never waits long for the mutex. Rows that change
  /// meanwhile are sent as they are when their turn comes, and again the next time.
  void send_changes(DisplayServer& server) {
    Region rest;
    {
      const std::lock_guard lock(mutex);
      rest = std::exchange(unsent, {});
    }
    while (!is_empty(rest)) {
      const int rows = std::max(1, packet_pixels / rest.width());
      Region rectangle = rest;
      rectangle.y1 = rest.y0 = std::min(rest.y0 + rows, rest.y1);
      server.send(packet_of(rectangle));
    }
  }

  /// Until there is something to send, or the end.
  void wait_for_change() {
    std::unique_lock lock(mutex);
    waits_for_more = is_empty(unsent);
    changed.wait(lock, [&] { return ending || !is_empty(unsent); });
    waits_for_more = false;
  }

  void pause(nanoseconds time) {
    std::unique_lock lock(mutex);
    changed.wait_for(lock, time, [&] { return ending.load(); });
  }

  bool all_is_sent() {
    const std::lock_guard lock(mutex);
    return is_empty(unsent);
  }

  void log_once(const std::string& why) {
    const std::lock_guard lock(mutex);
    if (warn) warn("the picture is not shown on " + shown_name(address) + ": " + why + "; the render goes on");
    warn = nullptr;
  }

  /// Until the end, or until the viewer fails.
  void serve() {
    DisplayServer server(address, ending);
    server.send(create_image_packet(image_name, view.width(), view.height()));
    {
      const std::lock_guard lock(mutex);
      unsent = shown;
    }
    while (!ending || !all_is_sent()) {
      const nanoseconds start = work_time();
      send_changes(server);
      pause(std::max<nanoseconds>(least_pause, pause_for_work * (work_time() - start)));
      wait_for_change();
    }
    server.finish();
  }

  void run() {
    for (bool first = true; first || !ending; first = false) {
      try {
        serve();
      } catch (const std::exception& error) {
        log_once(error.what());
        pause(between_attempts);
      }
    }
    const std::lock_guard lock(mutex);
    finished = true;
    changed.notify_all();
  }
};

DisplayClient::DisplayClient(const DisplayAddress& address, const std::string& image_name, const PictureExtent& extent,
                             const WarningFunction& warn)
    : shared_(std::make_shared<Shared>(address, image_name, extent, warn)) {
  try {
    thread_ = std::thread([shared = shared_] { shared->run(); });
  } catch (const std::system_error& error) {  // no more threads for this user, say
    shared_->log_once(error.what());
  }
}

DisplayClient::~DisplayClient() {
  if (!thread_.joinable()) return;
  bool finished = false;
  {
    std::unique_lock lock(shared_->mutex);
    shared_->ending = true;
    shared_->changed.notify_all();
    finished = shared_->changed.wait_for(lock, longest_end, [&] { return shared_->finished; });
  }
  if (finished) {
    thread_.join();
  } else {
    shared_->log_once("no answer in time");  // from the system, about the host's name
    thread_.detach();
  }
}

bool DisplayClient::is_due() const { return shared_->waits_for_more; }

void DisplayClient::show(const Film& film, const Region& changed) {
  const Region part = intersection(changed, shared_->extent.region);
  if (is_empty(part) || !thread_.joinable()) return;
  try {
    const std::lock_guard lock(shared_->mutex);
    shared_->copy(film, part);
    shared_->shown = around(shared_->shown, part);
    shared_->unsent = around(shared_->unsent, part);
    shared_->waits_for_more = false;
    shared_->changed.notify_all();
  } catch (const std::bad_alloc&) {
    shared_->log_once("not enough memory");
  }
}

}  // namespace raytrace

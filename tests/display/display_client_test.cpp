// What a viewer gets while a picture grows. That the packets are tev's is tested end to end
// (tests/command/test_display.py).
#include "raytrace/display/display_client.h"

#include <chrono>
#include <future>
#include <thread>
#include <vector>

#include "display/loopback_server.h"
#include "raytrace/display/display_server.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

constexpr Region whole = {0, 0, 4, 2}, left = {0, 0, 2, 2}, right = {2, 0, 4, 2};
constexpr PictureExtent extent = {4, 2, whole};

/// Whose sums are radiances.
Film film_of(const Region& region) {
  FilmSettings settings;
  settings.extent = {4, 2, region};
  settings.unit_exponent = 0;
  return Film(settings);
}

void fill(Film& film, const Region& region, int value) {
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) film.sum(x, y) = {value, value + 1, value + 2, 1, 1};
  }
}

std::string update(const Region& region, float value) {
  const std::vector<Pixel> pixels(static_cast<std::size_t>(region.width() * region.height()),
                                  Pixel{value, value + 1, value + 2, 1});
  return update_image_packet("a", region, pixels.data(), static_cast<std::size_t>(region.width()));
}

/// Until the viewer has taken all that was shown.
void wait_until_due(const DisplayClient& client) {
  for (int i = 0; i < 6000 && !client.is_due(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  REQUIRE(client.is_due());
}

}  // namespace

TEST_CASE("each state that is shown is sent when the viewer has the one before") {
  const LoopbackServer server;
  auto received = std::async([&] { return server.take(); });
  std::vector<std::string> warnings;
  Film film = film_of(whole);
  {
    DisplayClient client(server.address(), "a", extent, [&](const std::string& text) { warnings.push_back(text); });
    wait_until_due(client);
    fill(film, left, 1);
    client.show(film, left);
    CHECK_FALSE(client.is_due());
    wait_until_due(client);
    fill(film, right, 5);
    client.show(film, right);
  }
  CHECK(received.get() == create_image_packet("a", 4, 2) + update(left, 1) + update(right, 5));
  CHECK(warnings.empty());
}

TEST_CASE("of what changes faster than it is sent, the newest is sent") {
  const LoopbackServer server;
  auto received = std::async([&] { return server.take(); });
  Film film = film_of(whole);
  {
    DisplayClient client(server.address(), "a", extent, {});
    wait_until_due(client);
    fill(film, whole, 0);
    client.show(film, whole);
    for (int i = 1; i <= 1000; ++i) {
      fill(film, whole, i);
      client.show(film, whole);
    }
  }
  const std::string stream = received.get();
  const std::string last = update(whole, 1000);
  REQUIRE(stream.size() >= last.size());
  CHECK(stream.substr(stream.size() - last.size()) == last);
  CHECK(stream.size() < 20 * last.size());
}

TEST_CASE("pixels outside of the extent's region are left out") {
  const LoopbackServer server;
  auto received = std::async([&] { return server.take(); });
  Film film = film_of(left);
  fill(film, left, 3);
  {
    DisplayClient client(server.address(), "a", {4, 2, left}, {});
    client.show(film, whole);
    client.show(film, right);
    client.show(film, {});
  }
  CHECK(received.get() == create_image_packet("a", 4, 2) + update(left, 3));
}

TEST_CASE("a viewer that comes back gets all that was shown") {
  const LoopbackServer server;
  std::vector<std::string> warnings;
  Film film = film_of(whole);
  fill(film, whole, 7);
  auto first = std::async([&] { return server.take(10); });
  std::future<std::string> second;
  {
    DisplayClient client(server.address(), "a", extent, [&](const std::string& text) { warnings.push_back(text); });
    CHECK(first.get().size() == 10);
    second = std::async([&] { return server.take(); });
    client.show(film, whole);
    wait_until_due(client);
  }
  CHECK(second.get() == create_image_packet("a", 4, 2) + update(whole, 7));
  CHECK(warnings.size() == 1);
}

}  // namespace raytrace::test

// Pictures that are read several at once.
#include "raytrace/description/read_pictures.h"

#include <algorithm>
#include <atomic>
#include <random>
#include <vector>

#include "support/catch.h"

namespace raytrace::test {
namespace {

/// Where the pictures are that have been read and are still there.
struct InMemory {
  std::atomic<std::size_t> bytes{0}, most{0};
};

class CountedReader final : public PictureReader {
 public:
  /// made_of: bytes of what it is made of.
  CountedReader(int width, int height, InMemory& memory, std::size_t made_of = 0) : memory_(memory), made_of_(made_of) {
    set_layout({width, height, 1, TexelFormat::bytes});
  }
  std::uint64_t bytes_while_read() const override { return layout().bytes() + made_of_; }
  Picture read() override {
    const std::size_t bytes = memory_.bytes += layout().bytes() + made_of_;
    std::size_t most = memory_.most;
    while (most < bytes && !memory_.most.compare_exchange_weak(most, bytes)) {
    }
    if (layout().height == 13) throw PictureError("13 rows");
    Picture picture{layout(), {}, false};
    picture.pixels = LargeArray<std::byte>::zeros(picture.bytes());
    return picture;
  }

 private:
  InMemory& memory_;
  std::size_t made_of_;
};

}  // namespace

TEST_CASE("pictures are used in their order, each once, with their errors, within the memory for them") {
  std::mt19937 random(3);
  for (int round = 0; round < 20; ++round) {
    std::vector<int> heights(random() % 200);  // 0: not wanted; below 0: it cannot be opened
    for (int& height : heights) height = static_cast<int>(random() % 40) - 2;
    const std::size_t memory = random() % 20000, made_of = round % 2 == 0 ? 0 : 500;
    InMemory in_memory;
    std::size_t next = 0;
    read_pictures(
        heights.size(), 3, memory,
        [&](std::size_t i) -> std::unique_ptr<PictureReader> {
          if (heights[i] < 0) throw PictureError("closed");
          if (heights[i] == 0) return nullptr;
          return std::make_unique<CountedReader>(100, heights[i], in_memory, made_of);
        },
        [&](std::size_t i, const PictureResult& result) {
          CHECK(i == next++);
          const int height = heights[i];
          if (height < 0) {
            CHECK_THROWS_WITH(result.get(), "closed");
          } else if (height == 13) {
            CHECK_THROWS_WITH(result.get(), "13 rows");
          } else if (height == 0) {
            CHECK(result.get() == nullptr);
          } else {
            REQUIRE(result.get() != nullptr);
            CHECK(result.get()->height == height);
          }
          if (height > 0) in_memory.bytes -= static_cast<std::size_t>(height) * 100 + made_of;
        });
    CHECK(next == heights.size());
    CHECK(in_memory.most <= std::max<std::size_t>(memory, 37 * 100 + made_of));
  }
}

TEST_CASE("several pictures with room for them are in memory at once, and one without") {
  for (const auto& [memory, most] : {std::pair(std::uint64_t{1000}, std::size_t{1000}), {0, 100}}) {
    InMemory in_memory;
    read_pictures(
        30, 2, memory, [&](std::size_t) { return std::make_unique<CountedReader>(10, 10, in_memory); },
        [&](std::size_t, const PictureResult&) { in_memory.bytes -= 100; });
    CHECK(in_memory.most == most);
  }
}

}  // namespace raytrace::test

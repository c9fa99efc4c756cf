#include "raytrace/description/read_pictures.h"

#include <utility>
#include <vector>

#include "raytrace/parallel/for_each_index.h"

namespace raytrace {
namespace {

struct OpenedPicture {
  std::unique_ptr<PictureReader> reader;
  PictureResult result;

  std::uint64_t bytes() const { return reader ? reader->bytes_while_read() : 0; }
  void read() {
    if (!reader) return;
    try {
      result.picture = reader->read();
    } catch (...) {
      result.error = std::current_exception();
    }
    reader.reset();
  }
};

}  // namespace

void read_pictures(std::size_t count, int threads, std::uint64_t memory,
                   const std::function<std::unique_ptr<PictureReader>(std::size_t i)>& open,
                   const std::function<void(std::size_t i, const PictureResult& result)>& use) {
  constexpr std::size_t most_at_once = 64;  // open files
  std::optional<OpenedPicture> next;
  const auto open_next = [&](std::size_t i) {
    next.emplace();
    try {
      next->reader = open(i);
    } catch (...) {
      next->result.error = std::current_exception();
    }
  };
  for (std::size_t first = 0; first < count;) {
    std::vector<OpenedPicture> group;
    std::uint64_t bytes = 0;
    while (first + group.size() < count && group.size() < most_at_once) {
      if (!next) open_next(first + group.size());
      if (!group.empty() && bytes + next->bytes() > memory) break;
      bytes += next->bytes();
      group.push_back(std::move(*next));
      next.reset();
    }
    for_each_index(static_cast<int>(group.size()), threads, [&](int i) { group[static_cast<std::size_t>(i)].read(); });
    for (OpenedPicture& picture : group) {
      use(first++, picture.result);
      picture.result = {};  // whose memory others may want
    }
  }
}

}  // namespace raytrace

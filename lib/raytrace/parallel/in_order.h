// Work that several threads share, and whose results are taken one by one, in their order.
#pragma once

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <cstddef>

namespace raytrace {

/// For each i in [0, count): make(i, slot) runs on any thread, then take(i, slot): one at a time, in the order of i.
/// slots: a container with random access. A slot holds what make hands to take, and is used
/// again for another i; if there is but one, nothing runs at once.
template <class Slots, class Make, class Take>
void in_order(std::size_t count, Slots& slots, tbb::task_arena& arena, Make&& make, Take&& take) {
  if (count == 1 || slots.size() == 1) {
    for (std::size_t i = 0; i < count; ++i) {
      make(i, slots[0]);
      take(i, slots[0]);
    }
    return;
  }

  // As i leaves the pipeline before i + 1 does, those inside follow each other, and each has a slot of its own.
  const auto slot = [&](std::size_t i) -> auto& { return slots[i % slots.size()]; };
  std::size_t next = 0;
  const auto number =
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& end) {
        if (next == count) end.stop();
        return next++;
      });
  const auto parallel = tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, [&](std::size_t i) {
    make(i, slot(i));
    return i;
  });
  const auto ordered =
      tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, [&](std::size_t i) { take(i, slot(i)); });
  arena.execute([&] { tbb::parallel_pipeline(slots.size(), number & parallel & ordered); });
}

}  // namespace raytrace

// Work that several threads share, and whose results are taken one by one, in their order.
#pragma once

#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <cstddef>

#include "raytrace/parallel/handover.h"

namespace raytrace {

/// For each i in [0, count): make(i, workplace) on any thread, and then take(i, workplace), which comes after that of
/// i - 1 and never runs twice at once. workplaces: a container with random access. A workplace holds what make leaves
/// for take, and is used again for another i; if there is but one, nothing runs at once.
template <class Workplaces, class Make, class Take>
void in_order(std::size_t count, Workplaces& workplaces, tbb::task_arena& arena, Make&& make, Take&& take) {
  if (count == 1 || workplaces.size() == 1) {
    for (std::size_t i = 0; i < count; ++i) {
      make(i, workplaces[0]);
      take(i, workplaces[0]);
    }
    return;
  }

  // Static: a worker must find it before it reads anything of the loop.
  static constinit Handover handover;
  // As i leaves the pipeline before i + 1 does, those inside follow each other, and each has a workplace of its own.
  const auto workplace = [&](std::size_t i) -> auto& { return workplaces[i % workplaces.size()]; };
  std::size_t next = 0;
  const auto number =
      tbb::make_filter<void, std::size_t>(tbb::filter_mode::serial_in_order, [&](tbb::flow_control& end) {
        handover.take();
        if (next == count) end.stop();
        const std::size_t i = next++;
        handover.give();
        return i;
      });
  const auto parallel = tbb::make_filter<std::size_t, std::size_t>(tbb::filter_mode::parallel, [&](std::size_t i) {
    handover.take();
    make(i, workplace(i));
    handover.give();
    return i;
  });
  const auto ordered = tbb::make_filter<std::size_t, void>(tbb::filter_mode::serial_in_order, [&](std::size_t i) {
    handover.take();
    take(i, workplace(i));
    handover.give();
  });
  handover.give();
  run_loop([&] { arena.execute([&] { tbb::parallel_pipeline(workplaces.size(), number & parallel & ordered); }); });
  handover.take();
}

}  // namespace raytrace

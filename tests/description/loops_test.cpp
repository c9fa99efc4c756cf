// Loops on several threads leave nothing behind.
// Not with sanitizers: they keep memory for themselves.
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "raytrace/parallel/for_each_index.h"
#include "support/catch.h"

namespace raytrace::test {
namespace {

long resident_kilobytes() {
  std::ifstream file("/proc/self/statm");
  long all = 0, resident = 0;
  file >> all >> resident;
  return resident * (sysconf(_SC_PAGESIZE) / 1024);
}

}  // namespace

TEST_CASE("many loops take no more memory than a few") {
  std::atomic<int> calls = 0;
  const auto run = [&](int loops) {
    for (int i = 0; i < loops; ++i) for_each_index(4, 2, [&](int) { ++calls; });
  };
  run(100);
  const long before = resident_kilobytes();
  run(3000);
  CHECK(resident_kilobytes() - before < 5000);
  CHECK(calls == 4 * 3100);
}

TEST_CASE("loops in loops, and of several threads, are each done once, also after one that throws") {
  CHECK_THROWS_AS(for_each_index(4, 2, [](int) { throw std::runtime_error("no"); }), std::runtime_error);
  std::atomic<int> calls = 0;
  std::vector<std::thread> threads;
  for (int t = 0; t < 3; ++t)
    threads.emplace_back([&] { for_each_index(8, 2, [&](int) { for_each_index(8, 2, [&](int) { ++calls; }); }); });
  for (std::thread& thread : threads) thread.join();
  CHECK(calls == 3 * 8 * 8);
}

}  // namespace raytrace::test

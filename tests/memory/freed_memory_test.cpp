#include "raytrace/memory/freed_memory.h"

#include <sys/resource.h>

#include <cstddef>
#include <cstdlib>

#include "support/catch.h"
#include "support/sanitizers.h"

namespace raytrace::test {

namespace {

long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

/// How often the system was asked for a page while a large piece of memory was taken, written to and freed.
long faults_of_a_large_piece() {
  constexpr std::size_t bytes = std::size_t{64} << 20U, page = 4096;
  const long before = page_faults();
  auto* const memory = static_cast<volatile char*>(std::malloc(bytes));
  REQUIRE(memory != nullptr);
  for (std::size_t i = 0; i < bytes; i += page) memory[i] = 1;
  std::free(const_cast<char*>(memory));
  return page_faults() - before;
}

}  // namespace

#if defined(__GLIBC__)
TEST_CASE("memory that was kept needs no pages from the system until it is given back") {
  if (sanitized) {
    WARN("a sanitizer's allocator keeps memory as it likes");
    return;
  }
  keep_freed_memory();
  const long fresh = faults_of_a_large_piece();
  REQUIRE(fresh >= 16);  // with the largest pages that there are
  CHECK(faults_of_a_large_piece() * 4 < fresh);
  give_back_freed_memory();
  CHECK(faults_of_a_large_piece() * 4 > fresh);
}
#endif

}  // namespace raytrace::test

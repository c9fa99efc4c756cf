// Times the small parts of the renderer one by one, by Google Benchmark; its options choose and print.
#include <benchmark/benchmark.h>

#include "narrow_cases.h"
#include "raytrace/render/renderer.h"
#include "wide_cases.h"

namespace {

using raytrace::benchmark::MicroCase;

void run(benchmark::State& state, const MicroCase& micro_case) {
  for ([[maybe_unused]] const auto iteration : state) benchmark::DoNotOptimize(micro_case.run());
  const auto runs = static_cast<std::int64_t>(state.iterations());
  state.SetItemsProcessed(runs * micro_case.items);
  if (micro_case.bytes > 0) state.SetBytesProcessed(runs * micro_case.bytes);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;

  const auto shapes = raytrace::benchmark::shape_scenes();
  std::vector<MicroCase> cases;
  raytrace::benchmark::add_narrow_cases(cases);
  for (const std::string& isa : raytrace::isa_names())
    if (raytrace::isa_supported(isa)) raytrace::benchmark::add_wide_cases(isa, shapes, cases);

  for (const MicroCase& micro_case : cases)
    benchmark::RegisterBenchmark(micro_case.name.c_str(), [&](benchmark::State& state) { run(state, micro_case); });
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
}

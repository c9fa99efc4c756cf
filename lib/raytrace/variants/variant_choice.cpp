#include <tbb/task_arena.h>

#include <algorithm>
#include <array>

#include "raytrace/description/check_scene.h"
#include "raytrace/variants/variant.h"
#include "raytrace/variants/variant_list.h"

#define RAYTRACE_DECLARE(name, isa) extern "C" const raytrace::Variant& raytrace_variant_##name();
RAYTRACE_VARIANTS(RAYTRACE_DECLARE)

namespace raytrace {

namespace {

#define RAYTRACE_ENTRY(name, isa) &raytrace_variant_##name,
using EntryPoint = const Variant& (*)();
constexpr EntryPoint entry_points[] = {RAYTRACE_VARIANTS(RAYTRACE_ENTRY)};
#define RAYTRACE_ISA_NAME(name, isa) isa,
constexpr const char* variant_isas[] = {RAYTRACE_VARIANTS(RAYTRACE_ISA_NAME)};

bool processor_runs(const std::string& name) {
#if defined(__x86_64__)
  if (name == "x86-64-v2") return __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("popcnt");
  if (name == "x86-64-v3")
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2");
  if (name == "x86-64-v4")
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
           __builtin_cpu_supports("avx512vl");
#endif
  return name == "generic";
}

}  // namespace

std::vector<std::string> isa_names() { return {std::begin(variant_isas), std::end(variant_isas)}; }

bool isa_supported(const std::string& name) {
  return std::find(std::begin(variant_isas), std::end(variant_isas), name) != std::end(variant_isas) &&
         processor_runs(name);
}

std::string best_isa() {
  for (std::size_t i = std::size(variant_isas); i-- > 0;)
    if (processor_runs(variant_isas[i])) return variant_isas[i];
  throw RenderError(std::string("this processor is older than the least that this program was built for, ") +
                    variant_isas[0]);
}

const Variant& choose_variant(const std::string& isa) {
  const std::string name = isa.empty() ? best_isa() : isa;
  for (std::size_t i = 0; i < std::size(variant_isas); ++i)
    if (name == variant_isas[i]) {
      if (!processor_runs(name)) throw RenderError("this processor cannot run " + name + "; its best is " + best_isa());
      return entry_points[i]();
    }
  throw RenderError("unknown instruction set " + name);
}

int thread_count(int wanted) { return wanted > 0 ? wanted : tbb::this_task_arena::max_concurrency(); }

std::unique_ptr<const Scene> build_scene(const SceneDescription& description, const BuildSettings& settings) {
  if (!settings.checked) require_good_scene(description);
  const int threads = thread_count(settings.threads);
  return choose_variant(settings.isa).build(description, threads);
}

}  // namespace raytrace

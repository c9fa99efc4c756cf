#include "raytrace/batch/render_statistics.h"

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "raytrace/memory/process_status.h"
#include "raytrace/output/atomic_file.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

std::string aligned_line(const char* name, const std::string& value) { return formatted("%-16s", name) + value + "\n"; }

std::string seconds_text(double seconds) { return formatted("%10.3f s", seconds); }

/// With a metric prefix: "12.3 M".
std::string amount_text(double amount, const char* unit) {
  const char* const prefixes[] = {"", "k", "M", "G", "T"};
  int prefix = 0;
  while (amount >= 1000 && prefix < 4) {
    amount /= 1000;
    ++prefix;
  }
  std::string result = formatted("%10.*f %s%s", prefix == 0 ? 0 : 1, amount, prefixes[prefix], unit);
  while (result.back() == ' ') result.pop_back();
  return result;
}

std::string amount_text(std::uint64_t amount, const char* unit) {
  return amount_text(static_cast<double>(amount), unit);
}

}  // namespace

double RenderStatistics::rays_per_second() const {
  return phases.render.seconds > 0 ? static_cast<double>(total_rays()) / phases.render.seconds : 0;
}

std::string invalid_samples_text(const InvalidSamples& invalid) {
  std::string text = counted(invalid.count, "sample") + " without a finite radiance, counted as black:";
  for (const SampleId& id : invalid.listed)
    text +=
        " sample " + std::to_string(id.sample) + " of pixel " + std::to_string(id.x) + "," + std::to_string(id.y) + ";";
  const SampleId& first = invalid.listed.front();
  return text + " to see it again: --pixel " + std::to_string(first.x) + "," + std::to_string(first.y);
}

std::vector<std::pair<const char*, double>> RenderStatistics::stage_seconds() const {
  std::vector<std::pair<const char*, double>> result;
  if (stages.empty()) return result;
  for (std::size_t stage = 0; stage < StageTimes::names.size(); ++stage)
    result.emplace_back(StageTimes::names[stage], processor_seconds * stages.share(static_cast<Stage>(stage)));
  return result;
}

std::uint64_t peak_memory_bytes() {
  // Linux counts pages in batches, thread by thread, so that its peak may be a few pages less than it was before.
  static std::uint64_t highest = 0;
  highest = std::max(highest, process_status_bytes("VmHWM"));
  if (highest > 0) return highest;
  // The next best: the peak of whoever started this process is in it, too.
  constexpr std::uint64_t unit = 1024;  // Linux counts kibibytes
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * unit;
}

std::string statistics_text(const RenderStatistics& s) {
  const std::string picture = std::to_string(s.width) + " x " + std::to_string(s.height) + ", " +
                              counted(static_cast<std::uint64_t>(s.samples), "sample") + " per pixel";
  const std::string crop = s.region == Region{0, 0, s.width, s.height} ? "" : ", crop " + text_of(s.region);
  std::string view;
  const std::string balance = s.white_balance != 0 ? formatted(", white balance %g K", s.white_balance) : "";
  if (s.view_transform != "srgb" || s.exposure != 0 || !balance.empty())
    view = aligned_line("view", s.view_transform + formatted(", exposure %g", s.exposure) + balance);
  std::string seconds, peaks, stages;
  for (const auto& [name, processor_seconds] : s.stage_seconds())
    stages += (stages.empty() ? "" : ", ") + std::string(name) + formatted(" %.3f s", processor_seconds);
  for (const auto& [name, phase] : s.phases.named()) {
    seconds += aligned_line(name, seconds_text(phase.seconds));
    const std::string peak = amount_text(phase.peak_memory_bytes, "B");
    peaks += (peaks.empty() ? " (" : ", ") + std::string(name) + " " + peak.substr(peak.find_first_not_of(' '));
  }
  const std::string frame = s.frame ? ", frame " + std::to_string(*s.frame) : "";
  return aligned_line("scene", on_one_line(s.scene_file) + frame) + aligned_line("picture", picture + crop) + view +
         seconds + aligned_line("total", seconds_text(s.phases.seconds())) +
         (stages.empty() ? stages : aligned_line("stages", stages)) +
         (s.estimated_error ? aligned_line("estimated error", formatted("%10.2f %%", 100 * *s.estimated_error)) : "") +
         (s.photon_radius ? aligned_line("photon radius", formatted("%10.4g", double{*s.photon_radius})) : "") +
         aligned_line("camera rays", amount_text(s.rays.camera, "")) +
         aligned_line("shadow rays", amount_text(s.rays.shadow, "")) +
         (s.rays.indirect > 0 ? aligned_line("indirect rays", amount_text(s.rays.indirect, "")) : std::string()) +
         aligned_line("rays per second", amount_text(s.rays_per_second(), "")) +
         aligned_line("primitives", amount_text(s.scene.primitives, "")) +
         aligned_line("BVH", amount_text(s.scene.bvh_bytes, "B")) +
         aligned_line("peak memory", amount_text(s.peak_memory_bytes, "B") + peaks + ")") +
         aligned_line("threads", std::to_string(s.threads)) +
         aligned_line("instructions", s.scene.isa + ", " + std::to_string(s.scene.lanes) + " lanes") +
         aligned_line("Embree", s.scene.embree_version);
}

std::string statistics_json(const RenderStatistics& s) {
  nlohmann::ordered_json seconds, peaks;
  for (const auto& [name, phase] : s.phases.named()) {
    seconds[name] = phase.seconds;
    peaks[name] = phase.peak_memory_bytes;
  }
  seconds["total"] = s.phases.seconds();
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& [name, processor_seconds] : s.stage_seconds()) stages[name] = processor_seconds;
  nlohmann::ordered_json error = nullptr;
  if (s.estimated_error) error = *s.estimated_error;
  nlohmann::ordered_json photon_radius = nullptr;
  if (s.photon_radius) photon_radius = *s.photon_radius;
  nlohmann::ordered_json frame = nullptr;
  if (s.frame) frame = *s.frame;
  const nlohmann::ordered_json report = {
      {"schema_version", 1},
      {"software", s.software},
      {"scene", s.scene_file},
      {"frame", frame},
      {"outputs", s.outputs},
      {"picture",
       {{"width", s.width},
        {"height", s.height},
        {"region", {s.region.x0, s.region.y0, s.region.x1, s.region.y1}},
        {"samples", s.samples},
        {"seed", s.seed},
        {"view_transform", s.view_transform},
        {"exposure", s.exposure},
        {"white_balance", s.white_balance}}},
      {"seconds", seconds},
      {"processor_seconds", s.processor_seconds},
      {"stage_seconds", stages},
      {"estimated_error", error},
      {"photon_radius", photon_radius},
      {"rays",
       {{"camera", s.rays.camera},
        {"shadow", s.rays.shadow},
        {"indirect", s.rays.indirect},
        {"total", s.total_rays()},
        {"per_second", s.rays_per_second()}}},
      {"primitives", s.scene.primitives},
      {"memory",
       {{"bvh_bytes", s.scene.bvh_bytes}, {"peak_bytes", s.peak_memory_bytes}, {"peak_bytes_by_phase", peaks}}},
      {"threads", s.threads},
      {"instruction_set", {{"name", s.scene.isa}, {"lanes", s.scene.lanes}}},
      {"embree", s.scene.embree_version},
  };
  // A file name need not be UTF-8; JSON must.
  return report.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_statistics_file(const RenderStatistics& statistics, const std::string& file) {
  AtomicFile written(file);
  const std::string text = statistics_json(statistics);
  if (std::fwrite(text.data(), 1, text.size(), written.stream()) != text.size()) written.fail(errno);
  written.commit();
}

}  // namespace raytrace

// What a render did.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "raytrace/tracing/error_estimate.h"
#include "raytrace/tracing/stage_times.h"

namespace raytrace {

/// The rays of a render, by their purpose.
struct RayCounts {
  std::uint64_t camera = 0;
  std::uint64_t shadow = 0;
  std::uint64_t indirect = 0;  ///< that go on from a surface
  RayCounts& operator+=(const RayCounts& other) {
    camera += other.camera;
    shadow += other.shadow;
    indirect += other.indirect;
    return *this;
  }
};

/// A sample of a pixel, by its index in the pixel's sequence.
struct SampleId {
  int x = 0, y = 0;
  std::uint32_t sample = 0;
};

/// The samples whose radiance was not finite: counted as black, and reported.
struct InvalidSamples {
  static constexpr std::size_t most_listed = 10;
  std::uint64_t count = 0;
  std::vector<SampleId> listed;  ///< the first most_listed of them, by row, column and index

  void add(const SampleId& sample) { *this += InvalidSamples{1, {sample}}; }

  InvalidSamples& operator+=(const InvalidSamples& other) {
    if (other.count == 0) return *this;
    count += other.count;
    listed.insert(listed.end(), other.listed.begin(), other.listed.end());
    std::sort(listed.begin(), listed.end(), [](const SampleId& a, const SampleId& b) {
      return std::tie(a.y, a.x, a.sample) < std::tie(b.y, b.x, b.sample);
    });
    listed.resize(std::min(listed.size(), most_listed));
    return *this;
  }
};

struct RenderReport {
  RayCounts rays;
  InvalidSamples invalid_samples;
  StageTimes stages;             ///< of path tracing
  ErrorEstimate error;           ///< of what the render added; empty with raycast, and without two samples a pixel
  double processor_seconds = 0;  ///< of all threads together
  RenderReport& operator+=(const RenderReport& other) {
    rays += other.rays;
    invalid_samples += other.invalid_samples;
    stages += other.stages;
    error += other.error;
    processor_seconds += other.processor_seconds;
    return *this;
  }
};

}  // namespace raytrace

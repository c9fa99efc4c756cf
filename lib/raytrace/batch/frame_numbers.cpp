#include "raytrace/batch/frame_numbers.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "raytrace/batch/settings_error.h"
#include "raytrace/text/quoted.h"

namespace raytrace {

namespace {

constexpr std::size_t most_frame_numbers = 100000;

struct FramePart {
  std::int64_t first, last, step;  ///< first <= last, step > 0, or all frames in between are left out
  std::string text;
};

class FrameParser {
 public:
  explicit FrameParser(const std::string& text) : whole_(text), rest_(text) {}

  std::vector<FramePart> parts() {
    std::vector<FramePart> parts;
    do parts.push_back(part());
    while (take(','));
    if (!rest_.empty()) refuse();
    return parts;
  }

 private:
  [[noreturn]] void refuse() const {
    throw SettingsError(in_quotes(whole_) +
                        " is no list of frames; use numbers, ranges and ranges with a step, e.g. 1-10:2,15");
  }

  void skip_space() { rest_.remove_prefix(std::min(rest_.find_first_not_of(" \t"), rest_.size())); }

  bool take(char c) {
    skip_space();
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    return true;
  }

  int number() {
    const bool negative = take('-');
    skip_space();
    // from_chars would take a second sign.
    if (rest_.empty() || rest_.front() < '0' || rest_.front() > '9') refuse();
    int value = 0;
    const auto [stop, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc()) throw SettingsError(in_quotes(whole_) + " has a number beyond 2147483647");
    rest_.remove_prefix(static_cast<std::size_t>(stop - rest_.data()));
    return negative ? -value : value;
  }

  FramePart part() {
    skip_space();
    const char* const start = rest_.data();
    const std::int64_t first = number();
    const bool range = take('-');
    const std::int64_t last = range ? number() : first;
    const std::int64_t step = range && take(':') ? number() : 1;
    skip_space();
    std::string text(start, static_cast<std::size_t>(rest_.data() - start));
    text.erase(text.find_last_not_of(" \t") + 1);
    if (step == 0) throw SettingsError(in_quotes(text) + " has the step 0; leave it out for all frames");
    if (step > 0 && first > last) {
      throw SettingsError(in_quotes(text) + " goes down; write " + std::to_string(last) + "-" + std::to_string(first) +
                          (step == 1 ? "" : ":" + std::to_string(step)));
    }
    if (step < 0 && first < last) {
      throw SettingsError(in_quotes(text) + " goes up, its step down; write " + std::to_string(first) + "-" +
                          std::to_string(last) + ":" + std::to_string(-step));
    }
    if (step > 0) return {first, last, step, text};
    return {first - (first - last) / -step * -step, first, -step, text};
  }

  const std::string& whole_;
  std::string_view rest_;
};

}  // namespace

std::vector<int> frame_numbers(const std::string& text) {
  std::vector<FramePart> parts = FrameParser(text).parts();
  std::sort(parts.begin(), parts.end(), [](const FramePart& a, const FramePart& b) { return a.first < b.first; });
  std::vector<int> frames;
  const FramePart* before = nullptr;
  for (const FramePart& part : parts) {
    if (before && part.first <= before->last) {
      throw SettingsError(in_quotes(before->text) + " and " + in_quotes(part.text) +
                          " overlap; each frame is rendered once");
    }
    before = &part;
    if (static_cast<std::size_t>((part.last - part.first) / part.step) + 1 > most_frame_numbers - frames.size()) {
      throw SettingsError(in_quotes(text) + " is more than " + std::to_string(most_frame_numbers) +
                          " frames; split them into several runs");
    }
    for (std::int64_t frame = part.first; frame <= part.last; frame += part.step)
      frames.push_back(static_cast<int>(frame));
  }
  return frames;
}

std::string frames_text(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t first = 0, next = 0; first < frames.size(); first = next) {
    const auto step_to = [&](std::size_t i) { return std::int64_t{frames[i]} - frames[i - 1]; };
    next = first + 1;
    while (next < frames.size() && step_to(next) == step_to(first + 1)) ++next;
    const std::int64_t step = next == first + 1 ? 0 : step_to(next - 1);
    if (next == first + 2 && step > 1) --next;  // two make no range
    text += (text.empty() ? "" : ",") + std::to_string(frames[first]);
    if (next > first + 1) text += "-" + std::to_string(frames[next - 1]) + (step > 1 ? ":" + std::to_string(step) : "");
  }
  return text;
}

}  // namespace raytrace

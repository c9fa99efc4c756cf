#include "raytrace/batch/frames.h"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "raytrace/batch/settings_error.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

constexpr std::string_view scene_token = "{scene}", tile_token = "{tile}", hash_token = "{#}", percent_token = "%%";

/// As printf("%04d") does it: a minus sign is one of the digits.
std::string padded(int number, std::size_t digits) {
  std::string text = std::to_string(number);
  if (text.size() < digits) text.insert(number < 0 ? 1 : 0, digits - text.size(), '0');
  return text;
}

/// The name in which read_token(rest, result) was asked at each character: it appends what the token there stands for,
/// and gives the token's length; 0 if there is none.
template <class ReadToken>
std::string with_tokens_read(std::string_view name, const ReadToken& read_token) {
  std::string result;
  while (!name.empty()) {
    const std::size_t length = read_token(name, result);
    if (length == 0) result += name.front();
    name.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

std::size_t read_frame_token(std::string_view text, int frame, std::string& result) {
  if (text.starts_with(hash_token)) {
    result += '#';
    return hash_token.size();
  }
  if (text.starts_with(percent_token)) {
    result += '%';
    return percent_token.size();
  }
  std::size_t length = std::min(text.find_first_not_of('#'), text.size()), digits = length;
  if (text.starts_with("%d")) {
    length = 2;
  } else if (text.starts_with("%0") && text.size() > 3 && text[2] >= '0' && text[2] <= '9' && text[3] == 'd') {
    length = 4;
    digits = static_cast<std::size_t>(text[2] - '0');
  }
  if (length > 0) result += padded(frame, digits);
  return length;
}

/// Never a name of a folder, which "..." without what follows its last dot would be.
std::string scene_stem(const std::string& scene) {
  if (scene == "-") return "stdin";
  const std::filesystem::path name = std::filesystem::path(scene).filename();
  for (const std::string& candidate : {name.stem().string(), name.string()})
    if (candidate.find_first_not_of('.') != std::string::npos) return candidate;
  throw SettingsError("the scene " + in_quotes(scene) + " has no file name that could stand for {scene}");
}

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

std::string file_name(const std::string& name, const NameValues& values) {
  return with_tokens_read(name, [&](std::string_view rest, std::string& result) {
    if (values.frame)
      if (const std::size_t length = read_frame_token(rest, *values.frame, result)) return length;
    if (rest.starts_with(scene_token)) {
      result += scene_stem(values.scene);
      return scene_token.size();
    }
    if (!rest.starts_with(tile_token)) return std::size_t{0};
    if (!values.tile) throw SettingsError("{tile} in " + name + " has no number; give a tile, e.g. --tile 0/4");
    result += std::to_string(*values.tile);
    return tile_token.size();
  });
}

std::string scene_file_name(const std::string& name, std::optional<int> frame) {
  if (!frame) return name;
  return with_tokens_read(
      name, [&](std::string_view rest, std::string& result) { return read_frame_token(rest, *frame, result); });
}

std::string with_folders_kept(const std::string& name) {
  std::string result;
  for (std::size_t begin = 0; begin < name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const bool is_kept = end < name.size() && std::filesystem::is_directory(name.substr(0, end));
    for (const char c : std::string_view(name).substr(begin, end + 1 - begin)) {
      if (is_kept && c == '#') {
        result += hash_token;
      } else if (is_kept && c == '%') {
        result += percent_token;
      } else {
        result += c;
      }
    }
    begin = end + 1;
  }
  return result;
}

bool has_frame_token(const std::string& name) { return scene_file_name(name, 1) != scene_file_name(name, 2); }

std::string with_tokens(const std::string& name, bool frame, bool scene) {
  std::string tokens;
  if (scene && name.find(scene_token) == std::string::npos) tokens += "." + std::string(scene_token);
  if (frame && !has_frame_token(name)) tokens += ".####";
  const std::string extension = std::filesystem::path(name).extension().string();
  return name.substr(0, name.size() - extension.size()) + tokens + extension;
}

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

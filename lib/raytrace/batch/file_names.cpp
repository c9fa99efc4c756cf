#include "raytrace/batch/file_names.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string_view>

#include "raytrace/batch/settings_error.h"
#include "raytrace/text/quoted.h"

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

}  // namespace raytrace

#include "file_names.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <string_view>

#include "option_values.h"
#include "raytrace/text/quoted.h"

namespace raytrace {

namespace {

constexpr std::string_view scene_token = "{scene}";
constexpr std::string_view tile_token = "{tile}";

constexpr std::string_view hash_token = "{#}", percent_token = "%%";

struct FrameToken {
  std::size_t length = 0;   ///< in the name; 0: there is none
  std::size_t digits = 0;   ///< at least
  std::string_view letter;  ///< what it is, if it is not the frame's number
};

bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// The token that the text starts with.
FrameToken frame_token(std::string_view text) {
  if (text.starts_with(hash_token)) return {hash_token.size(), 0, "#"};
  if (text.starts_with(percent_token)) return {percent_token.size(), 0, "%"};
  const std::size_t run = std::min(text.find_first_not_of('#'), text.size());
  if (run > 0) return {run, run, {}};
  if (text.starts_with("%d")) return {2, 1, {}};
  if (text.starts_with("%0") && text.size() > 3 && is_digit(text[2]) && text[3] == 'd')
    return {4, static_cast<std::size_t>(text[2] - '0'), {}};
  return {};
}

/// As printf("%04d") does it: a minus sign is one of the digits.
std::string padded(int number, std::size_t digits) {
  std::string text = std::to_string(number);
  if (text.size() < digits) text.insert(number < 0 ? 1 : 0, digits - text.size(), '0');
  return text;
}

std::string text_of(const FrameToken& token, int frame) {
  return token.letter.empty() ? padded(frame, token.digits) : std::string(token.letter);
}

/// Never a name of a folder, which "..." without what follows its last dot would be.
std::string stem(const std::string& scene) {
  if (scene == "-") return "stdin";
  const std::filesystem::path name = std::filesystem::path(scene).filename();
  for (const std::string& candidate : {name.stem().string(), name.string()})
    if (candidate.find_first_not_of('.') != std::string::npos) return candidate;
  throw UsageError("the scene " + in_quotes(scene) + " has no file name that could stand for {scene}");
}

}  // namespace

std::string file_name(const std::string& name, const NameValues& values) {
  std::string result;
  for (std::string_view rest = name; !rest.empty();) {
    const FrameToken token = values.frame ? frame_token(rest) : FrameToken();
    if (token.length > 0) {
      result += text_of(token, *values.frame);
      rest.remove_prefix(token.length);
    } else if (rest.starts_with(scene_token)) {
      result += stem(values.scene);
      rest.remove_prefix(scene_token.size());
    } else if (rest.starts_with(tile_token)) {
      if (!values.tile) throw UsageError("{tile} in " + name + " has no number; give a tile, e.g. --tile 0/4");
      result += std::to_string(*values.tile);
      rest.remove_prefix(tile_token.size());
    } else {
      result += rest.front();
      rest.remove_prefix(1);
    }
  }
  return result;
}

std::string scene_file_name(const std::string& name, std::optional<int> frame) {
  if (!frame) return name;
  std::string result;
  for (std::string_view rest = name; !rest.empty();) {
    const FrameToken token = frame_token(rest);
    result += token.length > 0 ? text_of(token, *frame) : std::string(1, rest.front());
    rest.remove_prefix(std::max<std::size_t>(token.length, 1));
  }
  return result;
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

bool has_frame_token(const std::string& name) {
  for (std::string_view rest = name; !rest.empty();) {
    const FrameToken token = frame_token(rest);
    if (token.length > 0 && token.letter.empty()) return true;
    rest.remove_prefix(std::max<std::size_t>(token.length, 1));
  }
  return false;
}

std::string with_tokens(const std::string& name, bool frame, bool scene) {
  std::string tokens;
  if (scene && name.find(scene_token) == std::string::npos) tokens += "." + std::string(scene_token);
  if (frame && !has_frame_token(name)) tokens += ".####";
  const std::filesystem::path path(name);
  return name.substr(0, name.size() - path.extension().string().size()) + tokens + path.extension().string();
}

}  // namespace raytrace

#include "raytrace/textures/udim.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

namespace raytrace {
namespace {

constexpr int first_number = udim_number(0, 0), last_number = 9999;
constexpr std::size_t digits = 4;

/// What is before and behind the number in a file's name without its folder.
std::optional<std::pair<std::string, std::string>> around_number(const std::string& name) {
  for (const std::string_view mark : std::array<std::string_view, 2>{"<UDIM>", "%(UDIM)d"}) {
    const std::size_t at = name.find(mark);
    if (at != std::string::npos) return std::pair{name.substr(0, at), name.substr(at + mark.size())};
  }
  return std::nullopt;
}

}  // namespace

bool is_udim(std::string_view file) {
  return around_number(std::filesystem::path(file).filename().string()).has_value();
}

std::vector<UdimTile> find_udim_tiles(const std::string& file) {
  const std::filesystem::path path(file), folder = path.has_parent_path() ? path.parent_path() : ".";
  const auto around = around_number(path.filename().string());
  std::vector<UdimTile> tiles;
  std::error_code error;
  if (!around) return tiles;
  const auto& [before, behind] = *around;
  for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (name.size() != before.size() + digits + behind.size() || !name.starts_with(before) || !name.ends_with(behind))
      continue;
    int number = 0;
    const char* const first = name.data() + before.size();
    const auto [stop, wrong] = std::from_chars(first, first + digits, number);
    if (wrong != std::errc() || stop != first + digits || number < first_number || number > last_number) continue;
    const int place = number - first_number;
    tiles.push_back({place % udim_columns, place / udim_columns, (path.parent_path() / name).string()});
  }
  std::sort(tiles.begin(), tiles.end(), [](const UdimTile& a, const UdimTile& b) { return a.number() < b.number(); });
  return tiles;
}

}  // namespace raytrace

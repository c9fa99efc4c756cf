// The values that options take: from text, or a UsageError that says what would have been right.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/batch/model_scene.h"
#include "raytrace/batch/render_job.h"
#include "raytrace/batch/settings_error.h"
#include "raytrace/display/display_server.h"
#include "raytrace/film/aov_settings.h"
#include "raytrace/film/region.h"
#include "raytrace/film/tiles.h"
#include "raytrace/math/type_list.h"

namespace raytrace {

/// An invalid command line: exit code 2.
class UsageError : public SettingsError {
 public:
  /// more_lines: what to type instead, where that takes lines of its own.
  explicit UsageError(const std::string& text, std::vector<std::string> more_lines = {})
      : SettingsError(text), more_lines_(std::move(more_lines)) {}

  const std::vector<std::string>& more_lines() const { return more_lines_; }

 private:
  std::vector<std::string> more_lines_;
};

using Names = std::vector<std::string>;

/// The name that is most like the wrong one; empty if none is.
std::string nearest(const std::string& wrong, const Names& names);

/// "; did you mean 'name'?", if any of the names is like the wrong one.
std::string suggestion(const std::string& wrong, const Names& names);

int integer(const std::string& text, int least, int most);
inline auto integer_between(int least, int most) {
  return [=](const std::string& text) { return integer(text, least, most); };
}

/// Any that 64 bits hold.
std::uint64_t natural_number(const std::string& text);

/// 8 or 16.
int bit_depth(const std::string& text);
MissingTexture missing_texture(const std::string& text);
/// "1000", "500K", "20M", "2G" or "1T", by powers of 1024.
std::uint64_t byte_count(const std::string& text);
/// "front", "back", "side", "top", "iso", or "30,15".
std::array<double, 2> model_view(const std::string& text);
/// "-40,35": the second above 0, at most 90.
std::array<double, 2> sun_angles(const std::string& text);
double frames_per_second(const std::string& text);
/// A name that a scene file may have.
std::string label(const std::string& text);

/// The text, if it is one of the names.
std::string one_of(const std::string& text, const Names& names);
inline auto one_of(const Names& names) {
  return [=](const std::string& text) { return one_of(text, names); };
}

/// All types in a registry, as --list shows them.
template <class List>
Names names_in(List list) {
  Names names;
  for_each_type(list, [&]<class T>(std::type_identity<T>) {
    if constexpr (requires { T::name; })
      names.emplace_back(T::name);
    else
      names.emplace_back(T::element);
  });
  return names;
}

/// Those that --aov knows, and "all".
Names aov_choices();

/// "depth,normal", or "all" of them.
AovSet aovs(const std::string& text);

/// "wood,glass"
std::vector<std::string> material_names(const std::string& text);

/// "1920x1080"
Resolution resolution(const std::string& text);

/// "2/8": the third of eight.
Tile tile(const std::string& text);

struct PixelIndex {
  int x = 0, y = 0;
};

/// "x,y", from the top left; beyond the picture, perhaps.
PixelIndex pixel_index(const std::string& text);

/// "90", "90s", "10m", "1h30m": in seconds.
double duration(const std::string& text);
/// "2%" or "0.02", above 0, at most 1.
double error_limit(const std::string& text);

/// A finite number above 0.
double scale(const std::string& text);

/// A number from 0 to the largest that a scene may have.
double radiance(const std::string& text);

/// A number of stops: "-1.5", "+2".
double exposure(const std::string& text);

/// 0, or a temperature of math/blackbody.h.
double balanced_temperature(const std::string& text);

/// "x0,y0,x1,y1", at least one pixel; it may reach beyond the picture.
Region crop(const std::string& text);

/// "host:port", "[::1]:port", or a host alone, for tev's own port
DisplayAddress display_address(const std::string& text);

}  // namespace raytrace

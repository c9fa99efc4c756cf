#include "raytrace/import/read_strands.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <string_view>
#include <utility>

#include "raytrace/import/empty_files.h"
#include "raytrace/import/mesh_file.h"
#include "raytrace/import/mesh_text.h"
#include "raytrace/parameters/fields.h"
#include "raytrace/text/message.h"

namespace raytrace {

namespace {

constexpr std::size_t most_points = std::size_t{1} << 30U;

/// Takes strands that are points of arrays, one after the other, and leaves out those that cannot be rendered.
class StrandWriter {
 public:
  StrandWriter(Strands& strands, const Vec3d& origin) : strands_(strands), origin_(origin) {}

  /// The next `count` points are a strand. position(i), radius(i), color(i): of the point of that number.
  template <class Position, class Radius, class Color>
  void add(std::size_t first, std::size_t count, const Position& position, const Radius& radius, const Color& color) {
    const std::size_t kept = kept_;
    bool fine = count >= 2;
    for (std::size_t i = first; i < first + count && fine; ++i) {
      const Vec3d p = position(i) - origin_;
      const std::array coordinates{p.x, p.y, p.z};
      for (int axis = 0; axis < 3; ++axis) {
        const double coordinate = coordinates[static_cast<std::size_t>(axis)];
        fine = fine && std::abs(coordinate) <= largest_number;
        strands_.positions[3 * kept_ + static_cast<std::size_t>(axis)] = static_cast<float>(coordinate);
      }
      if (!strands_.radii.empty()) {
        const double r = radius(i);
        fine = fine && r >= 0 && r <= largest_number;
        strands_.radii[kept_] = static_cast<float>(r);
      }
      if (!strands_.colors.empty()) {
        const std::array<float, 3> rgb = color(i);
        for (std::size_t channel = 0; channel < 3; ++channel) {
          const float value = rgb[channel];
          strands_.colors[3 * kept_ + channel] = value >= 0 && value <= 1e6F ? value : 0;
        }
      }
      ++kept_;
    }
    if (fine)
      strands_.ends.push_back(static_cast<std::uint32_t>(kept_));
    else
      kept_ = kept;
    left_out_ += fine ? 0 : 1;
  }

  bool finish(Diagnostics& diagnostics) {
    strands_.positions.shorten_to(3 * kept_);
    if (!strands_.radii.empty()) strands_.radii.shorten_to(kept_);
    if (!strands_.colors.empty()) strands_.colors.shorten_to(3 * kept_);
    if (left_out_ > 0)
      diagnostics.warning({}, counted(left_out_, "strand") + (left_out_ == 1 ? " is" : " are") +
                                  " left out: of a single point, with a point that is not finite or too far away, or "
                                  "with a radius that is negative or no number");
    if (kept_ > 0) return true;
    diagnostics.error({}, left_out_ == 0 ? no_strands : "has no strands that can be rendered");
    return false;
  }

 private:
  Strands& strands_;
  Vec3d origin_;
  std::size_t kept_ = 0, left_out_ = 0;
};

/// Of a .hair file.
struct HairHeader {
  static constexpr std::size_t size = 128;
  enum Arrays : std::uint32_t { segments = 1, points = 2, thicknesses = 4, transparencies = 8, colors = 16 };

  std::array<char, 4> signature;
  std::uint32_t strands, point_count, arrays, default_segments;
  float default_thickness, default_transparency;
  std::array<float, 3> default_color;
  std::array<char, 88> information;

  bool has(Arrays array) const { return (arrays & array) != 0; }
};
static_assert(sizeof(HairHeader) == HairHeader::size);

std::optional<Strands> refuse(Diagnostics& diagnostics, std::string message) {
  diagnostics.error({}, std::move(message));
  return std::nullopt;
}

std::optional<Strands> read_hair(std::string_view bytes, const MeshReadSettings& settings, Diagnostics& diagnostics) {
  HairHeader header;
  if (bytes.size() < HairHeader::size || !bytes.starts_with("HAIR"))
    return refuse(diagnostics, "is no .hair file: it does not start with a header of 128 bytes and \"HAIR\"");
  std::memcpy(&header, bytes.data(), HairHeader::size);
  if (header.strands == 0) return refuse(diagnostics, no_strands);
  if (!header.has(HairHeader::points)) return refuse(diagnostics, "has no array of points");
  const std::size_t count = header.point_count, strands = header.strands;
  std::size_t at = HairHeader::size;
  const auto take = [&](HairHeader::Arrays array, std::size_t values, std::size_t each) {
    const std::size_t start = at;
    if (header.has(array)) at += values * each;
    return start;
  };
  const std::size_t segments_at = take(HairHeader::segments, strands, 2),
                    points_at = take(HairHeader::points, count, 12),
                    thicknesses_at = take(HairHeader::thicknesses, count, 4);
  take(HairHeader::transparencies, count, 4);
  const std::size_t colors_at = take(HairHeader::colors, count, 12);
  if (bytes.size() < at)
    return refuse(diagnostics, "ends too early: its " + std::to_string(strands) + " strands and " +
                                   std::to_string(count) + " points take " + std::to_string(at) +
                                   " bytes, and it has " + std::to_string(bytes.size()));
  if (count > most_points) return refuse(diagnostics, "has more than " + std::to_string(most_points) + " points");
  const auto number = [&]<class T>(std::size_t from, std::size_t i, T) {
    T value;
    std::memcpy(&value, bytes.data() + from + i * sizeof(T), sizeof(T));
    return value;
  };
  const auto segments_of = [&](std::size_t strand) -> std::size_t {
    return header.has(HairHeader::segments) ? number(segments_at, strand, std::uint16_t{}) : header.default_segments;
  };
  std::size_t needed = 0;
  for (std::size_t i = 0; i < strands && needed <= count; ++i) needed += segments_of(i) + 1;
  if (needed != count)
    return refuse(diagnostics, "its header says " + counted(count, "point") + ", and its strands take " +
                                   (needed > count ? "more" : std::to_string(needed)));
  Strands result;
  result.positions = MeshBuffer<float>(3 * count);
  const bool has_radii = header.has(HairHeader::thicknesses) || header.default_thickness > 0;
  if (has_radii) result.radii = MeshBuffer<float>(count);
  if (header.has(HairHeader::colors)) result.colors = MeshBuffer<float>(3 * count);
  StrandWriter writer(result, settings.origin);
  const auto position = [&](std::size_t i) {
    return Vec3d(number(points_at, 3 * i, 0.0F), number(points_at, 3 * i + 1, 0.0F),
                 number(points_at, 3 * i + 2, 0.0F));
  };
  const auto radius = [&](std::size_t i) {
    const bool has = header.has(HairHeader::thicknesses);
    return 0.5 * static_cast<double>(has ? number(thicknesses_at, i, 0.0F) : header.default_thickness);
  };
  const auto color = [&](std::size_t i) {
    return std::array{number(colors_at, 3 * i, 0.0F), number(colors_at, 3 * i + 1, 0.0F),
                      number(colors_at, 3 * i + 2, 0.0F)};
  };
  std::size_t first = 0;
  for (std::size_t i = 0; i < strands; ++i) {
    const std::size_t points = segments_of(i) + 1;
    writer.add(first, points, position, radius, color);
    first += points;
  }
  if (header.has(HairHeader::transparencies))
    diagnostics.warning({}, "the transparencies of its points are left out; a material has <opacity>");
  if (!writer.finish(diagnostics)) return std::nullopt;
  return result;
}

std::optional<Strands> read_text_strands(std::string_view text, const MeshReadSettings& settings,
                                         Diagnostics& diagnostics) {
  std::size_t numbers = 0, count = 0, line = 0;
  const std::size_t errors_before = diagnostics.error_count();
  // Twice, so that nothing is allocated that is not used: first it is checked.
  for_each_line<false>(text, [&](const char* start, const char* end) {
    ++line;
    LineWords words(start, end);
    const std::size_t found = words.count();
    if (found == 0) return true;
    if (numbers == 0) numbers = found;
    double value = 0;
    bool fine = found == numbers && (numbers == 3 || numbers == 4);
    for (std::size_t i = 0; i < found && fine; ++i) fine = words.number(value);
    if (!fine) {
      const std::string wanted =
          std::string(numbers == 3 ? "x y z" : "x y z radius") + (count > 0 ? ", as those before" : "");
      diagnostics.error({static_cast<std::uint32_t>(line), 0},
                        "is no point of a strand: a line has " + wanted + ", and an empty one is between strands");
    }
    ++count;
    return fine;
  });
  if (diagnostics.error_count() > errors_before) return std::nullopt;
  if (count == 0) return refuse(diagnostics, no_strands);
  if (count > most_points) return refuse(diagnostics, "has more than " + std::to_string(most_points) + " points");
  Strands result;
  result.positions = MeshBuffer<float>(3 * count);
  if (numbers == 4) result.radii = MeshBuffer<float>(count);
  StrandWriter writer(result, settings.origin);
  std::vector<std::array<double, 4>> strand;
  const auto end_strand = [&] {
    if (!strand.empty())
      writer.add(
          0, strand.size(), [&](std::size_t i) { return Vec3d(strand[i][0], strand[i][1], strand[i][2]); },
          [&](std::size_t i) { return strand[i][3]; }, [](std::size_t) { return std::array<float, 3>{}; });
    strand.clear();
  };
  for_each_line<false>(text, [&](const char* start, const char* end) {
    LineWords words(start, end);
    std::array<double, 4> point{};
    std::size_t i = 0;
    while (i < numbers && words.number(point[i])) ++i;
    if (i == 0)
      end_strand();
    else
      strand.push_back(point);
    return true;
  });
  end_strand();
  if (!writer.finish(diagnostics)) return std::nullopt;
  return result;
}

}  // namespace

std::optional<Strands> read_strands(const std::string& name, const MeshReadSettings& settings,
                                    Diagnostics& diagnostics) {
  std::optional<MeshFile> file = MeshFile::open(name, diagnostics);
  if (!file || !file->load(settings.threads, diagnostics)) return std::nullopt;
  const bool is_hair = mesh_type(name) == ".hair";
  std::optional<Strands> strands = is_hair ? read_hair(file->text(false), settings, diagnostics)
                                           : read_text_strands(file->text(true), settings, diagnostics);
  if (strands) strands->origin = settings.origin;
  return strands;
}

}  // namespace raytrace

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "raytrace/import/density_grid.h"

namespace raytrace {

namespace {

constexpr std::size_t vol_header = 48;

/// From the file's order of bytes, which starts with the lowest.
template <class Number>
Number little_endian(const char* bytes) {
  std::uint32_t bits = 0;
  for (int i = 3; i >= 0; --i) bits = bits << 8U | static_cast<unsigned char>(bytes[i]);
  return std::bit_cast<Number>(bits);
}

}  // namespace

std::shared_ptr<const DensityGrid> read_vol_grid(const std::string& file, int threads) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(file, error);
  std::ifstream stream(file, std::ios::binary);
  if (error || !stream.is_open()) throw GridError("it cannot be read");
  std::array<char, vol_header> header{};
  stream.read(header.data(), header.size());
  if (stream.gcount() < 4 || std::memcmp(header.data(), "VOL", 3) != 0)
    throw GridError("it is no file of Mitsuba's format, which begins with VOL");
  if (header[3] != 3)
    throw GridError("it is of version " + std::to_string(static_cast<unsigned char>(header[3])) + "; there is only 3");
  if (!stream) throw GridError("it ends within its header");
  const auto whole = [&](std::size_t place) { return little_endian<std::int32_t>(header.data() + place); };
  if (whole(4) != 1)
    throw GridError("its numbers are of type " + std::to_string(whole(4)) + "; only 1, floats, is read");
  const std::int32_t channels = whole(20);
  if (channels != 1 && channels != 3)
    throw GridError("it has " + std::to_string(channels) + " channels, where there are 1 or 3");
  std::array<std::int64_t, 3> size{whole(8), whole(12), whole(16)};
  if (bytes < vol_header) throw GridError("it ends within its header");
  std::uintmax_t left = (bytes - vol_header) / 4 / static_cast<std::uintmax_t>(channels);
  for (const std::int64_t points : size) {
    if (points < 1) throw GridError("it has no points");
    left /= static_cast<std::uintmax_t>(points);
  }
  if (left < 1) throw GridError("it ends before the last of its numbers");
  const auto corner = [&](std::size_t place) {
    const auto number = [&](std::size_t i) { return double{little_endian<float>(header.data() + place + 4 * i)}; };
    return Vec3d(number(0), number(1), number(2));
  };
  const Vec3d lower = corner(24), extent = corner(36) - lower;
  if (!(extent.x > 0 && extent.y > 0 && extent.z > 0 && length(extent) <= 1e17 && length(lower) <= 1e17))
    throw GridError("the box in its header is none");
  const auto count = [&](std::size_t axis) { return static_cast<double>(size[axis]); };
  DensityGrid::Lattice lattice;
  // One more on each side, as the last: beyond the middle of its share nothing changes.
  lattice.added = 2;
  for (std::size_t axis = 0; axis < 3; ++axis) lattice.points[axis] = size[axis] + lattice.added;
  lattice.lower = Vec3d(0.5, 0.5, 0.5);
  lattice.upper = Vec3d(count(0) + 0.5, count(1) + 0.5, count(2) + 0.5);
  const Vec3d edge(extent.x / count(0), extent.y / count(1), extent.z / count(2));
  lattice.world_from_lattice = {{edge.x, 0, 0}, {0, edge.y, 0}, {0, 0, edge.z}, lower + edge * -0.5};
  DensityGrid::cells_of(lattice);  // before there is memory for as many
  const auto points = static_cast<std::size_t>(size[0] * size[1] * size[2]);
  DensityGrid::check_memory(std::uint64_t{4} * points * static_cast<std::uint64_t>(channels));
  std::vector<float> numbers(points * static_cast<std::size_t>(channels));
  stream.read(reinterpret_cast<char*>(numbers.data()), static_cast<std::streamsize>(4 * numbers.size()));
  if (!stream) throw GridError("it ends before the last of its numbers");
  if constexpr (std::endian::native == std::endian::big)
    for (float& number : numbers) number = little_endian<float>(reinterpret_cast<const char*>(&number));
  if (channels == 3)
    for (std::size_t i = 0; i < points; ++i)
      numbers[i] = (numbers[3 * i] + numbers[3 * i + 1] + numbers[3 * i + 2]) / 3;
  return std::make_shared<const DensityGrid>(lattice, threads, [&](const std::array<int, 3>& first, float* to) {
    const auto place = [&](std::size_t axis, int i) {
      return std::clamp<std::int64_t>(std::int64_t{first[axis]} + i - 1, 0, size[axis] - 1);
    };
    for (int z = 0; z < DensityGrid::cell_points; ++z)
      for (int y = 0; y < DensityGrid::cell_points; ++y) {
        const std::int64_t row = (place(2, z) * size[1] + place(1, y)) * size[0];
        for (int x = 0; x < DensityGrid::cell_points; ++x) *to++ = numbers[static_cast<std::size_t>(row + place(0, x))];
      }
  });
}

}  // namespace raytrace

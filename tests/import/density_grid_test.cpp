// Grids of densities: their cells bound what is in them; files of Mitsuba's format, good and bad.
#include <cmath>
#include <filesystem>
#include <random>

#include "import/support.h"
#include "raytrace/import/grid_tiles.h"
#include "support/catch.h"
#include "support/contains.h"

using namespace raytrace;
using namespace raytrace::test;

namespace {

struct VolFile {
  std::string magic = std::string("VOL") + '\3';
  std::int32_t type = 1, x = 2, y = 3, z = 2, channels = 1;
  std::vector<float> box = {0, 0, 0, 2, 3, 4};
  std::vector<float> numbers = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

  std::string bytes() const {
    std::string all = magic;
    for (const std::int32_t number : {type, x, y, z, channels}) all += bytes_of_value(number);
    for (const float number : box) all += bytes_of_value(number);
    for (const float number : numbers) all += bytes_of_value(number);
    return all;
  }
};

std::shared_ptr<const DensityGrid> grid_of(const std::string& bytes) {
  const TemporaryFolder folder;
  write_text(folder.file("a.vol"), bytes);
  return read_vol_grid(folder.file("a.vol"), 2);
}

std::string error_of(const std::string& bytes) {
  try {
    grid_of(bytes);
  } catch (const GridError& error) {
    return error.what();
  }
  return "none";
}
std::string error_of(const VolFile& file) { return error_of(file.bytes()); }

double in_world(const DensityGrid& grid, const Vec3d& p) {
  return grid.at(grid.lattice().world_from_lattice.inverse().point(p));
}

}  // namespace

TEST_CASE("a .vol has each number in the middle of its share of the box, and what is linear between them") {
  const auto grid = grid_of(VolFile{}.bytes());
  CHECK(in_world(*grid, {0.5, 0.5, 1}) == Approx(1));
  CHECK(in_world(*grid, {1.5, 0.5, 1}) == Approx(2));
  CHECK(in_world(*grid, {0.5, 1.5, 1}) == Approx(3));
  CHECK(in_world(*grid, {0.5, 0.5, 3}) == Approx(7));
  CHECK(in_world(*grid, {1.25, 1.5, 2.5}) == Approx(3 + 0.75 + 6 * 0.75));
  // At the sides of the box is what is nearest; beyond them there is nothing.
  CHECK(in_world(*grid, {0.01, 0.01, 0.01}) == Approx(1));
  CHECK(in_world(*grid, {1.99, 2.99, 3.99}) == Approx(12));
  for (const Vec3d& outside : {Vec3d(-0.01, 1, 1), Vec3d(1, 3.01, 1), Vec3d(1, 1, 4.01)})
    CHECK(in_world(*grid, outside) == 0);
  VolFile colors;
  colors.x = 1;
  colors.y = colors.z = 2;
  colors.channels = 3;
  CHECK(in_world(*grid_of(colors.bytes()), {1, 0.1, 0.1}) == Approx(2));
}

TEST_CASE("what no .vol may be is refused, and says why") {
  const auto with = [](const auto& change) {
    VolFile file;
    change(file);
    return error_of(file);
  };
  CHECK(error_of(VolFile{}) == "none");
  CHECK(contains(error_of(""), "begins with VOL"));
  CHECK(contains(error_of("VOL"), "begins with VOL"));
  CHECK(contains(error_of(VolFile{}.bytes().substr(0, 47)), "ends within its header"));
  CHECK(contains(error_of(VolFile{}.bytes().substr(0, 95)), "ends before the last"));
  CHECK(contains(with([](VolFile& file) { file.magic[3] = 4; }), "version 4"));
  CHECK(contains(with([](VolFile& file) { file.magic[3] = '\xc8'; }), "version 200"));
  CHECK(contains(with([](VolFile& file) { file.type = 2; }), "type 2"));
  CHECK(contains(with([](VolFile& file) { file.channels = 2; }), "2 channels"));
  for (const std::int32_t lie : {0, -1, std::numeric_limits<std::int32_t>::min()})
    CHECK(contains(with([&](VolFile& file) { file.y = lie; }), "no points"));
  for (const std::int32_t lie : {3, 1 << 16, std::numeric_limits<std::int32_t>::max()})
    CHECK(contains(with([&](VolFile& file) { file.x = file.y = file.z = lie; }), "ends before the last"));
  for (const float number : {std::nanf(""), -std::nanf(""), HUGE_VALF, -HUGE_VALF})
    CHECK(contains(with([&](VolFile& file) { file.numbers[5] = number; }), "not finite"));
  CHECK(contains(with([](VolFile& file) { file.numbers[5] = 1e20F; }), "above 1e17"));
  for (const float number : {std::nanf(""), HUGE_VALF, 0.0F, -1.0F, 1e30F})
    CHECK(contains(with([&](VolFile& file) { file.box[3] = number; }), "the box in its header is none"));
  // Less than nothing is nothing.
  VolFile negative;
  negative.numbers.assign(12, -2);
  CHECK(grid_of(negative.bytes())->largest() == 0);
}

TEST_CASE("a lattice that is too large is refused before any memory is asked for") {
  GridTiles tiles;
  tiles.last = {1 << 30, 1 << 30, 1 << 30};
  CHECK_THROWS_AS(tiles.set_tiles(), GridError);
  DensityGrid::Lattice lattice;
  lattice.points = {1 << 20, 1 << 20, 1 << 20};
  CHECK_THROWS_AS(DensityGrid(lattice, 1, [](const auto&, float*) {}), GridError);
}

TEST_CASE("a .vol that is too large is refused by its header, which says what it has") {
  const TemporaryFolder folder;
  VolFile vol;
  vol.x = vol.y = 1;
  vol.z = 1 << 27;
  vol.numbers = {};
  write_text(folder.file("a.vol"), vol.bytes());
  std::filesystem::resize_file(folder.file("a.vol"), 48 + (std::uintmax_t{4} << 27U));  // zeros, which take no room
  try {
    read_vol_grid(folder.file("a.vol"), 2);
    FAIL("it was read");
  } catch (const GridError& error) {
    CHECK(contains(error.what(), "1 x 1 x 134217728 points, where the most are 16777216 cells"));
  }
}

TEST_CASE("bricks take no more memory than they may") {
  DensityGrid::Lattice lattice;
  lattice.points = {81, 81, 81};
  lattice.lower = Vec3d(0, 0, 0);
  lattice.upper = Vec3d(80, 80, 80);
  int filled = 0;
  const auto fill = [&](float other) {
    return [&filled, other](const std::array<int, 3>&, float* numbers) {
      ++filled;
      std::fill_n(numbers, DensityGrid::brick_numbers, 1.0F);
      numbers[0] = other;
    };
  };
  const std::uint64_t brick = 4 * DensityGrid::brick_numbers, all = 2 * 1000 * brick;
  CHECK(DensityGrid(lattice, 1, fill(2), all).bytes() > 1000 * brick);
  filled = 0;
  CHECK_THROWS_AS(DensityGrid(lattice, 1, fill(2), all / 10), GridError);
  CHECK(filled < 200);  // of 1000: it stops early
  CHECK_NOTHROW(DensityGrid(lattice, 1, fill(1), 0));
}

TEST_CASE("tiles of one number are kept once") {
  GridTiles tiles;
  std::array<float, GridTiles::tile_numbers> tile{};
  const auto add = [&](float number, float last) {
    tile.fill(number);
    tile.back() = last;
    tiles.add_tile(tile);
  };
  add(0, 0);
  add(2, 2);
  add(2, 2);
  add(2, 3);
  add(2, 2);
  add(4, 4);
  CHECK(tiles.places == std::vector<std::int32_t>{-1, 0, 0, 1, 0, 2});
  CHECK(tiles.numbers.size() == 3 * tile.size());
  tiles.most_bytes = 1 << 20;
  CHECK_THROWS_AS(([&] {
                    for (int i = 0; i < 1000; ++i) add(1, 2);
                  }()),
                  GridError);
}

TEST_CASE("tiles of OpenVDB are grids, with zeros around") {
  GridTiles tiles;
  tiles.first = {-9, 3, 6};
  tiles.last = {1, 4, 17};
  tiles.world_from_index = {{0.5, 0, 0}, {0, 0, 2}, {0, 1, 0}, {10, 20, 30}};
  tiles.set_tiles();
  CHECK(tiles.tiles == std::array<std::int64_t, 3>{3, 1, 3});
  const auto number = [](int x, int y, int z) { return static_cast<float>(1 + (x + 9) + 20 * y + 100 * z); };
  for (int z = 0; z < 3; ++z)
    for (int x = -2; x < 1; ++x) {
      // The last of them has zeros alone.
      const bool is_empty = z == 2 && x == 0;
      tiles.places.push_back(is_empty ? -1 : static_cast<std::int32_t>(tiles.numbers.size() / 512));
      for (int i = 0; i < (is_empty ? 0 : 512); ++i)
        tiles.numbers.push_back(number(x * 8 + i % 8, i / 8 % 8, z * 8 + i / 64));
    }
  const auto grid = grid_of_tiles(tiles, 1);
  const auto at_index = [&](double x, double y, double z) {
    return in_world(*grid, tiles.world_from_index.point(Vec3d(x, y, z)));
  };
  for (int z = 5; z <= 18; ++z)
    for (int y = 2; y <= 5; ++y)
      for (int x = -10; x <= 2; ++x) {
        const bool outside = x < -9 || x > 1 || y < 3 || y > 4 || z < 6 || z > 17 || (x >= 0 && z >= 16);
        INFO(x << ' ' << y << ' ' << z);
        CHECK(at_index(x, y, z) == Approx(outside ? 0 : number(x, y, z)).margin(1e-2));
      }
  CHECK(at_index(-9.5, 3, 8) == Approx(number(-9, 3, 8) / 2));
  CHECK(at_index(-10.01, 3, 8) == 0);
}

TEST_CASE("no density in a cell is beyond what the cell says") {
  std::mt19937 random(3);
  const auto share = [&] { return static_cast<double>(random()) * 0x1p-32; };
  for (int round = 0; round < 40; ++round) {
    VolFile file;
    file.x = 1 + static_cast<int>(random() % 20);
    file.y = 1 + static_cast<int>(random() % 20);
    file.z = 1 + static_cast<int>(random() % 20);
    file.numbers.clear();
    for (int i = 0; i < file.x * file.y * file.z; ++i)
      file.numbers.push_back(share() < 0.3 ? 0.0F : static_cast<float>(std::pow(share(), 6) * 1000));
    const auto grid = grid_of(file.bytes());
    const auto& cells = grid->cells();
    int brick_count = 0;
    for (int i = 0; i < 2000; ++i) {
      const Vec3d& upper = grid->lattice().upper;
      const Vec3d p(0.5 + share() * (upper.x - 0.5), 0.5 + share() * (upper.y - 0.5), 0.5 + share() * (upper.z - 0.5));
      const auto cell = [&](double place, std::size_t axis) {
        return std::min(static_cast<int>(place) / DensityGrid::cell_edge, cells[axis] - 1);
      };
      const auto row = cell(p.z, 2) * cells[1] + cell(p.y, 1);
      const auto place = row * cells[0] + cell(p.x, 0);
      const auto number = static_cast<std::size_t>(place);
      const double there = grid->at(p);
      CHECK(there <= double{grid->cells_largest()[number]});
      CHECK(there >= double{grid->cells_least()[number]});
      brick_count += grid->bricks()[number] >= 0;
    }
    if (file.x * file.y * file.z > 10) CHECK(brick_count > 0);
  }
}

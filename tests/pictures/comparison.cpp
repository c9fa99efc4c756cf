#include "pictures/comparison.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>

#include "raytrace/render/renderer.h"
#include "raytrace/sampling/pixel_sampler.h"
#include "reference/renderer.h"

namespace raytrace::test {

namespace {

using reference::Vector;

Vector absolute_difference(const Vector& a, const Vector& b) {
  return {std::fabs(a.x - b.x), std::fabs(a.y - b.y), std::fabs(a.z - b.z)};
}

std::string text_of(const Vector& v) {
  std::ostringstream text;
  text.precision(9);
  text << '(' << v.x << ' ' << v.y << ' ' << v.z << ')';
  return text.str();
}

/// Writes path.exr and path.png.
void save(const std::string& path, const Picture& picture) {
  OIIO::ImageBuf image(OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeDesc::FLOAT));
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const Vector v = picture.at(x, y);
      const float pixel[] = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
      image.setpixel(x, y, pixel);
    }
  }
  image.write(path + ".exr");
  OIIO::ImageBufAlgo::colorconvert(image, "linear", "sRGB").write(path + ".png", OIIO::TypeDesc::UINT8);
}

std::array<reference::Real, 2> first_sample(int x, int y, Dimension dimension) {
  const auto pixel = pixel_hash(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0);
  const ScrambledPoint<std::uint32_t> point = scrambled_point(pixel, std::uint32_t{0}, dimension);
  return {(point.x >> 8) * 0x1p-24L, (point.y >> 8) * 0x1p-24L};
}

}  // namespace

Picture library_picture(const SceneDescription& description, const std::string& isa) {
  const ViewPlane& plane = description.viewplane;
  const auto scene = build_scene(description, {1, isa});
  RayCounts rays;
  const Film film = render(*scene, description, {1, 0, {0, 0, plane.hres, plane.vres}}, rays);
  Picture picture{plane.hres, plane.vres, {}};
  for (const Pixel& pixel : film.pixels()) picture.pixels.push_back({pixel.red, pixel.green, pixel.blue});
  return picture;
}

void change_camera(reference::Scene& scene, unsigned seed) {
  using Projection = reference::Scene::Projection;
  scene.projection = std::array{Projection::thin_lens, Projection::fisheye, Projection::spherical}[seed % 3];
  const reference::Real distance = length(scene.eye - scene.look_at);
  scene.lens_radius = static_cast<float>(distance / 16);
  scene.focal_distance = static_cast<float>(distance * (seed % 2 == 0 ? 1 : 0.75L));
  scene.blades = seed % 4 < 2 ? 0 : static_cast<int>(3 + seed % 6);
  scene.blade_rotation = 17 * (static_cast<int>(seed) - 20);
  scene.angle = std::array{180, 360, 60, 270}[seed / 3 % 4];
  scene.lens_sample = [height = scene.vres](int column, int row) -> std::array<reference::Real, 2> {
    return first_sample(column, height - 1 - row, Dimension::lens);
  };
}

void set_time(reference::Scene& scene) {
  scene.time = [height = scene.vres](int column, int row) {
    return first_sample(column, height - 1 - row, time_dimension)[0];
  };
}

Picture reference_picture(const reference::Scene& scene) { return {scene.hres, scene.vres, reference::render(scene)}; }

double difference(const Vector& wanted, const Vector& got) {
  double largest = 0;
  for (const auto channel : {&Vector::x, &Vector::y, &Vector::z}) {
    const auto want = static_cast<double>(wanted.*channel), have = static_cast<double>(got.*channel);
    if (!std::isfinite(have)) return std::numeric_limits<double>::infinity();
    largest = std::fmax(largest, std::fabs(want - have) / std::fmax(1, std::fabs(want)));
  }
  return largest;
}

Comparison compare(const Picture& wanted, const Picture& got, double tolerance) {
  Comparison result;
  for (int y = 0; y < wanted.height; ++y) {
    for (int x = 0; x < wanted.width; ++x) {
      const double here = difference(wanted.at(x, y), got.at(x, y));
      result.differing += here > tolerance;
      if (here > result.worst) result = {result.differing, x, y, here};
    }
  }
  return result;
}

std::string save_evidence(const std::string& name, const Picture& wanted, const Picture& got,
                          const Comparison& comparison) {
  const auto folder = std::filesystem::current_path() / "failed-pictures";
  std::filesystem::create_directories(folder);
  Picture differences = wanted;
  for (std::size_t i = 0; i < wanted.pixels.size(); ++i) {
    differences.pixels[i] = absolute_difference(wanted.pixels[i], got.pixels[i]);
  }
  const std::string base = (folder / name).string();
  save(base + "-wanted", wanted);
  save(base + "-got", got);
  save(base + "-difference", differences);
  const int x = comparison.worst_x, y = comparison.worst_y;
  std::ostringstream message;
  message << comparison.differing << " of " << wanted.pixels.size() << " pixels differ; the worst, (" << x << ", " << y
          << ") from the top left, by " << comparison.worst << ": wanted " << text_of(wanted.at(x, y)) << ", got "
          << text_of(got.at(x, y)) << "\nsee " << base << "-{wanted,got,difference}.{exr,png}";
  return message.str();
}

}  // namespace raytrace::test

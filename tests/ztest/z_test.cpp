#include "z_test.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "raytrace/render/renderer.h"

namespace raytrace::test {

namespace {

const std::string folder = std::string(RAYTRACE_SOURCE_DIR) + "/tests/ztest/";

// Chances that equal pictures are refused: by Sidak's formula, that of one value follows.
constexpr double pixels_significance = 0.01, blocks_significance = 0.001;
// Nothing is known better. Of a sample, as Mitsuba's tests have it: of little variance where radiance is about 1. Of
// blocks, what floats in other places, edges of spotlights and suns that are not infinitely far make of a pixel.
constexpr double least_deviation = 0.01, block_tolerance = 0.0005;

Xyz xyz(const Pixel& p) {
  // The matrix of Mitsuba.
  const double r = p.red, g = p.green, b = p.blue;
  return {0.412453 * r + 0.357580 * g + 0.180423 * b, 0.212671 * r + 0.715160 * g + 0.072169 * b,
          0.019334 * r + 0.119193 * g + 0.950227 * b};
}

/// Means and errors of independent pictures.
MomentPicture moments(int width, int height, const std::vector<std::vector<Xyz>>& pictures) {
  const auto count = static_cast<double>(pictures.size());
  MomentPicture result{
      width, height, std::vector<Xyz>(pictures[0].size(), Xyz{}), {}, static_cast<int>(pictures.size())};
  result.error = result.mean;
  for (std::size_t i = 0; i < result.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0, squares = 0;
      for (const std::vector<Xyz>& picture : pictures) sum += picture[i][c];
      const double mean = sum / count;
      for (const std::vector<Xyz>& picture : pictures) squares += (picture[i][c] - mean) * (picture[i][c] - mean);
      result.mean[i][c] = mean;
      result.error[i][c] = std::sqrt(squares / (count * (count - 1)));
    }
  return result;
}

/// Each block's sums.
template <class Value>
std::vector<Xyz> block_sums(int width, int height, int edge, const Value& value) {
  const auto size = static_cast<std::size_t>(edge), across = static_cast<std::size_t>(width), columns = across / size;
  std::vector<Xyz> sums(columns * (static_cast<std::size_t>(height) / size), Xyz{});
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y)
    for (std::size_t x = 0; x < across; ++x)
      for (std::size_t c = 0; c < 3; ++c) sums[y / size * columns + x / size][c] += value(y * across + x, c);
  return sums;
}

struct Worst {
  int refused = 0;
  double z = 0;
  std::size_t index = 0, channel = 0;
};

template <class Floor>
Worst compared(const MomentPicture& reference, const MomentPicture& ours, double significance, const Floor& floor) {
  const double all = 3 * static_cast<double>(reference.mean.size());
  const double chance = -std::expm1(std::log1p(-significance) / all);
  Worst worst;
  for (std::size_t i = 0; i < reference.mean.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double a = reference.error[i][c] * reference.error[i][c], b = ours.error[i][c] * ours.error[i][c];
      const double least = floor(reference.mean[i][c]);
      // Welch's t-test. What is not estimated from differences is known.
      const double known = a + least * least,
                   freedom = (known + b) * (known + b) / std::max(b * b, 1e-300) * (ours.renders - 1);
      const double t = (ours.mean[i][c] - reference.mean[i][c]) / std::sqrt(known + b);
      const double z = std::isfinite(t) ? normal_deviate(t, std::min(freedom, 1e6)) : INFINITY;
      if (std::erfc(std::abs(z) / std::sqrt(2.0)) <= chance) ++worst.refused;
      if (std::abs(z) > std::abs(worst.z)) worst = {worst.refused, z, i, c};
    }
  return worst;
}

void report(std::ostream& out, int edge, const MomentPicture& reference, const MomentPicture& ours,
            const Worst& worst) {
  const std::size_t columns = static_cast<std::size_t>(reference.width), i = worst.index, c = worst.channel;
  const auto pixels = static_cast<std::size_t>(edge);
  out << edge << " x " << edge << " pixels: " << worst.refused << " of " << 3 * reference.mean.size()
      << " means are refused. Worst, z = " << worst.z << ": " << "XYZ"[c] << " at (" << i % columns * pixels << ", "
      << i / columns * pixels << "), from the upper left, is " << ours.mean[i][c] << " +- " << ours.error[i][c]
      << "; Mitsuba has " << reference.mean[i][c] << " +- " << reference.error[i][c] << "\n";
}

}  // namespace

double normal_deviate(double t, double freedom) {
  const double z = (8 * freedom + 1) / (8 * freedom + 3) * std::sqrt(freedom * std::log1p(t * t / freedom));
  return std::copysign(z, t);
}

MomentPicture mitsubas_picture(const std::string& scene) {
  const std::string file = folder + "references/" + scene + ".exr";
  const auto input = OIIO::ImageInput::open(file);
  if (!input) throw std::runtime_error(file + ": " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<float> values(static_cast<std::size_t>(spec.width * spec.height) * channels);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, values.data()))
    throw std::runtime_error(file + ": " + input->geterror());
  const int samples = spec.get_int_attribute("samples");
  if (samples < 2) throw std::runtime_error(file + ": of how many samples?");
  MomentPicture result{spec.width, spec.height, std::vector<Xyz>(values.size() / channels), {}, 0};
  result.error = result.mean;
  const std::array<std::string, 3> names{"X", "Y", "Z"};
  for (std::size_t c = 0; c < 3; ++c) {
    const int mean = spec.channelindex("mean." + names[c]), deviation = spec.channelindex("deviation." + names[c]);
    if (mean < 0 || deviation < 0) throw std::runtime_error(file + ": channels are missing");
    for (std::size_t i = 0; i < result.mean.size(); ++i) {
      result.mean[i][c] = double{values[i * channels + static_cast<std::size_t>(mean)]};
      result.error[i][c] = double{values[i * channels + static_cast<std::size_t>(deviation)]} / std::sqrt(samples);
    }
  }
  return result;
}

SceneDescription described_scene(const std::string& scene, const Edit& edit) {
  const std::string file = folder + "scenes/" + scene + ".xml";
  Diagnostics diagnostics(file);
  std::optional<SceneDescription> description;
  if (edit.from.empty()) {
    description = load_scene(file, diagnostics);
  } else {
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    const std::size_t place = text.find(edit.from);
    if (place == std::string::npos) throw std::runtime_error(file + " has no " + edit.from);
    description = parse_scene(text.replace(place, edit.from.size(), edit.to), diagnostics);
  }
  if (description && load_meshes(*description, diagnostics)) return std::move(*description);
  std::ostringstream message;
  diagnostics.print(message);
  throw std::runtime_error(message.str());
}

Renders::Renders(const SceneDescription& description, int count)
    : width_(description.viewplane.hres), height_(description.viewplane.vres) {
  const auto scene = build_scene(description, {});
  for (int seed = 1; seed <= count; ++seed) {
    RayCounts rays;
    RenderSettings settings;
    settings.seed = static_cast<std::uint64_t>(seed);
    std::vector<Xyz> picture;
    for (const Pixel& pixel : render(*scene, description, settings, rays).pixels()) picture.push_back(xyz(pixel));
    pictures_.push_back(std::move(picture));
  }
}

MomentPicture Renders::blocks(int edge) const {
  std::vector<std::vector<Xyz>> blocks;
  for (const std::vector<Xyz>& picture : pictures_)
    blocks.push_back(
        block_sums(width_, height_, edge, [&](std::size_t i, std::size_t c) { return picture[i][c] / (edge * edge); }));
  return moments(width_ / edge, height_ / edge, blocks);
}

void Renders::scale(double factor) {
  for (std::vector<Xyz>& picture : pictures_)
    for (Xyz& value : picture)
      for (double& channel : value) channel *= factor;
}

MomentPicture blocks_of(const MomentPicture& pixels, int edge) {
  const double area = edge * edge;
  const auto mean = [&](std::size_t i, std::size_t c) { return pixels.mean[i][c] / area; };
  const auto square = [&](std::size_t i, std::size_t c) { return std::pow(pixels.error[i][c] / area, 2); };
  MomentPicture result{pixels.width / edge, pixels.height / edge, {}, {}, pixels.renders};
  result.mean = block_sums(pixels.width, pixels.height, edge, mean);
  result.error = block_sums(pixels.width, pixels.height, edge, square);
  for (Xyz& error : result.error)
    for (double& channel : error) channel = std::sqrt(channel);
  return result;
}

Judgement z_test(const MomentPicture& reference, const Renders& renders) {
  Judgement judgement{true, {}};
  std::ostringstream out;
  for (const int edge : {1, 6, reference.width}) {
    const MomentPicture theirs = blocks_of(reference, edge), ours = renders.blocks(edge);
    if (ours.width != theirs.width || ours.height != theirs.height)
      throw std::runtime_error("pictures of different sizes");
    const double values = 3 * static_cast<double>(theirs.mean.size());
    const double pixel_floor = least_deviation / std::sqrt(ours.renders);
    const Worst worst = edge == 1 ? compared(theirs, ours, pixels_significance, [&](double) { return pixel_floor; })
                                  : compared(theirs, ours, blocks_significance,
                                             [](double mean) { return block_tolerance * std::abs(mean) + 1e-6; });
    if (worst.refused > (edge == 1 ? 0.0025 * values : 0)) judgement.equal = false;
    report(out, edge, theirs, ours, worst);
  }
  judgement.report = out.str();
  return judgement;
}

}  // namespace raytrace::test

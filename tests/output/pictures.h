// Pictures to write, and image files as read back.
#pragma once

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "raytrace/output/image_file.h"
#include "support/float_picture.h"

namespace raytrace::test {

/// Every pixel's channels differ from each other's and from all other pixels', and half holds them exactly.
inline FloatPicture distinct_film(int full_width, int full_height, const Region& region) {
  FloatPicture film(full_width, full_height, region);
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      const auto column = static_cast<float>(x), row = static_cast<float>(y);
      film.at(x, y) = {column / 64, row / 64, (column + 32 * row) / 2048, (column + row) / 256};
    }
  }
  return film;
}

inline FloatPicture distinct_film(int width, int height) { return distinct_film(width, height, {0, 0, width, height}); }

/// Noise in [0, 1), the same each time: hardly compressible.
inline FloatPicture noise_film(int width, int height) {
  FloatPicture film(width, height, {0, 0, width, height});
  std::uint32_t state = 1;
  const auto next = [&] {
    state = state * 1664525 + 1013904223;
    return static_cast<float>(state >> 8U) / 16777216.0F;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) film.at(x, y) = {next(), next(), next(), next()};
  }
  return film;
}

/// As for a film.
inline void fill_color(ImageBand& band, const FloatPicture& picture, int y0, int y1) {
  band.region = {picture.region().x0, y0, picture.region().x1, y1};
  band.planes.resize(std::max<std::size_t>(band.planes.size(), 4));
  const std::array<float Pixel::*, 4> channels = {&Pixel::red, &Pixel::green, &Pixel::blue, &Pixel::alpha};
  for (std::size_t i = 0; i < channels.size(); ++i) {
    std::vector<float> plane;
    for (int y = y0; y < y1; ++y) {
      for (int x = band.region.x0; x < band.region.x1; ++x) plane.push_back(picture.at(x, y).*channels[i]);
    }
    band.planes[i] = std::move(plane);
  }
}

inline ImageBand color_band(const FloatPicture& picture) {
  ImageBand band;
  fill_color(band, picture, picture.region().y0, picture.region().y1);
  return band;
}

inline Repairs write_image(const std::string& file, const FloatPicture& picture, const ImageMetadata& metadata,
                           const ImageFileSettings& settings) {
  ImageFile image(file, picture.extent(), color_channels(settings.full_float), metadata, settings);
  image.write(color_band(picture));
  return image.commit();
}

struct ReadPicture {
  OIIO::ImageSpec spec;
  std::vector<float> values;  ///< integers come as themselves over their largest

  float value(int column, int row, int channel) const {
    return values[(static_cast<std::size_t>(row) * static_cast<std::size_t>(spec.width) +
                   static_cast<std::size_t>(column)) *
                      static_cast<std::size_t>(spec.nchannels) +
                  static_cast<std::size_t>(channel)];
  }
};

inline ReadPicture read_picture(const std::string& file, const OIIO::ImageSpec* config = nullptr) {
  const auto input = OIIO::ImageInput::open(file, config);
  if (!input) throw std::runtime_error("cannot read " + file + ": " + OIIO::geterror());
  ReadPicture picture;
  picture.spec = input->spec();
  picture.values.resize(static_cast<std::size_t>(picture.spec.image_pixels()) *
                        static_cast<std::size_t>(picture.spec.nchannels));
  if (!input->read_image(0, 0, 0, picture.spec.nchannels, OIIO::TypeFloat, picture.values.data())) {
    throw std::runtime_error("cannot read the pixels of " + file + ": " + input->geterror());
  }
  return picture;
}

/// The values as the file has them; straight colour is not multiplied by alpha.
template <class Integer>
std::vector<Integer> integers(const std::string& file, const OIIO::TypeDesc& type) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  const auto input = OIIO::ImageInput::open(file, &config);
  if (!input || input->spec().format != type) throw std::runtime_error(file + " holds other integers");
  std::vector<Integer> values(static_cast<std::size_t>(input->spec().image_pixels()) *
                              static_cast<std::size_t>(input->spec().nchannels));
  input->read_image(0, 0, 0, input->spec().nchannels, type, values.data());
  return values;
}

inline ImageMetadata some_metadata() {
  ImageMetadata metadata;
  metadata.software = "raytrace 1.2.3";
  metadata.scene_file = "folder/scene.xml";
  metadata.samples = 16;
  metadata.seed = 18446744073709551615U;
  metadata.threads = 3;
  metadata.render_seconds = 12.5;
  for (int i = 0; i < 16; ++i) {
    metadata.camera.world_to_camera[i] = static_cast<float>(i) + 0.1F;
    metadata.camera.world_to_ndc[i] = -static_cast<float>(i);
  }
  return metadata;
}

}  // namespace raytrace::test

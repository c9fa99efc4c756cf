#include "raytrace/output/denoised_picture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>
#include <variant>

#include "raytrace/film/light_pass.h"
#include "raytrace/parameters/light_group.h"

namespace raytrace {

namespace {

constexpr std::size_t colors = 3;

std::size_t plane_of(const std::vector<Channel>& channels, const std::string& name) {
  const auto found =
      std::find_if(channels.begin(), channels.end(), [&](const Channel& channel) { return channel.name == name; });
  return static_cast<std::size_t>(found - channels.begin());
}

/// The name of the part of the light whose first channel it is; else nothing.
std::string_view layer_of(const Channel& channel) {
  std::string_view name = channel.name;
  if (!name.ends_with(".R")) return {};
  name.remove_suffix(2);
  const bool is_pass =
      std::find(std::begin(light_pass_names), std::end(light_pass_names), name) != std::end(light_pass_names);
  return is_pass || name.starts_with(light_aov_prefix) ? name : std::string_view();
}

/// The first channels of parts of the light.
std::vector<std::size_t> layers_among(const std::vector<Channel>& channels) {
  std::vector<std::size_t> layers;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (!layer_of(channels[i]).empty()) layers.push_back(i);
  return layers;
}

}  // namespace

std::vector<Channel> noisy_channels(const std::vector<Channel>& channels, bool transparent) {
  std::vector<Channel> noisy(channels.begin(), channels.begin() + (transparent ? colors + 1 : colors));
  for (const std::size_t layer : layers_among(channels))
    for (std::size_t channel = 0; channel < colors; ++channel) noisy.push_back(channels[layer + channel]);
  for (Channel& channel : noisy) channel.name = "noisy." + channel.name;
  return noisy;
}

DenoisedPicture::DenoisedPicture(const Region& region, const std::vector<Channel>& channels, bool transparent)
    : region_(region),
      albedo_(plane_of(channels, std::string(denoiser_aovs[0]) + ".R")),
      normal_(plane_of(channels, std::string(denoiser_aovs[1]) + ".X")),
      layers_(layers_among(channels)) {
  picture_.width = region.width();
  picture_.height = region.height();
  const std::size_t numbers = colors * region.pixels();
  for (std::vector<float>* const pixels : {&picture_.color, &picture_.albedo, &picture_.normal})
    pixels->resize(numbers);
  if (transparent) picture_.alpha.resize(numbers);
  for (const std::size_t layer : layers_)
    are_groups_.push_back(layer_of(channels[layer]).starts_with(light_aov_prefix));
  picture_.layers.assign(layers_.size(), std::vector<float>(numbers));
}

std::size_t DenoisedPicture::begin_of(const ImageBand& band) const { return region_.index(region_.x0, band.region.y0); }

void DenoisedPicture::copy(const ImageBand& band, std::size_t plane, std::size_t channel,
                           std::vector<float>& pixels) const {
  const auto& values = std::get<std::vector<float>>(band.planes[plane]);
  const std::size_t begin = begin_of(band);
  for (std::size_t i = 0; i < values.size(); ++i) pixels[colors * (begin + i) + channel] = values[i];
}

void DenoisedPicture::add(const ImageBand& band) {
  for (std::size_t channel = 0; channel < colors; ++channel) {
    copy(band, channel, channel, picture_.color);
    copy(band, albedo_ + channel, channel, picture_.albedo);
    copy(band, normal_ + channel, channel, picture_.normal);
    if (!picture_.alpha.empty()) copy(band, colors, channel, picture_.alpha);
    for (std::size_t i = 0; i < layers_.size(); ++i) copy(band, layers_[i] + channel, channel, picture_.layers[i]);
  }
}

bool DenoisedPicture::denoise(int threads, const std::function<bool()>& stop) {
  const std::vector<std::uint8_t> even = even_alpha();
  std::vector<float> noisy_alpha;
  for (std::size_t i = 0; i < picture_.alpha.size(); i += colors) noisy_alpha.push_back(picture_.alpha[i]);
  const bool are_light = layers_are_light();
  std::vector<std::vector<std::size_t>> wholes;
  for (const bool of_groups : {false, true})
    if (std::vector<std::size_t> some = layers_of(of_groups); add_up(some)) wholes.push_back(std::move(some));
  std::vector<std::vector<float>> noisy_layers;
  if (!are_light) noisy_layers.swap(picture_.layers);
  auto clean = denoised(std::move(picture_), threads, stop);
  picture_ = {};
  if (!clean) return false;
  picture_.color = std::move(clean->color);
  picture_.layers = std::move(are_light ? clean->layers : noisy_layers);
  if (are_light)
    for (const std::vector<std::size_t>& layers : wholes) scale(layers);
  picture_.alpha.resize(noisy_alpha.size());
  for (std::size_t pixel = 0; pixel < noisy_alpha.size(); ++pixel)
    picture_.alpha[pixel] =
        even[pixel] != 0 ? noisy_alpha[pixel] : std::clamp(clean->alpha[colors * pixel], 0.0F, 1.0F);
  return true;
}

bool DenoisedPicture::layers_are_light() const {
  return std::all_of(picture_.layers.begin(), picture_.layers.end(), [](const std::vector<float>& layer) {
    return std::all_of(layer.begin(), layer.end(), [](float value) { return value >= 0; });
  });
}

std::vector<std::size_t> DenoisedPicture::layers_of(bool of_groups) const {
  std::vector<std::size_t> layers;
  for (std::size_t i = 0; i < are_groups_.size(); ++i)
    if (are_groups_[i] == of_groups) layers.push_back(i);
  return layers;
}

float DenoisedPicture::sum_of(const std::vector<std::size_t>& layers, std::size_t number) const {
  float sum = 0;
  for (const std::size_t layer : layers) sum += picture_.layers[layer][number];
  return sum;
}

bool DenoisedPicture::add_up(const std::vector<std::size_t>& layers) const {
  for (std::size_t i = 0; i < picture_.color.size(); ++i)
    // Colours may be half floats.
    if (!(std::abs(sum_of(layers, i) - picture_.color[i]) <= 2e-3F * std::abs(picture_.color[i]) + 1e-6F)) return false;
  return true;
}

void DenoisedPicture::scale(const std::vector<std::size_t>& layers) {
  for (std::size_t i = 0; i < picture_.color.size(); ++i) {
    const float sum = sum_of(layers, i), scale = sum > 0 ? picture_.color[i] / sum : 1;
    if (std::isfinite(scale))
      for (const std::size_t layer : layers) picture_.layers[layer][i] *= scale;
  }
}

/// Of each pixel, whether all within two pixels of it have alpha 0, or all have 1.
std::vector<std::uint8_t> DenoisedPicture::even_alpha() const {
  constexpr int reach = 2;
  const int width = picture_.width, height = picture_.height;
  std::vector<std::uint8_t> even;
  if (picture_.alpha.empty()) return even;
  const auto alpha = [&](int x, int y) {
    return picture_
        .alpha[colors * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x))];
  };
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float wanted = alpha(x, y);
      bool all = wanted == 0 || wanted == 1;
      for (int v = std::max(0, y - reach); all && v <= std::min(height - 1, y + reach); ++v)
        for (int u = std::max(0, x - reach); all && u <= std::min(width - 1, x + reach); ++u)
          all = alpha(u, v) == wanted;
      even.push_back(all ? 1 : 0);
    }
  return even;
}

void DenoisedPicture::put_into(ImageBand& band) const {
  const std::size_t begin = begin_of(band), noisy = band.planes.size();
  const std::size_t planes = colors + (picture_.alpha.empty() ? 0 : 1);
  const auto keep = [&](std::size_t first, std::size_t count) {
    for (std::size_t plane = first; plane < first + count; ++plane) band.planes.push_back(band.planes[plane]);
  };
  keep(0, planes);
  for (const std::size_t layer : layers_) keep(layer, colors);
  const auto values = [&](std::size_t plane) { return std::get<std::vector<float>>(band.planes[plane]).data(); };
  const std::size_t pixels = std::get<std::vector<float>>(band.planes[0]).size();
  const auto replace = [&](std::size_t plane, std::size_t noisy_plane, const std::vector<float>& clean) {
    for (std::size_t channel = 0; channel < colors; ++channel) {
      float* const shown = values(plane + channel);
      const float* const kept = values(noisy_plane + channel);
      for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
        const bool is_empty = planes > colors && values(colors)[pixel] == 0;
        if (!is_empty || kept[pixel] != 0) shown[pixel] = clean[colors * (begin + pixel) + channel];
      }
    }
  };
  if (planes > colors) std::copy_n(picture_.alpha.begin() + static_cast<std::ptrdiff_t>(begin), pixels, values(colors));
  replace(0, noisy, picture_.color);
  for (std::size_t i = 0; i < layers_.size(); ++i) replace(layers_[i], noisy + planes + i * colors, picture_.layers[i]);
}

}  // namespace raytrace

#include "raytrace/output/denoised_picture.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <variant>

namespace raytrace {

namespace {

constexpr std::size_t colors = 3;

std::size_t plane_of(const std::vector<Channel>& channels, const std::string& name) {
  const auto found =
      std::find_if(channels.begin(), channels.end(), [&](const Channel& channel) { return channel.name == name; });
  return static_cast<std::size_t>(found - channels.begin());
}

}  // namespace

std::vector<Channel> noisy_channels(bool full_float, bool transparent) {
  std::vector<Channel> channels = color_channels(full_float);
  if (!transparent) channels.pop_back();
  for (Channel& channel : channels) channel.name = "noisy." + channel.name;
  return channels;
}

DenoisedPicture::DenoisedPicture(const Region& region, const std::vector<Channel>& channels, bool transparent)
    : region_(region),
      albedo_(plane_of(channels, std::string(denoiser_aovs[0]) + ".R")),
      normal_(plane_of(channels, std::string(denoiser_aovs[1]) + ".X")) {
  picture_.width = region.width();
  picture_.height = region.height();
  const std::size_t numbers = colors * region.pixels();
  for (std::vector<float>* const pixels : {&picture_.color, &picture_.albedo, &picture_.normal})
    pixels->resize(numbers);
  if (transparent) picture_.alpha.resize(numbers);
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
  }
}

bool DenoisedPicture::denoise(int threads, const std::function<bool()>& stop) {
  const std::vector<std::uint8_t> even = even_alpha();
  std::vector<float> noisy_alpha;
  for (std::size_t i = 0; i < picture_.alpha.size(); i += colors) noisy_alpha.push_back(picture_.alpha[i]);
  auto clean = denoised(std::move(picture_), threads, stop);
  picture_ = {};
  if (!clean) return false;
  picture_.color = std::move(clean->color);
  picture_.alpha.resize(noisy_alpha.size());
  for (std::size_t pixel = 0; pixel < noisy_alpha.size(); ++pixel)
    picture_.alpha[pixel] =
        even[pixel] != 0 ? noisy_alpha[pixel] : std::clamp(clean->alpha[colors * pixel], 0.0F, 1.0F);
  return true;
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
  for (std::size_t plane = 0; plane < planes; ++plane) band.planes.push_back(band.planes[plane]);
  const auto values = [&](std::size_t plane) { return std::get<std::vector<float>>(band.planes[plane]).data(); };
  const std::size_t pixels = std::get<std::vector<float>>(band.planes[0]).size();
  for (std::size_t pixel = 0; pixel < pixels; ++pixel) {
    if (planes > colors) values(colors)[pixel] = picture_.alpha[begin + pixel];
    const bool is_empty = planes > colors && values(colors)[pixel] == 0;
    for (std::size_t channel = 0; channel < colors; ++channel)
      if (!is_empty || values(noisy + channel)[pixel] != 0)
        values(channel)[pixel] = picture_.color[colors * (begin + pixel) + channel];
  }
}

}  // namespace raytrace

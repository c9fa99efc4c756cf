#include "raytrace/output/denoised_picture.h"

#include <algorithm>
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

const std::vector<float>& floats(const ImageBand& band, std::size_t plane) {
  return std::get<std::vector<float>>(band.planes[plane]);
}

}  // namespace

std::vector<Channel> noisy_channels(bool full_float) {
  std::vector<Channel> channels = color_channels(full_float);
  channels.resize(colors);
  for (Channel& channel : channels) channel.name = "noisy." + channel.name;
  return channels;
}

DenoisedPicture::DenoisedPicture(const Region& region, const std::vector<Channel>& channels)
    : region_(region),
      albedo_(plane_of(channels, std::string(denoiser_aovs[0]) + ".R")),
      normal_(plane_of(channels, std::string(denoiser_aovs[1]) + ".X")) {
  picture_.width = region.width();
  picture_.height = region.height();
  const std::size_t numbers =
      colors * static_cast<std::size_t>(region.width()) * static_cast<std::size_t>(region.height());
  for (std::vector<float>* const pixels : {&picture_.color, &picture_.albedo, &picture_.normal})
    pixels->resize(numbers);
}

void DenoisedPicture::copy(const ImageBand& band, std::size_t first_plane, std::vector<float>& pixels) const {
  const std::size_t begin =
      static_cast<std::size_t>(band.region.y0 - region_.y0) * static_cast<std::size_t>(region_.width());
  for (std::size_t i = 0; i < colors; ++i) {
    const std::vector<float>& plane = floats(band, first_plane + i);
    for (std::size_t pixel = 0; pixel < plane.size(); ++pixel) pixels[colors * (begin + pixel) + i] = plane[pixel];
  }
}

void DenoisedPicture::add(const ImageBand& band) {
  copy(band, 0, picture_.color);
  copy(band, albedo_, picture_.albedo);
  copy(band, normal_, picture_.normal);
}

bool DenoisedPicture::denoise(int threads, const std::function<bool()>& stop) {
  auto clean = denoised(std::move(picture_), threads, stop);
  picture_ = {};
  if (clean) picture_.color = std::move(*clean);
  return clean.has_value();
}

void DenoisedPicture::put_into(ImageBand& band) const {
  const std::size_t begin =
      static_cast<std::size_t>(band.region.y0 - region_.y0) * static_cast<std::size_t>(region_.width());
  for (std::size_t i = 0; i < colors; ++i) {
    band.planes.push_back(band.planes[i]);
    auto& plane = std::get<std::vector<float>>(band.planes[i]);
    for (std::size_t pixel = 0; pixel < plane.size(); ++pixel)
      plane[pixel] = picture_.color[colors * (begin + pixel) + i];
  }
}

}  // namespace raytrace

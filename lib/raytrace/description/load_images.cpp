#include "raytrace/description/load_images.h"

#include <array>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "raytrace/math/content_hash.h"
#include "raytrace/memory/file_mapping.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/output/image_file.h"
#include "raytrace/output/picture.h"
#include "raytrace/text/message.h"
#include "raytrace/textures/udim.h"

namespace raytrace {
namespace {

std::string hash_of(std::string_view bytes) {
  ContentHash hash;
  hash.add(bytes.data(), bytes.size());
  return hash.digits();
}

/// Throws PictureError for what is no regular file.
void refuse_no_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw PictureError("there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw PictureError("it is no file");
}

/// Throws PictureError or PhotometryError.
LoadedPhotometry load_photometry(const std::filesystem::path& file) {
  constexpr std::streamsize most_bytes = 64 << 20;
  refuse_no_file(file);
  std::ifstream stream(file, std::ios::binary);
  if (!stream.is_open()) throw PictureError("it cannot be read");
  std::string text(std::size_t{most_bytes} + 1, '\0');
  stream.read(text.data(), most_bytes + 1);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) throw PictureError("it cannot be read");
  if (stream.gcount() > most_bytes) throw PictureError("it is larger than 64 MiB");
  return {hash_of(text), std::make_shared<const Photometry>(read_photometry(text))};
}

/// Of the file's bytes. Throws PictureError.
std::string file_hash(const std::filesystem::path& file) {
  refuse_no_file(file);
  std::ifstream stream(file, std::ios::binary);
  ContentHash hash;
  std::string bytes(std::size_t{1} << 20U, '\0');
  while (stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || stream.gcount() > 0)
    hash.add(bytes.data(), static_cast<std::size_t>(stream.gcount()));
  if (!stream.is_open() || stream.bad()) throw PictureError("it cannot be read");
  return hash.digits();
}

/// Whether an image's use as a colour, and as a number, is sRGB.
std::array<bool, 2> is_srgb(ColorSpace space, TexelFormat format) {
  if (space == ColorSpace::automatic) return {format == TexelFormat::bytes, false};
  return {space == ColorSpace::srgb, space == ColorSpace::srgb};
}

class ImageLoader {
 public:
  /// taken: bytes of texels that are in memory already.
  ImageLoader(int threads, std::optional<std::uint64_t> memory, std::uint64_t taken)
      : threads_(threads), memory_(memory.value_or(available_memory() / 2)), taken_(taken) {}

  /// bytes: of the file; null: they are read. used: as a colour, as a number. Throws PictureError.
  LoadedImage load(const Image::Parameters& image, const std::string* bytes, const std::array<bool, 2>& used) {
    const std::string& file = image.file.path;
    LoadedImage loaded{bytes != nullptr ? hash_of(*bytes) : file_hash(file), nullptr, nullptr};
    std::optional<Picture> picture;
    const auto need_picture = [&] {
      if (!picture) picture = bytes != nullptr ? decode_picture(*bytes) : read_picture(file);
      return picture->format;
    };
    const auto known = formats_.find(loaded.hash);
    const TexelFormat format =
        known != formats_.end() ? known->second : formats_.emplace(loaded.hash, need_picture()).first->second;
    const std::array<bool, 2> srgb = is_srgb(image.colorspace, format);
    const std::array<std::shared_ptr<const TexelImage>*, 2> wanted{&loaded.color, &loaded.number};
    for (std::size_t use = 0; use < 2; ++use) {
      if (!used[use]) continue;
      auto& texels = texels_[{loaded.hash, srgb[use]}];
      if (!texels) {
        need_picture();
        texels = kept(TexelImage(*picture, srgb[use], threads_));
      }
      *wanted[use] = texels;
    }
    return loaded;
  }

  /// The same of the files of tiles.
  LoadedImage load_tiles(const Image::Parameters& image, const std::array<bool, 2>& used) {
    const std::vector<UdimTile> files = find_udim_tiles(image.file.path);
    if (files.empty()) throw PictureError("there is no file of a tile, whose number would be from 1001 to 9999");
    const auto of_tile = [](const UdimTile& tile, const auto& f) {
      try {
        return f();
      } catch (const PictureError& error) {
        throw PictureError("tile " + std::to_string(tile.number()) + ": " + error.what());
      }
    };
    ContentHash hash;
    for (const UdimTile& tile : files) {
      const std::string of_file =
          std::to_string(tile.number()) + ' ' + of_tile(tile, [&] { return file_hash(tile.file); }) + ' ';
      hash.add(of_file.data(), of_file.size());
    }
    LoadedImage loaded{hash.digits(), nullptr, nullptr};
    const std::array<std::shared_ptr<const TexelImage>*, 2> wanted{&loaded.color, &loaded.number};
    for (std::size_t use = 0; use < 2; ++use) {
      if (!used[use]) continue;
      auto& texels = tiles_[{loaded.hash, image.colorspace, image.colorspace == ColorSpace::automatic ? use : 0}];
      if (!texels) {
        std::vector<TexelImage::Tile> tiles;
        for (const UdimTile& tile : files) {
          const Picture picture = of_tile(tile, [&] { return read_picture(tile.file); });
          const bool srgb = is_srgb(image.colorspace, picture.format)[use];
          tiles.push_back({tile.column, tile.row, TexelImage(picture, srgb, threads_)});
        }
        texels = kept(TexelImage::of_tiles(std::move(tiles)));
        if (texels->format() != TexelFormat::bytes) tiles_[{loaded.hash, image.colorspace, 1 - use}] = texels;
      }
      *wanted[use] = texels;
    }
    return loaded;
  }

  /// Why texels that have no room in memory are in memory nonetheless; empty if none are.
  const std::string& failure() const { return failure_; }

 private:
  std::shared_ptr<const TexelImage> kept(TexelImage image) {
    taken_ += image.bytes();
    if (taken_ > memory_ && failure_.empty()) {
      try {
        image.move_to_file(folder_for_large_files());
        taken_ -= image.bytes();
      } catch (const std::system_error& error) {
        failure_ = error.what();
      }
    }
    return std::make_shared<const TexelImage>(std::move(image));
  }

  int threads_;
  std::uint64_t memory_, taken_;
  std::string failure_;
  std::map<std::string, TexelFormat> formats_;                                        ///< by hash
  std::map<std::pair<std::string, bool>, std::shared_ptr<const TexelImage>> texels_;  ///< by hash and colour space
  /// By hash, colour space and use.
  std::map<std::tuple<std::string, ColorSpace, std::size_t>, std::shared_ptr<const TexelImage>> tiles_;
};

/// For each image, whether materials use it as a colour, and as a number.
std::vector<std::array<bool, 2>> image_uses(const SceneDescription& scene) {
  std::vector<std::array<bool, 2>> uses(std::get<TextureItems<Image>>(scene.textures).size());
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    const Fields& fields = element_type<T>().fields;
    for (const auto& item : std::get<MaterialItems<T>>(scene.materials))
      for (const TextureUse& use : item.textures)
        if (use.texture.type == index_of<Image>(Textures{}))
          uses[use.texture.index][fields[use.field].template is<double>() ? 1 : 0] = true;
  });
  return uses;
}

/// Of the texels of images that are loaded.
std::uint64_t loaded_bytes(const SceneDescription& scene) {
  std::set<const TexelImage*> images;
  for (const TextureItem<Image>& item : std::get<TextureItems<Image>>(scene.textures))
    images.insert({item.image.color.get(), item.image.number.get()});
  std::uint64_t bytes = 0;
  for (const TexelImage* const image : images)
    if (image != nullptr) bytes += image->bytes();
  return bytes;
}

}  // namespace

bool load_images(SceneDescription& scene, Diagnostics& diagnostics, int threads, const TextureSettings& settings) {
  diagnostics.add_files(scene.included);
  ImageLoader loader(threads, settings.memory, loaded_bytes(scene));
  bool fine = true;
  /// what: the image is for. Textures may have tiles.
  const auto load = [&](std::string_view what, const Image::Parameters& parameters, const std::array<bool, 2>& used,
                        const std::string& name, std::uint32_t line, LoadedImage& image) {
    const FileName& file = parameters.file;
    if (!image.hash.empty()) return;
    try {
      const bool has_tiles = what == "texture" && !image.bytes && is_udim(file.path);
      image = has_tiles ? loader.load_tiles(parameters, used) : loader.load(parameters, image.bytes.get(), used);
    } catch (const std::runtime_error& error) {
      const bool warns = settings.missing == MissingTexture::warn;
      fine = fine && warns;
      const SourceLocation location = file.line > 0 ? SourceLocation{file.line, file.column} : SourceLocation{line, 0};
      diagnostics.add(warns ? Severity::warning : Severity::error, location,
                      "the " + std::string(what) + " " + in_quotes(name) + " cannot be used: " + error.what() +
                          (warns ? "; it is magenta" : ""));
      if (warns) image = {"missing", TexelImage::of_color(255, 0, 255), TexelImage::of_color(255, 0, 255)};
    }
  };
  // Where there are errors, materials may name textures that were refused.
  const auto uses = diagnostics.has_errors()
                        ? std::vector<std::array<bool, 2>>(std::get<TextureItems<Image>>(scene.textures).size())
                        : image_uses(scene);
  std::size_t i = 0;
  for (TextureItem<Image>& item : std::get<TextureItems<Image>>(scene.textures)) {
    const std::string& file = item.parameters.file.path;
    const std::string name = item.imported ? std::filesystem::path(file).filename().string() : file;
    load("texture", item.parameters, uses[i++], name, item.line, item.image);
  }
  for (LightItem<EnvironmentLight>& item : std::get<LightItems<EnvironmentLight>>(scene.lights))
    if (!item.parameters.file.path.empty())
      load("environment", {item.parameters.file}, {true, false}, item.parameters.file.path, item.line, item.image);
  for_each_type(Lights{}, [&]<class Light>(std::type_identity<Light>) {
    for (auto& item : std::get<LightItems<Light>>(scene.lights))
      if constexpr (requires { item.photometry; }) {
        const FileName& file = item.parameters.iesfile;
        if (file.path.empty() || !item.photometry.hash.empty()) continue;
        try {
          item.photometry = load_photometry(file.path);
        } catch (const std::runtime_error& error) {
          fine = false;
          diagnostics.add(Severity::error,
                          file.line > 0 ? SourceLocation{file.line, file.column} : SourceLocation{item.line, 0},
                          "the IES file " + in_quotes(file.path) + " cannot be used: " + error.what());
        }
      }
  });
  if (!loader.failure().empty())
    diagnostics.warning(
        {}, "textures stay in memory, beyond the limit, for there is no room for them in files: " + loader.failure());
  return fine;
}

}  // namespace raytrace

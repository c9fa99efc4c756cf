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

#include "raytrace/description/holds_normals.h"
#include "raytrace/description/load_grids.h"
#include "raytrace/description/made_picture.h"
#include "raytrace/description/read_pictures.h"
#include "raytrace/description/refine_mesh.h"
#include "raytrace/import/specular_glossiness.h"
#include "raytrace/math/content_hash.h"
#include "raytrace/memory/file_mapping.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/output/image_file.h"
#include "raytrace/output/picture.h"
#include "raytrace/parallel/for_each_index.h"
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

/// Of what it follows from.
std::string hash_of(const SpecularGlossiness& from) {
  ContentHash hash;
  for (const SpecularGlossiness::Source& source : {from.diffuse, from.specular}) {
    const std::string digits = source.bytes          ? hash_of(*source.bytes)
                               : source.file.empty() ? std::string(32, '-')
                                                     : naming(source, [&] { return file_hash(source.file); });
    hash.add(digits.data(), digits.size());
  }
  for (const double factor :
       {from.diffuse_factor.red, from.diffuse_factor.green, from.diffuse_factor.blue, from.specular_factor.red,
        from.specular_factor.green, from.specular_factor.blue, from.glossiness_factor, from.is_color ? 1.0 : 0.0})
    hash.add(&factor, sizeof factor);
  return hash.digits();
}

std::string hash_of(const LoadedImage& image, const std::string& file) {
  if (image.made_of) return hash_of(*image.made_of);
  return image.bytes ? hash_of(*image.bytes) : file_hash(file);
}

/// Whether an image's use as a colour, and as a number, is sRGB.
std::array<bool, 2> is_srgb(ColorSpace space, TexelFormat format) {
  if (space == ColorSpace::automatic) return {format == TexelFormat::bytes, false};
  return {space == ColorSpace::srgb, space == ColorSpace::srgb};
}

/// An image that is to be loaded.
struct ImageTask {
  std::string_view what;  ///< what it is for
  Image::Parameters image;
  std::array<bool, 2> used;  ///< as a colour, as a number
  std::string_view unread;   ///< what it is if it cannot be read, and need not be
  std::string name;
  SourceLocation location;
  LoadedImage* loaded;

  std::string hash{};
  std::exception_ptr error{};

  /// Textures may have tiles.
  bool has_tiles() const { return what == "texture" && !loaded->bytes && !loaded->made_of && is_udim(image.file.path); }
};

class ImageLoader {
 public:
  /// taken: bytes of texels that are in memory already.
  ImageLoader(int threads, std::optional<std::uint64_t> memory, std::uint64_t taken)
      : threads_(threads), memory_(memory.value_or(available_memory() / 2)), taken_(taken) {}

  /// Calls fail(task) in the handler of what was thrown for a task that cannot be loaded.
  template <class Fail>
  void load(std::vector<ImageTask>& tasks, const Fail& fail) {
    for_each_index(static_cast<int>(tasks.size()), threads_, [&](int i) {
      ImageTask& task = tasks[static_cast<std::size_t>(i)];
      try {
        if (!task.has_tiles()) task.hash = hash_of(*task.loaded, task.image.file.path);
      } catch (...) {
        task.error = std::current_exception();
      }
    });
    std::set<std::string> being_read;  // hashes
    const auto open = [&](std::size_t i) -> std::unique_ptr<PictureReader> {
      const ImageTask& task = tasks[i];
      if (task.error) std::rethrow_exception(task.error);
      if (task.has_tiles() || has_texels(task) || !being_read.insert(task.hash).second) return nullptr;
      return open_picture_of(task);
    };
    read_pictures(tasks.size(), threads_, memory_ahead(), open, [&](std::size_t i, const PictureResult& result) {
      const ImageTask& task = tasks[i];
      being_read.erase(task.hash);
      try {
        const Picture* const picture = result.get();
        *task.loaded = task.has_tiles() ? load_tiles(task) : load_picture(task, picture);
      } catch (const std::runtime_error& error) {
        fail(task, error);
      }
    });
  }

  /// Why texels that have no room in memory are in memory nonetheless; empty if none are.
  const std::string& failure() const { return failure_; }

 private:
  /// For pictures beside the texels.
  std::uint64_t memory_ahead() const { return memory_ / 4; }

  static std::unique_ptr<PictureReader> open_picture_of(const ImageTask& task) {
    if (task.loaded->made_of) return open_made_picture(*task.loaded->made_of);
    return task.loaded->bytes ? open_encoded_picture(*task.loaded->bytes) : open_picture(task.image.file.path);
  }

  /// Whether all that the task wants has been made for an earlier one.
  bool has_texels(const ImageTask& task) const {
    const auto format = formats_.find(task.hash);
    if (format == formats_.end()) return false;
    const std::array<bool, 2> srgb = is_srgb(task.image.colorspace, format->second);
    for (std::size_t use = 0; use < 2; ++use)
      if (task.used[use] && !texels_.contains({task.hash, srgb[use]})) return false;
    return true;
  }

  /// read: the picture, if it has been. Throws PictureError.
  LoadedImage load_picture(const ImageTask& task, const Picture* read) {
    LoadedImage loaded{task.hash, nullptr, nullptr};
    std::optional<Picture> read_again;
    if (read == nullptr && !has_texels(task)) read = &read_again.emplace(open_picture_of(task)->read());
    if (read != nullptr) formats_.emplace(task.hash, read->format);
    const std::array<bool, 2> srgb = is_srgb(task.image.colorspace, formats_.at(task.hash));
    const std::array<std::shared_ptr<const TexelImage>*, 2> wanted{&loaded.color, &loaded.number};
    for (std::size_t use = 0; use < 2; ++use) {
      if (!task.used[use]) continue;
      auto& texels = texels_[{task.hash, srgb[use]}];
      if (!texels) texels = kept(TexelImage(*read, srgb[use], threads_));
      *wanted[use] = texels;
    }
    return loaded;
  }

  /// The same of the files of tiles.
  LoadedImage load_tiles(const ImageTask& task) {
    const Image::Parameters& image = task.image;
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
      if (!task.used[use]) continue;
      auto& texels = tiles_[{loaded.hash, image.colorspace, image.colorspace == ColorSpace::automatic ? use : 0}];
      if (!texels) {
        std::vector<TexelImage::Tile> tiles;
        read_pictures(
            files.size(), threads_, memory_ahead(), [&](std::size_t i) { return open_picture(files[i].file); },
            [&](std::size_t i, const PictureResult& result) {
              const Picture& picture = *of_tile(files[i], [&] { return result.get(); });
              const bool srgb = is_srgb(image.colorspace, picture.format)[use];
              tiles.push_back({files[i].column, files[i].row, TexelImage(picture, srgb, threads_)});
            });
        texels = kept(TexelImage::of_tiles(std::move(tiles)));
        if (texels->format() != TexelFormat::bytes) tiles_[{loaded.hash, image.colorspace, 1 - use}] = texels;
      }
      *wanted[use] = texels;
    }
    return loaded;
  }

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

struct ImageUses {
  std::array<bool, 2> in_materials{};  ///< as a colour, and as a number
  bool moves = false;                  ///< it displaces a mesh

  std::array<bool, 2> all() const { return {in_materials[0], in_materials[1] || moves}; }
  std::string_view unread() const {
    if (!moves) return "it is magenta";
    return in_materials[0] || in_materials[1] ? "it is magenta, and moves nothing" : "it moves nothing";
  }
};

/// What the scene uses each image for.
std::vector<ImageUses> image_uses(const SceneDescription& scene) {
  std::vector<ImageUses> uses(std::get<TextureItems<Image>>(scene.textures).size());
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    const Fields& fields = element_type<T>().fields;
    for (const auto& item : std::get<MaterialItems<T>>(scene.materials))
      for (const TextureUse& use : item.textures)
        if (use.texture.type == index_of<Image>(Textures{}))
          uses[use.texture.index].in_materials[fields[use.field].template is<double>() ? 1 : 0] = true;
  });
  for_each_displacement(scene, [&](const TextureUse& use) {
    if (use.texture.type == index_of<Image>(Textures{})) uses[use.texture.index].moves = true;
  });
  return uses;
}

/// Of those that have just been loaded.
void warn_of_heights(const SceneDescription& scene, const std::vector<bool>& is_new, Diagnostics& diagnostics) {
  const auto& images = std::get<TextureItems<Image>>(scene.textures);
  for_each_type(Materials{}, [&]<class T>(std::type_identity<T>) {
    const Fields& fields = element_type<T>().fields;
    for (const auto& item : std::get<MaterialItems<T>>(scene.materials))
      for (const TextureUse& use : item.textures) {
        const std::string_view field = fields[use.field].name;
        if (field != normalmap_field && field != coatnormalmap_field) continue;
        if (use.texture.type != index_of<Image>(Textures{}) || !is_new[use.texture.index]) continue;
        const auto& image = images[use.texture.index];
        if (image.image.number == nullptr || !is_grey(*image.image.number)) continue;
        diagnostics.warning(location_of(item),
                            "the normal map of the material " + in_quotes(item.name) + ", " +
                                in_quotes(std::filesystem::path(image.parameters.file.path).filename().string()) +
                                ", is grey, as heights are: it slants the surface; normals can be baked from heights, "
                                "and a <bump> has them as they are");
      }
  });
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
  // Where there are errors, materials may name textures that were refused.
  const auto uses = diagnostics.has_errors()
                        ? std::vector<ImageUses>(std::get<TextureItems<Image>>(scene.textures).size())
                        : image_uses(scene);
  std::vector<ImageTask> tasks;
  std::size_t i = 0;
  for (TextureItem<Image>& item : std::get<TextureItems<Image>>(scene.textures)) {
    const std::string& file = item.parameters.file.path;
    const std::string name = item.imported ? std::filesystem::path(file).filename().string() : file;
    tasks.push_back(
        {"texture", item.parameters, uses[i].all(), uses[i].unread(), name, location_of(item), &item.image});
    ++i;
  }
  for (LightItem<EnvironmentLight>& item : std::get<LightItems<EnvironmentLight>>(scene.lights))
    if (const FileName& file = item.parameters.file; !file.path.empty()) {
      Image::Parameters picture;
      picture.file = file;
      tasks.push_back(
          {"environment", picture, {true, false}, ImageUses{}.unread(), file.path, location_of(item), &item.image});
    }
  std::vector<bool> is_new(uses.size());
  for (std::size_t image = 0; image < uses.size(); ++image) is_new[image] = tasks[image].loaded->hash.empty();
  std::erase_if(tasks, [](const ImageTask& task) { return !task.loaded->hash.empty(); });
  loader.load(tasks, [&](const ImageTask& task, const std::runtime_error& error) {
    const FileName& file = task.image.file;
    const bool warns = settings.missing == MissingTexture::warn;
    fine = fine && warns;
    const SourceLocation location = file.line > 0 ? location_of(file) : task.location;
    diagnostics.add(warns ? Severity::warning : Severity::error, location,
                    "the " + std::string(task.what) + " " + in_quotes(task.name) + " cannot be used: " + error.what() +
                        (warns ? "; " + std::string(task.unread) : ""));
    if (warns)
      *task.loaded = {std::string(missing_image), TexelImage::of_color(255, 0, 255), TexelImage::of_color(255, 0, 255)};
  });
  if (!diagnostics.has_errors()) warn_of_heights(scene, is_new, diagnostics);
  for_each_type(Lights{}, [&]<class Light>(std::type_identity<Light>) {
    for (auto& item : std::get<LightItems<Light>>(scene.lights))
      if constexpr (requires { item.photometry; }) {
        const FileName& file = item.parameters.iesfile;
        if (file.path.empty() || !item.photometry.hash.empty()) continue;
        try {
          item.photometry = load_photometry(file.path);
        } catch (const std::runtime_error& error) {
          fine = false;
          diagnostics.add(Severity::error, file.line > 0 ? location_of(file) : location_of(item),
                          "the IES file " + in_quotes(file.path) + " cannot be used: " + error.what());
        }
      }
  });
  fine &= load_grids(scene, diagnostics, threads, [](const std::string& file) { return file_hash(file); });
  if (!loader.failure().empty())
    diagnostics.warning(
        {}, "textures stay in memory, beyond the limit, for there is no room for them in files: " + loader.failure());
  return fine;
}

}  // namespace raytrace

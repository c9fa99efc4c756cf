// The picture of an image texture, and ever smaller ones of it (mip maps), in the form that look-ups want.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/memory/file_mapping.h"
#include "raytrace/memory/large_array.h"
#include "raytrace/output/picture.h"
#include "raytrace/textures/udim.h"

namespace raytrace {

/// Texels keep the format of the file. Rows count from the bottom. Texels of each 4 x 4 lie together, so that those of
/// one look-up are in one or two cache lines. Immutable.
class TexelImage {
 public:
  static constexpr std::int32_t block_edge = 4, block_texels = block_edge * block_edge;

  /// A picture half as wide and high as the one before, rounded down; the last has one texel.
  struct Level {
    std::int32_t width, height;
    std::int32_t blocks;  ///< a row
    std::int32_t first;   ///< the number of its first texel among all
  };

  /// srgb: its colours are sRGB's. Each texel of a smaller picture is the mean of what it covers of the larger one, in
  /// linear light. threads: so many at most share the work. Throws std::bad_alloc.
  TexelImage(const Picture& picture, bool srgb, int threads);

  /// One of several pictures, each of which covers a unit of u and v.
  struct Tile;
  static constexpr int tile_columns = udim_columns;

  /// Of such tiles. Throws PictureError if their numbers have different formats or are too many.
  static TexelImage of_tiles(std::vector<Tile> tiles);

  /// Of one opaque colour.
  static std::shared_ptr<const TexelImage> of_color(std::uint8_t red, std::uint8_t green, std::uint8_t blue);

  TexelFormat format() const { return format_; }
  int channels() const { return channels_; }  ///< 1 or 4
  bool has_alpha() const { return has_alpha_; }
  /// Of a picture, or of one tile after the other, which then have the same number of levels.
  const std::vector<Level>& levels() const { return levels_; }
  int levels_of_picture() const { return levels_of_picture_; }
  /// For each place, in rows of tile_columns, the number of its tile's first level, or -1; empty: one picture is all.
  const std::vector<std::int32_t>& tiles() const { return tiles_; }
  const std::byte* texels() const { return in_file_.data() != nullptr ? in_file_.data() : texels_.data(); }
  /// Of the texels.
  std::size_t bytes() const;
  /// Puts the texels into a file in that folder, from which the system reads those that are used. Throws
  /// std::system_error; then they stay where they are.
  void move_to_file(const std::string& folder);
  /// Whether colours are sRGB's, as those of bytes may be; else they are linear light.
  bool srgb() const { return srgb_; }
  /// No number is larger by magnitude.
  float largest() const { return largest_; }

  /// The number of a texel among all.
  static std::int64_t index(const Level& level, std::int32_t x, std::int32_t y) {
    const std::int64_t block = std::int64_t{y / block_edge} * level.blocks + x / block_edge;
    const std::int64_t in_block = std::int64_t{y % block_edge} * block_edge + x % block_edge;
    return level.first + block * block_texels + in_block;
  }

 private:
  TexelImage() = default;
  std::size_t texel_count() const;

  template <class Numbers>
  void fill(const Picture& picture, const Numbers& numbers, int threads);
  template <class Numbers>
  void fill_level(std::size_t level, const Numbers& numbers, int threads);

  TexelFormat format_ = TexelFormat::bytes;
  int channels_ = 0;
  bool has_alpha_ = false;
  std::vector<Level> levels_;
  int levels_of_picture_ = 0;
  std::vector<std::int32_t> tiles_{};
  LargeArray<std::byte> texels_;  ///< or else
  FileMapping in_file_;
  bool srgb_ = false;
  float largest_ = 1;
};

struct TexelImage::Tile {
  int column, row;
  TexelImage image;
};

struct SpecularGlossiness;  // import/specular_glossiness.h

/// What the file of an image texture has.
struct LoadedImage {
  std::string hash;  ///< of its bytes; empty: it has not been loaded
  /// For where it is used as a colour, and as a number; the same if both mean the same.
  std::shared_ptr<const TexelImage> color, number;
  /// Until it is loaded: the bytes, where they are within another file.
  std::shared_ptr<const std::string> bytes{};
  std::shared_ptr<const SpecularGlossiness> made_of{};  ///< what it follows from, where it is in no file
};

}  // namespace raytrace

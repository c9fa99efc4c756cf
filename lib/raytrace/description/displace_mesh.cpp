#include "raytrace/description/displace_mesh.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "raytrace/description/load_images.h"
#include "raytrace/import/unique_items.h"
#include "raytrace/import/vertex_normals.h"
#include "raytrace/memory/large_array.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/text/message.h"
#include "raytrace/textures/texture_value.h"

namespace raytrace {

namespace {

/// What a texture is looked up by.
enum class LookUp { first_uvs, second_uvs, space, nothing };

LookUp look_up(const Image::Parameters& image) {
  return image.uvset == UvSet::first ? LookUp::first_uvs : LookUp::second_uvs;
}
LookUp look_up(const Checker::Parameters& checker) {
  if (checker.scale > 0) return LookUp::space;
  return checker.uvset == UvSet::first ? LookUp::first_uvs : LookUp::second_uvs;
}
LookUp look_up(const Noise::Parameters&) { return LookUp::space; }
LookUp look_up(const VertexColor::Parameters&) { return LookUp::nothing; }

/// None where the texture has nothing that could move a vertex.
template <class Texture>
std::optional<TextureValue> value_of(const TextureItem<Texture>& item, const TexturePlace& place) {
  if constexpr (std::is_same_v<Texture, Image>) {
    if (item.image.hash == missing_image || item.image.number == nullptr) return std::nullopt;
    return height_value(item.parameters, *item.image.number, place);
  } else {
    return texture_value(item.parameters, place);
  }
}

/// The longest edges at each vertex: of texture coordinates, along u and along v; of positions, their length.
class EdgeWidths {
 public:
  EdgeWidths(const MeshData& mesh, const float* values, std::size_t size, int threads)
      : size_(size == 2 ? 2 : 1), widths_(LargeArray<std::uint32_t>::zeros(size_ * mesh.vertex_count())) {
    const auto corners = static_cast<std::size_t>(mesh.corners);
    for_each_item(mesh.indices.size(), threads, [&](std::size_t i) {
      const std::size_t a = mesh.indices[i];
      const std::size_t b = mesh.indices[i % corners + 1 < corners ? i + 1 : i + 1 - corners];
      if (size == 2) {
        for (std::size_t k = 0; k < 2; ++k) add(a, b, k, std::abs(values[2 * a + k] - values[2 * b + k]));
      } else {
        double square = 0;
        for (std::size_t k = 0; k < 3; ++k) {
          const double way = double{values[3 * a + k]} - double{values[3 * b + k]};
          square += way * way;
        }
        add(a, b, 0, static_cast<float>(std::sqrt(square)));
      }
    });
  }

  double at(std::size_t vertex, std::size_t k) const { return std::bit_cast<float>(widths_[size_ * vertex + k]); }

 private:
  // The bits of floats that are not negative are in their order.
  void add(std::size_t a, std::size_t b, std::size_t k, float width) {
    if (!(width > 0)) return;
    const auto bits = std::bit_cast<std::uint32_t>(width);
    for (const std::size_t vertex : {a, b}) {
      std::atomic_ref entry(widths_[size_ * vertex + k]);
      std::uint32_t known = entry.load(std::memory_order_relaxed);
      while (known < bits && !entry.compare_exchange_weak(known, bits, std::memory_order_relaxed)) continue;
    }
  }

  std::size_t size_;
  LargeArray<std::uint32_t> widths_;
};

/// The mean of the values of items that are the same, which does not depend on the order of threads: sums are of whole
/// numbers.
class Means {
 public:
  Means(const UniqueItems& items, const LargeArray<double>& values, int threads)
      : sums_(LargeArray<std::int64_t>::zeros(items.first.size())),
        counts_(LargeArray<std::uint32_t>::zeros(items.first.size())) {
    const std::size_t count = items.number.size();
    std::vector<double> largest(chunk_count(count));
    for_each_chunk(count, threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last; ++i) largest[chunk] = std::max(largest[chunk], std::abs(values[i]));
    });
    const double most = *std::max_element(largest.begin(), largest.end());
    // Room for as many terms as there are items.
    unit_ = std::ldexp(1.0, std::ilogb(std::max(most, 1e-300)) + 1 + static_cast<int>(std::bit_width(count)) - 62);
    for_each_item(count, threads, [&](std::size_t i) {
      const auto term = static_cast<std::int64_t>(std::llrint(values[i] / unit_));
      std::atomic_ref(sums_[items.number[i]]).fetch_add(term, std::memory_order_relaxed);
      std::atomic_ref(counts_[items.number[i]]).fetch_add(1, std::memory_order_relaxed);
    });
  }

  double of(std::uint32_t number) const { return static_cast<double>(sums_[number]) * unit_ / counts_[number]; }

 private:
  LargeArray<std::int64_t> sums_;
  LargeArray<std::uint32_t> counts_;
  double unit_ = 1;
};

class Displacer {
 public:
  Displacer(MeshData& mesh, const Displacement& displacement, int threads)
      : mesh_(mesh), displacement_(displacement), threads_(threads) {}

  template <class Texture>
  std::optional<std::string> run(const TextureItem<Texture>& texture) {
    const LookUp by = look_up(texture.parameters);
    const bool by_uvs = by == LookUp::first_uvs || by == LookUp::second_uvs;
    if (by_uvs && mesh_.uvs.empty())
      return "has no texture coordinates, by which its displacement looks up the texture " + in_quotes(texture.name);
    const MeshBuffer<float>& uvs = by == LookUp::second_uvs && !mesh_.uvs2.empty() ? mesh_.uvs2 : mesh_.uvs;
    auto values = LargeArray<double>::unset(mesh_.vertex_count());
    {
      const EdgeWidths widths(mesh_, by_uvs ? uvs.data() : mesh_.positions.data(), by_uvs ? 2 : 3, threads_);
      std::atomic<bool> is_number{true};
      for_each_item(mesh_.vertex_count(), threads_, [&](std::size_t i) {
        TexturePlace place;
        if (by_uvs) {
          place.sets[0] = {{uvs[2 * i], uvs[2 * i + 1]}, {widths.at(i, 0), widths.at(i, 1)}};
          place.sets[1] = place.sets[0];
        } else {
          place.point =
              Vec3d(mesh_.positions[3 * i], mesh_.positions[3 * i + 1], mesh_.positions[3 * i + 2]) + mesh_.origin;
          place.width = widths.at(i, 0);
        }
        if (!mesh_.colors.empty())
          place.vertex_color = {mesh_.colors[3 * i], mesh_.colors[3 * i + 1], mesh_.colors[3 * i + 2]};
        if (!mesh_.alphas.empty()) place.vertex_alpha = mesh_.alphas[i];
        const std::optional<TextureValue> value = value_of(texture, place);
        values[i] = value ? (*value)[static_cast<std::size_t>(displacement_.texture.channel)] : displacement_.midlevel;
        if (!std::isfinite(values[i])) is_number = false;
      });
      if (!is_number)
        return "cannot be displaced: the texture " + in_quotes(texture.name) + " has a value that is not finite";
    }
    return move(values);
  }

 private:
  std::optional<std::string> move(const LargeArray<double>& values) {
    const std::size_t count = mesh_.vertex_count();
    const MeshBuffer<float> normals = vertex_normals(mesh_, mesh_.positions.data(), threads_);
    const UniqueItems places = unique_positions(mesh_.positions.data(), count, threads_);
    const Means means(places, values, threads_);
    std::atomic<bool> is_near{true};
    for_each_item(count, threads_, [&](std::size_t i) {
      const double way = displacement_.height * (means.of(places.number[i]) - displacement_.midlevel);
      for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
        const double moved = double{mesh_.positions[k]} + double{normals[k]} * way;
        constexpr double farthest = 1e18;  // as mesh_data.h has it
        if (!(std::abs(moved) <= farthest)) is_near = false;
        mesh_.positions[k] = static_cast<float>(std::clamp(moved, -farthest, farthest));
      }
    });
    mesh_.normals = {};
    mesh_.tangents = {};
    if (!is_near) return std::string("would be displaced beyond 1e18");
    return std::nullopt;
  }

  MeshData& mesh_;
  const Displacement& displacement_;
  int threads_;
};

}  // namespace

std::optional<std::string> displace(MeshData& mesh, const SceneDescription& scene, const Displacement& displacement,
                                    int threads) {
  const TextureReference& texture = displacement.texture.texture;
  return with_type(Textures{}, texture.type, [&]<class Texture>(std::type_identity<Texture>) {
    const auto& item = std::get<TextureItems<Texture>>(scene.textures).at(texture.index);
    return Displacer(mesh, displacement, threads).run(item);
  });
}

}  // namespace raytrace

// https://github.com/KhronosGroup/glTF/blob/main/extensions/2.0/Vendor/EXT_meshopt_compression/README.md, and
// KHR_meshopt_compression beside it, which adds a filter for colours.
#include "raytrace/import/gltf_meshopt.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "raytrace/import/gltf_material.h"

#if defined(RAYTRACE_MESHOPTIMIZER)
#include <meshoptimizer.h>
#endif

namespace raytrace::gltf {
namespace {

constexpr const char* meshopt_names[] = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

template <class Value, std::size_t count>
Value choice_of(const Item& item, const std::pair<std::string_view, Value> (&values)[count]) {
  std::string all;
  for (const auto& [name, value] : values) {
    if (item.text() == name) return value;
    all += (all.empty() ? "" : ", ") + std::string(name);
  }
  item.fail("is none of " + all);
}

#if defined(RAYTRACE_MESHOPTIMIZER)

// The filters are not the library's: its results differ between processors, which the extension allows them.

/// Calls f with all arrays of four values, which it changes.
template <class T, class Function>
void for_each_four(std::string& bytes, const Function& f) {
  std::array<T, 4> values{};
  for (std::size_t at = 0; at + sizeof values <= bytes.size(); at += sizeof values) {
    std::memcpy(values.data(), bytes.data() + at, sizeof values);
    f(values);
    std::memcpy(bytes.data() + at, values.data(), sizeof values);
  }
}

/// A value from -1 to 1, or from 0 to 1, as an integer is normalized.
template <class T>
T normalized_integer(double value) {
  const double least = std::is_signed_v<T> ? -1 : 0;
  return static_cast<T>(std::round(std::clamp(value, least, 1.0) * double{std::numeric_limits<T>::max()}));
}

template <class T>
void unfold_octahedra(std::string& bytes) {
  for_each_four<T>(bytes, [](std::array<T, 4>& v) {
    const double one = std::max<T>(v[2], 1);
    double x = v[0] / one, y = v[1] / one;
    const double z = 1 - std::abs(x) - std::abs(y), fold = std::min(z, 0.0);
    x -= std::copysign(fold, x);
    y -= std::copysign(fold, y);
    const double scale = 1 / std::sqrt(x * x + y * y + z * z);
    v = {normalized_integer<T>(x * scale), normalized_integer<T>(y * scale), normalized_integer<T>(z * scale), v[3]};
  });
}

void complete_quaternions(std::string& bytes) {
  for_each_four<std::int16_t>(bytes, [](std::array<std::int16_t, 4>& v) {
    const int last = v[3];
    const double unit = std::max(last | 3, 1) * std::sqrt(2.0);
    const double x = v[0] / unit, y = v[1] / unit, z = v[2] / unit;
    const double w = std::sqrt(std::max(0.0, 1 - x * x - y * y - z * z));
    const auto largest = static_cast<std::size_t>(last & 3);
    v[(largest + 1) % 4] = normalized_integer<std::int16_t>(x);
    v[(largest + 2) % 4] = normalized_integer<std::int16_t>(y);
    v[(largest + 3) % 4] = normalized_integer<std::int16_t>(z);
    v[largest] = normalized_integer<std::int16_t>(w);
  });
}

void scale_by_exponents(std::string& bytes) {
  for_each_four<std::uint8_t>(bytes, [](std::array<std::uint8_t, 4>& v) {
    const auto word = std::bit_cast<std::int32_t>(v);
    const std::int32_t mantissa = static_cast<std::int32_t>(static_cast<std::uint32_t>(word) << 8U) >> 8;
    v = std::bit_cast<std::array<std::uint8_t, 4>>(std::ldexp(static_cast<float>(mantissa), word >> 24));
  });
}

/// Of luma and two differences of colour, of as many bits as the last value has.
template <class T>
void restore_colors(std::string& bytes) {
  for_each_four<T>(bytes, [](std::array<T, 4>& v) {
    using Signed = std::make_signed_t<T>;
    const int first_bit = std::bit_floor(std::max<T>(v[3], 1));
    const double most = 2 * first_bit - 1;
    const double y = v[0], orange = static_cast<Signed>(v[1]), green = static_cast<Signed>(v[2]);
    const int alpha = v[3] & (first_bit - 1);
    v = {normalized_integer<T>((y + orange - green) / most), normalized_integer<T>((y + green) / most),
         normalized_integer<T>((y - orange - green) / most), normalized_integer<T>((2 * alpha + (alpha & 1)) / most)};
  });
}

void apply_filter(MeshoptLayout::Filter filter, std::size_t stride, std::string& bytes) {
  using Filter = MeshoptLayout::Filter;
  switch (filter) {
    case Filter::octahedral:
      return stride == 4 ? unfold_octahedra<std::int8_t>(bytes) : unfold_octahedra<std::int16_t>(bytes);
    case Filter::quaternion:
      return complete_quaternions(bytes);
    case Filter::exponential:
      return scale_by_exponents(bytes);
    case Filter::color:
      return stride == 4 ? restore_colors<std::uint8_t>(bytes) : restore_colors<std::uint16_t>(bytes);
    case Filter::none:
      break;
  }
}

#endif

}  // namespace

bool is_meshopt_extension(std::string_view name) {
  return std::any_of(std::begin(meshopt_names), std::end(meshopt_names), [&](const char* of) { return name == of; });
}

std::string meshopt_version() {
#if defined(RAYTRACE_MESHOPTIMIZER)
  return "meshoptimizer " + std::to_string(MESHOPTIMIZER_VERSION / 1000) + '.' +
         std::to_string(MESHOPTIMIZER_VERSION % 1000 / 10);
#else
  return {};
#endif
}

std::optional<MeshoptLayout> meshopt_layout(const Item& view) {
  using Mode = MeshoptLayout::Mode;
  using Filter = MeshoptLayout::Filter;
  static constexpr std::pair<std::string_view, Mode> modes[] = {
      {"ATTRIBUTES", Mode::attributes}, {"TRIANGLES", Mode::triangles}, {"INDICES", Mode::indices}};
  static constexpr std::pair<std::string_view, Filter> filters[] = {{"NONE", Filter::none},
                                                                    {"OCTAHEDRAL", Filter::octahedral},
                                                                    {"QUATERNION", Filter::quaternion},
                                                                    {"EXPONENTIAL", Filter::exponential},
                                                                    {"COLOR", Filter::color}};
  if (!can_read_meshopt()) return std::nullopt;
  std::optional<Item> found;
  for (const char* const name : meshopt_names)
    if (!found) found = extension(view, name);
  if (!found) return std::nullopt;
  MeshoptLayout layout{*found};
  const Item& item = layout.compressed;
  layout.count = item["count"].whole();
  const Item stride = item["byteStride"];
  layout.stride = stride.whole();
  layout.mode = choice_of(item["mode"], modes);
  const std::optional<Item> filter = item.find("filter");
  if (filter) layout.filter = choice_of(*filter, filters);

  const bool is_of_attributes = layout.mode == Mode::attributes;
  if (is_of_attributes ? layout.stride % 4 != 0 || layout.stride < 4 || layout.stride > 256
                       : layout.stride != 2 && layout.stride != 4)
    stride.fail(is_of_attributes ? "is no multiple of 4 from 4 to 256" : "is neither 2 nor 4");
  if (layout.mode == Mode::triangles && layout.count % 3 != 0) item["count"].fail("is no multiple of 3");
  if (layout.filter != Filter::none && !is_of_attributes) filter->fail("is of ATTRIBUTES alone");
  if (layout.filter == Filter::quaternion && layout.stride != 8) stride.fail("is not 8, as QUATERNION has it");
  if ((layout.filter == Filter::octahedral || layout.filter == Filter::color) && layout.stride > 8)
    stride.fail("is neither 4 nor 8, as " + filter->text() + " has it");
  if (layout.count > std::numeric_limits<std::uint32_t>::max() || view["byteLength"].whole() != layout.size())
    view.fail("its byteLength is not " + std::to_string(layout.count) + " times " + std::to_string(layout.stride) +
              ", as it has where it is compressed");
  return layout;
}

std::string meshopt_decoded(const MeshoptLayout& layout, [[maybe_unused]] std::string_view bytes) {
#if defined(RAYTRACE_MESHOPTIMIZER)
  std::string decoded(layout.size(), '\0');
  const auto* const from = reinterpret_cast<const unsigned char*>(bytes.data());
  using Mode = MeshoptLayout::Mode;
  const int error = layout.mode == Mode::attributes
                        ? meshopt_decodeVertexBuffer(decoded.data(), layout.count, layout.stride, from, bytes.size())
                    : layout.mode == Mode::triangles
                        ? meshopt_decodeIndexBuffer(decoded.data(), layout.count, layout.stride, from, bytes.size())
                        : meshopt_decodeIndexSequence(decoded.data(), layout.count, layout.stride, from, bytes.size());
  if (error != 0)
    layout.compressed.fail("its data is damaged, or of a kind that " + meshopt_version() + " does not read");
  apply_filter(layout.filter, layout.stride, decoded);
  return decoded;
#else
  layout.compressed.fail("cannot be read without meshoptimizer");
#endif
}

}  // namespace raytrace::gltf

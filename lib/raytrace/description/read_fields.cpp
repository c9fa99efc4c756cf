#include "raytrace/description/read_fields.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

#include "raytrace/description/scene_layout.h"

namespace raytrace {
namespace {

/// Bit i: the element has a child infos[i].
std::uint64_t present_fields(Element element, std::span<const FieldInfo> infos) {
  std::uint64_t present = 0;
  for (Node node = element.first_child(); node; node = node.next()) {
    const std::size_t i = node.element() ? find_field(infos, node.element().name()) : infos.size();
    if (i < infos.size()) present |= std::uint64_t(1) << i;
  }
  return present;
}

/// Names of other programs, and the field that stands for them here.
struct Synonym {
  std::string_view name, field;
  std::string_view note{};  ///< ", which ..."
};
constexpr Synonym synonyms[] = {
    {"bumpmap", "bump"},
    {"normal", "normalmap"},
    {"filename", "file"},
    {"spp", "samples"},
    {"metallic", "base_metalness"},
    {"sheen", "fuzz_weight"},
    {"clearcoat", "coat_weight"},
    {"transmission", "transmission_weight"},
    {"intensity", "scaleradiance"},
    {"power", "scaleradiance"},
    {"radiance", "scaleradiance"},
    {"wrapu", "wrap"},
    {"wraps", "wrap"},
    {"wrapt", "wrapv"},
    {"near", "nearclip"},
    {"clip_start", "nearclip"},
    {"lensshift", "shift"},
    {"shift_x", "shift"},
    {"shift_y", "shift"},
    {"width", "hres"},
    {"height", "vres"},
    {"extinction", "meanfreepath", ", which is 1 / extinction"},
    {"aperture", "lensradius"},
    {"focusdistance", "focaldistance"},
};

const Synonym* find_synonym(std::string_view name, std::span<const FieldInfo> infos) {
  for (const Synonym& synonym : synonyms)
    if (synonym.name == name && find_field(infos, synonym.field) < infos.size()) return &synonym;
  return nullptr;
}

/// "<thinlenscamera> has <lensradius>", for a camera that has not; empty if none has it, or this one.
std::string other_camera_with(std::string_view name, std::string_view camera) {
  std::string found;
  bool lacks_it = false;  // what is no camera does not
  for_each_type(Cameras{}, [&]<class T>(std::type_identity<T>) {
    if (T::element == camera) lacks_it = true;
    const Fields fields = fields_in_files<T>();
    for (const Field& field : fields) {
      const bool is_it =
          field.name == name || std::any_of(std::begin(synonyms), std::end(synonyms),
                                            [&](const auto& s) { return s.name == name && s.field == field.name; });
      if (is_it && T::element == camera) lacks_it = false;
      if (found.empty() && is_it) found = tag(T::element) + " has " + tag(field.name);
    }
  });
  return lacks_it ? found : std::string();
}

/// That of the fields which the unknown name stands for or is misspelt of; it is absent.
std::string_view meant_field(std::span<const FieldInfo> infos, std::uint64_t present, std::string_view name) {
  if (const Synonym* const synonym = find_synonym(name, infos))
    if (!(present >> find_field(infos, synonym->field) & 1)) return synonym->field;
  return nearest_absent(infos, present, name);
}

std::string explain_unknown(Element child, Element parent, std::span<const FieldInfo> infos, std::string_view nearest) {
  const std::string start = "unknown element " + tag(child.name()) + " in " + tag(parent.name()) + "; ";
  const auto& steps = TransformStep::elements;
  if (std::find(steps.begin(), steps.end(), child.name()) != steps.end() &&
      find_field(infos, transform_element) < infos.size())
    return start + "put it into " + tag(transform_element);
  if (const std::string other = other_camera_with(child.name(), parent.name()); !other.empty()) return start + other;
  if (!nearest.empty()) {
    const Synonym* const synonym = find_synonym(child.name(), infos);
    return start + "did you mean " + tag(nearest) + std::string(synonym != nullptr ? synonym->note : "") + "?";
  }
  std::vector<std::string_view> names, longer;
  for (const FieldInfo& info : infos) names.push_back(info.name);
  // A name may lack its first word, as OpenPBR's "metalness", or its last one.
  const auto add_longer = [&](auto&& is_meant) {
    constexpr std::size_t few = 4;
    for (const std::string_view name : names)
      if (longer.size() < few && is_meant(name)) longer.push_back(name);
  };
  const std::string last = '_' + std::string(child.name()), first = std::string(child.name()) + '_';
  add_longer([&](std::string_view name) { return name.ends_with(last); });
  if (longer.empty()) add_longer([&](std::string_view name) { return name.starts_with(first); });
  if (longer.empty()) return start + "it takes " + list_of_tags(names);
  return start + "did you mean " + list_of_tags(longer, "or") + "?";
}

}  // namespace

bool read_fields(Element element, std::span<const FieldInfo> infos, std::span<const FieldTarget> targets,
                 const ReadContext& context, std::vector<FieldTexture>* textures) {
  Diagnostics& diagnostics = context.diagnostics;
  const std::size_t errors_before = diagnostics.error_count();
  refuse_attributes(element, infos, diagnostics);
  std::uint64_t read = 0;  // bit i: infos[i]
  std::optional<std::uint64_t> present;
  for (Node node = element.first_child(); node; node = node.next()) {
    if (refuse_text(node, element, diagnostics)) continue;
    const Element child = node.element();
    const std::size_t i = find_field(infos, child.name());
    if (i < infos.size()) {
      const std::uint64_t bit = std::uint64_t(1) << i;
      if (read & bit) {
        diagnostics.error(child, [&] {
          return "a second " + tag(infos[i].name) + " in " + tag(element.name()) + "; the first one is in " +
                 diagnostics.line_name(element.child(infos[i].name).line(), child.line());
        });
      } else {
        FieldTexture texture{i, {}, child};
        const bool takes_texture = textures != nullptr && !infos[i].is_constant;
        if (read_value(child, infos[i], targets[i], context, takes_texture ? &texture.attributes : nullptr) &&
            !texture.attributes.texture.empty())
          textures->push_back(texture);
      }
      read |= bit;
      continue;
    }
    std::string_view nearest;
    if (diagnostics.keeps_another(Severity::error)) {
      if (!present) present = present_fields(element, infos);
      if (other_camera_with(child.name(), element.name()).empty()) nearest = meant_field(infos, *present, child.name());
    }
    diagnostics.error(child, [&] { return explain_unknown(child, element, infos, nearest); });
    // One slip, one message: a child that was only misspelt is not reported as missing too.
    if (!nearest.empty()) read |= std::uint64_t(1) << find_field(infos, nearest);
  }
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (infos[i].in_place_of.empty() || !(read >> i & 1)) continue;
    const std::uint64_t other = std::uint64_t(1) << find_field(infos, infos[i].in_place_of);
    // It is not there where an element that was misspelt has been taken for it.
    if (const Element shorthand = element.child(infos[i].name); (read & other) && shorthand) {
      diagnostics.error(shorthand, [&] {
        return tag(infos[i].name) + " stands in place of " + tag(infos[i].in_place_of) + "; remove one of them";
      });
    }
    read |= other;
  }
  for (std::size_t i = 0; i < infos.size(); ++i) {
    if (!infos[i].required || (read >> i & 1)) continue;
    diagnostics.error(element, [&] {
      // Where there is a shorthand, it is what people mean.
      std::size_t meant = i;
      for (std::size_t k = 0; k < infos.size(); ++k)
        if (infos[k].in_place_of == infos[i].name) meant = k;
      return "missing " + tag(infos[i].name) + (meant == i ? "" : " or " + tag(infos[meant].name)) + " in " +
             tag(element.name()) + "; add " + example_value(infos[meant], targets[meant], element.name());
    });
  }
  return diagnostics.error_count() == errors_before;
}

FieldsReader::FieldsReader(const ElementType& type, std::span<const FieldInfo> labels, bool may_skip)
    : type_(type), infos_(labels.begin(), labels.end()), may_skip_(may_skip) {
  for (const Field& field : type.fields_in_files) infos_.push_back(field);
  targets_.reserve(infos_.size());
}

bool FieldsReader::read(Element element, void* parameters, std::span<const FieldTarget> labels,
                        const ReadContext& context, std::vector<FieldTexture>* textures) {
  if (!read_fields(element, infos_, targets(parameters, labels), context, textures)) return false;
  const bool usable = check_together(type_, parameters, may_skip_, [&](Severity severity, const std::string& message) {
    context.diagnostics.report(severity, element, [&] { return message; });
  });
  if (!usable) return false;
  const auto is_textured = [&](std::string_view field) {
    return textures != nullptr && std::any_of(textures->begin(), textures->end(),
                                              [&](const FieldTexture& use) { return infos_[use.field].name == field; });
  };
  report_warnings(type_, parameters, is_textured, [&](const ParameterWarning& warning) {
    const Element child = element.child(warning.field);
    context.diagnostics.warning(child ? child : element, [&] { return warning.message; });
  });
  return true;
}

std::span<const FieldTarget> FieldsReader::targets(void* parameters, std::span<const FieldTarget> labels) {
  targets_.assign(labels.begin(), labels.end());
  for (const Field& field : type_.fields_in_files)
    std::visit([&](const auto& value) { targets_.emplace_back(value); }, field.value(parameters));
  return targets_;
}

}  // namespace raytrace

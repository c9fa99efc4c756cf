// Reads an element into a Parameters struct, as its table of fields says.
//
// Whatever is wrong is reported where it stands, together with what to write instead: unknown, repeated, missing and
// malformed children; attributes and text where none belong; parameters that do not go together.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/description/read_value.h"

namespace raytrace {

/// The texture that the value of a field names.
struct FieldTexture {
  std::size_t field;  ///< in `infos`
  TextureAttributes attributes;
  Element element;
};

/// Reads the children of `element`: the value of infos[i] goes to targets[i]. Members of absent or faulty children keep
/// their values. False if there was an error.
/// textures: receives those that the values name; null: they are refused.
bool read_fields(Element element, std::span<const FieldInfo> infos, std::span<const FieldTarget> targets,
                 const ReadContext& context, std::vector<FieldTexture>* textures = nullptr);

/// Whether the parameters, each of which is fine alone, go together; otherwise report(severity, message).
/// may_skip: whether what they are for may be left out, with a warning, where the type says so.
template <class Report>
bool check_together(const ElementType& type, const void* parameters, bool may_skip, const Report& report) {
  const std::optional<ParameterDiagnostic> diagnostic = type.check != nullptr ? type.check(parameters) : std::nullopt;
  if (!diagnostic) return true;
  const bool skip = diagnostic->effect == ParameterDiagnostic::Effect::skip && may_skip;
  report(skip ? Severity::warning : Severity::error, diagnostic->message);
  return false;
}

/// report(ParameterWarning) for each.
template <class Report>
void report_warnings(const ElementType& type, const void* parameters, const IsTextured& is_textured,
                     const Report& report) {
  if (type.warnings == nullptr) return;
  for (const ParameterWarning& warning : type.warnings(parameters, is_textured)) report(warning);
}

/// Reads elements of one type, one after the other. Their parameters are of that type.
class FieldsReader {
 public:
  /// labels: children that the elements have beside those of their parameters. may_skip: as in check_together().
  explicit FieldsReader(const ElementType& type, std::span<const FieldInfo> labels = {}, bool may_skip = false);

  /// False if the element is of no use, which is reported. labels: where the labels' values go, in the order of the
  /// constructor's. textures: as in read_fields().
  bool read(Element element, void* parameters, std::span<const FieldTarget> labels, const ReadContext& context,
            std::vector<FieldTexture>* textures = nullptr);

  /// What read() gives read_fields(); targets are valid until the next call.
  std::span<const FieldInfo> infos() const { return infos_; }
  std::span<const FieldTarget> targets(void* parameters, std::span<const FieldTarget> labels);

 private:
  const ElementType& type_;
  std::vector<FieldInfo> infos_;
  std::vector<FieldTarget> targets_;  // of the element at hand
  bool may_skip_;
};

}  // namespace raytrace

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

/// Whether the parameters of a T, each of which is fine alone, go together; otherwise report(severity, message).
/// may_skip: whether what they are for may be left out, with a warning, where the type says so.
template <class T, class Report>
bool check_together(const typename T::Parameters& parameters, bool may_skip, const Report& report) {
  if constexpr (requires { T::check(parameters); }) {
    if (const std::optional<ParameterDiagnostic> diagnostic = T::check(parameters)) {
      const bool skip = diagnostic->effect == ParameterDiagnostic::Effect::skip && may_skip;
      report(skip ? Severity::warning : Severity::error, diagnostic->message);
      return false;
    }
  }
  return true;
}

/// Reads elements of the type T, one after the other.
template <class T>
class FieldsReader {
 public:
  using Parameters = typename T::Parameters;

  /// labels: children that the elements have beside those of their parameters. may_skip: as in check_together().
  explicit FieldsReader(std::span<const FieldInfo> labels = {}, bool may_skip = false)
      : infos_(labels.begin(), labels.end()), may_skip_(may_skip) {
    for (const auto& field : fields_) infos_.push_back(field);
    targets_.reserve(infos_.size());
  }

  /// False if the element is of no use, which is reported. labels: where the labels' values go, in the order of the
  /// constructor's. textures: as in read_fields().
  bool read(Element element, Parameters& parameters, std::span<const FieldTarget> labels, const ReadContext& context,
            std::vector<FieldTexture>* textures = nullptr) {
    if (!read_fields(element, infos_, targets(parameters, labels), context, textures)) return false;
    return check_together<T>(parameters, may_skip_, [&](Severity severity, const std::string& message) {
      context.diagnostics.report(severity, element, [&] { return message; });
    });
  }

  /// What read() gives read_fields(); targets are valid until the next call.
  std::span<const FieldInfo> infos() const { return infos_; }
  std::span<const FieldTarget> targets(Parameters& parameters, std::span<const FieldTarget> labels) {
    targets_.assign(labels.begin(), labels.end());
    for (const auto& field : fields_)
      field.visit(parameters, [&]<class Value>(Value&& value) {
        if constexpr (std::is_same_v<Value, ChoiceReference>)
          targets_.emplace_back(value);
        else
          targets_.emplace_back(&value);
      });
    return targets_;
  }

 private:
  Fields<Parameters> fields_ = fields_in_files<T>();
  std::vector<FieldInfo> infos_;
  std::vector<FieldTarget> targets_;  // of the element at hand
  bool may_skip_;
};

}  // namespace raytrace

// Reads an element into a Parameters struct, as its table of fields says.
//
// Whatever is wrong is reported where it stands, together with what to write instead: unknown, repeated, missing and
// malformed children; attributes and text where none belong.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "raytrace/description/read_value.h"
#include "raytrace/parameters/fields.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"

namespace raytrace {

/// Reads the children of `element`: the value of infos[i] goes to targets[i]. Members of absent or faulty children keep
/// their values. False if there was an error.
bool read_fields(Element element, std::span<const FieldInfo> infos, std::span<const FieldTarget> targets,
                 Diagnostics& diagnostics);

/// Reads elements of one type, one after the other.
template <class Parameters>
class FieldsReader {
 public:
  /// labels: children that the elements have beside those of their parameters.
  explicit FieldsReader(Fields<Parameters> fields, std::vector<FieldInfo> labels = {})
      : fields_(std::move(fields)), label_count_(labels.size()), infos_(std::move(labels)) {
    for (const Field<Parameters>& field : fields_) infos_.push_back({field.name, field.required, field.range});
    targets_.reserve(infos_.size());
  }

  /// labels: receives the labels' texts, in the order of the constructor's.
  bool read(Element element, Parameters& parameters, std::span<std::string_view> labels, Diagnostics& diagnostics) {
    return read_fields(element, infos_, targets(parameters, labels), diagnostics);
  }

  /// What read() gives read_fields(); targets are valid until the next call.
  std::span<const FieldInfo> infos() const { return infos_; }
  std::span<const FieldTarget> targets(Parameters& parameters, std::span<std::string_view> labels) {
    targets_.clear();
    for (std::size_t i = 0; i < label_count_; ++i) targets_.emplace_back(&labels[i]);
    for (const Field<Parameters>& field : fields_) {
      std::visit([&](auto member) { targets_.emplace_back(&(parameters.*member)); }, field.member);
    }
    return targets_;
  }

 private:
  Fields<Parameters> fields_;
  std::size_t label_count_;
  std::vector<FieldInfo> infos_;
  std::vector<FieldTarget> targets_;  // of the element at hand
};

}  // namespace raytrace

// Reads a <transform>.
#pragma once

#include "raytrace/description/read_value.h"

namespace raytrace {

/// The attributes of a step that has any, in the order of its values.
std::span<const std::string_view> step_attributes(TransformStep::Type type);

/// Why a step, each number of which is fine alone, is refused: worded as OptionalMessage says.
OptionalMessage check_step(const TransformStep& step);

/// The same of what all steps make together, which may be too much though each is fine.
OptionalMessage check_affine(const Affine& affine);

/// Reads the steps. Reports what is wrong with them; false if there was an error.
bool read_transform(Element element, Transform& transform, const ReadContext& context);

}  // namespace raytrace

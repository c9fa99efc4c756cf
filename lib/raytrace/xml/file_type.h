// What a file that is no scene seems to be instead.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace raytrace {

/// The message for a text that is no XML: "this seems to be a PLY model; ..."; none if nobody knows. It goes by the
/// first bytes of what people have beside their scenes: models, pictures, packed files, and scenes of other renderers.
std::optional<std::string> explain_file_type(std::string_view text);

}  // namespace raytrace

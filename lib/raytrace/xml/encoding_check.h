// Refuses files whose bytes are no text in UTF-8, and says what they seem to be instead.
#pragma once

#include <optional>
#include <string_view>

#include "raytrace/xml/xml_diagnostic.h"

namespace raytrace {

/// The first byte of `text` that XML in UTF-8 cannot have there, or its first byte if all of it is UTF-16 or UTF-32.
/// threads: as in find_invalid_utf8().
std::optional<XmlDiagnostic> find_encoding_error(std::string_view text, int threads);

}  // namespace raytrace

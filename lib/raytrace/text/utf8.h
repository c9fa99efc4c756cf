// UTF-8 as XML allows it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace raytrace {

/// The bytes, 1 to 4, of the character that `text` starts with; 0 if it starts with none that XML allows: a broken or
/// overlong sequence, a surrogate, U+FFFE, U+FFFF, or a control character other than tab, line feed and return.
std::size_t utf8_length(std::string_view text);

/// Whether XML allows the character of that number.
bool is_xml_character(std::uint32_t character);

/// The offset of the first byte that is no part of an allowed character; npos if all of the text is fine. threads: so
/// many at most share the work; 0: all that the machine has.
std::size_t find_invalid_utf8(std::string_view text, int threads);

}  // namespace raytrace

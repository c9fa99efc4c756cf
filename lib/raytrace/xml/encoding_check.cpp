#include "raytrace/xml/encoding_check.h"

#include "raytrace/text/quoted.h"
#include "raytrace/text/utf8.h"

namespace raytrace {

std::optional<XmlDiagnostic> find_encoding_error(std::string_view text, int threads) {
  using namespace std::string_view_literals;
  for (const std::string_view start : {"\xff\xfe"sv, "\xfe\xff"sv, "<\0"sv, "\0<"sv})
    if (text.starts_with(start)) return XmlDiagnostic{0, "the file is encoded as UTF-16 or UTF-32; save it as UTF-8"};
  const std::size_t invalid = find_invalid_utf8(text, threads);
  if (invalid == std::string_view::npos) return std::nullopt;
  const bool control = static_cast<unsigned char>(text[invalid]) < 0x20;
  return XmlDiagnostic{invalid,
                       "the byte " + in_quotes(text.substr(invalid, 1)) +
                           (control ? " is no text: is this a scene file?"
                                    : " is no UTF-8 text; save the file as UTF-8 (is it one of another program?)")};
}

}  // namespace raytrace

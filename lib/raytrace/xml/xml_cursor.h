// A position in an XML text, and what may be read there whatever is around it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "raytrace/text/message.h"
#include "raytrace/text/utf8.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/xml_characters.h"

namespace raytrace {

/// The text has passed the check of its bytes, so that '\0' stands at its end and nowhere else. Functions leave the
/// cursor behind what they have read, and throw TextError.
class XmlCursor {
 protected:
  explicit XmlCursor(std::string_view text) : begin_(text.data()), end_(begin_ + text.size()), here_(begin_) {}

  std::size_t offset(const char* at) const { return static_cast<std::size_t>(at - begin_); }

  [[noreturn]] void fail(const char* at, std::string message) const { throw TextError{offset(at), std::move(message)}; }

  std::string_view rest() const { return {here_, here_ < end_ ? static_cast<std::size_t>(end_ - here_) : 0}; }

  bool starts_with(std::string_view prefix) const { return rest().starts_with(prefix); }

  void skip_space() {
    while (xml::is(*here_, xml::space)) ++here_;
  }

  std::string_view name() {
    const char* const start = here_;
    while (xml::is(*here_, xml::name_part)) ++here_;
    return {start, static_cast<std::size_t>(here_ - start)};
  }

  /// What comes after the next `end`; fails at `start` if there is none.
  void skip_past(const char* start, std::string_view end, const char* what) {
    const std::size_t found = rest().find(end);
    if (found == std::string_view::npos)
      fail(start, std::string(what) + " that starts here never ends; add " + std::string(end));
    here_ += found + end.size();
  }

  void entity() {
    static constexpr std::string_view known[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"};
    for (const std::string_view entity : known) {
      if (starts_with(entity)) {
        here_ += entity.size();
        return;
      }
    }
    const char* const start = here_;
    if (here_[1] == '#') {
      const bool hexadecimal = here_[2] == 'x';
      here_ += hexadecimal ? 3 : 2;
      const std::uint32_t base = hexadecimal ? 16 : 10;
      std::uint32_t character = 0;
      const char* const digits = here_;
      for (; xml::digit(*here_) < base && character <= 0x10ffff; ++here_)
        character = character * base + xml::digit(*here_);
      if (here_ > digits && *here_ == ';' && is_xml_character(character)) {
        ++here_;
        return;
      }
      fail(start, in_quotes({start, static_cast<std::size_t>(here_ - start) + (*here_ == ';' ? 1 : 0)}) +
                      " is no character that XML allows");
    }
    ++here_;
    const std::string_view found = name();
    if (!found.empty() && *here_ == ';') {
      fail(start,
           "unknown entity " + in_quotes({start, found.size() + 2}) + "; XML knows &amp; &lt; &gt; &quot; and &apos;");
    }
    fail(start, "a '&' in a text must be written '&amp;'");
  }

  struct Attribute {
    std::string_view name, value;
  };

  /// name="value" or name='value'.
  Attribute attribute() {
    const char* const start = here_;
    const std::string_view found = name();
    const auto example = [&] { return ", as in " + printable(found) + "=\"1\""; };
    skip_space();
    if (*here_ != '=') fail(start, "the attribute " + in_quotes(found) + " has no value; add one" + example());
    ++here_;
    skip_space();
    const char quote = *here_;
    if (quote != '"' && quote != '\'') {
      fail(here_, "the value of the attribute " + in_quotes(found) + " must stand in quotes" + example());
    }
    const char* const value = ++here_;
    while (true) {
      while (!xml::is(*here_, xml::value_end)) ++here_;
      if (*here_ == quote) break;
      if (*here_ == '&')
        entity();
      else if (*here_ == '"' || *here_ == '\'')
        ++here_;
      else
        fail(start, "the value of the attribute " + in_quotes(found) + " has no closing quote");
    }
    return {found, {value, static_cast<std::size_t>(here_++ - value)}};
  }

  const char* begin_;
  const char* end_;
  const char* here_;
};

}  // namespace raytrace

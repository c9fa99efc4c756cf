// An EXR file taken apart, so that its header can say anything: what OpenEXR's own classes would never write.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace raytrace::test {

std::string little_endian(std::uint32_t number);
std::string little_endian(const std::vector<std::int32_t>& numbers);

struct ExrBytes {
  struct Attribute {
    std::string name, type, value;
  };

  std::uint32_t version = 2;  ///< with its flags
  std::vector<Attribute> attributes;
  std::string rest;                     ///< the table of where chunks begin, and these
  std::uint64_t rows_a_chunk = 1;       ///< and so on: as the header said before it was changed
  std::uint64_t chunks = 0, start = 0;  ///< start: of the rest in the file

  /// None if there is no whole header with all that every EXR file has.
  static std::optional<ExrBytes> parsed(std::string_view bytes);

  /// With the places of chunks as they are behind the header that there is now.
  std::string bytes() const;

  /// Of that name; added if there is none.
  Attribute& operator[](std::string_view name);
  void remove(std::string_view name);

  /// An attribute of this program.
  void set_text(std::string_view name, const std::string& text) { set(name, "string", text); }
  void set_int(std::string_view name, std::int32_t number) { set(name, "int", little_endian(std::vector{number})); }
  void set(std::string_view name, const std::string& type, const std::string& value);

  /// The first value of a channel, of a file without compression that nothing else was changed of; all are of 32 bit,
  /// but for R, G, B and A.
  void set_first_value(std::string_view channel, std::uint32_t value);
};

struct ExrChannel {
  std::string name;
  std::string layout;  ///< type, linearity and sampling
};

std::vector<ExrChannel> channels_of(std::string_view value);
std::string channels_value(const std::vector<ExrChannel>& channels);

}  // namespace raytrace::test

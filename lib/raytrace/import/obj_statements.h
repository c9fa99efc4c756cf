// What the lines of an OBJ file are, and what there is in a part of it. Inside of read_obj().
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "raytrace/import/mesh_faces.h"
#include "raytrace/import/mesh_text.h"

namespace raytrace::obj {

enum class Statement : std::uint8_t { empty, position, uv, normal, face, other };

/// Moves behind the keyword, unless that is one of the others.
inline Statement read_keyword(LineWords& words) {
  if (!words.skip_space()) return Statement::empty;
  LineWords after = words;
  after.advance();
  Statement statement = *words.at() == 'v'   ? Statement::position
                        : *words.at() == 'f' ? Statement::face
                                             : Statement::other;
  if (statement == Statement::position && !after.at_word_end()) {
    statement = *after.at() == 't' ? Statement::uv : *after.at() == 'n' ? Statement::normal : Statement::other;
    after.advance();
  }
  if (statement == Statement::other || !after.at_word_end()) return Statement::other;
  words = after;
  return statement;
}

/// How many there are in a part of the file, of v, vt and vn by number.
struct Counts {
  std::array<std::size_t, 3> values{};
  FaceCounts faces;

  Counts& operator+=(const Counts& more) {
    for (std::size_t i = 0; i < values.size(); ++i) values[i] += more.values[i];
    faces += more.faces;
    return *this;
  }
};

struct Name {
  std::string_view text;
  std::uint32_t material = no_index;  ///< of a usemtl
};

/// An o statement, and what faces of its chunk are before it.
struct Object {
  std::string_view name;
  FaceCounts before;
};

struct Chunk {
  Counts counts;
  std::vector<Object> objects;
  std::vector<Name> libraries, materials;  ///< mtllib and usemtl statements
  bool has_colors = false;
  std::size_t skipped = 0;
  std::string_view first_skipped;
};

}  // namespace raytrace::obj

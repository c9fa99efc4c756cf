// What the items of a large group have in common: all of their text but the values.
//
// Programs write a million spheres one like the other, with other numbers. So an item that was parsed and read is the
// pattern for those that follow it: where their text is the same but for what stands between quotes and between tags,
// their values mean what its values meant, and nothing has to be parsed to know that. That takes a fifth of the time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "raytrace/description/read_value.h"

namespace raytrace {

class ItemPattern {
 public:
  /// text: that of an item, which was read from `item`, with nothing to say, as these infos and targets want it. None
  /// if there is more to it than plain values: keys, comments, character data.
  static std::optional<ItemPattern> of(std::string_view text, Element item, std::span<const FieldInfo> infos,
                                       std::span<const FieldTarget> targets);

  /// Reads the item that `text`, a well-formed one of several, starts with: its values go to the targets, which are of
  /// the same types as those of the pattern. The length of its text; 0 if it is another or there is something to say
  /// about it or, which may be, to its values: variables, entities. The targets then hold anything.
  std::size_t read(std::string_view text, std::span<const FieldTarget> targets) const;

  /// How many lines an item ends.
  std::uint32_t line_ends() const { return line_ends_; }

 private:
  struct Value {
    std::string before;  ///< what stands between it and the value before
    std::size_t field;
    std::size_t component;  ///< of a vector or a color
  };

  std::vector<FieldInfo> infos_;
  std::vector<Value> values_;
  std::string end_;
  std::uint32_t line_ends_ = 0;
};

}  // namespace raytrace

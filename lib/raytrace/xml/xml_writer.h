// Writes XML: each tag in a line of its own, indented by how deep it is.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace raytrace {

class XmlWriter {
 public:
  /// An element, and between its tags what print_content() writes. tag: its name, and its attributes if any.
  template <class PrintContent>
  void element(std::string_view tag, const PrintContent& print_content) {
    line("<" + std::string(tag) + ">");
    ++depth_;
    print_content();
    --depth_;
    line("</" + std::string(tag.substr(0, tag.find(' '))) + ">");
  }

  void line(std::string_view content) { text_.append(2 * depth_, ' ').append(content).append("\n"); }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::size_t depth_ = 0;
};

}  // namespace raytrace

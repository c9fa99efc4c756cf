// A parsed XML text and handles to its parts: what the rest of the reader sees of tinyxml2.
//
// Handles are as light as pointers, and valid as long as their Document.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "raytrace/description/diagnostics.h"

namespace tinyxml2 {
class XMLAttribute;
class XMLElement;
class XMLNode;
}  // namespace tinyxml2

namespace raytrace {

class Element;

class Attribute {
 public:
  Attribute(const tinyxml2::XMLElement* element, const tinyxml2::XMLAttribute* attribute)
      : element_(element), attribute_(attribute) {}

  explicit operator bool() const { return attribute_ != nullptr; }
  std::string_view name() const;
  std::string_view value() const;
  Attribute next() const;
  SourceLocation location() const;  ///< of its name

 private:
  const tinyxml2::XMLElement* element_;
  const tinyxml2::XMLAttribute* attribute_;
};

/// An element, or a text between the tags of one. Comments are never seen.
class Node {
 public:
  explicit Node(const tinyxml2::XMLNode* node) : node_(node) {}

  explicit operator bool() const { return node_ != nullptr; }
  Element element() const;          ///< false if this is a text
  std::string_view text() const;    ///< without white space around it; empty for an element
  Node next() const;                ///< among its parent's
  SourceLocation location() const;  ///< of the start tag, or of the text's first letter

 private:
  const tinyxml2::XMLNode* node_;
};

class Element {
 public:
  explicit Element(const tinyxml2::XMLElement* element = nullptr) : element_(element) {}

  explicit operator bool() const { return element_ != nullptr; }
  std::string_view name() const;
  Attribute first_attribute() const;
  Node first_child() const;
  Element child(std::string_view name) const;  ///< the first of that name; false if there is none
  std::uint32_t line() const;
  SourceLocation location() const;  ///< of the start tag

 private:
  const tinyxml2::XMLElement* element_;
};

class Document {
 public:
  /// Parses a text. If it is not well-formed, the reason goes to `diagnostics`, and root() is false.
  Document(std::string text, Diagnostics& diagnostics);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  Element root() const;

 private:
  friend class Attribute;
  friend class Element;
  friend class Node;
  struct Implementation;

  static SourceLocation location(const tinyxml2::XMLNode& node);
  static SourceLocation location(const tinyxml2::XMLElement& element, std::string_view attribute);

  std::unique_ptr<Implementation> implementation_;
};

/// The text without the white space of XML around it.
std::string_view trimmed(std::string_view text);

}  // namespace raytrace

// Parsed parts of a scene's text and handles to what is in them: what the rest of the reader sees of tinyxml2.
//
// Handles are as light as pointers, and valid until their Document parses something else. A Document and its handles
// belong to one thread, even to read: tinyxml2 finishes names and texts when they are first read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/scene_text.h"

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

/// An element, or a text between the tags of one. Comments are left out.
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
  std::size_t offset() const;                       ///< of the start tag, in the scene's text
  SourceLocation location() const;                  ///< of the start tag
  std::string_view keep(std::string&& text) const;  ///< keeps a text for as long as the element lives

 private:
  const tinyxml2::XMLElement* element_;
};

class Document {
 public:
  /// source: must outlive the document.
  explicit Document(const SceneText& source);
  ~Document();
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  /// Parses the skeleton. The root is that of the scene.
  void parse_skeleton(Diagnostics& diagnostics);
  /// Parses whole items of a group. The root stands for the group, and bears another name. Many parsed by one document
  /// take less time than by as many, since tinyxml2 uses its memory again.
  void parse_items(const Span& items, Diagnostics& diagnostics);

  /// Of what was parsed last; false if that failed.
  Element root() const;

 private:
  std::unique_ptr<class ParsedText> parsed_;
};

}  // namespace raytrace

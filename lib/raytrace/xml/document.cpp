#include "raytrace/xml/document.h"

#include <tinyxml2.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "raytrace/xml/xml_scanner.h"

namespace raytrace {

/// Columns are wanted for messages only, so nothing is spent on them before the first one. Then one scan of the text
/// finds where all nodes stand, and each node of the tree gets its offset as its user data.
struct Document::Implementation {
  /// What was parsed from a span of the source.
  struct Part {
    std::size_t begin;
    std::uint32_t line;
    Span source;
  };

  Implementation(const SceneText& scene_text, const Variables& scene_variables)
      : source(scene_text), variables(scene_variables) {
    tree.SetUserData(this);
  }

  static Implementation& of(const tinyxml2::XMLNode& node) {
    return *static_cast<Implementation*>(node.GetDocument()->GetUserData());
  }

  void clear() {
    text.clear();
    parts.clear();
    offsets.clear();
    kept.clear();
  }

  /// Parts are told apart by their lines, so each must start a new one.
  void add(const Span& span, std::uint32_t line) {
    parts.push_back({text.size(), line, span});
    text += source.of(span);
  }

  void parse(Diagnostics& diagnostics) {
    if (tree.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS) return;
    diagnostics.error({source_line(static_cast<std::uint32_t>(tree.ErrorLineNum())), 0}, "this is no well-formed XML");
    tree.Clear();
  }

  std::uint32_t source_line(std::uint32_t line) const {
    const auto next = std::upper_bound(parts.begin() + 1, parts.end(), line,
                                       [](std::uint32_t wanted, const Part& part) { return wanted < part.line; });
    const Part& part = *(next - 1);
    return part.source.line + (line - part.line);
  }

  std::size_t source_offset(std::size_t offset) const {
    const auto next = std::upper_bound(parts.begin() + 1, parts.end(), offset,
                                       [](std::size_t wanted, const Part& part) { return wanted < part.begin; });
    const Part& part = *(next - 1);
    return part.source.begin + (offset - part.begin);
  }

  /// In `text`.
  std::size_t offset(const tinyxml2::XMLNode& node) {
    if (offsets.empty()) {
      offsets = find_nodes(text);
      std::size_t next = 0;
      number(tree, next);
    }
    return *static_cast<std::size_t*>(node.GetUserData());
  }

  // Depth first, as find_nodes counts; it lets no tree be so deep that this recursion could not follow.
  void number(tinyxml2::XMLNode& parent, std::size_t& next) {
    for (tinyxml2::XMLNode* node = parent.FirstChild(); node; node = node->NextSibling()) {
      if (!node->ToElement() && !node->ToText()) continue;
      node->SetUserData(&offsets.at(next++));
      number(*node, next);
    }
  }

  const SceneText& source;
  const Variables& variables;
  tinyxml2::XMLDocument tree;
  std::string text;         // that of the tree
  std::vector<Part> parts;  // of the text, in its order
  std::vector<std::size_t> offsets;
  std::deque<std::string> kept;
};

namespace {

// The scanner lets nothing but elements, texts and comments stand in an element.
const tinyxml2::XMLNode* skip_comments(const tinyxml2::XMLNode* node) {
  while (node && node->ToComment()) node = node->NextSibling();
  return node;
}

}  // namespace

Document::Document(const SceneText& source, const Variables& variables)
    : implementation_(std::make_unique<Implementation>(source, variables)) {}

Document::~Document() = default;

void Document::parse_skeleton(Diagnostics& diagnostics) {
  Implementation& document = *implementation_;
  document.clear();
  std::uint32_t line = 1;
  for (const Span& span : document.source.skeleton()) {
    document.add(span, line);
    document.text += '\n';
    const std::string_view text = document.source.of(span);
    line += static_cast<std::uint32_t>(std::count(text.begin(), text.end(), '\n')) + 1;
  }
  document.parse(diagnostics);
}

void Document::parse_items(const Span& items, Diagnostics& diagnostics) {
  Implementation& document = *implementation_;
  document.clear();
  document.text = "<_>";
  document.add(items, 1);
  document.text += "</_>";
  document.parse(diagnostics);
}

Element Document::root() const { return Element(implementation_->tree.RootElement()); }

std::size_t Document::offset(const tinyxml2::XMLNode& node) {
  Implementation& document = Implementation::of(node);
  return document.source_offset(document.offset(node));
}

SourceLocation Document::location(const tinyxml2::XMLNode& node) {
  return Implementation::of(node).source.locate(offset(node));
}

SourceLocation Document::location(const tinyxml2::XMLElement& element, std::string_view attribute) {
  Implementation& document = Implementation::of(element);
  const std::size_t offset = find_attribute(document.text, document.offset(element), attribute);
  return document.source.locate(document.source_offset(offset));
}

std::uint32_t Document::line(const tinyxml2::XMLNode& node) {
  return Implementation::of(node).source_line(static_cast<std::uint32_t>(node.GetLineNum()));
}

std::string_view Attribute::name() const { return attribute_->Name(); }
std::string_view Attribute::value() const { return attribute_->Value(); }
Attribute Attribute::next() const { return {element_, attribute_->Next()}; }
SourceLocation Attribute::location() const { return Document::location(*element_, name()); }

Element Node::element() const { return Element(node_->ToElement()); }
std::string_view Node::text() const { return node_->ToText() ? trimmed(node_->Value()) : std::string_view(); }
Node Node::next() const { return Node(skip_comments(node_->NextSibling())); }
SourceLocation Node::location() const { return Document::location(*node_); }

std::string_view Element::name() const { return element_->Name(); }
Attribute Element::first_attribute() const { return {element_, element_->FirstAttribute()}; }
Node Element::first_child() const { return Node(skip_comments(element_->FirstChild())); }

Element Element::child(std::string_view name) const {
  for (Node node = first_child(); node; node = node.next()) {
    const Element element = node.element();
    if (element && element.name() == name) return element;
  }
  return Element();
}

std::uint32_t Element::line() const { return Document::line(*element_); }
std::size_t Element::offset() const { return Document::offset(*element_); }
SourceLocation Element::location() const { return Document::location(*element_); }

const Variables& Element::variables() const { return Document::Implementation::of(*element_).variables; }

std::string_view Element::keep(std::string&& text) const {
  return Document::Implementation::of(*element_).kept.emplace_back(std::move(text));
}

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace raytrace

#include "raytrace/description/document.h"

#include <tinyxml2.h>

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "raytrace/description/line_index.h"
#include "raytrace/description/xml_scanner.h"

namespace raytrace {

/// Lines and columns are wanted for messages only, so nothing is spent on them before the first one. Then one scan of
/// the text finds where all nodes stand, and each node of the tree gets its offset as its user data.
struct Document::Implementation {
  explicit Implementation(std::string source) : text(std::move(source)) { tree.SetUserData(this); }

  static Implementation& of(const tinyxml2::XMLNode& node) {
    return *static_cast<Implementation*>(node.GetDocument()->GetUserData());
  }

  std::size_t offset(const tinyxml2::XMLNode& node) {
    if (!lines) {
      lines.emplace(text);
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

  std::string text;
  tinyxml2::XMLDocument tree;
  std::optional<LineIndex> lines;
  std::vector<std::size_t> offsets;
};

namespace {

// The scanner lets nothing but elements, texts and comments stand in an element.
const tinyxml2::XMLNode* skip_comments(const tinyxml2::XMLNode* node) {
  while (node && node->ToComment()) node = node->NextSibling();
  return node;
}

}  // namespace

Document::Document(std::string text, Diagnostics& diagnostics)
    : implementation_(std::make_unique<Implementation>(std::move(text))) {
  const std::string& source = implementation_->text;
  if (const auto problem = find_xml_problem(source)) {
    diagnostics.error(LineIndex(source).locate(problem->offset), problem->message);
    return;
  }
  tinyxml2::XMLDocument& tree = implementation_->tree;
  if (tree.Parse(source.data(), source.size()) != tinyxml2::XML_SUCCESS) {
    diagnostics.error({static_cast<std::uint32_t>(tree.ErrorLineNum()), 0}, "this is no well-formed XML");
    tree.Clear();
  }
}

Document::~Document() = default;

Element Document::root() const { return Element(implementation_->tree.RootElement()); }

SourceLocation Document::location(const tinyxml2::XMLNode& node) {
  Implementation& document = Implementation::of(node);
  const std::size_t offset = document.offset(node);
  return document.lines->locate(offset);
}

SourceLocation Document::location(const tinyxml2::XMLElement& element, std::string_view attribute) {
  Implementation& document = Implementation::of(element);
  const std::size_t offset = find_attribute(document.text, document.offset(element), attribute);
  return document.lines->locate(offset);
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

std::uint32_t Element::line() const { return static_cast<std::uint32_t>(element_->GetLineNum()); }
SourceLocation Element::location() const { return Document::location(*element_); }

std::string_view trimmed(std::string_view text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; };
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

}  // namespace raytrace

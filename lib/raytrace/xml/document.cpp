#include "raytrace/xml/document.h"

#include <tinyxml2.h>

#include <algorithm>
#include <deque>
#include <utility>
#include <vector>

#include "raytrace/xml/xml_characters.h"
#include "raytrace/xml/xml_scanner.h"

namespace raytrace {

/// Columns are wanted for messages only, so nothing is spent on them before the first one. Then one scan of the text
/// finds where all nodes stand, and each node of the tree gets its offset as its user data.
class ParsedText {
 public:
  explicit ParsedText(const SceneText& source) : source_(source) { tree_.SetUserData(this); }

  static ParsedText& of(const tinyxml2::XMLNode& node) {
    return *static_cast<ParsedText*>(node.GetDocument()->GetUserData());
  }

  const tinyxml2::XMLElement* root() const { return tree_.RootElement(); }

  void parse_skeleton(Diagnostics& diagnostics) {
    clear();
    std::uint32_t line = 1;
    for (const Span& span : source_.skeleton()) {
      // Parts are distinguished by their lines, so each starts a new one.
      add(span, line);
      text_ += '\n';
      line += xml::line_ends(source_.of(span)) + 1;
    }
    parse(diagnostics);
  }

  void parse_items(const Span& items, Diagnostics& diagnostics) {
    clear();
    text_ = "<_>";
    add(items, 1);
    text_ += "</_>";
    parse(diagnostics);
  }

  // In the source.
  std::uint32_t line(const tinyxml2::XMLNode& node) const { return source_line(node.GetLineNum()); }
  std::size_t offset(const tinyxml2::XMLNode& node) { return source_offset(text_offset(node)); }
  SourceLocation location(const tinyxml2::XMLNode& node) { return source_.locate(offset(node), located_); }
  SourceLocation location(const tinyxml2::XMLElement& element, std::string_view attribute) {
    return source_.locate(source_offset(find_attribute(text_, text_offset(element), attribute)), located_);
  }

  std::string_view keep(std::string&& text) { return kept_.emplace_back(std::move(text)); }

 private:
  /// What was parsed from a span of the source.
  struct Part {
    std::size_t begin;
    std::uint32_t line;
    Span source;
  };

  void clear() {
    text_.clear();
    parts_.clear();
    offsets_.clear();
    kept_.clear();
  }

  void add(const Span& span, std::uint32_t line) {
    parts_.push_back({text_.size(), line, span});
    text_ += source_.of(span);
  }

  void parse(Diagnostics& diagnostics) {
    if (tree_.Parse(text_.data(), text_.size()) == tinyxml2::XML_SUCCESS) return;
    diagnostics.error({source_line(tree_.ErrorLineNum()), 0}, "this is no well-formed XML");
    tree_.Clear();
  }

  /// The last part whose `start` is at `position` or before it.
  template <class Position>
  const Part& part_at(Position position, Position Part::* start) const {
    return *(std::upper_bound(parts_.begin() + 1, parts_.end(), position,
                              [&](Position wanted, const Part& part) { return wanted < part.*start; }) -
             1);
  }

  std::uint32_t source_line(int text_line) const {
    const auto line = static_cast<std::uint32_t>(text_line);
    const Part& part = part_at(line, &Part::line);
    return part.source.line + (line - part.line);
  }

  std::size_t source_offset(std::size_t offset) const {
    const Part& part = part_at(offset, &Part::begin);
    return part.source.begin + (offset - part.begin);
  }

  std::size_t text_offset(const tinyxml2::XMLNode& node) {
    if (offsets_.empty()) {
      offsets_ = find_nodes(text_);
      std::size_t next = 0;
      number(tree_, next);
    }
    return *static_cast<std::size_t*>(node.GetUserData());
  }

  // Depth first, as find_nodes counts; it lets no tree be so deep that this recursion could not follow.
  void number(tinyxml2::XMLNode& parent, std::size_t& next) {
    for (tinyxml2::XMLNode* node = parent.FirstChild(); node; node = node->NextSibling()) {
      if (!node->ToElement() && !node->ToText()) continue;
      node->SetUserData(&offsets_.at(next++));
      number(*node, next);
    }
  }

  const SceneText& source_;
  tinyxml2::XMLDocument tree_;
  std::string text_;         // that of the tree
  std::vector<Part> parts_;  // of the text, in its order
  std::vector<std::size_t> offsets_;
  LineMark located_;  // what was located last
  std::deque<std::string> kept_;
};

namespace {

// The scanner lets nothing but elements, texts and comments stand in an element.
const tinyxml2::XMLNode* skip_comments(const tinyxml2::XMLNode* node) {
  while (node && node->ToComment()) node = node->NextSibling();
  return node;
}

}  // namespace

Document::Document(const SceneText& source) : parsed_(std::make_unique<ParsedText>(source)) {}
Document::~Document() = default;

void Document::parse_skeleton(Diagnostics& diagnostics) { parsed_->parse_skeleton(diagnostics); }
void Document::parse_items(const Span& items, Diagnostics& diagnostics) { parsed_->parse_items(items, diagnostics); }
Element Document::root() const { return Element(parsed_->root()); }

std::string_view Attribute::name() const { return attribute_->Name(); }
std::string_view Attribute::value() const { return attribute_->Value(); }
Attribute Attribute::next() const { return {element_, attribute_->Next()}; }
SourceLocation Attribute::location() const { return ParsedText::of(*element_).location(*element_, name()); }

Element Node::element() const { return Element(node_->ToElement()); }
std::string_view Node::text() const { return node_->ToText() ? xml::trimmed(node_->Value()) : std::string_view(); }
Node Node::next() const { return Node(skip_comments(node_->NextSibling())); }
SourceLocation Node::location() const { return ParsedText::of(*node_).location(*node_); }

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

std::uint32_t Element::line() const { return ParsedText::of(*element_).line(*element_); }
std::size_t Element::offset() const { return ParsedText::of(*element_).offset(*element_); }
SourceLocation Element::location() const { return ParsedText::of(*element_).location(*element_); }
std::string_view Element::keep(std::string&& text) const { return ParsedText::of(*element_).keep(std::move(text)); }

}  // namespace raytrace

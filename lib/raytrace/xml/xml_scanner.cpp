#include "raytrace/xml/xml_scanner.h"

#include <algorithm>
#include <cstring>

#include "raytrace/parallel/worker_count.h"
#include "raytrace/text/message.h"
#include "raytrace/text/utf8.h"
#include "raytrace/xml/xml_characters.h"
#include "raytrace/xml/xml_cursor.h"

namespace raytrace {
namespace {

using namespace xml;

constexpr std::size_t most_open = 64;
constexpr std::size_t most_attributes = 64;

// What may be a group: an element in a section at the root, or in one of <groups> of objects.
constexpr std::size_t group_depth = 3, nested_group_depth = 5;
constexpr std::string_view groups_of_objects = "groups";

/// Walks over a whole text. Throws TextError.
class Scanner : private XmlCursor {
 public:
  explicit Scanner(std::string_view text) : XmlCursor(text) {
    open_.reserve(most_open);
    attributes_.reserve(most_attributes);
  }

  std::vector<std::size_t>* nodes = nullptr;        ///< receives what find_nodes returns
  std::vector<std::string_view>* values = nullptr;  ///< receives what find_values returns
  ChunkCutter* cutter = nullptr;                    ///< is called for the items of groups

  /// Has up to so many threads look ahead in the groups that are cut.
  void look_ahead(int threads) {
    const auto scan = [this](const char* from, const char* to, const char* limit, std::vector<TextChunk>& chunks) {
      return scan_items(from, to, limit, chunks);
    };
    if (threads > 1) ahead_.emplace(end_, threads, scan);
  }

  void scan() {
    if (starts_with(byte_order_mark)) here_ += byte_order_mark.size();
    if (starts_with("<?xml") && !is(here_[5], name_part)) declaration();
    while (true) {
      skip_space();
      if (ahead_ && at_item() && cutter->cuts(open_.back().name)) pass_scanned_items();
      if (*here_ == '\0') break;
      scan_next();
    }
    if (!open_.empty()) {
      fail(open_.back().begin, tag(open_.back().name) + " is never closed; add " + closing_tag(open_.back().name));
    }
    if (!root_seen_) {
      const bool empty = offset(here_) == std::strspn(begin_, " \t\n\r");
      fail(begin_, std::string(empty ? "the file is empty" : "there is no scene in the file") +
                       "; a scene starts with <raytracer>");
    }
  }

  /// The first element alone, at the '<' of which the text starts; where it ends.
  std::size_t scan_element() {
    do {
      skip_space();
      scan_next();
    } while (!open_.empty());
    return offset(here_);
  }

  /// Leaves the scanner behind the name of an attribute, having gone through the tag at `tag_offset` that far.
  std::size_t attribute_offset(std::size_t tag_offset, std::string_view wanted) {
    here_ = begin_ + tag_offset + 1;
    name();
    while (true) {
      skip_space();
      if (!is(*here_, name_start)) return tag_offset;
      const char* const start = here_;
      if (attribute().name == wanted) return offset(start);
    }
  }

 private:
  struct OpenElement {
    std::string_view name;
    const char* begin;
  };

  /// A tag, a text, a comment...
  void scan_next() {
    if (*here_ != '<')
      text();
    else if (here_[1] == '/')
      end_tag();
    else if (here_[1] == '!')
      comment_or_section();
    else if (here_[1] == '?')
      refuse_instruction();
    else
      start_tag();
  }

  bool in_group() const {
    return open_.size() == group_depth || (open_.size() == nested_group_depth && open_[1].name == groups_of_objects);
  }

  /// At the '<' of an item's start tag.
  bool at_item() const { return in_group() && *here_ == '<' && is(here_[1], name_start); }

  /// From an item on: over as many as others have gone through.
  void pass_scanned_items() {
    while (at_item()) {
      const ItemsAhead::ScannedRange* const range = ahead_->from(open_.back().begin, here_);
      if (range == nullptr) return;
      cutter->add(offset(open_.back().begin), open_.back().name, range->chunks);
      here_ = range->end;
    }
  }

  /// What ItemsAhead wants: another scanner's work on the group at hand.
  const char* scan_items(const char* from, const char* to, const char* limit, std::vector<TextChunk>& chunks) const {
    Scanner scanner({begin_, offset(limit)});
    scanner.open_ = open_;
    scanner.root_seen_ = scanner.guessing_ = true;
    scanner.here_ = from;
    ChunkCutter group_cutter(*cutter, chunks);
    scanner.cutter = &group_cutter;
    try {
      if (!scanner.scan_items(to)) return nullptr;
    } catch (const TextError&) {
      return nullptr;
    }
    chunks.back().end = offset(scanner.here_);
    return scanner.here_;
  }

  /// Up to the group's end tag or to the first item that is not before `to`; false if they are not found.
  bool scan_items(const char* to) {
    while (true) {
      skip_space();
      if (here_ > end_ || *here_ == '\0') return false;
      const bool at_end_tag = in_group() && here_[0] == '<' && here_[1] == '/';
      if (at_end_tag || (here_ >= to && at_item())) return true;
      scan_next();
    }
  }

  std::string opened_in(const OpenElement& element) const {
    const SourceLocation location = locate({begin_, offset(here_)}, offset(element.begin));
    return "opened in line " + std::to_string(location.line) + ", column " + std::to_string(location.column);
  }

  void note_node(const char* at) {
    if (nodes) nodes->push_back(offset(at));
  }

  void note_value(std::string_view value) {
    if (values) values->push_back(value);
  }

  void declaration() {
    const char* const start = here_;
    here_ += 5;
    bool has_version = false;
    std::string_view encoding;
    for (skip_space(); is(*here_, name_start); skip_space()) {
      const Attribute found = attribute();
      if (found.name == "version") has_version = true;
      if (found.name == "encoding") encoding = found.value;
    }
    if (!has_version || !starts_with("?>"))
      fail(start, "write this declaration as <?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    here_ += 2;
    std::string upper(encoding.substr(0, 10));
    for (char& c : upper) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (!upper.empty() && upper != "UTF-8" && upper != "US-ASCII" && upper != "ASCII") {
      fail(start, "the encoding " + in_quotes(encoding) + " is not read; save the file as UTF-8, and write that here");
    }
  }

  void text() {
    if (open_.empty()) {
      if (root_seen_) fail(here_, "text after the end of the scene; remove it");
      fail(here_, "this is no XML: it starts with " + in_quotes({here_, std::strcspn(here_, "\r\n<")}) +
                      ", but a scene starts with <raytracer>");
    }
    const char* const start = here_;
    note_node(start);
    while (true) {
      while (!is(*here_, text_end)) ++here_;
      if (*here_ == '&')
        entity();
      else if (*here_ != ']')
        return note_value({start, static_cast<std::size_t>(here_ - start)});
      else if (starts_with("]]>"))
        fail(here_, "']]>' in a text must be written ']]&gt;'");
      else
        ++here_;
    }
  }

  void start_tag() {
    const char* const start = here_++;
    if (!is(*here_, name_start)) fail(start, "a '<' that starts no tag must be written '&lt;'");
    const std::string_view element = name();
    if (open_.empty() && root_seen_) {
      fail(start,
           tag(element) + " after the end of the scene; everything belongs between <raytracer> and </raytracer>");
    }
    if (open_.size() == most_open) fail(start, "elements are nested more than 64 deep here; is a closing tag missing?");
    root_seen_ = true;
    note_node(start);
    if (cutter && in_group()) cutter->item(offset(open_.back().begin), open_.back().name, offset(start));
    attributes_.clear();
    while (true) {
      const char* const before = here_;
      skip_space();
      if (*here_ == '>') {
        ++here_;
        open_.push_back({element, start});
        return;
      }
      if (*here_ == '/' && here_[1] == '>') {
        here_ += 2;
        return;
      }
      if (*here_ == '\0' || *here_ == '<') fail(start, "the tag <" + printable(element) + " never ends; add '>'");
      if (!is(*here_, name_start) || before == here_) {
        fail(here_, "unexpected " + in_quotes({here_, std::max<std::size_t>(1, utf8_length(here_))}) + " in the tag " +
                        tag(element) + "; attributes look like x=\"1\" y=\"2\" (is a quote or a space missing?)");
      }
      const char* const attribute_start = here_;
      const auto [found, value] = attribute();
      if (std::find(attributes_.begin(), attributes_.end(), found) != attributes_.end()) {
        fail(attribute_start,
             "the attribute " + in_quotes(found) + " stands twice in " + tag(element) + "; remove one");
      }
      if (attributes_.size() == most_attributes) fail(attribute_start, tag(element) + " has more than 64 attributes");
      attributes_.push_back(found);
      note_value(value);
    }
  }

  void end_tag() {
    const char* const start = here_;
    here_ += 2;
    const std::string_view found = name();
    if (open_.empty()) fail(start, closing_tag(found) + " closes nothing; remove it");
    const OpenElement& last = open_.back();
    if (found != last.name) fail(start, guessing_ ? std::string() : mismatch(last, found));  // which takes long
    skip_space();
    if (*here_ != '>') fail(start, "the tag </" + printable(found) + " never ends; add '>'");
    ++here_;
    if (cutter && in_group()) cutter->end(offset(last.begin), offset(start));
    open_.pop_back();
  }

  /// What to say where `found` closes an element while `last` is the one to be closed: a slip in the name, or a closing
  /// tag left out.
  std::string mismatch(const OpenElement& last, std::string_view found) const {
    const bool closes_outer =
        std::any_of(open_.begin(), open_.end(), [&](const OpenElement& outer) { return outer.name == found; });
    if (!closes_outer && !nearest_name(found, {&last.name, 1}).empty()) {
      return closing_tag(found) + " does not match " + tag(last.name) + ", " + opened_in(last) + "; write " +
             closing_tag(last.name);
    }
    return tag(last.name) + ", " + opened_in(last) + ", is not closed before this " + closing_tag(found) + "; add " +
           closing_tag(last.name);
  }

  void comment_or_section() {
    const char* const start = here_;
    if (starts_with("<!--")) {
      here_ += 4;
      const std::size_t dashes = rest().find("--");
      const char* const text_start = here_;
      skip_past(start, "-->", "the comment");
      if (text_start + dashes + 3 != here_) fail(text_start + dashes, "'--' must not stand inside a comment");
    } else if (starts_with("<![CDATA[")) {
      if (open_.empty()) fail(start, "text outside the scene; remove it");
      note_node(start);
      skip_past(start, "]]>", "the CDATA section");
    } else if (starts_with("<!DOCTYPE") && is(here_[9], space)) {
      if (root_seen_ || doctype_seen_) fail(start, "<!DOCTYPE> must stand once, before <raytracer>; remove it");
      doctype_seen_ = true;
      here_ += 9;
      document_type(start);
    } else {
      fail(start, "'<!' starts neither a comment (<!-- ... -->) nor anything else that a scene may have");
    }
  }

  /// The rest of <!DOCTYPE name SYSTEM "file">.
  void document_type(const char* start) {
    skip_space();
    if (is(*here_, name_start)) name();
    skip_space();
    const int literals = starts_with("SYSTEM") ? 1 : starts_with("PUBLIC") ? 2 : 0;
    if (literals > 0) here_ += 6;
    for (int i = 0; i < literals; ++i) {
      skip_space();
      if (*here_ != '"' && *here_ != '\'') break;
      const char* const end = std::strchr(here_ + 1, *here_);
      if (end == nullptr) break;
      here_ = end + 1;
    }
    skip_space();
    if (*here_ == '[') fail(here_, "declarations inside <!DOCTYPE> are not part of the scene format; remove them");
    if (*here_ == '\0' || *here_ == '<') fail(start, "the <!DOCTYPE that starts here never ends; add '>'");
    if (*here_ != '>') fail(here_, "unexpected text in <!DOCTYPE>; write <!DOCTYPE raytracer>, or leave it out");
    ++here_;
  }

  [[noreturn]] void refuse_instruction() {
    const char* const start = here_;
    here_ += 2;
    if (name() == "xml") fail(start, "<?xml ... ?> must be the very first thing in the file, or be left out");
    fail(start, "processing instructions (<?...?>) are not part of the scene format; remove this one");
  }

  std::vector<OpenElement> open_;
  std::vector<std::string_view> attributes_;  // of the tag at hand
  bool root_seen_ = false;
  bool doctype_seen_ = false;

  bool guessing_ = false;  ///< whether it works for ItemsAhead
  std::optional<ItemsAhead> ahead_;
};

/// The first byte of `text` that XML in UTF-8 cannot have there, or its first byte if all of it is UTF-16 or UTF-32.
std::optional<TextError> find_encoding_error(std::string_view text, int threads) {
  using namespace std::string_view_literals;
  for (const std::string_view start : {"\xff\xfe"sv, "\xfe\xff"sv, "<\0"sv, "\0<"sv})
    if (text.starts_with(start)) return TextError{0, "the file is encoded as UTF-16 or UTF-32; save it as UTF-8"};
  const std::size_t invalid = find_invalid_utf8(text, threads);
  if (invalid == std::string_view::npos) return std::nullopt;
  const bool control = static_cast<unsigned char>(text[invalid]) < 0x20;
  return TextError{invalid,
                   "the byte " + in_quotes(text.substr(invalid, 1)) +
                       (control ? " is no text: is this a scene file?"
                                : " is no UTF-8 text; save the file as UTF-8 (is it one of another program?)")};
}

}  // namespace

std::optional<TextError> find_xml_error(std::string_view text, std::span<const std::string_view> groups,
                                        std::vector<TextChunk>& chunks, int threads) {
  if (auto error = find_encoding_error(text, threads)) return error;
  try {
    Scanner scanner(text);
    ChunkCutter cutter(groups, chunks);
    scanner.cutter = &cutter;
    scanner.look_ahead(worker_count(threads));
    scanner.scan();
  } catch (TextError& error) {
    return std::move(error);
  }
  return std::nullopt;
}

std::vector<std::size_t> find_nodes(std::string_view text) {
  std::vector<std::size_t> nodes;
  Scanner scanner(text);
  scanner.nodes = &nodes;
  scanner.scan();
  return nodes;
}

std::size_t element_length(std::string_view text) { return Scanner(text).scan_element(); }

std::vector<std::string_view> find_values(std::string_view text) {
  std::vector<std::string_view> values;
  Scanner scanner(text);
  scanner.values = &values;
  scanner.scan_element();
  return values;
}

std::size_t find_attribute(std::string_view text, std::size_t tag_offset, std::string_view name) {
  return Scanner(text).attribute_offset(tag_offset, name);
}

}  // namespace raytrace

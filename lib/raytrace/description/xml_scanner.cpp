#include "raytrace/description/xml_scanner.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>

#include "raytrace/description/encoding_problem.h"
#include "raytrace/description/line_index.h"
#include "raytrace/description/nearest_name.h"
#include "raytrace/description/quoted.h"
#include "raytrace/description/utf8.h"
#include "raytrace/parallel/for_each_index.h"

namespace raytrace {
namespace {

constexpr std::size_t most_open = 64;
constexpr std::size_t most_attributes = 64;
constexpr std::size_t group_depth = 3;

enum CharacterClass : std::uint8_t { space = 1, name_start = 2, name_part = 4, text_end = 8, value_end = 16 };

constexpr std::array<std::uint8_t, 256> character_classes = [] {
  std::array<std::uint8_t, 256> classes{};
  for (const char c : {' ', '\t', '\n', '\r'}) classes[static_cast<unsigned char>(c)] |= space;
  for (std::size_t c = 0; c < 256; ++c) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_' || c == ':' || c >= 0x80;
    if (letter) classes[c] |= name_start | name_part;
    if ((c >= '0' && c <= '9') || c == '-' || c == '.') classes[c] |= name_part;
  }
  for (const char c : {'\0', '<', '&', ']'}) classes[static_cast<unsigned char>(c)] |= text_end;
  for (const char c : {'\0', '<', '&', '"', '\''}) classes[static_cast<unsigned char>(c)] |= value_end;
  return classes;
}();

bool is(char c, std::uint8_t classes) { return (character_classes[static_cast<unsigned char>(c)] & classes) != 0; }

/// Walks over a text that has passed the check of its bytes, so that '\0' stands at its end and nowhere else.
/// Throws XmlProblem.
class Scanner {
 public:
  explicit Scanner(std::string_view text) : begin_(text.data()), end_(begin_ + text.size()), here_(begin_) {
    open_.reserve(most_open);
    attributes_.reserve(most_attributes);
  }

  /// nodes: receives what find_nodes returns.
  void collect_nodes(std::vector<std::size_t>& nodes) { nodes_ = &nodes; }

  void cut_pieces(PieceCutter& cutter) { cutter_ = &cutter; }

  /// Has up to so many threads look ahead in the groups that are cut.
  void look_ahead(int threads) { threads_ = threads; }

  void scan() {
    if (starts_with(byte_order_mark)) here_ += byte_order_mark.size();
    if (starts_with("<?xml") && !is(here_[5], name_part)) declaration();
    while (true) {
      skip_space();
      if (threads_ > 1 && at_item()) pass_scanned_items();
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

  /// Leaves the scanner behind the name of an attribute, having gone through the tag at `tag_offset` that far.
  std::size_t attribute_offset(std::size_t tag_offset, std::string_view wanted) {
    here_ = begin_ + tag_offset + 1;
    name();
    while (true) {
      skip_space();
      if (!is(*here_, name_start)) return tag_offset;
      const char* const start = here_;
      const std::string_view found = attribute();
      if (found == wanted) return offset(start);
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

  // Looking ahead. A large group is scanned in chunks by several threads, each chunk from what looks like the start of
  // an item, which it may not be: it may stand in a comment, in another item or behind the group. The scanner that
  // comes from the text's beginning knows. Where it finds itself at an item with which a chunk starts, it would go
  // through the chunk as that thread did, and need not. Chunks that it does not come to like that, or with a mistake,
  // it scans itself.

  static constexpr std::ptrdiff_t chunk_size = 1 << 18;
  static constexpr std::ptrdiff_t least_chunks = 8, most_chunks = 128;  ///< more while they are of use

  /// Items of one group and what is between them, from a '<' to another, or to the group's end tag.
  struct Chunk {
    const char *begin = nullptr, *end = nullptr;  ///< null if nothing is known
    std::vector<Piece> pieces;
  };

  /// At the '<' of an item's start tag.
  bool at_item() const { return open_.size() == group_depth && *here_ == '<' && is(here_[1], name_start); }

  /// From an item on: over as many as others have gone through.
  void pass_scanned_items() {
    if (here_ >= chunks_end_ || open_.back().begin != chunks_group_) scan_chunks();
    while (next_chunk_ < chunks_.size() && at_item()) {
      const Chunk& chunk = chunks_[next_chunk_];
      if (chunk.begin > here_) return;
      if (chunk.begin == here_) {
        cutter_->add(offset(open_.back().begin), open_.back().name, chunk.pieces);
        here_ = chunk.end;
        ++passed_chunks_;
      }
      ++next_chunk_;
    }
  }

  /// Makes those from this item on.
  void scan_chunks() {
    const bool useful = 2 * passed_chunks_ > chunks_.size();
    if (!useful && !chunks_.empty()) --chances_;
    wanted_chunks_ =
        useful && open_.back().begin == chunks_group_ ? std::min(2 * wanted_chunks_, most_chunks) : least_chunks;
    chunks_.clear();
    next_chunk_ = passed_chunks_ = 0;
    chunks_group_ = open_.back().begin;
    const std::ptrdiff_t count = std::min((end_ - here_) / chunk_size, wanted_chunks_);
    chunks_end_ = count == wanted_chunks_ ? here_ + count * chunk_size : end_;
    if (count < 2 || chances_ == 0 || !cutter_->cuts(open_.back().name)) return;
    const char* name_end = here_ + 1;
    while (is(*name_end, name_part)) ++name_end;
    const std::string_view item_start(here_, static_cast<std::size_t>(name_end - here_));
    chunks_.resize(static_cast<std::size_t>(count));
    for_each_index(static_cast<int>(count), threads_, [&](int i) {
      const char* const from = here_ + i * chunk_size;
      chunks_[static_cast<std::size_t>(i)] = scan_chunk(item_start, from, from + chunk_size);
    });
  }

  /// From the first item in [from, to) to the first behind.
  Chunk scan_chunk(std::string_view item_start, const char* from, const char* to) const {
    Chunk chunk;
    const char* const begin = find_item(item_start, from, to);
    if (begin == nullptr) return chunk;
    const std::ptrdiff_t scanned_most = to - begin_ + std::min(end_ - to, chunk_size);  // it may take all for a comment
    Scanner scanner({begin_, static_cast<std::size_t>(scanned_most)});
    scanner.open_ = open_;
    scanner.root_seen_ = scanner.guessing_ = true;
    scanner.here_ = begin;
    PieceCutter cutter(*cutter_, chunk.pieces);
    scanner.cut_pieces(cutter);
    try {
      if (!scanner.scan_items(to)) return chunk;
    } catch (const XmlProblem&) {
      return chunk;
    }
    chunk.begin = begin;
    chunk.end = scanner.here_;
    chunk.pieces.back().end = offset(chunk.end);
    return chunk;
  }

  static const char* find_item(std::string_view item_start, const char* from, const char* to) {
    while (true) {
      const std::size_t found = std::string_view(from, static_cast<std::size_t>(to - from)).find(item_start);
      if (found == std::string_view::npos) return nullptr;
      from += found;
      if (!is(from[item_start.size()], name_part)) return from;
      ++from;
    }
  }

  /// Up to the group's end tag or to the first item that is not before `to`; false if they are not found.
  bool scan_items(const char* to) {
    while (true) {
      skip_space();
      if (here_ > end_ || *here_ == '\0') return false;
      const bool at_end_tag = open_.size() == group_depth && here_[0] == '<' && here_[1] == '/';
      if (at_end_tag || (here_ >= to && at_item())) return true;
      scan_next();
    }
  }

  std::size_t offset(const char* at) const { return static_cast<std::size_t>(at - begin_); }

  [[noreturn]] void fail(const char* at, std::string message) const {
    throw XmlProblem{offset(at), std::move(message)};
  }

  std::string_view rest() const { return {here_, here_ < end_ ? static_cast<std::size_t>(end_ - here_) : 0}; }

  bool starts_with(std::string_view prefix) const { return rest().starts_with(prefix); }

  void skip_space() {
    while (is(*here_, space)) ++here_;
  }

  std::string_view name() {
    const char* const start = here_;
    while (is(*here_, name_part)) ++here_;
    return {start, static_cast<std::size_t>(here_ - start)};
  }

  std::string opened_in(const OpenElement& element) const {
    const SourceLocation location = LineIndex({begin_, offset(here_)}).locate(offset(element.begin));
    return "opened in line " + std::to_string(location.line) + ", column " + std::to_string(location.column);
  }

  void note_node(const char* at) {
    if (nodes_) nodes_->push_back(offset(at));
  }

  /// What comes after the next `end`; fails at `start` if there is none.
  void skip_past(const char* start, std::string_view end, const char* what) {
    const std::size_t found = rest().find(end);
    if (found == std::string_view::npos)
      fail(start, std::string(what) + " that starts here never ends; add " + std::string(end));
    here_ += found + end.size();
  }

  void declaration() {
    const char* const start = here_;
    here_ += 5;
    bool has_version = false;
    std::string_view encoding;
    for (skip_space(); is(*here_, name_start); skip_space()) {
      const char* const attribute_start = here_;
      const std::string_view found = attribute();
      if (found == "version") has_version = true;
      if (found == "encoding") encoding = attribute_value(attribute_start);
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

  /// The value, without its quotes, of an attribute that has passed the check and starts here.
  static std::string_view attribute_value(const char* at) {
    const char* const open_quote = std::strpbrk(at, "\"'");
    return {open_quote + 1, static_cast<std::size_t>(std::strchr(open_quote + 1, *open_quote) - open_quote - 1)};
  }

  void text() {
    if (open_.empty()) {
      if (root_seen_) fail(here_, "text after the end of the scene; remove it");
      fail(here_, "this is no XML: it starts with " + in_quotes({here_, std::strcspn(here_, "\r\n<")}) +
                      ", but a scene starts with <raytracer>");
    }
    note_node(here_);
    while (true) {
      while (!is(*here_, text_end)) ++here_;
      if (*here_ == '&')
        entity();
      else if (*here_ != ']')
        return;
      else if (starts_with("]]>"))
        fail(here_, "']]>' in a text must be written ']]&gt;'");
      else
        ++here_;
    }
  }

  void entity() {
    static constexpr std::string_view known[] = {"&amp;", "&lt;", "&gt;", "&quot;", "&apos;"};
    for (const std::string_view entity : known) {
      if (starts_with(entity)) {
        here_ += entity.size();
        return;
      }
    }
    const char* const start = here_;
    if (here_[1] == '#') {
      const bool hexadecimal = here_[2] == 'x';
      here_ += hexadecimal ? 3 : 2;
      const std::uint32_t base = hexadecimal ? 16 : 10;
      std::uint32_t character = 0;
      const char* const digits = here_;
      for (; digit(*here_) < base && character <= 0x10ffff; ++here_) character = character * base + digit(*here_);
      if (here_ > digits && *here_ == ';' && allowed(character)) {
        ++here_;
        return;
      }
      fail(start, in_quotes({start, static_cast<std::size_t>(here_ - start) + (*here_ == ';' ? 1 : 0)}) +
                      " is no character that XML allows");
    }
    ++here_;
    const std::string_view found = name();
    if (!found.empty() && *here_ == ';') {
      fail(start,
           "unknown entity " + in_quotes({start, found.size() + 2}) + "; XML knows &amp; &lt; &gt; &quot; and &apos;");
    }
    fail(start, "a '&' in a text must be written '&amp;'");
  }

  static std::uint32_t digit(char c) {
    if (c >= '0' && c <= '9') return static_cast<std::uint32_t>(c - '0');
    if (c >= 'a' && c <= 'f') return static_cast<std::uint32_t>(c - 'a' + 10);
    if (c >= 'A' && c <= 'F') return static_cast<std::uint32_t>(c - 'A' + 10);
    return 16;
  }

  static bool allowed(std::uint32_t character) {
    if (character < 0x20) return character == '\t' || character == '\n' || character == '\r';
    const bool surrogate = character >= 0xd800 && character <= 0xdfff;
    return character <= 0x10ffff && !surrogate && character != 0xfffe && character != 0xffff;
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
    if (cutter_ && open_.size() == group_depth)
      cutter_->item(offset(open_.back().begin), open_.back().name, offset(start));
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
      const std::string_view found = attribute();
      if (std::find(attributes_.begin(), attributes_.end(), found) != attributes_.end()) {
        fail(attribute_start,
             "the attribute " + in_quotes(found) + " stands twice in " + tag(element) + "; remove one");
      }
      if (attributes_.size() == most_attributes) fail(attribute_start, tag(element) + " has more than 64 attributes");
      attributes_.push_back(found);
    }
  }

  /// name="value" or name='value'; gives the name.
  std::string_view attribute() {
    const char* const start = here_;
    const std::string_view found = name();
    const auto example = [&] { return ", as in " + printable(found) + "=\"1\""; };
    skip_space();
    if (*here_ != '=') fail(start, "the attribute " + in_quotes(found) + " has no value; add one" + example());
    ++here_;
    skip_space();
    const char quote = *here_;
    if (quote != '"' && quote != '\'') {
      fail(here_, "the value of the attribute " + in_quotes(found) + " must stand in quotes" + example());
    }
    ++here_;
    while (true) {
      while (!is(*here_, value_end)) ++here_;
      if (*here_ == quote) break;
      if (*here_ == '&')
        entity();
      else if (*here_ == '"' || *here_ == '\'')
        ++here_;
      else
        fail(start, "the value of the attribute " + in_quotes(found) + " has no closing quote");
    }
    ++here_;
    return found;
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
    if (cutter_ && open_.size() == group_depth) cutter_->end(offset(last.begin), offset(start));
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
      here_ += std::strcspn(here_, "[>");
      if (*here_ == '[') fail(here_, "declarations inside <!DOCTYPE> are not part of the scene format; remove them");
      if (*here_ == '\0') fail(start, "the <!DOCTYPE that starts here never ends; add '>'");
      ++here_;
    } else {
      fail(start, "'<!' starts neither a comment (<!-- ... -->) nor anything else that a scene may have");
    }
  }

  [[noreturn]] void refuse_instruction() {
    const char* const start = here_;
    here_ += 2;
    if (name() == "xml") fail(start, "<?xml ... ?> must be the very first thing in the file, or be left out");
    fail(start, "processing instructions (<?...?>) are not part of the scene format; remove this one");
  }

  const char* begin_;
  const char* end_;
  const char* here_;
  std::vector<std::size_t>* nodes_ = nullptr;
  PieceCutter* cutter_ = nullptr;
  std::vector<OpenElement> open_;
  std::vector<std::string_view> attributes_;  // of the tag at hand
  bool root_seen_ = false;
  bool doctype_seen_ = false;

  int threads_ = 1;
  bool guessing_ = false;  ///< whether this scans a chunk
  std::vector<Chunk> chunks_;
  std::size_t next_chunk_ = 0, passed_chunks_ = 0;
  std::ptrdiff_t wanted_chunks_ = least_chunks;
  const char *chunks_end_ = nullptr, *chunks_group_ = nullptr;
  int chances_ = 64;  ///< so often may most chunks be scanned in vain: a text could be made for that
};

}  // namespace

std::optional<XmlProblem> find_xml_problem(std::string_view text, std::span<const std::string_view> groups,
                                           std::vector<Piece>& pieces, int threads) {
  if (auto problem = find_encoding_problem(text)) return problem;
  try {
    Scanner scanner(text);
    PieceCutter cutter(groups, pieces);
    scanner.cut_pieces(cutter);
    scanner.look_ahead(worker_count(threads));
    scanner.scan();
  } catch (XmlProblem& problem) {
    return std::move(problem);
  }
  return std::nullopt;
}

std::vector<std::size_t> find_nodes(std::string_view text) {
  std::vector<std::size_t> nodes;
  Scanner scanner(text);
  scanner.collect_nodes(nodes);
  scanner.scan();
  return nodes;
}

std::size_t find_attribute(std::string_view text, std::size_t tag_offset, std::string_view name) {
  return Scanner(text).attribute_offset(tag_offset, name);
}

}  // namespace raytrace

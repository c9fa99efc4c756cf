// Large groups are scanned by several threads that guess where items start, with the same result.
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "raytrace/xml/xml_scanner.h"
#include "support/catch.h"

namespace raytrace::test {
namespace {

const std::string_view groups[] = {"as", "bs"};

struct Scanned {
  std::string error;  ///< empty if there is none
  std::vector<TextChunk> chunks;
};

Scanned scan(const std::string& text, int threads) {
  Scanned scanned;
  if (const auto error = find_xml_error(text, groups, scanned.chunks, threads))
    scanned.error = std::to_string(error->offset) + ": " + error->message;
  return scanned;
}

/// What the chunks of a group have in common however they are cut.
struct Group {
  std::size_t group, begin, end, items;
  friend bool operator==(const Group&, const Group&) = default;
};

std::vector<Group> joined(const std::vector<TextChunk>& chunks) {
  std::vector<Group> result;
  for (const TextChunk& chunk : chunks) {
    if (result.empty() || result.back().group != chunk.group) {
      result.push_back({chunk.group, chunk.begin, chunk.end, chunk.items});
    } else {
      REQUIRE(chunk.begin == result.back().end);
      result.back().end = chunk.end;
      result.back().items += chunk.items;
    }
  }
  return result;
}

std::string plain_item(int i) {
  const std::string number = std::to_string(i);
  return "<a><name>" + number + "</name>\n<center x=\"" + number + "\" y='0'/></a>\n";
}

std::string repeated(const std::string& what, std::size_t bytes) {
  std::string text;
  while (text.size() < bytes) text += what;
  return text;
}

/// Of some megabytes. item(i): what stands for item i.
std::string text_of(const std::function<std::string(int)>& item, const std::string& behind = "</as></s></root>") {
  std::string text = "<root><s><as>";
  for (int i = 0; text.size() < (std::size_t{3} << 20U); ++i) text += item(i);
  return text + behind;
}

void check_alike(const std::string& text) {
  const Scanned alone = scan(text, 1);
  const Scanned together = scan(text, 4);
  REQUIRE(together.error == alone.error);
  if (alone.error.empty()) REQUIRE(joined(together.chunks) == joined(alone.chunks));
}

}  // namespace

TEST_CASE("threads find the items that one finds") {
  const std::string text = text_of(plain_item);
  const std::vector<Group> found = joined(scan(text, 4).chunks);
  REQUIRE(found.size() == 1);
  CHECK(found[0].group == text.find("<as>"));
  CHECK(found[0].begin == text.find("<a>"));
  CHECK(found[0].end == text.find("</as>"));
  std::size_t items = 0;
  for (std::size_t at = text.find("<a>"); at != std::string::npos; at = text.find("<a>", at + 1)) ++items;
  CHECK(found[0].items == items);
  check_alike(text);
}

TEST_CASE("what only looks like an item is none") {
  const std::size_t large = 700'000;  // more than what a thread takes at once
  const std::string items = repeated(plain_item(7), large);
  const std::vector<std::string> traps{
      "<!-- " + items + "-->",
      "<a><![CDATA[" + items + "]]></a>",
      "<a><deeper>" + items + "</deeper></a>",
      "<a>" + items + "</a>",
      "<ab/><a.b><a/></a.b>",
      repeated("<other>" + plain_item(3) + "</other>", large),
      "<a title='" + std::string(large, 'x') + "'/>",
      "text" + std::string(large, ' ') + "<!-- <a> --> &amp; ]] text",
      "</as><as>",
      "</as><bs>" + items + repeated("<b/>", large) + "</bs><as>",
      "</as><cs>" + items + "</cs><as x='1'>",
      "</as></s><s>" + items + "<as>",
  };
  for (std::size_t i = 0; i < traps.size(); ++i) {
    INFO("trap " << i);
    for (const int where : {0, 20000})
      check_alike(text_of([&](int item) { return item == where ? traps[i] + plain_item(item) : plain_item(item); }));
  }
  std::mt19937 random(3);
  check_alike(text_of([&](int item) {
    return random() % 4000 == 0 ? traps[random() % traps.size()] + plain_item(item) : plain_item(item);
  }));
  check_alike(text_of(plain_item, "</as>" + repeated("<as><a/></as><bs><b/></bs>", large) + "</s></root>"));
}

TEST_CASE("the first error of a text is the same for all threads") {
  const std::vector<std::string> mistakes{
      "<a><name></a>",
      "</a>",
      "<a x=1/>",
      "<a x='1' x='2'/>",
      "<a>&nothing;</a>",
      "<a></as>",
      "<!-- -- -->",
      "<!-- ",
      "<a><![CDATA[ ",
      "<a x='",
      "</as></s></root><a>",
      "<?processing?",
      "<!DOCTYPE>",
      "<a>]]></a>",
      "<",
  };
  for (const std::string& mistake : mistakes) {
    INFO(mistake);
    for (const int where : {1, 30000}) {
      const std::string text =
          text_of([&](int item) { return item == where ? mistake + plain_item(item) : plain_item(item); });
      REQUIRE_FALSE(scan(text, 4).error.empty());
      check_alike(text);
    }
  }
  check_alike(text_of(plain_item, ""));
  check_alike(text_of(plain_item, "</as></s>"));
  check_alike(text_of([](int) { return "<a>"; }));
}

}  // namespace raytrace::test

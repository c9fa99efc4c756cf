// XML as such: what is accepted, what is said about a text that is none, and where.
#include <string>

#include "raytrace/description/scene_layout.h"
#include "raytrace/text/message.h"
#include "raytrace/xml/diagnostics.h"
#include "raytrace/xml/document.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

const std::string fine = scene_with("");

/// Puts `part` where the scene has its only end of line.
std::string with_part(const std::string& part) { return scene_with(part); }

}  // namespace

TEST_CASE("all that XML allows around a scene is accepted") {
  CHECK(reported(fine) == "");
  CHECK(reported("\xef\xbb\xbf" + fine) == "");
  CHECK(reported("<?xml version=\"1.0\"?>" + fine) == "");
  CHECK(reported("<?xml version='1.0' encoding='utf-8' standalone='yes' ?>\n" + fine) == "");
  CHECK(reported("\xef\xbb\xbf<?xml version=\"1.0\" encoding=\"UTF-8\"?><!-- a --><!DOCTYPE raytracer>" + fine) == "");
  CHECK(reported("<!DOCTYPE raytracer SYSTEM \"a.dtd\">" + fine + "<!-- the end -->\n\n") == "");
  CHECK(reported(with_part("<!-- <objects> & -> - > -->")) == "");
  CHECK(reported(with_part("<objects></objects><objects\n/><objects ></objects >")) == "");
  CHECK(reported(with_part(
            "\r\n\t<lights><ambientlight><color red = '1'\n\tgreen=\"0\" blue='0'/></ambientlight></lights>")) == "");
  CHECK(reported(with_part("<lights><![CDATA[ ]]></lights>")) == "");
}

TEST_CASE("entities and sections give the characters they stand for") {
  const auto name = [](const std::string& text) {
    const std::string sphere =
        "<name>" + text +
        "</name><center x='0' y='&#48;' z='&#x30;'/><radius>&#49;.5</radius><material>clay</material>";
    const auto item = std::get<ObjectItems<Sphere>>(accepted(scene_with_sphere(sphere)).objects).at(0);
    CHECK(item.parameters.radius == 1.5);
    return item.name;
  };
  CHECK(name("a &amp; b &lt;&gt; &quot;c&apos;") == "a & b <> \"c'");
  CHECK(name("&#x1F600;&#252;") == "\xf0\x9f\x98\x80\xc3\xbc");
  CHECK(name("  \n two words \t") == "two words");
  CHECK(name("<![CDATA[a & <b>]]>") == "a & <b>");
  CHECK(name("<!-- it is -->ball") == "ball");
  CHECK(name("ball<!-- it is -->") == "ball");
  CHECK(name("a > b") == "a > b");
}

TEST_CASE("columns count bytes from 1 and no byte order mark") {
  CHECK(reported("\xef\xbb\xbf<raytracer") == "s:1:1: error: the tag <raytracer never ends; add '>'\n");
  CHECK(reported("\n  <a/>") == "s:2:3: error: the scene starts with <a>; it must be <raytracer>\n");
  CHECK(reported("\r\n\t<a/>") == "s:2:2: error: the scene starts with <a>; it must be <raytracer>\n");
  const std::string umlauts = "<!-- \xc3\xa4\xc3\xb6 --><a/>";
  CHECK(reported(umlauts) == "s:1:14: error: the scene starts with <a>; it must be <raytracer>\n");
}

TEST_CASE("lines and columns are found behind all that may stand before them") {
  const std::string before = "<!-- <lamp/> \n -->\n<lights><![CDATA[\n]]><!-- --> </lights>  <objects/>";
  CHECK(reported(with_part(before + "<lamps/>")) == "s:5:34: error: unknown element <lamps> in <raytracer>; it takes " +
                                                        list_of_tags(elements_in(root_element)) + "\n");
  CHECK(reported(with_part("<objects>\n a <spheres/> <!-- --> \n  b <spheres/></objects>")) ==
        "s:3:2: error: unexpected text 'a' in <objects>, which takes only elements\n"
        "s:4:3: error: unexpected text 'b' in <objects>, which takes only elements\n");
  CHECK(reported(
            with_part("<lights><ambientlight><color red='a>b'\n  green='x'\n\tblue='0'/></ambientlight></lights>")) ==
        "s:2:30: error: 'a>b' for red in <color> is not a number; write one such as 1.5\n"
        "s:3:3: error: 'x' for green in <color> is not a number; write one such as 1.5\n");
}

TEST_CASE("the closing tag that is missing is named") {
  CHECK(
      reported("<raytracer>\n  <objects>\n</raytracer>") ==
      "s:3:1: error: <objects>, opened in line 2, column 3, is not closed before this </raytracer>; add </objects>\n");
  CHECK(reported("<raytracer>\n  <objects>\n  </object>\n</raytracer>") ==
        "s:3:3: error: </object> does not match <objects>, opened in line 2, column 3; write </objects>\n");
  CHECK(reported("<raytracer>\n  <objects>\n") == "s:2:3: error: <objects> is never closed; add </objects>\n");
}

TEST_CASE("bytes that are no text are refused where they stand") {
  using namespace std::string_literals;
  CHECK(reported("<a>\n\x01</a>") == "s:2:1: error: the byte '\\x01' is no text: is this a scene file?\n");
  CHECK(reported("<a>\0</a>"s) == "s:1:4: error: the byte '\\x00' is no text: is this a scene file?\n");
  for (const char* bytes : {"\xff", "\xc3", "\xc0\xaf", "\xe0\x80\xaf", "\xed\xa0\x80", "\xef\xbf\xbe",
                            "\xf4\x90\x80\x80", "\xf8\x88\x80\x80"}) {
    CHECK(contains(reported("<a>" + std::string(bytes) + "</a>"), "s:1:4: error: the byte '\\x"));
  }
  // Beyond the first block that is checked at once.
  CHECK(contains(reported(std::string(10000, '\n') + "\x7f\x80"), "s:10001:2: error: the byte '\\x80' is no UTF-8"));
  for (const std::string& text : {"\xff\xfe<\0"s, "\xfe\xff\0<"s, "<\0r\0"s, "\0<\0r"s}) {
    CHECK(reported(text) == "s:1:1: error: the file is encoded as UTF-16 or UTF-32; save it as UTF-8\n");
  }
}

TEST_CASE("numeric entities must be characters") {
  for (const char* entity : {"&#0;", "&#x0;", "&#xD800;", "&#xFFFE;", "&#1114112;", "&#x110000;",
                             "&#99999999999999999999;", "&#;", "&#x;", "&#xg;", "&#12", "&#8;"}) {
    CHECK(contains(reported(scene_with_sphere("<name>" + std::string(entity) + "</name>")),
                   "is no character that XML allows"));
  }
}

TEST_CASE("the first and the last byte of each line have their lines and columns, counted from anywhere before") {
  const std::string text = "ab\n\ncd";
  const auto at = [&](std::size_t offset) {
    const SourceLocation location = locate(text, offset);
    for (std::size_t from = 0; from <= offset; ++from) {
      LineMark mark = first_mark(text);
      mark.pass(std::string_view(text).substr(0, from));
      mark.pass(std::string_view(text).substr(from, offset - from));
      const SourceLocation same = mark.location();
      CHECK(same.line == location.line);
      CHECK(same.column == location.column);
    }
    return std::to_string(location.line) + ":" + std::to_string(location.column);
  };
  CHECK(at(0) == "1:1");
  CHECK(at(2) == "1:3");
  CHECK(at(3) == "2:1");
  CHECK(at(4) == "3:1");
  CHECK(at(6) == "3:3");
}

}  // namespace raytrace::test

// Inputs made to crash, stall or exhaust a reader. Each must be answered, and with a few short lines.
#include <algorithm>
#include <string>

#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

std::string repeated(std::size_t count, const std::string& text) {
  std::string result;
  result.reserve(count * text.size());
  for (std::size_t i = 0; i < count; ++i) result += text;
  return result;
}

/// Reads the text and checks that the answer is bounded, whatever was in it.
std::string bounded_report(const std::string& text) {
  const std::string found = reported(text);
  CHECK_FALSE(found.empty());
  CHECK(found.size() < 60000);
  CHECK(std::all_of(found.begin(), found.end(), [](char c) { return c == '\n' || (c >= 0x20 && c < 0x7f); }));
  return found;
}

}  // namespace

TEST_CASE("100,000 nested elements are refused") {
  CHECK(contains(bounded_report(repeated(100000, "<raytracer>")), "nested more than 64 deep"));
  const std::string deep = repeated(100000, "<a>") + repeated(100000, "</a>");
  CHECK(contains(bounded_report("<raytracer>" + deep + "</raytracer>"), "nested more than 64 deep"));
}

TEST_CASE("a tag of a million attributes is refused") {
  std::string tag = "<raytracer><objects";
  for (int i = 0; i < 1000000; ++i) tag += " a" + std::to_string(i) + "='1'";
  CHECK(contains(bounded_report(tag + "/></raytracer>"), "more than 64 attributes"));
}

TEST_CASE("very many unknown elements are counted, not listed") {
  CHECK(contains(bounded_report("<raytracer>" + repeated(100000, "<spehre/>") + "</raytracer>"),
                 "more errors not shown"));
  CHECK(contains(bounded_report(scene_with_sphere(repeated(100000, "<raduis x='1'/>"))), "more errors not shown"));
  CHECK(contains(bounded_report(scene_with("<objects>" + repeated(100000, "x<!-- -->") + "</objects>")),
                 "more errors not shown"));
}

TEST_CASE("very many repeated and missing parts are counted, not listed") {
  CHECK(contains(bounded_report(scene_with_sphere(repeated(100000, "<radius>1</radius>"))), "more errors not shown"));
  CHECK(contains(
      bounded_report(scene_with("<objects><spheres>" + repeated(100000, "<sphere/>") + "</spheres></objects>")),
      "more errors not shown"));
  CHECK(contains(bounded_report(scene_with(repeated(100000, "<viewplane/><camera/>"))), "more errors not shown"));
  CHECK(contains(bounded_report(scene_with("<lights>" + repeated(100000, "<ambientlight/>") + "</lights>")),
                 "more errors not shown"));
}

TEST_CASE("50,000 materials and objects with errors are answered") {
  std::string materials, objects;
  for (int i = 0; i < 50000; ++i) {
    materials += "<matte><name>material" + std::to_string(i) +
                 "</name><ka>0</ka><kd>1</kd><cd red='1' green='1' blue='1'/></matte>";
    objects += "<sphere><name>same</name><center x='0' y='0' z='0'/><radius>1</radius><material>materiall" +
               std::to_string(i) + "</material></sphere>";
  }
  CHECK(
      contains(bounded_report(scene_with("<materials><mattes>" + materials + "</mattes></materials><objects><spheres>" +
                                         objects + "</spheres></objects>")),
               "more errors not shown"));
}

TEST_CASE("very many groups and sections of nothing are nothing") {
#if defined(__SANITIZE_THREAD__)
  constexpr std::size_t count = 10'000;  // each takes the thread sanitizer half a millisecond
#else
  constexpr std::size_t count = 200'000;
#endif
  CHECK(reported(scene_with("<objects>" + repeated(count, "<spheres/>") + "</objects>" +
                            repeated(count, "<objects/>"))) == "");
}

TEST_CASE("texts and names of megabytes are shortened") {
  const std::string megabytes(10 << 20, 'a');
  bounded_report(std::string(10 << 20, '<'));
  bounded_report(std::string(10 << 20, '&'));
  bounded_report(std::string(10 << 20, ' '));
  bounded_report(megabytes);
  bounded_report("<" + megabytes);
  bounded_report("<raytracer " + megabytes + "=''");
  bounded_report("<raytracer>&" + megabytes);
  bounded_report("<raytracer><!--" + megabytes);
  bounded_report("<raytracer></" + megabytes);
  bounded_report("<raytracer><" + megabytes + "/></raytracer>");
  bounded_report("<raytracer " + megabytes + "='" + megabytes + "'/>");
  bounded_report("<" + megabytes + "></" + megabytes + "b>");
  bounded_report("<?xml version='1.0' encoding='" + megabytes + "'?><raytracer/>");
  bounded_report(scene_with_sphere("<radius>" + std::string(10 << 20, '9') + "</radius>"));
  bounded_report(scene_with_sphere("<radius>0." + std::string(10 << 20, '0') + "1x</radius>"));
  bounded_report(scene_with_sphere("<name>" + megabytes + "</name><material>" + megabytes + "</material>"));
  bounded_report(scene_with_sphere("<" + megabytes + "/><center " + megabytes + "='1'/>"));
  bounded_report(scene_with_sphere("<center x='" + megabytes + "' y='" + megabytes + "'/>"));
}

TEST_CASE("binary junk is refused") {
  std::string junk;
  unsigned state = 1;
  for (int i = 0; i < 100000; ++i) {
    state = state * 1664525u + 1013904223u;
    junk += static_cast<char>(state >> 24);
  }
  bounded_report(junk);
  bounded_report("<raytracer>" + junk);
}

}  // namespace raytrace::test

// Numbers must not depend on where the user lives.
#include <clocale>
#include <locale>

#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {
namespace {

/// As in most of Europe: 1.234,5.
class CommaNumbers : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

class ForeignLocale {
 public:
  ForeignLocale() : cpp_(std::locale::global(std::locale(std::locale::classic(), new CommaNumbers))) {
    // The C library's too, where the system has such a locale.
    for (const char* name : {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "pt_BR.UTF-8", "ru_RU.UTF-8"}) {
      if (std::setlocale(LC_ALL, name)) break;
    }
  }
  ~ForeignLocale() {
    std::setlocale(LC_ALL, "C");
    std::locale::global(cpp_);
  }

 private:
  std::locale cpp_;
};

}  // namespace

TEST_CASE("scenes are read, printed and refused in every locale alike") {
  const std::string text =
      scene_with_sphere("<center x='1.25' y='-1e-3' z='123456.5'/><radius>0.5</radius><material>clay</material>");
  const std::string faulty =
      std::string(1234, '\n') + scene_with_sphere("<center x='1,5' y='0' z='0'/><radius>1234567.5.</radius>");
  const std::string printed = print_scene(accepted(text));
  const std::string found = reported(faulty);
  CHECK(contains(found, "s:1236:9: error: '1,5' for x in <center> is not a number; write it with a point: 1.5\n"));

  const ForeignLocale foreign;
  CHECK(std::get<ObjectItems<Sphere>>(accepted(text).objects).at(0).parameters.center.x == 1.25);
  CHECK(print_scene(accepted(text)) == printed);
  CHECK(reported(faulty) == found);
}

}  // namespace raytrace::test

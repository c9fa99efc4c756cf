// Numbers must not depend on where the user lives.
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <locale>

#include "raytrace/batch/checkpoint.h"
#include "raytrace/text/message.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/sample_pieces.h"
#include "support/temporary_folder.h"

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
    // The C library's too: one of our own, since few systems have such a locale.
    write_text(folder_.file("source"),
               "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n");
    const std::string command = "localedef -c -f ANSI_X3.4-1968 -i " + folder_.file("source") + " " +
                                folder_.file("aa_AA") + " >/dev/null 2>&1";
    static_cast<void>(std::system(command.c_str()));  // it warns of what a whole locale would have
    setenv("LOCPATH", folder_.path().c_str(), 1);
    REQUIRE(std::setlocale(LC_NUMERIC, "aa_AA") != nullptr);
    char text[8];
    std::snprintf(text, sizeof text, "%.1f", 1.5);
    REQUIRE(text == std::string("1,5"));
  }
  ~ForeignLocale() {
    std::setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
    std::locale::global(cpp_);
  }

 private:
  TemporaryFolder folder_;
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

TEST_CASE("checkpoints and messages are the same in every locale") {
  const TemporaryFolder folder;
  SamplePiece piece;
  piece.partial = true;
  const PieceIdentity identity = identity_of(piece);
  const ErrorOfPasses::Sums error{1.0 / 3, 1e-5};
  ImageMetadata metadata;
  metadata.software = identity.provenance.software;
  metadata.seed = identity.film.seed;
  const auto write = [&](const std::string& name) {
    write_checkpoint(folder.file(name), film_of(piece), identity, metadata, error);
  };
  const auto read_error = [&](const std::string& name) {
    Film film(identity.film);
    const ErrorOfPasses::Sums read = read_checkpoint(folder.file(name), identity, film);
    return read.variance == error.variance && read.samples == error.samples;
  };
  write("here.exr");
  CHECK(read_error("here.exr"));
  const ForeignLocale foreign;
  CHECK(read_error("here.exr"));
  write("there.exr");
  CHECK(read_error("there.exr"));
  CHECK(time_taken(1.25) == " in 1.250 s");
}

}  // namespace raytrace::test

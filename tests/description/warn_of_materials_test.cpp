#include "raytrace/description/warn_of_materials.h"

#include "description/reported.h"
#include "support/catch.h"

namespace raytrace::test {

namespace {

std::string materials_with(const std::string& more) { return scene_with("<materials>" + more + "</materials>"); }

std::string matte_of(const std::string& kd, const std::string& red) {
  return materials_with("<mattes><matte><name>m</name><ka>1</ka><kd>" + kd + "</kd><cd red='" + red +
                        "' green='0' blue='0'/></matte></mattes>");
}

std::string film_of(const std::string& thickness) {
  return materials_with("<openpbrs><openpbr><name>m</name><thin_film_thickness>" + thickness +
                        "</thin_film_thickness></openpbr></openpbrs>");
}

std::string fog_on(const std::string& objects) {
  return scene_with(
      "<materials><fogs><fog><name>mist</name><meanfreepath>1</meanfreepath></fog></fogs></materials>"
      "<objects>" +
      objects + "</objects>");
}

}  // namespace

TEST_CASE("a surface that reflects more light than it gets is a warning") {
  CHECK(reported(matte_of("1", "1")).empty());
  CHECK(reported(matte_of("0.7", "1.42857142857143")).empty());
  CHECK(reported(matte_of("0.1", "9")).empty());
  CHECK(reported(matte_of("0.5", "200")) ==
        "s:2: warning: <kd> times <cd> of the material 'm' is 100, above 1: light grows where it is reflected\n");
  CHECK(reported(materials_with("<openpbrs><openpbr><name>m</name><base_color red='2' green='0' blue='0'/></openpbr>"
                                "</openpbrs>")) ==
        "s:2: warning: <base_weight> times <base_color> of the material 'm' is 2, above 1: light grows where it is "
        "reflected\n");
}

TEST_CASE("a film whose thickness is one in nanometres is a warning") {
  CHECK(reported(film_of("20")).empty());
  CHECK(reported(film_of("550")) ==
        "s:2: warning: <thin_film_thickness> of the material 'm' is in micrometres: 550 nanometres are 0.55\n");
}

TEST_CASE("fog on a plane or a disk is a warning") {
  CHECK(reported(fog_on("<planes><plane><point x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><material>mist</material>"
                        "</plane></planes>")) ==
        "s:2: warning: a <fog> on a <plane>, which has no inside; fill an object with it that is closed, such as a "
        "<box>\n");
  CHECK(reported(fog_on("<disks><disk><center x='0' y='0' z='0'/><normal x='0' y='1' z='0'/><radius>1</radius>"
                        "<material>mist</material></disk></disks>")) ==
        "s:2: warning: a <fog> on a <disk>, which has no inside; fill an object with it that is closed, such as a "
        "<box>\n");
  CHECK(reported(fog_on("<boxes><box><min x='0' y='0' z='0'/><max x='1' y='1' z='1'/><material>mist</material></box>"
                        "</boxes>"))
            .empty());
}

}  // namespace raytrace::test

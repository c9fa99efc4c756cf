// Files of other formats, given as a scene.
#include <string>

#include "raytrace/xml/scene_text.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"

namespace raytrace::test {

TEST_CASE("a file of another format is named by what it seems to be") {
  using namespace std::string_literals;
  const auto check = [](const std::string& text, const std::string& name, const std::string& advice = "") {
    CHECK(reported(text) == "s:1:1: error: this seems to be " + name +
                                "; raytrace reads scenes in XML, which start with <raytracer>" + advice + "\n");
  };
  const std::string obj = "a Wavefront OBJ model";
  const std::string model = ", and models by their names' ends: .glb, .gltf, .obj, .ply, .stl, .fbx, .dae and others",
                    other = ", and models in .glb, .gltf, .obj, .ply and .stl: export it as one of them",
                    povray = "; docs/from-pov-ray.md tells how to come over";
  check("# Blender v3.4\nmtllib a.mtl\no Cube\nv 1 1 1\n", obj, model);
  check("\r\n#\r\n\r\nv 0 0 0\r\n", obj, model);
  check("\xef\xbb\xbfvn 0 0 1\n", obj, model);
  check("ply\nformat ascii 1.0\n", "a PLY model", model);
  check("solid cube\nfacet normal 0 0 1\n", "an STL model", model);
  check(std::string(80, 'x') + "\1\0\0\0"s + std::string(50, '\0'), "an STL model", model);
  check("glTF\2\0\0\0"s, "a glTF model (.glb)", model);
  check("{ \"asset\": { \"version\": \"2.0\" } }", "a glTF model", model);
  check("BLENDER-v300", "a Blender file", other);
  check("Kaydara FBX Binary  \0"s, "an FBX model", model);
  check("\x28\xb5\x2f\xfd\0"s, "packed with zstd, as Blender does with its files", "; unpack it first");
  check("\x1f\x8b\x08\0"s, "packed with gzip", "; unpack it first");
  check("\x89PNG\r\n\x1a\n\0"s, "a PNG picture", "; if it is the picture to write, put -o before it");
  check("\x76\x2f\x31\x01\2\0"s, "an OpenEXR picture", "; if it is a piece of a picture, use raytrace merge");
  check("\xff\xd8\xff\xe0", "a JPEG picture", "; if it is the picture to write, put -o before it");
  check("// a sphere\n#include \"colors.inc\"\n", "a POV-Ray scene", povray);
  check("camera { location <0, 2, -3> }", "a POV-Ray scene", povray);
  check("# pbrt\nLookAt 0 0 1  0 0 0  0 1 0\n", "a pbrt scene");
  check("#usda 1.0\n", "a USD scene", other);
}

TEST_CASE("a Mitsuba scene, which is XML, is named by its root") {
  CHECK(reported("<scene version='3.0.0'><integrator type='path'/></scene>") ==
        "s:1:1: error: the scene starts with <scene>; it must be <raytracer>. This seems to be a Mitsuba scene: "
        "docs/from-mitsuba.md tells how to come over\n");
}

TEST_CASE("what is not known, and what is XML, is said to be of no type") {
  for (const char* const text : {"", "volume", "no scene", "{ \"viewplane\": 4 }", "<scene/>", "\n <raytracer"})
    CHECK_FALSE(explain_file_type(text));
  CHECK(contains(reported("volume 3"), "this is no XML: it starts with 'volume 3'"));
  CHECK(contains(reported(std::string("\xff\xfe#\0 \0", 6)), "encoded as UTF-16 or UTF-32; save it as UTF-8"));
}

}  // namespace raytrace::test

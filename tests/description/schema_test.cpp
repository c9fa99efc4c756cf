// scenes/raytracer.xsd and the program: the same format, and what the schema refuses the program refuses too.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "random_description.h"
#include "raytrace/description/scene_description.h"
#include "raytrace/description/scene_layout.h"
#include "reported.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {
namespace {

namespace fs = std::filesystem;

const fs::path schema = RAYTRACE_SOURCE_DIR "/scenes/raytracer.xsd";

/// The scene files below a folder.
std::vector<fs::path> scenes_in(const fs::path& folder) {
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".xml") scenes.push_back(entry.path());
  }
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

/// Whatever the files that its textures name.
bool program_accepts(const fs::path& file) {
  Diagnostics diagnostics(file.string());
  return parse_scene(bytes_of(file), diagnostics).has_value();
}

/// Those of the files that xmllint finds valid.
std::set<fs::path> valid_by_schema(const std::vector<fs::path>& files) {
  std::string command = "xmllint --noout --schema '" + schema.string() + "'";
  for (const fs::path& file : files) command += " '" + file.string() + "'";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> output(popen((command + " 2>&1").c_str(), "r"), pclose);
  REQUIRE(output);
  std::string said;
  std::array<char, 4096> buffer{};
  while (const std::size_t length = std::fread(buffer.data(), 1, buffer.size(), output.get()))
    said.append(buffer.data(), length);
  INFO(said.substr(0, 2000));
  REQUIRE_FALSE(contains(said, "xmllint: not found"));
  REQUIRE_FALSE(contains(said, "Schemas parser error"));
  std::set<fs::path> valid;
  for (const fs::path& file : files) {
    if (contains("\n" + said, "\n" + file.string() + " validates\n")) valid.insert(file);
  }
  return valid;
}

/// Damages a scene a little, in ways that keep it well-formed more often than not.
std::string mutated(const std::string& text, std::mt19937_64& random) {
  static const std::vector<std::string> values = {
      "0",     "-1",  "+1",         " 2 ",        "1.",   ".5",    "1e3",  "1E-3",  "1e+17",  "1e18",  "-1e17",
      "nan",   "INF", "",           " ",          "true", ">true", "> 1",  ">>1",   "false ", "0x1",   "1,5",
      "00012", "-0",  "2147483647", "2147483648", "1.0",  "a",     "a  b", "65537", "1e-17",  "1e-18", "\n3\t"};
  static const std::vector<std::string> names = {"sphere", "spheres", "radius", "name", "material",
                                                 "x",      "matte",   "lights", "foo"};
  std::string result = text;
  for (std::size_t i = 1 + random() % 2; i > 0; --i) {
    const std::size_t from = random() % result.size();
    const std::string& value = values[random() % values.size()];
    const std::size_t close = result.find("</", from);
    const std::size_t quote = result.find('"', from);
    switch (random() % 6) {
      case 0: {  // another text in an element
        if (close == std::string::npos) break;
        const std::size_t open = result.rfind('>', close);
        result.replace(open + 1, close - open - 1, value);
        break;
      }
      case 1: {  // another value of an attribute
        if (quote == std::string::npos) break;
        const std::size_t end = result.find('"', quote + 1);
        if (end != std::string::npos && result.find_first_of("<>", quote) > end)
          result.replace(quote + 1, end - quote - 1, value);
        break;
      }
      case 2:
      case 3: {  // a line removed, or repeated somewhere
        const std::size_t start = result.rfind('\n', from) + 1;
        const std::size_t end = std::min(result.find('\n', from), result.size() - 1) + 1;
        const std::string line = result.substr(start, end - start);
        if (random() % 2)
          result.erase(start, end - start);
        else
          result.insert(result.rfind('\n', random() % result.size()) + 1, line);
        break;
      }
      case 4: {  // another name of an element
        const std::size_t open = result.find('<', from);
        if (open == std::string::npos) break;
        const std::size_t end = result.find_first_of(" />", open + 1);
        const std::string old = result.substr(open + 1, end - open - 1);
        const std::string& name = names[random() % names.size()];
        const std::size_t closing = old.empty() ? std::string::npos : result.find("</" + old + ">", open);
        if (closing != std::string::npos) result.replace(closing + 2, old.size(), name);
        result.replace(open + 1, old.size(), name);
        break;
      }
      default: {  // text or an attribute where none was
        const std::size_t end = result.find('>', from);
        if (end == std::string::npos || end == 0) break;
        if (random() % 2)
          result.insert(end + 1, value);
        else
          result.insert(result[end - 1] == '/' ? end - 1 : end,
                        " " + names[random() % names.size()] + "=\"" + value + "\"");
      }
    }
    if (result.empty()) result = text;
  }
  return result;
}

}  // namespace

TEST_CASE("the schema file is the one that the registries make", "[schema]") {
  if (std::getenv("RAYTRACE_UPDATE_SCHEMA")) std::ofstream(schema, std::ios::binary) << print_schema();
  INFO("After a change of the registries: RAYTRACE_UPDATE_SCHEMA=1 description_tests '[schema]' writes it anew.");
  CHECK(bytes_of(schema) == print_schema());
}

TEST_CASE("the schema has an element for each field and each part of the frame", "[schema]") {
  const std::string text = bytes_of(schema);
  const auto has = [&](std::string_view element) {
    return contains(text, "<xs:element name=\"" + std::string(element) + "\"");
  };
  for (const LayoutEntry& entry : scene_layout()) CHECK(has(entry.element));
  const auto check_fields = [&]<class T>(std::type_identity<T>) {
    for (const auto& field : fields_in_files<T>()) CHECK(has(field.name));
  };
  check_fields(std::type_identity<ViewPlane>{});
  for_each_type(Cameras{}, check_fields);
  for_each_type(Lights{}, check_fields);
  for_each_type(Materials{}, check_fields);
  for_each_type(Objects{}, check_fields);
}

TEST_CASE("every scene of the repository is valid and accepted", "[schema]") {
  const std::vector<fs::path> scenes = scenes_in(RAYTRACE_SOURCE_DIR "/scenes");
  REQUIRE_FALSE(scenes.empty());
  const std::set<fs::path> valid = valid_by_schema(scenes);
  for (const fs::path& scene : scenes) {
    INFO(scene);
    CHECK(valid.count(scene) == 1);
    CHECK(program_accepts(scene));
  }
}

TEST_CASE("the schema refuses most of the bad scenes, the program all", "[schema]") {
  const std::vector<fs::path> scenes = scenes_in(RAYTRACE_SOURCE_DIR "/tests/description/bad");
  for (const fs::path& scene : scenes) {
    INFO(scene);
    CHECK_FALSE(program_accepts(scene));
  }
  std::set<std::string> valid_names;
  for (const fs::path& scene : valid_by_schema(scenes)) valid_names.insert(scene.stem().string());
  // What no schema can say, or the program alone does not want.
  std::set<std::string> expected = {"cylinder_without_length",
                                    "eye_at_lookat",
                                    "instruction",
                                    "name_with_line_break",
                                    "other_encoding",
                                    "second_ambientlight",
                                    "too_many_pixels",
                                    "transform_of_infinite_product",
                                    "transform_of_large_product",
                                    "transform_that_flattens",
                                    "instances_of_large_product",
                                    "utf16",
                                    "edge_too_long",
                                    "zero_direction",
                                    "zero_normal",
                                    "zero_up",
                                    "internal_subset",
                                    "second_integrator",
                                    "environment_ground_of_file",
                                    "environment_twice",
                                    "environment_scaled",
                                    "skylight_at_night",
                                    "skylight_too_hazy",
                                    "skylight_twice",
                                    "skylight_beside_environment",
                                    "box_inside_out",
                                    "cone_without_length",
                                    "cone_without_width",
                                    "curve_of_file_and_points",
                                    "curve_of_one_point",
                                    "curve_without_points",
                                    "curve_without_radius",
                                    "annulus_without_area",
                                    "include_missing"};
  // Nor that one element stands in place of another, or goes with some only.
  expected.insert({"exposure_too_low", "filter_too_wide", "kelvin_beside_red", "kelvin_too_cold", "key_too_hot",
                   "whitebalance_too_warm", "fisheye_beyond_all", "fov_and_pixelsize", "fov_and_viewdistance",
                   "fov_too_wide", "lens_of_two_blades", "missing_viewdistance", "too_many_indirectsamples"});
  // Nor what a material's numbers and colours are together.
  expected.insert({"conductor_of_two_colors",
                   "conductor_of_two_edges",
                   "conductor_too_rough",
                   "conductor_too_stretched",
                   "conductor_without_color",
                   "dielectric_that_shines",
                   "dielectric_beyond_dispersion",
                   "dielectric_thin_and_dispersive",
                   "dielectric_thin_and_thick",
                   "dielectric_too_dense",
                   "dielectric_too_dispersive",
                   "dielectric_too_rough",
                   "dielectric_without_distance",
                   "openpbr_film_of_nothing",
                   "openpbr_that_shines",
                   "openpbr_too_dense",
                   "openpbr_too_dispersive",
                   "openpbr_too_rough",
                   "hair_of_two_colors",
                   "hair_too_dark",
                   "hair_too_dense",
                   "hair_too_red",
                   "hair_too_rough",
                   "hair_too_rough_around",
                   "hair_too_tilted",
                   "hair_without_color"});
  // Nor which objects a material may be of.
  expected.insert({"hair_on_a_sphere", "hair_on_an_instance"});
  // Nor how large a number is at most, or whether there is a texture of a name.
  expected.insert({"displacement_of_unknown_texture", "subdivision_too_often"});
  // Nor what a fog's density is of.
  expected.insert({"fog_density_beside_file", "fog_density_in_a_plane", "fog_density_negative",
                   "fog_density_of_a_picture", "fog_density_on_surfaces", "fog_density_unknown",
                   "fog_density_with_a_space", "fog_fade_of_nothing", "fog_file_of_another_kind", "fog_grid_of_a_vol",
                   "fog_transform_of_nothing"});
  // Nor what may be in a file that is included.
  expected.insert({"missing_camera", "missing_viewplane", "missing_viewplane_fov"});
  // What it cannot say since numbers and vectors may have keys, and values variables.
  expected.insert({"degenerate_triangle_without_material",
                   "dollar_without_name",
                   "empty_number",
                   "hexadecimal_number",
                   "missing_component",
                   "misspelt_material",
                   "nan",
                   "near_clip_negative",
                   "negative_coefficient",
                   "negative_radius",
                   "not_a_number",
                   "number_in_pieces",
                   "number_with_comma",
                   "number_with_unit",
                   "tiny_radius",
                   "two_keys_of_one_frame",
                   "two_numbers",
                   "unknown_material",
                   "value_beside_keys",
                   "variable_not_set",
                   "zero_radius"});
  CHECK(valid_names == expected);
}

TEST_CASE("what the schema refuses the program refuses, over many damaged scenes", "[schema]") {
  const TemporaryFolder folder;
  std::mt19937_64 random(19450508);
  std::vector<std::string> sound = {bytes_of(RAYTRACE_SOURCE_DIR "/scenes/seed.xml")};
  for (int i = 0; i < 4; ++i) sound.push_back(print_scene(random_description(random)));
  std::vector<fs::path> files;
  for (int i = 0; i < 800; ++i) {
    files.push_back(folder.path() / ("scene" + std::to_string(i) + ".xml"));
    write_text(files.back(), mutated(sound[static_cast<std::size_t>(i) % sound.size()], random));
  }
  const std::set<fs::path> valid = valid_by_schema(files);
  std::size_t accepted_count = 0;
  for (const fs::path& file : files) {
    const bool accepted = program_accepts(file);
    accepted_count += accepted;
    if (accepted && !valid.count(file)) FAIL_CHECK("accepted, but invalid by the schema:\n" << bytes_of(file));
  }
  // There must be some of both for the test to say anything.
  CHECK(accepted_count > 50);
  CHECK(valid.size() < 700);
}

}  // namespace raytrace::test

// Fogs that are not the same everywhere: against sums over their grids in double precision, which know nothing of cells
// and flights, and against fogs that are the same everywhere.
//
// Not with the thread sanitizer: statistics.
#include <cmath>
#include <functional>
#include <memory>
#include <numbers>
#include <random>
#include <string>

#include "render/fogged.h"
#include "support/catch.h"
#include "support/usable_isas.h"

namespace raytrace::test {

namespace {

using Grid = std::shared_ptr<const DensityGrid>;

/// Of so many points along each axis, in the box from `lower` to `upper`: its corners are points.
Grid grid_of(const std::array<int, 3>& points, const Vec3d& lower, const Vec3d& upper,
             const std::function<float(int x, int y, int z)>& number) {
  DensityGrid::Lattice lattice;
  for (std::size_t axis = 0; axis < 3; ++axis) lattice.points[axis] = points[axis];
  lattice.lower = Vec3d(0, 0, 0);
  lattice.upper = Vec3d(points[0] - 1, points[1] - 1, points[2] - 1);
  const Vec3d extent = upper - lower;
  lattice.world_from_lattice = {{extent.x / lattice.upper.x, 0, 0},
                                {0, extent.y / lattice.upper.y, 0},
                                {0, 0, extent.z / lattice.upper.z},
                                lower};
  return std::make_shared<const DensityGrid>(lattice, 1, [&](const std::array<int, 3>& first, float* to) {
    const auto place = [&](std::size_t axis, int i) { return std::min(first[axis] + i, points[axis] - 1); };
    for (int z = 0; z < 9; ++z)
      for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 9; ++x) *to++ = number(place(0, x), place(1, y), place(2, z));
  });
}

/// Mostly nothing, here and there much.
Grid spiky_grid(const std::array<int, 3>& points, const Vec3d& lower, const Vec3d& upper, double share, float spike) {
  std::vector<float> numbers;
  for (auto [i, random] = std::pair(0, std::mt19937(7)); i < points[0] * points[1] * points[2]; ++i)
    numbers.push_back(static_cast<double>(random()) * 0x1p-32 < share ? spike : 0.0F);
  return grid_of(points, lower, upper, [&](int x, int y, int z) {
    const int place = (z * points[1] + y) * points[0] + x;
    return numbers[static_cast<std::size_t>(place)];
  });
}

SceneDescription with_grid(const Fogged& scene, const Grid& grid) {
  SceneDescription description = parsed_scene(text_of(scene));
  for (auto& fog : std::get<MaterialItems<Fog>>(description.materials)) fog.grid = {"grid", grid};
  return description;
}

double extinction_at(const DensityGrid& grid, const Vec3d& p) {
  return grid.at(grid.lattice().world_from_lattice.inverse().point(p)) / mean_free_path;
}

/// The depth of the way from a to b.
double depth_between(const DensityGrid& grid, const Vec3d& a, const Vec3d& b, int steps = 4000) {
  double sum = 0;
  for (int i = 0; i < steps; ++i) sum += extinction_at(grid, a + (b - a) * ((i + 0.5) / steps));
  return sum * length(b - a) / steps;
}

std::string wall_at(double z, const std::string& material) {
  return "<rectangles><rectangle><corner x='-60' y='-60' z='" + std::to_string(z) +
         "'/><edge1 x='120' y='0' z='0'/><edge2 x='0' y='120' z='0'/><material>" + material +
         "</material></rectangle></rectangles>";
}

const Vec3d box_lower(-2, -2, -3), box_upper(2, 2, 2);

/// A ray that meets cells aslant, from outside of the grid to outside.
const Vec3d eye(1.3, -1.1, 5), seen(-1.4, 1.2, -4);

Fogged slanted() {
  Fogged scene;
  scene.eye = "<eye x='1.3' y='-1.1' z='5'/><lookat x='-1.4' y='1.2' z='-4'/><fov>0.001</fov>";
  return scene;
}

std::vector<Grid> some_grids() {
  return {grid_of({9, 5, 26}, box_lower, box_upper, [](int, int, int z) { return static_cast<float>(z) * 0.08F; }),
          grid_of({3, 40, 33}, box_lower, box_upper,
                  [](int x, int y, int z) { return static_cast<float>((x * 7 + y * 3 + z * 5) % 11) * 0.15F; }),
          spiky_grid({24, 37, 41}, box_lower, box_upper, 0.02, 25),
          spiky_grid({70, 5, 30}, box_lower, box_upper, 0.3, 4)};
}

}  // namespace

TEST_CASE("what uneven fog takes on the way to a lamp is the sum of its density") {
  for (const Grid& grid : some_grids()) {
    Fogged scene = slanted();
    scene.fog = "<color red='0' green='0' blue='0'/>";
    scene.objects = wall_at(-4, "lamp");
    scene.samples = 512;
    const double wanted = 3 * std::exp(-depth_between(*grid, eye, seen));
    for (const std::string& isa : usable_isas()) {
      const double mean = mean_of(rendered(with_grid(scene, grid), 2, isa)).green;
      // Each of 2^17 samples is 3 or 0.
      const double deviation = std::sqrt(wanted * (3 - wanted) / (512 << 8));
      INFO(isa << ": " << mean << " for " << wanted << " +- " << deviation);
      CHECK(std::abs(mean - wanted) < 4 * deviation);
    }
  }
}

TEST_CASE("what uneven fog takes of light on its way to a surface is the sum of its density") {
  const std::string lights = GENERATE(
      "<pointlights><pointlight><location x='1.3' y='-1.1' z='5'/></pointlight></pointlights>",
      "<directionallights><directionallight><direction x='2.7' y='-2.3' z='9'/></directionallight></directionallights>",
      "<spotlights><spotlight><location x='1.3' y='-1.1' z='5'/><lookat x='-1.4' y='1.2' "
      "z='-4'/><coneangle>20</coneangle></spotlight>"
      "</spotlights>");
  for (const Grid& grid : some_grids()) {
    Fogged scene;
    scene.fog = "<color red='0' green='0' blue='0'/>";
    scene.objects = wall_at(-4, "grey");
    // Close to the wall, behind the fog.
    scene.eye = "<eye x='-1.4' y='1.2' z='-3.9'/><lookat x='-1.4' y='1.2' z='-4'/><fov>0.001</fov>";
    scene.lights = lights;
    scene.samples = 64;
    const double through = mean_of(rendered(with_grid(scene, grid), 2)).green;
    scene.box = "";
    const double without = mean_of(scene).green;
    const double wanted = std::exp(-depth_between(*grid, eye, seen));
    INFO(lights << ": " << through / without << " for " << wanted);
    CHECK(std::abs(through / without - wanted) < 0.005);
  }
}

TEST_CASE("a grid of one number is a fog that is the same everywhere") {
  Fogged scene;
  scene.eye = "<eye x='3' y='2' z='6'/><lookat x='0' y='0' z='-1'/><fov>60</fov>";
  scene.box = "<box><min x='-2' y='-2' z='-3'/><max x='2' y='2' z='2'/><material>fog</material></box>";
  scene.fog = "<color red='0.9' green='0.7' blue='0.4'/><anisotropy>0.4</anisotropy>";
  scene.path = "<maxdepth>12</maxdepth>";
  scene.objects =
      wall_at(-4, "grey") +
      "<spheres><sphere><center x='0' y='3' z='0'/><radius>0.5</radius><material>lamp</material></sphere></spheres>";
  scene.lights =
      "<pointlights><pointlight><location x='0.5' y='0.5' z='4'/><scaleradiance>9</scaleradiance>"
      "<falloff>inversesquare</falloff></pointlight></pointlights><environmentlights><environmentlight>"
      "<color red='0.2' green='0.3' blue='0.5'/></environmentlight></environmentlights>";
  scene.samples = 256;
  const Mean even = mean_of(scene);
  scene.fog += "<density>2</density>";
  for (const float other : {0.5F, 0.4999F}) {
    const Grid grid = grid_of({30, 21, 25}, box_lower, box_upper,
                              [&](int x, int y, int z) { return (x + y + z) % 2 == 0 ? 0.5F : other; });
    const Mean mean = mean_of(rendered(with_grid(scene, grid), 2));
    INFO(other << ": " << mean.red << ' ' << mean.green << ' ' << mean.blue << " for " << even.red << ' ' << even.green
               << ' ' << even.blue);
    CHECK(std::abs(mean.red / even.red - 1) < 0.004);
    CHECK(std::abs(mean.green / even.green - 1) < 0.004);
    CHECK(std::abs(mean.blue / even.blue - 1) < 0.004);
  }
}

TEST_CASE("light that uneven fog scatters once is the sum over all distances") {
  const Grid grid = spiky_grid({16, 15, 22}, box_lower, box_upper, 0.2, 2.5);
  Fogged scene = slanted();
  scene.fog = "<color red='1' green='0.5' blue='0'/><anisotropy>0.5</anisotropy>";
  scene.objects = wall_at(-4, "black");
  scene.samples = 512;
  const Vec3d lamp(0.2, 1.5, 0.4), way = seen - eye, unit = way * (1 / length(way));
  const auto sum_for = [&](const auto& arriving) {
    constexpr int steps = 3000;
    double sum = 0, depth = 0;
    for (int i = 0; i < steps; ++i) {
      const Vec3d p = eye + way * ((i + 0.5) / steps);
      const double here = extinction_at(*grid, p) * length(way) / steps;
      if (here > 0) sum += std::exp(-depth - here / 2) * here * arriving(p);
      depth += here;
    }
    return sum;
  };
  const auto phase = [&](const Vec3d& to_light) {
    const double cosine = dot(unit, to_light) / length(to_light), g = 0.5;
    return (1 - g * g) / (4 * std::numbers::pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
  };
  const auto from = [&](const Vec3d& place, const Vec3d& p) {
    return 4 * std::exp(-depth_between(*grid, p, place, 500)) * phase(place - p);
  };
  const auto check = [&](double wanted, double within) {
    for (const std::string& isa : usable_isas()) {
      const Mean mean = mean_of(rendered(with_grid(scene, grid), 2, isa));
      INFO(scene.lights << isa << ": " << mean.red << " for " << wanted);
      CHECK(std::abs(mean.red / wanted - 1) < within);
      CHECK(std::abs(mean.green / mean.red - 0.5) < 1e-4);
      CHECK(mean.blue == 0);
    }
  };
  const std::string place = "<location x='0.2' y='1.5' z='0.4'/><scaleradiance>4</scaleradiance>";
  SECTION("of a point light in it") {
    scene.lights = "<pointlights><pointlight>" + place + "</pointlight></pointlights>";
    check(sum_for([&](const Vec3d& p) { return from(lamp, p); }), 0.01);
  }
  SECTION("of one of many, in two places") {
    const std::string falls_off = "<scaleradiance>4</scaleradiance><falloff>inversesquare</falloff></pointlight>";
    for (int i = 0; i < 40; ++i)
      scene.lights += "<pointlight><location " + std::string(i % 2 == 0 ? "x='0.2' y='1.5'" : "x='-1.5' y='-1'") +
                      " z='0.4'/>" + falls_off;
    scene.lights = "<pointlights>" + scene.lights + "</pointlights>";
    // Lights are drawn where paths go on; of so dark a fog that hardly matters.
    scene.path = "<maxdepth>2</maxdepth>";
    scene.fog = "<color red='0.0001' green='0.00005' blue='0'/><anisotropy>0.5</anisotropy>";
    const Vec3d other(-1.5, -1, 0.4);
    check(sum_for([&](const Vec3d& p) {
            return 0.002 * (from(lamp, p) / dot(lamp - p, lamp - p) + from(other, p) / dot(other - p, other - p));
          }),
          0.015);
  }
  SECTION("of a lamp with a size, which paths come to as well") {
    scene.objects +=
        "<spheres><sphere><center x='0.2' y='1.5' z='0.4'/><radius>0.03</radius><material>lamp</material></sphere>"
        "</spheres>";
    const double intensity = 3 * std::numbers::pi * 0.03 * 0.03;
    check(sum_for([&](const Vec3d& p) { return intensity / 4 * from(lamp, p) / dot(lamp - p, lamp - p); }), 0.02);
  }
}

TEST_CASE("white fog of any density is 1 under light of 1 from all around") {
  const std::string lights = GENERATE("", "<environmentlights><environmentlight/></environmentlights>");
  for (const Grid& grid : {spiky_grid({13, 30, 22}, Vec3d(-1, -1, -1), Vec3d(1, 1, 1), 0.1, 40),
                           spiky_grid({30, 11, 9}, Vec3d(-1, -1, -1), Vec3d(1, 1, 1), 0.5, 3)}) {
    Fogged scene;
    scene.fog = "<anisotropy>0.5</anisotropy>";
    scene.path = "<maxdepth>1000</maxdepth>";
    scene.lights = lights;
    scene.background = scene.lights.empty() ? "<background red='1' green='1' blue='1'/>" : "";
    scene.box = "<box><min x='-1' y='-1' z='-1'/><max x='1' y='1' z='1'/><material>fog</material></box>";
    scene.eye = "<eye x='0.6' y='0.4' z='3'/><lookat x='0' y='0' z='0'/><fov>40</fov>";
    scene.samples = 128;
    CHECK(std::abs(mean_of(rendered(with_grid(scene, grid), 2)).red - 1) < 0.005);
    // From inside, too.
    scene.eye = "<eye x='0' y='0' z='0.5'/><lookat x='0' y='0' z='0'/><fov>90</fov>";
    CHECK(std::abs(mean_of(rendered(with_grid(scene, grid), 2)).red - 1) < 0.005);
  }
}

TEST_CASE("fog that shines sends what it would absorb") {
  Fogged scene = slanted();
  scene.fog = "<color red='0' green='0' blue='0'/><ce red='2' green='1' blue='0.5'/>";
  scene.objects = wall_at(-4, "black");
  scene.samples = 256;
  const Grid grid = spiky_grid({24, 37, 41}, box_lower, box_upper, 0.1, 3);
  const double share = 1 - std::exp(-depth_between(*grid, eye, seen));
  const Mean mean = mean_of(rendered(with_grid(scene, grid), 2));
  INFO(mean.red << " for " << 2 * share);
  CHECK(std::abs(mean.red - 2 * share) < 0.02);
  CHECK(std::abs(mean.green / mean.red - 0.5) < 1e-4);
  CHECK(std::abs(mean.blue / mean.red - 0.25) < 1e-4);
}

TEST_CASE("density is where the fog's transform, its group's instance and the world's origin have it") {
  const std::string turn = "<rotate x='1' y='2' z='0.5' angle='40'/><scale x='1.5' y='0.7' z='1'/>";
  const std::string far = "<translate x='9000' y='0.3' z='-8000'/>";
  const Grid grid = spiky_grid({9, 14, 11}, Vec3d(-1, -1, -1), Vec3d(1, 1, 1), 0.3, 6);
  const auto scene = [&](const std::string& of_fog, const std::string& objects, const std::string& groups) {
    SceneDescription description = parsed_scene(
        "<raytracer><viewplane><hres>24</hres><vres>24</vres><samples>1024</samples></viewplane><camera>"
        "<eye x='9003' y='1' z='-7996'/><lookat x='9000' y='0.3' z='-8000'/><fov>40</fov></camera><integrator><path>"
        "<maxdepth>3</maxdepth></path></integrator><lights><pointlights><pointlight>"
        "<location x='9001' y='4' z='-7999'/><scaleradiance>5</scaleradiance></pointlight></pointlights></lights>"
        "<materials><fogs><fog><name>fog</name><meanfreepath>0.5</meanfreepath><densityfile>any.vol</densityfile>" +
        of_fog + "</fog></fogs></materials><objects>" + objects + "</objects>" + groups + "</raytracer>");
    for (auto& fog : std::get<MaterialItems<Fog>>(description.materials)) fog.grid = {"grid", grid};
    return rendered(description, 2);
  };
  const std::string box = "<boxes><box><min x='-1' y='-1' z='-1'/><max x='1' y='1' z='1'/><material>fog</material>";
  const std::string all = "<transform>" + turn + far + "</transform>";
  const FloatPicture by_fog = scene(all, box + all + "</box></boxes>", "");
  const auto check = [&](const FloatPicture& picture) {
    // Quarters of the picture.
    for (int quarter = 0; quarter < 4; ++quarter) {
      double wanted = 0, sum = 0;
      for (int i = 0; i < 144; ++i) {
        const int x = i % 12 + quarter % 2 * 12, y = i / 12 + quarter / 2 * 12;
        wanted += double{by_fog.at(x, y).green};
        sum += double{picture.at(x, y).green};
      }
      INFO("quarter " << quarter << ": " << sum << " for " << wanted);
      CHECK(std::abs(sum / wanted - 1) < 0.015);
    }
  };
  const auto group = [&](const std::string& objects) {
    return "<groups><group><name>cloud</name><objects>" + objects + "</objects></group></groups>";
  };
  const auto instance = [](const std::string& transform) {
    return "<instances><instance><group>cloud</group><transform>" + transform + "</transform></instance></instances>";
  };
  check(scene("", instance(turn + far), group(box + "</box></boxes>")));
  // The group's box stands turned already; so does its fog.
  const std::string turned = "<transform>" + turn + "</transform>";
  check(scene(turned, instance(far), group(box + turned + "</box></boxes>")));
  // A sphere around it that is an ellipsoid in its group, where the fog is as its file has it.
  check(scene("", instance(turn + far),
              group("<spheres><sphere><center x='0' y='0' z='0'/><radius>1.8</radius><material>fog</material>"
                    "<transform><scale x='1' y='1.3' z='1.1'/></transform></sphere></spheres>")));
}

TEST_CASE("a texture in space is a density") {
  Fogged scene = slanted();
  scene.fog = "<color red='0' green='0' blue='0'/><density texture='t'/>";
  scene.objects = wall_at(-4, "lamp");
  scene.samples = 512;
  scene.box = "<box><min x='-2' y='-2' z='-3'/><max x='2' y='2' z='2'/><material>fog</material></box>";
  const auto rendered_with = [&](const std::string& texture) {
    std::string text = text_of(scene);
    text.replace(text.find("<materials>"), 0, "<textures>" + texture + "</textures>");
    return mean_of(rendered(parsed_scene(text), 2)).green;
  };
  const Vec3d way = seen - eye;
  const double in_box = 5 * length(way) / std::abs(way.z);
  SECTION("a noise of one colour") {
    const double mean = rendered_with(
        "<noises><noise><name>t</name><color1 red='0.6' green='0' blue='0'/>"
        "<color2 red='0.6' green='0' blue='0'/></noise></noises>");
    CHECK(std::abs(mean - 3 * std::exp(-0.6 * in_box / mean_free_path)) < 0.02);
  }
  SECTION("cubes of a checker, with a channel") {
    // As thick as their share of the way is long.
    double share = 0;
    constexpr int steps = 100000;
    for (int i = 0; i < steps; ++i) {
      const Vec3d p = eye + way * ((i + 0.5) / steps);
      if (p.z > 2 || p.z < -3) continue;
      const double cubes = std::floor(p.x / 0.8) + std::floor(p.y / 0.8) + std::floor(p.z / 0.8);
      share += std::fmod(std::abs(cubes), 2) == 0 ? 1.0 / steps : 0;
    }
    scene.fog = "<color red='0' green='0' blue='0'/><density texture='t' channel='green'>1.5</density>";
    const double mean = rendered_with(
        "<checkers><checker><name>t</name><color1 red='0' green='1' blue='0'/>"
        "<color2 red='1' green='-1' blue='1'/><scale>0.8</scale></checker></checkers>");
    const double wanted = 3 * std::exp(-1.5 * share * length(way) / mean_free_path);
    INFO(mean << " for " << wanted);
    CHECK(std::abs(mean - wanted) < 0.03);
  }
  SECTION("that fades towards the sides") {
    scene.fog = "<color red='0' green='0' blue='0'/><density texture='t'/><densityfade x='0' y='0' z='2.5'/>";
    const double mean = rendered_with(
        "<noises><noise><name>t</name><color1 red='2' green='0' blue='0'/>"
        "<color2 red='2' green='0' blue='0'/><octaves>1</octaves></noise></noises>");
    CHECK(std::abs(mean - 3 * std::exp(-1 * in_box / mean_free_path)) < 0.02);
  }
}

TEST_CASE("in a transparent picture uneven fog covers what it does not let through") {
  const Grid grid = some_grids()[2];
  const SceneDescription description = with_grid(slanted(), grid);
  const auto built = build_scene(description, {2, {}});
  RenderSettings settings{2, 0, whole(description)};
  settings.transparent = true;
  RayCounts rays;
  const Mean mean = mean_of(FloatPicture(render(*built, description, settings, rays)));
  CHECK(std::abs(mean.alpha - (1 - std::exp(-depth_between(*grid, eye, seen)))) < 0.01);
}

TEST_CASE("uneven fog has the same bits however its picture is cut") {
  const std::string caustics = GENERATE("none", "light", "photons");
  SceneDescription description = parsed_scene(
      "<raytracer><viewplane><hres>37</hres><vres>29</vres><samples>8</samples></viewplane><camera>"
      "<eye x='0' y='1' z='4'/><lookat x='0' y='0' z='0'/><fov>60</fov></camera><integrator><path><caustics>" +
      caustics +
      "</caustics></path></integrator><lights><pointlights><pointlight><location x='1' y='2' z='0'/>"
      "<falloff>inversesquare</falloff></pointlight></pointlights><environmentlights>"
      "<environmentlight><color red='0.2' green='0.2' blue='0.3'/></environmentlight></environmentlights></lights>"
      "<textures><noises><noise><name>n</name><color1 red='-1' green='0' blue='0'/>"
      "<color2 red='3' green='0' blue='0'/></noise></noises></textures>"
      "<materials><mattes><matte><name>grey</name><ka>0</ka><kd>1</kd><cd red='0.5' green='0.5' blue='0.5'/>"
      "</matte></mattes><dielectrics><dielectric><name>glass</name></dielectric></dielectrics>"
      "<emissives><emissive><name>lamp</name><ce red='3' green='3' blue='3'/></emissive></emissives>"
      "<fogs><fog><name>mist</name><meanfreepath>3</meanfreepath></fog><fog><name>smoke</name>"
      "<meanfreepath>0.2</meanfreepath><color red='0.6' green='0.7' blue='0.8'/><anisotropy>0.5</anisotropy>"
      "<ce red='0.1' green='0' blue='0'/><densityfile>any.vol</densityfile></fog>"
      "<fog><name>cloud</name><meanfreepath>0.5</meanfreepath><density texture='n'/></fog></fogs></materials><objects>"
      "<planes><plane><point x='0' y='-1' z='0'/><normal x='0' y='1' z='0'/><material>grey</material></plane></planes>"
      "<instances><instance><group>g</group><transform><translate x='-0.8' y='0' z='0.2'/></transform></instance>"
      "<instance><group>g</group><transform><rotate x='1' y='1' z='0' angle='50'/><translate x='-0.2' y='0' z='0.2'/>"
      "</transform></instance></instances>"
      "<spheres><sphere><center x='0.7' y='0' z='0'/><radius>0.5</radius>"
      "<material>glass</material></sphere><sphere><center x='0.7' y='0.2' z='0.8'/><radius>0.6</radius>"
      "<material>cloud</material></sphere><sphere><center x='0' y='1' z='-1'/><radius>0.2</radius>"
      "<material>lamp</material></sphere></spheres><boxes><box><min x='-2' y='-1' z='-2'/><max x='2' y='1.5' z='2'/>"
      "<material>mist</material></box></boxes></objects><groups><group><name>g</name><objects><spheres><sphere>"
      "<center x='0' y='0' z='0'/><radius>0.6</radius><material>smoke</material></sphere></spheres></objects></group>"
      "</groups></raytracer>");
  std::get<MaterialItems<Fog>>(description.materials)[1].grid = {
      "grid", spiky_grid({19, 12, 25}, Vec3d(-0.6, -0.6, -0.6), Vec3d(0.6, 0.6, 0.6), 0.3, 3)};
  check_same_bits(description, caustics == "none");
}

}  // namespace raytrace::test

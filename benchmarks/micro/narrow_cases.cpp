#include "narrow_cases.h"

#include <memory>
#include <stdexcept>

#include "../scenes.h"
#include "raytrace/film/film.h"

namespace raytrace::benchmark {

namespace {

/// Sums of blocks of 4 x 4 pixels, as the renderer adds them.
MicroCase film_case() {
  constexpr int edge = 256, block = 4, pixels = edge * edge;
  FilmSettings settings;
  settings.extent = {edge, edge, {0, 0, edge, edge}};
  const auto film = std::make_shared<Film>(settings);
  return {"film/add", pixels, 0, [film] {
            for (int top = 0; top < edge; top += block)
              for (int left = 0; left < edge; left += block)
                for (int y = top; y < top + block; ++y)
                  for (int x = left; x < left + block; ++x) film->sum(x, y) += {x, y, x + y, 1, 1};
            return static_cast<float>(film->sum(0, 0).samples);
          }};
}

MicroCase xml_case() {
  constexpr int objects = 1000;
  const std::string text = print_scene(random_mix(objects, 1024, 16));
  return {"xml/load", objects, static_cast<std::int64_t>(text.size()), [text] {
            Diagnostics diagnostics("random objects");
            const auto scene = parse_scene(text, diagnostics);
            if (!scene) throw std::logic_error("the scene does not parse");
            return static_cast<float>(scene->viewplane.samples);
          }};
}

}  // namespace

void add_narrow_cases(std::vector<MicroCase>& cases) {
  cases.push_back(film_case());
  cases.push_back(xml_case());
}

}  // namespace raytrace::benchmark

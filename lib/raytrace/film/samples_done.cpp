#include "raytrace/film/samples_done.h"

#include <algorithm>

namespace raytrace {

namespace {

bool has_any_mean(const Film& film) {
  const Region& region = film.region();
  for (int y = region.y0; y < region.y1; ++y) {
    for (int x = region.x0; x < region.x1; ++x) {
      const Pixel mean = film.pixel(x, y);
      if (mean.red != 0 || mean.green != 0 || mean.blue != 0 || mean.alpha != 0) return true;
    }
  }
  return false;
}

}  // namespace

SamplesDone samples_done(const Film& film) {
  if (film.content() != FilmContent::sums) return {0, has_any_mean(film) ? film.settings().samples.count : 0};
  SamplesDone done{film.settings().samples.count, 0};
  const Region rendered = film.settings().rendered();
  for (int y = rendered.y0; y < rendered.y1; ++y) {
    for (int x = rendered.x0; x < rendered.x1; ++x) {
      done.least = std::min(done.least, film.sum(x, y).samples);
      done.most = std::max(done.most, film.sum(x, y).samples);
    }
  }
  return done;
}

std::string samples_done_text(const Film& film) {
  const SamplesDone done = samples_done(film);
  return std::to_string(done.least) + (done.most != done.least ? " to " + std::to_string(done.most) : "") + " of " +
         std::to_string(film.settings().samples.count) + " samples per pixel";
}

}  // namespace raytrace

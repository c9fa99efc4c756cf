// Judges the library's answers about one shape by the reference's, and remembers the worst.
#pragma once

#include <string>

#include "exactness/shape_cases.h"
#include "reference/shapes.h"
#include "support/probe.h"

namespace raytrace::test {

/// How exact an answer must be. "Size" is the smallest extent of the shape: radius, tube, altitude.
struct Exactness {
  /// Rays that pass the silhouette within this part of the size may hit or miss.
  double band = 1e-5;
  /// Of the hit distance, relative. (Double's own limit is allowed on top: 8 rounding errors of the largest numbers
  /// that are subtracted, over the cosine at the surface.)
  double distance = 1e-5;
  /// Float's limit, for shapes that are solved in float (Embree's triangles): every coordinate, taken from the ray's
  /// origin, may be off by this many times 2^-24 of the largest of them. This moves the silhouette; and it moves the
  /// distance, divided by the cosine at the surface, and times the triangle's length over its altitude, since a
  /// sliver's normal turns with its corners.
  double float_errors = 0;
};

/// A reference answer with what is uncertain about it.
class Expectation {
 public:
  Expectation(const ShapeCase& shape, const ProbeRay& ray, const Exactness& exactness);

  /// Too close to a silhouette to say what is hit.
  bool is_silhouette() const { return silhouette_; }

  /// The first crossing between near and far for sure, or -1: no hit.
  int first() const { return first_; }

  /// Whether a crossing at near or far, within the tolerance, makes both answers right.
  bool allows_miss() const { return first_ < 0; }

  /// The error of a distance over its tolerance, for the crossing that it is closest to of those that may be the first.
  double error(double distance) const;

  const reference::Crossings& crossings() const { return crossings_; }

 private:
  reference::Crossings crossings_;
  std::array<double, 4> tolerances_{};
  std::array<bool, 4> possible_{};  ///< may be the first between near and far
  int first_ = -1;
  bool silhouette_ = false;
};

/// The worst of many cases, and how to see it again.
struct Worst {
  double value = 0;
  std::string where;
  template <class Describe>
  void update(double candidate, const Describe& describe) {
    if (candidate <= value) return;
    value = candidate;
    where = describe();
  }
};

struct Tally {
  long rays = 0, hits = 0, misses = 0, silhouettes = 0;
  long wrong_hits = 0, wrong_misses = 0;
  std::string first_wrong;
  Worst distance;  ///< error over tolerance

  void count(const ShapeCase& shape, const ProbeRay& ray, const Expectation& expected, bool hit,
             double distance_if_hit);
  /// Only whether something is hit.
  void count(const ShapeCase& shape, const ProbeRay& ray, const Expectation& expected, bool hit);

 private:
  void note_wrong(const ShapeCase& shape, const ProbeRay& ray, const Expectation& expected, const std::string& got);
};

}  // namespace raytrace::test

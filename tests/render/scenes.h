// Scenes as texts, and renders of them, for the tests of what must not change a picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "raytrace/output/image_band.h"
#include "raytrace/render/renderer.h"
#include "support/float_picture.h"
#include "support/parsed_scene.h"

namespace raytrace::test {

/// The scene's text around the given parts.
inline std::string scene_text(int width, int height, int samples, const std::string& parts,
                              const std::string& camera = "<eye x='0' y='2' z='12'/><lookat x='0' y='0' z='0'/>") {
  return "<raytracer><viewplane><hres>" + std::to_string(width) + "</hres><vres>" + std::to_string(height) +
         "</vres><samples>" + std::to_string(samples) +
         "</samples><background red='0.1' green='0.2' blue='0.4'/></viewplane><camera>" + camera + "<viewdistance>" +
         std::to_string(width) + "</viewdistance></camera>" + parts + "</raytracer>";
}

inline std::string vector_text(const std::string& element, double x, double y, double z) {
  return "<" + element + " x='" + std::to_string(x) + "' y='" + std::to_string(y) + "' z='" + std::to_string(z) + "'/>";
}

/// All shapes and both materials under three lights, with a thousand small spheres among them.
std::string busy_scene(int width, int height, int samples);

/// A value that goes from that at frame 0 to that at frame 2: attributes of a vector or the like.
inline std::string keys(const std::string& element, const std::string& first, const std::string& last) {
  return "<" + element + "><key frame='0' " + first + "/><key frame='2' " + last + "/></" + element + ">";
}

/// The scene as it stands so long after frame 1.
SceneDescription at_moment(const std::string& text, double after_frame);

inline Region whole(const SceneDescription& description) {
  return {0, 0, description.viewplane.hres, description.viewplane.vres};
}

/// The whole picture, built and rendered with the same number of threads.
inline FloatPicture rendered(const SceneDescription& description, int threads = 1, const std::string& isa = {},
                             std::uint64_t seed = 0) {
  const auto scene = build_scene(description, {threads, isa});
  RayCounts rays;
  return render(*scene, description, {threads, seed, whole(description)}, rays);
}

inline FloatPicture rendered(const std::string& text) { return rendered(parsed_scene(text)); }

/// Whether all bits of the pixels are the same.
bool identical(const Pixel& a, const Pixel& b);
bool identical(const FloatPicture& a, const FloatPicture& b);

/// Fails where the picture depends on threads, on the passes in which its samples are traced, whose packets have
/// several shapes, or on which part of it is rendered; with each instruction set.
void check_same_bits(const SceneDescription& description, bool transparent = false);

/// The same for 18 balls of those materials in turn, under a point light. checks: the colours of a texture of that
/// name.
void check_same_bits_of_balls(const std::string& materials, const std::vector<std::string>& names,
                              const std::string& checks =
                                  "<color1 red='1' green='1' blue='1'/>"
                                  "<color2 red='0.3' green='0.6' blue='0.2'/>",
                              const std::string& more_objects = {});

/// A row of so many pixels, whose centers are at x 0.5, 1.5, ..., y 0.5, seen from z 9. Their objects may be of `m`.
std::string row_of_pixels(int pixels, const std::string& objects, const std::string& groups = {});

/// These AOVs of the whole picture.
ImageBand picture_aovs(const SceneDescription& description, const std::vector<std::string>& aovs,
                       const std::string& isa = {});

/// The ids of the objects in the picture's pixels.
std::vector<std::uint32_t> object_ids(const SceneDescription& description, const std::string& isa);

/// The mean of its pixels' green: of all channels, where a scene is grey.
double mean_green(const FloatPicture& picture);

/// The largest difference of their channels.
double difference(const Pixel& a, const Pixel& b);

}  // namespace raytrace::test

// What a picture's bits depend on.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "raytrace/film/film.h"
#include "raytrace/film/tiles.h"
#include "raytrace/output/exr_reader.h"
#include "raytrace/output/image_file.h"
#include "raytrace/output/view_options.h"
#include "raytrace/render/renderer.h"

namespace raytrace {

/// Together with a film's settings, all that its sums depend on.
struct Provenance {
  std::string software;        ///< "raytrace 1.2.3"
  std::string embree_version;  ///< "3.13.5"
  std::string isa;
  std::string scene;  ///< scene_hash()
};

/// "raytrace 1.2.3": this library.
std::string software_name();

/// Of pictures that this library renders. threads: as scene_hash() takes them.
Provenance provenance_of(const Scene& scene, const SceneDescription& description, int threads = 0);

/// What a scene's settings say in a picture's metadata: "D=1e6 size=2". In values, a backslash stands before each space
/// and backslash.
std::string variables_text(const std::map<std::string, std::string>& variables);

/// What an EXR file says of itself, so that it can be put together with others, or continued.
struct PieceIdentity {
  Provenance provenance;
  FilmSettings film;
  Region whole;              ///< the region of the picture that this piece is a part of
  std::optional<Tile> tile;  ///< the part of it; none: all
  bool partial = false;      ///< stopped before all its samples were taken; pixels may have different numbers of them
  std::optional<int> frame = std::nullopt;  ///< none: not one of several
  std::string variables{};                  ///< variables_text()
  ViewSettings view{};                      ///< for the files for display that it becomes a part of
  bool denoise = false;                     ///< so is the picture that it becomes a part of
};

/// The attributes of a picture without noise, and of a piece of one; 1 there.
inline constexpr const char* denoised_name = "raytrace:denoised";
inline constexpr const char* denoise_name = "raytrace:denoise";

/// What a file of linear colour says of how it is to be shown: nothing where all is the default.
std::vector<ImageAttribute> wished_view(const ViewSettings& view);

/// All of it that ImageMetadata has no member for, but for the view.
std::vector<ImageAttribute> identity_attributes(const PieceIdentity& identity);

/// Of a picture whose render has not ended: marked as partial, with the fewest and the most samples that its pixels
/// have so far.
std::vector<ImageAttribute> partial_attributes(PieceIdentity identity, const Film& film);

/// Of it, what differs between pictures, as text: neither the program's version nor the machine, and nothing that
/// is known only when the scene is built. "" for what the picture's file does not have. any_samples: but for their
/// number.
std::map<std::string, std::string> picture_attributes(const PieceIdentity& identity, bool any_samples);

/// Throws InputError if it is no picture of ours, or holds what no picture of ours can.
PieceIdentity identity_of(const ExrReader& piece);

/// Throws InputError if the file has other channels than these, in whatever order; the first of which it names.
void refuse_other_channels(const ExrReader& piece, const std::vector<Channel>& wanted);

/// What must not differ between pictures of which one continues or completes another, and does: "the scene",
/// "the instruction set (x86-64-v3, not x86-64-v4): pin one with --isa"; none if all is the same. Regions and sample
/// ranges may differ; so may views, and frames and variables, where they make the same scene.
std::optional<std::string> difference(const PieceIdentity& wanted, const PieceIdentity& got);

}  // namespace raytrace

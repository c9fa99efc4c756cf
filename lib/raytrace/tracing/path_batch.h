// The paths of many packets of camera rays, followed together.
//
// At each depth they are sorted by what they met, so that a packet's lanes shade one material on one type of shape, and
// those that end leave no lanes empty (Afra et al., "Local Shading Coherence Extraction for SIMD-Efficient Path Tracing
// on CPUs", HPG 2016). A lane's arithmetic depends neither on its lane nor on its neighbours: the order of the paths
// changes no bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "raytrace/accel/traced_scene.h"
#include "raytrace/film/film.h"
#include "raytrace/integrators/path.h"
#include "raytrace/scene/medium_table.h"
#include "raytrace/tracing/aov_values.h"
#include "raytrace/tracing/light_parts.h"
#include "raytrace/tracing/path_packet.h"
#include "raytrace/tracing/photon_map.h"
#include "raytrace/tracing/ray_result.h"
#include "raytrace/tracing/render_report.h"
#include "raytrace/tracing/sampled_light.h"
#include "raytrace/tracing/stage_times.h"

namespace raytrace {

class PathBatch {
 public:
  /// film: that the samples are for, with their photons if the scene has any. Throws std::bad_alloc.
  PathBatch(const TracedScene& scene, const Film& film);

  std::size_t packets() const { return direct_.size() / (strands_ * groups_); }
  bool is_full() const { return packets() == most_packets_; }

  /// Of what is done with packets, here and by who adds them.
  StageClock& clock() { return clock_; }

  /// Begins a path in each lane of `wanted`, where its camera ray hits something. Ends the rays there, and sets `first`
  /// to what all rays of `active` hit if it is not null. The result: the lanes of `active` that hit something, or were
  /// in fog. In transparent films it is their coverage: those that hit something, or were scattered by fog. Fog that
  /// scatters nothing there may still send light along the others.
  MaskN add(CameraRays& camera, const MaskN& active, const MaskN& wanted, FirstHits* first);

  /// Follows all paths to their ends.
  void trace(RayCounts& counts);

  /// What came along the camera rays of that packet from lights of that group; nothing in lanes without a path.
  Rgb<FloatN> radiance(std::size_t packet, std::size_t group) const;

  /// The same by passes, where the film has any.
  bool has_passes() const { return has_passes_; }
  PassLight passes(std::size_t packet) const;

  /// Whether the film has AOVs that follow mirrors, and then what they hold of that packet's lanes.
  bool follows_mirrors() const { return follows_mirrors_; }
  FollowedSurface followed(std::size_t packet) const;

  /// Removes all.
  void clear();

 private:
  static constexpr std::size_t most_paths = 1024, pass_slots = light_pass_count + 1;

  using Chunk = PathChunk<PathPacket>;
  using Sums = std::array<std::array<float, packet_lanes>, 3>;  ///< red, green and blue of each lane

  /// Of each lane's path: albedo and normal of what it met last, as long as that was a mirror or clear.
  struct Followed {
    std::array<std::array<float, packet_lanes>, 6> values{};
    std::array<bool, packet_lanes> has_ended{};
  };

  /// What those paths have met becomes what was followed last.
  void follow(const PathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
              const TexturePoint<FloatN>* point, const MaskN& lanes);
  void stop_following(const PathPacket& path, const MaskN& lanes);
  /// Adds to those lanes' paths what came from lights of each lane's group, of so many; or to each lane's pass.
  static void add(std::vector<Sums>& sums, std::size_t groups, const IntN& slot, const MaskN& lanes,
                  const Rgb<FloatN>& radiance, const IntN& group);
  /// The same to the sums of what surfaces have scattered so often, and fogs path.fog_scatterings times.
  void add_scattered(const PathPacket& path, const MaskN& lanes, const Rgb<FloatN>& radiance, const IntN& group,
                     int scatterings);
  /// The same of light that a fog scatters, whose paths surfaces have scattered so often.
  void add_from_fog(const PathPacket& path, const MaskN& lanes, const Rgb<FloatN>& radiance, const IntN& group,
                    int depth);
  Rgb<FloatN> sum(const std::vector<Sums>& sums, std::size_t groups, std::size_t packet, std::size_t group) const;
  /// The share that is left of what clampindirect bounds.
  Rgb<FloatN> left_of_indirect(std::size_t packet) const;

  // Where the film has passes.

  /// Adds to the passes of paths that were first scattered so, with the share of gloss that they have. scatterings: as
  /// add_scattered() has them. otherwise: the pass of those that were not scattered.
  void add_to_passes(const PathPacket& path, const IntN& first, const MaskN& lanes, const Rgb<FloatN>& radiance,
                     int scatterings, LightPass otherwise = LightPass::emission);
  /// The same of light that surfaces scatter, with its parts, which count for the paths that these scatter first.
  void add_to_passes(const PathPacket& path, const MaskN& lanes, const Rgb<FloatN>& light, LightParts& parts,
                     int depth);
  /// Says what scattered those paths first, where nothing did before.
  void set_first(PathPacket& path, const MaskN& lanes, const IntN& scattering) const;
  /// Lights the points that these paths have met, in those lanes, and scatters the paths there.
  void extend(PathPacket& path, const MaskN& arrived, int depth, RayCounts& counts);
  /// Points that paths scatter at.
  struct PathDeparture {
    const PathVertex& vertex;
    const MediumBoundary& boundary;
    const MediumStack& media;  ///< that they came through
    int depth;
    std::uint32_t next_key;  ///< of the next rays
    MaskN lanes;
    // In scenes with caustics: those that focus light; camera rays' first points; those on light paths' ways, and those
    // that would be, but for gloss.
    MaskN focuses, is_first, on_way, on_gloss_way;
  };
  /// From there in a direction that was drawn to the next points. roulette: a random number.
  void scatter(PathPacket& path, const PathDeparture& from, const BsdfSample<FloatN>& sample, const FloatN& roulette,
               RayCounts& counts);
  /// Says what those paths leave by, for light paths.
  void set_way(PathPacket& path, const PathDeparture& from, const BsdfSample<FloatN>& sample, const MaskN& lanes) const;
  /// Of paths in those lanes, makes each one of what gloss reflects, or of the rest, so that both are as bright as they
  /// were. The result: those by gloss.
  MaskN split_gloss(PathPacket& path, const PathDeparture& from, const BsdfSample<FloatN>& sample,
                    const MaskN& lanes) const;
  /// One of the paths that go on from a camera ray's first point, where several do.
  void scatter_branch(const PathPacket& path, const PathDeparture& from, int branch, RayCounts& counts);
  /// Those paths' ways through media that scatter light, from where their rays start, to the next surfaces. depth: the
  /// number of their rays, 0 the camera's.
  Hits walk(PathPacket& path, const IntN& medium, const MaskN& lanes, std::uint32_t number, int depth,
            RayCounts& counts);

  // In scenes with fog.

  struct FogWay {
    std::uint32_t number;              ///< as WalkIds have it
    int depth;                         ///< the number of the paths' rays, 0 the camera's
    MaskN through;                     ///< those that came through the surfaces where they start
    const Hits* first_hits = nullptr;  ///< what the rays hit, if that is known; their ends are, too
    MaskN* fogged = nullptr;           ///< receives, of those lanes, which to count as hits, if it is not null
  };
  struct FogPart;
  struct FogLight;
  struct FogNumbers;
  /// Those paths' ways, from where their rays start, to the next surfaces, by way of scatterings in fogs. What comes to
  /// them there, and from where nothing is, is added. media: where they start, and then are; those of the paths follow.
  Hits go_through_fog(PathPacket& path, MediumStack& media, const MaskN& lanes, const FogWay& way, RayCounts& counts);
  /// The light of all lights that a part of their ways sends along paths.
  void light_fog(const PathPacket& path, const FogPart& part, FogNumbers numbers, int depth, RayCounts& counts);
  FogLight choose_light(const PathPacket& path, const FogPart& part, const FogNumbers& numbers, const FloatN& u) const;
  FogLight draw_light_in_fog(const PathPacket& path, const FogPart& part, const FogNumbers& numbers,
                             const FloatN& u) const;
  void add_emission(const PathPacket& path, const FogPart& part, int depth);
  /// Light that is drawn for places in fog, in those lanes.
  DrawnLight draw_light_for(const Vec3<FloatN>& places, const MaskN& lanes, const FogNumbers& numbers) const;
  /// Adds what comes from a light to where a fog scatters it. scattered: by what the light's radiance is multiplied.
  /// distance: of the paths to there.
  void add_fog_light(const PathPacket& path, const FogPart& part, const FogLight& light, const RayIds& ids,
                     const Rgb<FloatN>& scattered, const FloatN& distance, int depth, RayCounts& counts);
  /// The lanes that end within the part, which are scattered there, unless it absorbs them.
  static MaskN scatter_in_fog(PathPacket& path, const FogPart& part, const FogNumbers& numbers, int depth);

  // The same where a fog is not the same everywhere: at points, where free flights end.

  struct FogPoint;
  /// Lights such a part, in the lanes that may be scattered once more, and scatters the paths that end in it.
  MaskN go_through_density(PathPacket& path, const FogPart& part, const MaskN& may_scatter, FogNumbers numbers,
                           int depth, RayCounts& counts);
  /// color: the share of the light that is scattered there.
  void light_fog_point(const PathPacket& path, const FogPart& part, const FogPoint& point, const Rgb<FloatN>& color,
                       const FogNumbers& numbers, int depth, RayCounts& counts);
  FogLight choose_light_at(const FogPart& part, const FogPoint& point, const Rgb<FloatN>& scattered,
                           const FogNumbers& numbers) const;
  FogLight draw_light_at(const PathPacket& path, const FogPart& part, const FogPoint& point,
                         const FogNumbers& numbers) const;

  /// Those paths' ways below the surfaces that they have met, to where they come out: rays start and go there.
  void go_below(const PathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                const TexturePoint<FloatN>* point, const MaskN& lanes, int depth, RayCounts& counts);
  /// next_boundary() of paths whose ray to there was their ray number `depth`.
  MediumBoundary find_boundary(PathPacket& path, MediumStack& media, Hits& hits, SurfaceInteraction<FloatN>& surface,
                               int depth, RayCounts& counts);
  /// The lanes in which the ray number `depth` of paths is what the camera sees by: from the eye on, unscattered.
  static MaskN seen_by(const PathPacket& path, int depth) {
    return depth == 0 ? !float_mask<FloatN>(path.way == IntN(by_scattering)) : MaskN(false);
  }
  /// Of first points that the camera sees, in those lanes: adds the media that are not visible to it, since paths go on
  /// from there in all that there is.
  void add_invisible_media(const PathPacket& path, const SurfaceInteraction<FloatN>& surface, const MaskN& lanes,
                           MediumStack& media, MediumBoundary& boundary) const;
  /// Of light groups, that of each lane's light; where there is more than one.
  IntN group_of(const DrawnLight& light) const;
  /// The light that photons have brought to those points of paths.
  void add_photons(const PathPacket& path, const Hits& hits, const SurfaceInteraction<FloatN>& surface,
                   const TexturePoint<FloatN>* point, const MaskN& lanes, int depth);
  /// What comes to paths from where nothing is, along their ray number `depth`: 0 is the camera's.
  void add_escaped(const PathPacket& path, const MaskN& lanes, int depth);
  void append(Chunk& chunk, const PathPacket& path, const Hits& hits, const MaskN& lanes) const;

  const TracedScene& scene_;
  const PhotonMap* photons_;
  bool is_transparent_, follows_mirrors_, has_passes_;
  const Path::Parameters& settings_;
  StageClock clock_;
  std::size_t branches_, most_packets_;  ///< that go on from a camera ray's first point
  Chunk paths_, next_;
  RayCounts camera_walks_;           ///< of what was added since trace() ran
  std::vector<std::int32_t> order_;  ///< the numbers of paths, in the lowest 16 bits of their keys
  std::size_t groups_;               ///< of the scene's lights
  bool has_one_light_;               ///< to draw: none is chosen
  /// Sums of each lane: that of its camera ray's first point, then those of the branches, whose paths are in any order;
  /// one of all where there is one branch.
  std::size_t strands_;
  /// Of each packet and strand, group by group: what was scattered once or never, and all else.
  std::vector<Sums> direct_, indirect_;
  /// The same by passes; those of diffuse_direct that clampindirect bounds, which came out from below a surface, last.
  std::vector<Sums> pass_sums_;
  std::vector<Followed> followed_;  ///< of each packet, if AOVs follow mirrors
};

}  // namespace raytrace

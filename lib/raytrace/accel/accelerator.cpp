#include "raytrace/accel/accelerator.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <new>
#include <set>
#include <string>

#include "raytrace/memory/large_array.h"
#include "raytrace/memory/out_of_memory.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/scene/scene.h"

namespace raytrace {

namespace {

[[noreturn]] void throw_embree_error(RTCError code, const char* message) {
  if (code == RTC_ERROR_OUT_OF_MEMORY || (message != nullptr && says_out_of_memory(message))) throw std::bad_alloc();
  throw RenderError(std::string("Embree: ") + (message != nullptr ? message : "unknown error"));
}

/// Embree's triangles, straight from the table.
template <class Shape>
embree::Geometry make_triangles(RTCDevice device, std::span<const typename ShapeTable<Shape>::Record> records) {
  const auto count = static_cast<unsigned>(records.size());
  embree::Geometry geometry(rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, records.data(), 0,
                             sizeof(Vec3f), 3 * static_cast<std::size_t>(count));
  auto* index = static_cast<unsigned*>(
      rtcSetNewGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), count));
  if (index == nullptr) throw std::bad_alloc();
  for (unsigned i = 0; i < 3 * count; ++i) index[i] = i;
  return geometry;
}

/// Embree's triangles or quads, in the mesh's own buffers, behind each of which are 16 bytes that may be read.
embree::Geometry make_mesh_geometry(RTCDevice device, const MeshTable& mesh) {
  const bool is_triangles = mesh.corners() == 3;
  embree::Geometry geometry(rtcNewGeometry(device, is_triangles ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_QUAD));
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh.positions(), 0,
                             sizeof(Vec3f), mesh.vertex_count());
  rtcSetSharedGeometryBuffer(geometry.get(), RTC_BUFFER_TYPE_INDEX, 0,
                             is_triangles ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT4, mesh.indices(), 0,
                             static_cast<std::size_t>(mesh.corners()) * sizeof(std::uint32_t), mesh.face_count());
  return geometry;
}

void attach(const embree::Scene& scene, const embree::Geometry& geometry, std::size_t index) {
  rtcCommitGeometry(geometry.get());
  rtcAttachGeometryByID(scene.get(), geometry.get(), static_cast<unsigned>(index));
}

template <class Shape>
BoundedObject placed_object(const typename ShapeTable<Shape>::Record& record, std::uint32_t primitive) {
  constexpr bool is_sphere = requires { requires Kernel<Shape>::is_its_bounding_sphere; };
  BoundedObject object{static_cast<std::uint16_t>(index_of<Shape>(Shapes{})), is_sphere, primitive,
                       Kernel<Shape>::bounds(record), bounding_radius<Shape>(record)};
  if constexpr (EmbreeTriangle<Shape>) object.corners = &record.vertex1;
  return object;
}

}  // namespace

/// What Embree's callbacks report, to be thrown where it is safe: not through Embree's own frames.
struct Accelerator::Report {
  std::atomic<std::int64_t> bytes{0};
  std::mutex mutex;  ///< for what follows
  RTCError error = RTC_ERROR_NONE;
  std::string message;

  static void on_error(void* user, RTCError code, const char* message) {
    auto& report = *static_cast<Report*>(user);
    const std::lock_guard lock(report.mutex);
    if (report.error != RTC_ERROR_NONE) return;
    report.error = code;
    report.message = message != nullptr ? message : "";
  }

  static bool on_memory(void* user, ssize_t bytes, bool) {
    static_cast<Report*>(user)->bytes += bytes;
    return true;
  }

  void throw_error() {
    const std::lock_guard lock(mutex);
    if (error != RTC_ERROR_NONE) throw_embree_error(error, message.c_str());
  }
};

Accelerator::Accelerator(const GeometryTable& table, int threads, const char* isa, std::span<const std::uint8_t> fogs)
    : report_(std::make_unique<Report>()), table_(table), few_objects_(table) {
  const std::string configuration = "threads=" + std::to_string(threads) + ",set_affinity=0,isa=" + isa;
  device_.reset(rtcNewDevice(configuration.c_str()));
  if (!device_) throw_embree_error(rtcGetDeviceError(nullptr), "no device could be created");
  rtcSetDeviceErrorFunction(device_.get(), &Report::on_error, report_.get());
  rtcSetDeviceMemoryMonitorFunction(device_.get(), &Report::on_memory, report_.get());

  scene_ = make_scene(table, instance_callbacks_.world_shapes);
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    const std::span records(table.table<Shape>().records);
    records_in_memory_[index_of<Shape>(Shapes{})] = {std::as_bytes(records).data(),
                                                     sizeof(typename ShapeTable<Shape>::Record)};
  });
  if (!table.instances().empty()) add_instances();
  add_fogs(fogs);
  report_->throw_error();
}

embree::Scene Accelerator::new_scene() const {
  embree::Scene scene(rtcNewScene(device_.get()));
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_MEDIUM);
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);  // no misses at box borders far from the origin
  return scene;
}

embree::Scene Accelerator::make_scene(const GeometryTable& table, InstanceCallbacks::Shapes& shapes) const {
  embree::Scene scene = new_scene();
  for_each_type(Shapes{}, [&]<class Shape>(std::type_identity<Shape>) {
    if constexpr (!UnboundedShape<Shape>) {
      constexpr std::size_t index = index_of<Shape>(Shapes{});
      const ShapeTable<Shape>& objects = table.table<Shape>();
      shapes[index] = shape_callbacks(objects);
      if (objects.records.empty()) return;
      embree::Geometry geometry;
      if constexpr (UserGeometry<Shape>) {
        geometry.reset(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
      } else {
        geometry = make_triangles<Shape>(device_.get(), objects.records);
      }
      set_callbacks(geometry.get(), objects);
      attach(scene, geometry, index);
    }
  });
  for (std::size_t i = Shapes::size; i < table.geometries().size(); ++i) {
    if (const CurveTable* const curves = table.geometries()[i].curves; curves != nullptr) {
      const embree::Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
      set_callbacks(geometry.get(), *curves);
      attach(scene, geometry, i);
      continue;
    }
    const MeshTable& mesh = *table.geometries()[i].mesh;
    const embree::Geometry geometry = make_mesh_geometry(device_.get(), mesh);
    set_callbacks(geometry.get(), mesh);
    attach(scene, geometry, i);
  }
  return scene;
}

void Accelerator::add_instances() {
  instance_callbacks_.instances = &table_.instances();
  for (const auto& group : table_.groups()) {
    group_scenes_.push_back(make_scene(*group, instance_callbacks_.group_shapes.emplace_back()));
    instance_callbacks_.groups.push_back(group_scenes_.back().get());
  }
  for (const bool moves : {false, true}) {
    InstanceGeometry& instances = instance_geometries_[moves ? 1 : 0];
    instances = {&instance_callbacks_, moves};
    if (!has_instances(moves)) continue;
    const embree::Geometry geometry(rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER));
    set_callbacks(geometry.get(), instances);
    attach(scene_, geometry, table_.geometries().size() + (moves ? 1 : 0));
  }
}

bool Accelerator::has_instances(bool that_move) const {
  const std::size_t moving = table_.instances().moving().size();
  return that_move ? moving > 0 : moving < table_.instances().size();
}

void Accelerator::add_fogs(std::span<const std::uint8_t> fogs) {
  if (fogs.empty()) return;
  fog_scene_ = new_scene();
  const auto instances = static_cast<std::uint32_t>(table_.geometries().size());
  std::set<std::uint32_t> geometries;
  const auto objects = table_.bounded_objects(fogs);
  has_several_fogs_ = objects.size() != 1;  // none: some are planes
  for (const auto& object : objects) geometries.insert(object.geometry);
  if (geometries.erase(instances) > 0)
    for (const bool move : {false, true})
      if (has_instances(move)) geometries.insert(instances + (move ? 1 : 0));
  for (const std::uint32_t i : geometries) rtcAttachGeometryByID(fog_scene_.get(), rtcGetGeometry(scene_.get(), i), i);
}

Accelerator::~Accelerator() = default;

void Accelerator::build() const {
  for (const embree::Scene& group : group_scenes_) rtcCommitScene(group.get());
  rtcCommitScene(scene_.get());
  if (fog_scene_) rtcCommitScene(fog_scene_.get());
  report_->throw_error();
  is_built_.store(true, std::memory_order_release);
}

std::uint64_t Accelerator::bvh_bytes() const {
  return static_cast<std::uint64_t>(std::max<std::int64_t>(report_->bytes, 0));
}

std::vector<std::optional<DirectionBuffer>> Accelerator::direction_buffers(
    std::span<const std::optional<BufferOrigin>> origins, int threads) const {
  std::vector<std::optional<DirectionBuffer>> buffers(origins.size());
  // Faces of meshes and pieces of curves are found as soon by Embree.
  if (!table_.has_shapes_only()) return buffers;
  if (std::none_of(origins.begin(), origins.end(), [](const auto& origin) { return origin.has_value(); }))
    return buffers;
  auto objects = LargeArray<BoundedObject>::unset(table_.primitive_count());
  std::size_t count = 0;
  for_each_type(Shapes{}, [&](auto type) {
    using Shape = typename decltype(type)::type;
    if constexpr (!UnboundedShape<Shape>) {
      const auto& records = table_.table<Shape>().records;
      for_each_chunk(records.size(), threads, [&](std::size_t, std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          objects[count + i] = placed_object<Shape>(records[i], static_cast<std::uint32_t>(i));
      });
      count += records.size();
    }
  });
  for (std::size_t i = 0; i < origins.size(); ++i)
    if (origins[i]) buffers[i] = DirectionBuffer::make(*origins[i], {objects.data(), count}, threads);
  return buffers;
}

std::string Accelerator::embree_version() const {
  const auto number = [&](RTCDeviceProperty property) {
    return std::to_string(rtcGetDeviceProperty(device_.get(), property));
  };
  return number(RTC_DEVICE_PROPERTY_VERSION_MAJOR) + '.' + number(RTC_DEVICE_PROPERTY_VERSION_MINOR) + '.' +
         number(RTC_DEVICE_PROPERTY_VERSION_PATCH);
}

}  // namespace raytrace

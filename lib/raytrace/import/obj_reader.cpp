// OBJ: https://paulbourke.net/dataformats/obj/. Threads go through chunks of lines three times: to count what is in
// each, so that all know their first numbers; to read the vertices; and to read the faces, which may need positions
// from anywhere in the file.
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "raytrace/import/mesh_faces.h"
#include "raytrace/import/mesh_readers.h"
#include "raytrace/import/mesh_text.h"
#include "raytrace/import/obj_statements.h"
#include "raytrace/math/srgb.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace obj {
namespace {

constexpr std::uint32_t none = no_index;
constexpr std::size_t most_indices = std::size_t{1} << 31U;

/// Blender and MeshLab write what a screen shows: sRGB.
float linear_color(double code) { return finite_or_zero(rounded(linear_of_srgb(code))); }

MeshMaterial named_material(std::string_view name) {
  MeshMaterial material;
  material.name = name;
  return material;
}

class Reader {
 public:
  Reader(std::string_view text, std::string folder, const MeshReadSettings& settings, Diagnostics& diagnostics)
      : text_(text),
        folder_(std::move(folder)),
        settings_(settings),
        diagnostics_(diagnostics),
        starts_(line_chunks(text)),
        chunks_(starts_.size() - 1) {}

  std::optional<MeshData> read();

 private:
  /// Calls f(index of the chunk, statement, words behind its keyword) for each line of the chunks that are
  /// wanted(chunk).
  template <class Wanted, class Function>
  void for_statements(const Wanted& wanted, const Function& f) {
    for_each_index(static_cast<int>(chunks_.size()), settings_.threads, [&](int index) {
      const auto i = static_cast<std::size_t>(index);
      if (!wanted(chunks_[i])) return;
      for_each_line<true>(text_.substr(starts_[i], starts_[i + 1] - starts_[i]),
                          [&](const char* start, const char* end) {
                            LineWords words(start, end);
                            const bool is_short = end - start > 2 && start[1] == ' ';
                            Statement statement = Statement::empty;
                            if (is_short && (*start == 'v' || *start == 'f')) {
                              statement = *start == 'v' ? Statement::position : Statement::face;
                              words.advance();
                            } else {
                              statement = read_keyword(words);
                            }
                            if (statement != Statement::empty) f(i, statement, words);
                            return true;
                          });
    });
  }
  std::size_t offset_of(const char* at) const { return static_cast<std::size_t>(at - text_.data()); }
  std::uint32_t line_of(std::string_view word) const { return locate(text_, offset_of(word.data())).line; }

  void count();
  static void count_other(Chunk& chunk, LineWords words);
  bool read_values();
  bool read_faces();
  /// The number, from 0 on, of an index in a face; none, if there is no such value.
  std::uint32_t resolved(std::int64_t index, std::size_t seen, std::size_t which) const;
  void read_materials();
  bool join_indices();
  void set_parts();

  std::string_view text_;
  std::string folder_;
  const MeshReadSettings& settings_;
  Diagnostics& diagnostics_;
  std::vector<std::size_t> starts_;
  std::vector<Chunk> chunks_;
  std::vector<Counts> before_;  ///< each chunk, and all
  MeshData mesh_;
  MeshFaults faults_;
  std::array<MeshBuffer<std::uint32_t>, 3> indices_;  ///< of each of the mesh's corners, its vt and vn
  /// Of vt and vn: whether any corner has one, and whether all have that of the number of their v.
  std::array<bool, 3> is_used_{}, is_same_{};
};

void Reader::count_other(Chunk& chunk, LineWords words) {
  static constexpr std::string_view ignored[] = {"g",        "s",          "mg",        "lod",    "bevel", "c_interp",
                                                 "d_interp", "shadow_obj", "trace_obj", "usemap", "maplib"};
  const std::string_view keyword = words.word();
  if (keyword == "mtllib") {
    chunk.libraries.push_back({words.rest()});
  } else if (keyword == "usemtl") {
    chunk.materials.push_back({words.rest()});
  } else if (keyword == "o") {
    // Those without faces are none.
    if (!chunk.objects.empty() && chunk.objects.back().before == chunk.counts.faces) chunk.objects.pop_back();
    chunk.objects.push_back({words.rest(), chunk.counts.faces});
  } else if (std::find(std::begin(ignored), std::end(ignored), keyword) == std::end(ignored)) {
    if (chunk.skipped++ == 0) chunk.first_skipped = keyword;
  }
}

void Reader::count() {
  const auto all = [](const Chunk&) { return true; };
  for_statements(all, [&](std::size_t i, Statement statement, const LineWords& words) {
    Chunk& chunk = chunks_[i];
    switch (statement) {
      case Statement::position:
        if (chunk.counts.values[0]++ == 0) chunk.has_colors = words.count() >= 6;
        break;
      case Statement::uv:
        ++chunk.counts.values[1];
        break;
      case Statement::normal:
        ++chunk.counts.values[2];
        break;
      case Statement::face:
        chunk.counts.faces.add(words.count());
        break;
      default:
        count_other(chunk, words);
    }
  });
  std::vector<Counts> counts;
  for (const Chunk& chunk : chunks_) counts.push_back(chunk.counts);
  before_ = sums_before(counts);
}

bool Reader::read_values() {
  const auto& all = before_.back().values;
  if (std::any_of(all.begin(), all.end(), [](std::size_t count) { return count >= most_indices; })) {
    diagnostics_.error({}, "has more than 2147483647 vertices");
    return false;
  }
  const bool has_colors = std::any_of(chunks_.begin(), chunks_.end(), [](const Chunk& c) { return c.has_colors; });
  mesh_.positions = MeshBuffer<float>(3 * all[0]);
  if (all[1] > 0) mesh_.uvs = MeshBuffer<float>(2 * all[1]);
  if (all[2] > 0) mesh_.normals = MeshBuffer<float>(3 * all[2]);
  if (has_colors) mesh_.colors = MeshBuffer<float>(3 * all[0]);
  std::vector<ChunkErrors> errors(chunks_.size());
  std::vector<Counts> next = before_;
  const auto has_values = [](const Chunk& chunk) {
    return std::any_of(chunk.counts.values.begin(), chunk.counts.values.end(), [](std::size_t n) { return n > 0; });
  };
  for_statements(has_values, [&](std::size_t i, Statement statement, LineWords& words) {
    if (statement > Statement::normal) return;
    const std::size_t which = statement == Statement::position ? 0 : statement == Statement::uv ? 1 : 2;
    const std::size_t number = next[i].values[which]++;
    constexpr std::size_t most = 8;
    double values[most] = {};
    const char* const start = words.at();
    std::size_t count = 0;
    while (count < most && words.number(values[count])) ++count;
    const std::size_t least = statement == Statement::uv ? 1 : 3;
    if (count < least || words.skip_space()) {
      errors[i].add(offset_of(start), words.skip_space() ? in_quotes(words.word()) + " is no number"
                                                         : "needs at least " + std::to_string(least) + " numbers");
      return;
    }
    if (statement == Statement::position) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        mesh_.positions[3 * number + axis] =
            rounded(values[axis] - component(settings_.origin, static_cast<int>(axis)));
      for (std::size_t channel = 0; has_colors && channel < 3; ++channel)
        mesh_.colors[3 * number + channel] = count >= 6 ? linear_color(values[3 + channel]) : 1;
    } else {
      MeshBuffer<float>& out = statement == Statement::uv ? mesh_.uvs : mesh_.normals;
      const std::size_t numbers = statement == Statement::uv ? 2 : 3;
      for (std::size_t k = 0; k < numbers; ++k) out[numbers * number + k] = finite_or_zero(rounded(values[k]));
    }
  });
  if (!ChunkErrors::report(errors, text_, diagnostics_)) return false;
  std::vector<std::size_t> bad(chunk_count(all[0]));
  for_each_chunk(all[0], settings_.threads, [&](std::size_t chunk, std::size_t first, std::size_t last) {
    bad[chunk] = mark_bad_positions(mesh_.positions.data() + 3 * first, last - first);
  });
  for (const std::size_t count : bad) faults_.bad_vertices += count;
  return true;
}

std::uint32_t Reader::resolved(std::int64_t index, std::size_t seen, std::size_t which) const {
  const std::int64_t number = index < 0 ? index + static_cast<std::int64_t>(seen) : index - 1;
  const bool exists = index != 0 && number >= 0 && static_cast<std::size_t>(number) < before_.back().values[which];
  return exists ? static_cast<std::uint32_t>(number) : none;
}

bool Reader::read_faces() {
  mesh_.keeps_polygons = settings_.polygons;
  if (!make_faces(before_.back().faces, mesh_, diagnostics_)) return false;
  faults_.too_small_polygons = before_.back().faces.too_small;
  for (const std::size_t which : {1U, 2U})
    if (before_.back().values[which] > 0) indices_[which] = MeshBuffer<std::uint32_t>(mesh_.indices.size());
  const bool has_materials = !mesh_.materials.empty();
  if (has_materials) mesh_.face_materials = MeshBuffer<std::uint32_t>(mesh_.face_count());

  struct State {
    FaceWriter faces;
    Counts seen;
    std::uint32_t material;
    std::size_t next_material = 0;
    std::array<bool, 3> used{}, same{true, true, true};
    ChunkErrors errors{};
    std::vector<std::uint32_t> polygon{};
    std::array<std::vector<std::uint32_t>, 3> others{};
  };
  std::vector<State> states;
  std::uint32_t material = none;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    states.push_back({FaceWriter(mesh_, before_[i].faces.faces(mesh_.corners)), before_[i], material});
    if (!chunks_[i].materials.empty()) material = chunks_[i].materials.back().material;
  }
  // A texture coordinate or normal that is not in the file is an error where a corner has it.
  const std::array<bool, 3> exists{true, before_.back().values[1] > 0, before_.back().values[2] > 0};
  const auto has_faces = [](const Chunk& chunk) { return chunk.counts.faces.any(); };
  for_statements(has_faces, [&](std::size_t i, Statement statement, LineWords& words) {
    State& state = states[i];
    if (statement <= Statement::normal) {
      ++state.seen.values[statement == Statement::position ? 0 : statement == Statement::uv ? 1 : 2];
      return;
    }
    if (statement == Statement::other) {
      if (words.word() == "usemtl") state.material = chunks_[i].materials[state.next_material++].material;
      return;
    }
    state.polygon.clear();
    for (auto& other : state.others) other.clear();
    while (words.skip_space()) {
      LineWords whole = words;
      std::array<std::uint32_t, 3> corner{none, none, none};
      const auto refuse = [&](const std::string& message) {
        state.errors.add(offset_of(whole.at()), in_quotes(LineWords(whole).word()) + message);
      };
      for (std::size_t which = 0; which < 3; ++which) {
        if (which > 0) {
          if (words.at_word_end()) break;
          words.advance();  // the slash
          if (words.at_word_end() || *words.at() == '/') continue;
        }
        std::int64_t index = 0;
        if (!words.integer(index)) return refuse(" is no corner of a face, which is v, v/vt, v//vn or v/vt/vn");
        corner[which] = resolved(index, state.seen.values[which], which);
        if (corner[which] == none) {
          static constexpr std::string_view names[] = {"vertices", "texture coordinates", "normals"};
          return refuse(" is not one of the " + std::to_string(before_.back().values[which]) + " " +
                        std::string(names[which]));
        }
      }
      if (!words.at_word_end()) return refuse(" is no corner of a face, which is v, v/vt, v//vn or v/vt/vn");
      state.polygon.push_back(corner[0]);
      for (const std::size_t which : {1U, 2U}) {
        if (!exists[which]) continue;
        state.others[which].push_back(corner[which]);
        state.used[which] = state.used[which] || corner[which] != none;
        state.same[which] = state.same[which] && corner[which] == corner[0];
      }
    }
    state.faces.add(state.polygon, [&](std::size_t out, std::uint32_t local) {
      for (const std::size_t which : {1U, 2U})
        if (!indices_[which].empty()) indices_[which][out] = state.others[which][local];
      if (has_materials) mesh_.face_materials[out / static_cast<std::size_t>(mesh_.corners)] = state.material;
    });
  });

  std::vector<ChunkErrors> errors;
  is_same_ = {true, true, true};
  for (State& state : states) {
    for (const std::size_t which : {1U, 2U}) {
      is_used_[which] = is_used_[which] || state.used[which];
      is_same_[which] = is_same_[which] && state.same[which];
    }
    faults_.degenerate_faces += state.faces.degenerate();
    errors.push_back(std::move(state.errors));
  }
  return ChunkErrors::report(errors, text_, diagnostics_);
}

/// Makes one vertex of each combination of v, vt and vn that faces have.
bool Reader::join_indices() {
  const auto& all = before_.back().values;
  for (const std::size_t which : {1U, 2U})
    if (!is_used_[which]) {
      indices_[which] = {};
      (which == 1 ? mesh_.uvs : mesh_.normals) = {};
    }
  const auto fits = [&](std::size_t which) { return !is_used_[which] || (is_same_[which] && all[which] == all[0]); };
  if (fits(1) && fits(2)) return true;
  if (mesh_.indices.size() >= most_indices) {
    diagnostics_.error({}, "has faces of more than 2147483647 corners");
    return false;
  }
  join_vertices(mesh_, indices_[1], indices_[2], settings_.threads);
  return true;
}

void Reader::read_materials() {
  constexpr std::size_t most_libraries = 256;
  std::vector<std::string_view> libraries, names;
  std::map<std::string_view, std::uint32_t> number_of;
  for (Chunk& chunk : chunks_) {
    for (const Name& library : chunk.libraries)
      if (libraries.size() < most_libraries &&
          std::none_of(libraries.begin(), libraries.end(), [&](auto known) { return known == library.text; }))
        libraries.push_back(library.text);
    for (Name& name : chunk.materials) {
      const auto [known, is_new] = number_of.try_emplace(name.text, static_cast<std::uint32_t>(names.size()));
      if (is_new) names.push_back(name.text);
      name.material = known->second;
    }
  }
  std::vector<MeshMaterial> defined;
  // Of libraries whose materials are all overridden nothing is missing.
  const bool is_any_used = std::ranges::any_of(names, [&](auto name) { return !settings_.overrides(name); });
  Diagnostics ignored = Diagnostics::counter(), &told = is_any_used ? diagnostics_ : ignored;
  for (const std::string_view library : libraries)
    read_material_libraries(library, folder_, line_of(library), defined, mesh_.files, settings_, told);
  std::map<std::string_view, const MeshMaterial*> by_name;
  for (const MeshMaterial& material : defined) by_name.try_emplace(material.name, &material);
  for (const std::string_view name : names) {
    const auto found = by_name.find(name);
    mesh_.materials.push_back(found != by_name.end() ? *found->second : named_material(name));
    if (found == by_name.end() && !settings_.overrides(name) && diagnostics_.keeps_another(Severity::warning))
      diagnostics_.warning({line_of(name), 0}, "no material " + in_quotes(name) + " in the material libraries");
  }
}

/// Objects that have faces. Those that follow each other with the same name are one.
void Reader::set_parts() {
  std::vector<MeshPart>& parts = mesh_.parts;
  std::string_view name = "default";  // as the format has it of groups
  std::size_t first = 0;
  const auto end_object = [&](std::size_t end) {
    if (end > first && (parts.empty() || parts.back().name != name)) parts.push_back({std::string(name), first});
    first = end;
  };
  for (std::size_t i = 0; i < chunks_.size(); ++i)
    for (const Object& object : chunks_[i].objects) {
      FaceCounts before = before_[i].faces;
      before += object.before;
      end_object(before.faces(mesh_.corners));
      name = object.name.empty() ? "default" : object.name;
    }
  end_object(mesh_.face_count());
  if (parts.size() == 1) parts.clear();
}

std::optional<MeshData> Reader::read() {
  count();
  read_materials();
  if (!read_values() || !read_faces() || !join_indices()) return std::nullopt;
  set_parts();
  for (MeshMaterial& material : mesh_.materials) material.vertex_colors = !mesh_.colors.empty();
  std::size_t skipped = 0;
  std::string_view first;
  for (const Chunk& chunk : chunks_) {
    if (skipped == 0) first = chunk.first_skipped;
    skipped += chunk.skipped;
  }
  if (skipped > 0)
    diagnostics_.warning({line_of(first), 0}, std::to_string(skipped) +
                                                  " statements are skipped, the first of which is " + in_quotes(first));
  const auto& of_faces = mesh_.face_materials;
  if (std::all_of(of_faces.begin(), of_faces.end(), [](std::uint32_t material) { return material == 0; }))
    mesh_.face_materials = {};
  if (!finish_mesh(mesh_, faults_, false, settings_.threads, diagnostics_)) return std::nullopt;
  return std::move(mesh_);
}

}  // namespace
}  // namespace obj

std::optional<MeshData> read_obj(MeshFile& file, const std::string& folder, const MeshReadSettings& settings,
                                 Diagnostics& diagnostics) {
  if (!file.load(settings.threads, diagnostics)) return std::nullopt;
  std::string_view text = file.text(true);
  if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
  return obj::Reader(text, folder, settings, diagnostics).read();
}

}  // namespace raytrace

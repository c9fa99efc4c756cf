// A glTF file's JSON and buffers: what its numbers name. Inside of read_gltf().
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "raytrace/import/gltf_accessor.h"
#include "raytrace/import/gltf_json.h"
#include "raytrace/import/mesh_file.h"
#include "raytrace/xml/diagnostics.h"

namespace raytrace::gltf {

/// What is wrong is thrown as Error.
class Document {
 public:
  /// file: all of it, which stays where it is. name: its file's, beside which others are.
  Document(std::string_view file, std::string name, int threads);
  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  const Item& root() const { return root_; }
  const std::string& name() const { return name_; }
  int threads() const { return threads_; }
  /// Those beside its own that are read so far.
  std::vector<std::string> files() const;
  /// Bytes of all files that are read so far, and of what was decoded.
  std::size_t size() const { return size_ + decoded_bytes_; }

  /// The item of a list at the root that `from` names by its number.
  Item listed(const char* list, const Item& from) const {
    const std::uint64_t number = from.whole();
    const std::optional<Item> items = root_.find(list);
    if (!items || number >= items->size())
      from.fail("there is no " + std::string(list) + '[' + std::to_string(number) + ']');
    return (*items)[number];
  }
  /// That of the list's items which has that name, else that number.
  std::uint64_t number_by_name(const std::optional<Item>& list, const std::string& name, const char* what) const;

  /// What it points into lives as long as this.
  Accessor accessor(const Item& number);
  /// The same without values: all are 0.
  Accessor accessor_of_zeros(const Item& number) const;
  std::string_view view_bytes(const Item& view);

  /// Counts bytes that decoding will take, of which a file has only so many: no memory follows from a claim alone.
  void expand(std::size_t bytes, const Item& place);
  /// What was decoded, as long as this.
  const std::string& keep(std::string bytes) {
    decoded_bytes_ += bytes.size();
    return decoded_.emplace_back(std::move(bytes));
  }

  /// Counts values that are read to evaluate an animation, of which a file has only so many: parts of it that say the
  /// same numbers again and again take no endless time.
  void spend(std::size_t values, const Item& place);
  /// Counts values that are looked at for a warning alone. Whether they may be: files of usual sizes have no more, but
  /// parts of others say the same ones again and again.
  bool may_look_at(std::size_t values);

  void warn(const std::string& place, const std::string& message) {
    if (!is_quiet_) warnings_.push_back(place + ": " + message);
  }
  /// Of the first place alone.
  void warn_once(const std::string& place, const std::string& message);
  /// Nothing is said while it is quiet.
  void be_quiet(bool quiet) { is_quiet_ = quiet; }
  void report(Diagnostics& diagnostics) const;

 private:
  /// The path of a file of that name.
  std::string beside(const std::string& file) const;
  void read_values(const Item& item, const Item& view, Elements& elements);
  std::string_view buffer(const Item& number);
  /// The bytes that a buffer view names, or what is in its place where it is compressed.
  std::string_view stored_bytes(const Item& view);

  Chunks chunks_;
  nlohmann::json json_;
  Item root_;
  std::string name_;
  int threads_;
  std::map<std::string, MeshFile> files_;
  std::map<std::uint64_t, std::string> data_;  ///< of the buffers that the file has as URIs
  std::deque<std::string> decoded_;
  std::map<std::string, std::string_view> decoded_views_;  ///< by their places
  std::size_t size_, decoded_bytes_ = 0, spent_ = 0, looked_at_ = 0, expanded_ = 0;
  std::vector<std::string> warnings_;
  std::set<std::string> warned_;
  bool is_quiet_ = false;
};

/// Of a URI, with '/' between folders.
std::string file_name(const Item& uri);

}  // namespace raytrace::gltf

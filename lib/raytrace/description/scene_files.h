// The files that a scene is read from: its own, and those that it includes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "raytrace/description/name_table.h"
#include "raytrace/description/read_value.h"
#include "raytrace/xml/document.h"
#include "raytrace/xml/scene_text.h"

namespace raytrace {

struct SceneFile {
  SceneText text;
  std::size_t first_chunk;  ///< chunks count through all files
  std::string folder;
  ReadContext context;
  Document skeleton{text};  ///< parsed
};

/// Whether an item of the group that starts there may have keys, or something in it looks so.
bool may_have_keys(const SceneFile& file, Element group);

/// All stay open to the end. Their lines and chunks count on from each to the next.
class SceneFiles {
 public:
  /// Whatever is wrong with files goes to the diagnostics. threads: as SceneText has it.
  SceneFiles(const Variables& variables, Diagnostics& diagnostics, int threads)
      : variables_(variables), diagnostics_(diagnostics), threads_(threads) {}

  /// The scene's own: what `file` holds, which may be "-" or empty. Null if it is no scene.
  const SceneFile* open(TextBuffer text, const std::string& file);

  /// One that the file at hand includes, which is at hand until leave(). Null, and it is not, if it cannot be read or
  /// is no scene, if it is at hand already, or if there are too many.
  const SceneFile* include(const FileName& file);
  void leave() { at_hand_.pop_back(); }

  const std::vector<IncludedFile>& included() const { return included_; }

  /// The item once more, parsed by a document that `document` receives.
  Element item_at(ItemPosition position, std::unique_ptr<Document>& document) const;

 private:
  const SceneFile* add(TextBuffer text, const std::string& file);

  const Variables& variables_;
  Diagnostics& diagnostics_;
  int threads_;
  std::deque<SceneFile> files_;
  std::vector<IncludedFile> included_;
  std::vector<std::string> at_hand_;  ///< their names: the scene's own, what it includes, what that includes...
  std::uint32_t next_line_ = 1;
  std::size_t next_chunk_ = 0;
};

}  // namespace raytrace

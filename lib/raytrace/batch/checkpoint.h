// A render's state on disk, from which another process can go on.
//
// The file is an EXR without compression: the picture so far, to look at, and the film's sums. It appears whole or not
// at all, and carries a hash of the sums.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "raytrace/batch/passes.h"
#include "raytrace/batch/provenance.h"
#include "raytrace/batch/render_observer.h"
#include "raytrace/film/film.h"

namespace raytrace {

/// Gives the file that it made. Throws OutputError. identity.film is the film's; metadata: its samples and attributes
/// are set here. error: what is known of the film's.
FileIdentity write_checkpoint(const std::string& file, const Film& film, const PieceIdentity& identity,
                              ImageMetadata metadata, const ErrorOfPasses::Sums& error = {});

/// Fills an empty film. Throws InputError if the file is not whole, or of another scene, other settings or another
/// region, which it names. The checkpoint may be of fewer or more samples than the film's settings ask for, but not
/// have more. The result: what is known of its error.
ErrorOfPasses::Sums read_checkpoint(const std::string& file, const PieceIdentity& identity, Film& film);

/// When a render writes its checkpoint, and whether the file is still this render's.
class CheckpointFile {
 public:
  using Clock = std::chrono::steady_clock;

  /// None is to be written.
  CheckpointFile() = default;

  /// interval: in seconds, between two checkpoints; the first of them begins now.
  CheckpointFile(std::string file, double interval);

  bool is_due() const { return !file_.empty() && Clock::now() >= next_; }

  /// Throws as read_checkpoint() does.
  ErrorOfPasses::Sums read(const PieceIdentity& identity, Film& film);

  /// False if it could not be written, which is reported: the render can go on, and an earlier one is as it was.
  bool write(const Film& film, const PieceIdentity& identity, const ImageMetadata& metadata,
             const ErrorOfPasses::Sums& error, RenderObserver& observer);

  /// Removes what was read or written last, if it is still there.
  void remove(RenderObserver& observer) const;

 private:
  std::string file_;
  Clock::duration interval_{};
  Clock::time_point next_ = Clock::now() + interval_;
  std::optional<FileIdentity> last_;  ///< that was read or written
};

}  // namespace raytrace

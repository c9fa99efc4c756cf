// A render's state on disk, from which another process can go on.
//
// The file is an EXR without compression: the picture so far, to look at, and the film's sums. It appears whole or not
// at all, and carries a hash of the sums.
#pragma once

#include <string>

#include "raytrace/batch/provenance.h"
#include "raytrace/film/film.h"

namespace raytrace {

/// Gives the file that it made. Throws OutputError. identity.film is the film's; metadata: its samples and attributes
/// are set here.
FileIdentity write_checkpoint(const std::string& file, const Film& film, const PieceIdentity& identity,
                              ImageMetadata metadata);

/// Fills an empty film. Throws InputError if the file is not whole, or of another scene, other settings or another
/// region, which it names. The checkpoint may be of fewer or more samples than the film's settings ask for, but not
/// have more.
void read_checkpoint(const std::string& file, const PieceIdentity& identity, Film& film);

}  // namespace raytrace

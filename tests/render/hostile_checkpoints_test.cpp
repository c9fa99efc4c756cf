// Checkpoints that were damaged: each is refused by its name, before anything follows from what it claims.
#include <string>
#include <vector>

#include "render/exr_edits.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

TEST_CASE("a damaged checkpoint is refused") {
  const TemporaryFolder folder;
  const std::string file = folder.file("checkpoint.exr");
  SamplePiece piece;
  piece.partial = piece.aovs = true;
  const auto refusal_of = [&](const Edit& edit) {
    const PieceIdentity identity = identity_of(piece);
    ImageMetadata metadata;
    metadata.software = identity.provenance.software;
    metadata.seed = identity.film.seed;
    write_checkpoint(file, film_of(piece), identity, metadata);
    ExrBytes exr = exr_of(file);
    edit(exr);
    write_text(file, exr.bytes());
    return resume_refusal(file, piece);
  };
  REQUIRE(refusal_of([](ExrBytes&) {}) == "");
  const std::vector<Edit> edits = {
      [](ExrBytes& exr) { set_window(exr, "dataWindow", {100000, 0, 100023, 17}); },
      [](ExrBytes& exr) { set_window(exr, "dataWindow", {5, 0, 28, 17}); },
      [](ExrBytes& exr) { set_window(exr, "displayWindow", {0, 0, 65535, 65535}); },
      [](ExrBytes& exr) { exr.set_text("raytrace:whole", "1,1,2,2"); },
      [](ExrBytes& exr) { exr.set_text("raytrace:region", "0,0,24,17"); },
      [](ExrBytes& exr) { exr.set_int("raytrace:samples", -1); },
      [](ExrBytes& exr) { exr.set_text("raytrace:firstSample", "0x"); },
      [](ExrBytes& exr) { exr.set_text("raytrace:sumsHash", "0123"); },
      [](ExrBytes& exr) { exr.remove("raytrace:sumsHash"); },
      [](ExrBytes& exr) { exr.set_first_value("sums.red.low", 1); },
      [](ExrBytes& exr) { exr.set_first_value("sums.samples", 0xffffffff); },
      [](ExrBytes& exr) { exr.set_first_value("sums.aov.nearest.sample", 0xffffffff); },
      [](ExrBytes& exr) { exr.set_first_value("sums.aov.cover0.count000", 0xffffffff); },
      [](ExrBytes& exr) {
        edit_channels(exr,
                      [](auto& all) { channel(all, "sums.aov.cover0.count001").name = "sums.aov.cover0.counx001"; });
      },
      [](ExrBytes& exr) { edit_channels(exr, [](auto& all) { channel(all, "sums.hits").layout[0] = '\2'; }); },
      [](ExrBytes& exr) { exr.rest.resize(exr.rest.size() - 1); },
      [](ExrBytes& exr) { exr.rest.resize(40); },
  };
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const std::string message = refusal_of(edits[i]);
    INFO("edit " << i << ": " << message);
    CHECK(contains(message, file));
  }
  write_piece(file, {});
  CHECK(contains(resume_refusal(file, {}), "it is a picture without the sums of its samples"));
}

}  // namespace raytrace::test

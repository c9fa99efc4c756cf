// Jobs and merges whose settings cannot be meant: each is refused with a sentence before anything is done.
#include <cmath>
#include <functional>
#include <string>

#include "raytrace/batch/check_job.h"
#include "raytrace/batch/merge_pieces.h"
#include "raytrace/batch/render_picture.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/sample_pieces.h"
#include "support/temporary_folder.h"

namespace raytrace::test {
namespace {

std::string thrown_by(const std::function<void()>& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

std::string job_refusal(const std::function<void(RenderJob&)>& change) {
  RenderJob job;
  job.scene = "no-such-scene.xml";
  job.outputs = {"no-such-folder/picture.exr"};
  change(job);
  RenderObserver observer;
  RenderControl control;
  try {
    render_picture(job, observer, control);
  } catch (const SettingsError& error) {
    return error.what();
  } catch (const std::exception&) {
  }
  return "";
}

}  // namespace

TEST_CASE("a job whose values cannot be meant is refused") {
  using Job = RenderJob;
  const double nan = std::nan("");
  CHECK(job_refusal([](Job&) {}) == "");
  for (const Tile tile : {Tile{5, 2}, Tile{-1, 2}, Tile{0, 0}, Tile{2, 2}})
    CHECK(job_refusal([&](Job& j) { j.tile = tile; }) ==
          "--tile: there is no tile " + text_of(tile) + "; of N tiles, the first is 0/N and the last N-1/N");
  CHECK(job_refusal([](Job& j) { j.tile = Tile{1, 2}; }) == "");
  CHECK(job_refusal([](Job& j) { j.resolution = Resolution{0, -4}; }) ==
        "--resolution: 0 x -4 pixels are no picture; each is at least 1");
  for (const double scale : {0.0, -1.0, nan, HUGE_VAL})
    CHECK(contains(job_refusal([&](Job& j) { j.scale = scale; }), " is not a scale; it is a number above 0"));
  CHECK(contains(job_refusal([](Job& j) { j.samples = -3; }), "--samples: -3 is too few"));
  CHECK(contains(job_refusal([](Job& j) { j.bit_depth = 7; }), "--bit-depth: 7 is neither 8 nor 16"));
  CHECK(contains(job_refusal([&](Job& j) { j.view.exposure = nan; }), "--exposure: nan is not an exposure"));
  CHECK(contains(job_refusal([](Job& j) { j.time_limit = -1; }), "--time-limit: -1 s is not a time"));
  for (const double interval : {-1.0, nan, 1e300})
    CHECK(contains(job_refusal([&](Job& j) { j.checkpoint_interval = interval; }), " s is not a time; it is from 0"));
  for (const double error : {0.0, nan, 1.5})
    CHECK(contains(job_refusal([&](Job& j) { j.error_limit = error; }), " is not an error; it is above 0"));
  CHECK(contains(job_refusal([](Job& j) { j.error_limit = 0.5, j.sample_offset = 1; }), "with --sample-offset each"));
  CHECK(contains(job_refusal([](Job& j) { j.resume = true; }), "--resume goes on from a checkpoint"));
  CHECK(contains(job_refusal([](Job& j) { j.outputs.clear(); }), "--output: none is given"));
}

TEST_CASE("a merge of nothing, to nothing, or over its pieces is refused") {
  const TemporaryFolder folder;
  const std::string piece = folder.file("piece.exr");
  write_piece(piece, {});
  const std::string bytes = bytes_of(piece);
  const auto refusal = [](const MergeSettings& settings) { return thrown_by([&] { merge_pieces(settings); }); };
  MergeSettings settings;
  settings.outputs = {folder.file("whole.exr")};
  CHECK(refusal(settings) == "no pieces are given");
  settings.pieces = {piece};
  CHECK(refusal(settings) == "");
  settings.outputs = {folder.file("./piece.exr")};
  CHECK(contains(refusal(settings), "is the same file as the piece " + piece + ", and would be overwritten"));
  CHECK(bytes_of(piece) == bytes);
  settings.outputs = {};
  CHECK(contains(refusal(settings), "--output: none is given"));
}

}  // namespace raytrace::test

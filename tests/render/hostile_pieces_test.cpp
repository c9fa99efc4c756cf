// Pieces that were damaged, or made to harm: each is refused by its name, before anything follows from
// what it claims. tests/fuzz/fuzz_pieces.cpp tries what nobody thought of.
#include <sys/stat.h>

#include <limits>
#include <string>
#include <vector>

#include "raytrace/batch/merge_pieces.h"
#include "render/exr_edits.h"
#include "support/catch.h"
#include "support/contains.h"
#include "support/exr_bytes.h"
#include "support/sample_pieces.h"
#include "support/temporary_folder.h"

namespace raytrace::test {

namespace {

/// What merging says of the pieces, which must leave no picture; "" if it does not refuse them.
std::string refusal(const TemporaryFolder& folder, const std::vector<std::string>& pieces, bool partial = false) {
  MergeSettings settings;
  for (const std::string& piece : pieces) settings.pieces.push_back(folder.file(piece));
  settings.outputs = {folder.file("merged.exr")};
  settings.partial = partial;
  settings.threads = 1;
  try {
    merge_pieces(settings);
  } catch (const MergeError& error) {
    CHECK(!std::filesystem::exists(settings.outputs[0]));
    return error.what();
  }
  std::filesystem::remove(settings.outputs[0]);
  return "";
}

/// Edits the right tile of two, which is then refused with this text, whether or not pieces may be missing.
void check_refused(const SamplePiece& kind, const Edit& edit, const std::string& text) {
  const TemporaryFolder folder;
  SamplePiece left = kind, right = kind;
  left.tile = raytrace::Tile{0, 2};
  right.tile = raytrace::Tile{1, 2};
  write_piece(folder.file("left.exr"), left);
  write_piece(folder.file("right.exr"), right);
  REQUIRE(refusal(folder, {"left.exr", "right.exr"}) == "");
  ExrBytes exr = exr_of(folder.file("right.exr"));
  edit(exr);
  write_text(folder.file("right.exr"), exr.bytes());
  for (const bool partial : {false, true}) {
    const std::string message = refusal(folder, {"left.exr", "right.exr"}, partial);
    INFO("wanted: " << text << "; message: " << message);
    CHECK(contains(message, folder.file("right.exr")));
    CHECK(contains(message, text));
    CHECK(refusal(folder, {"right.exr"}, partial) == message);
  }
}

void check_refused(const Edit& edit, const std::string& text) { check_refused({}, edit, text); }

constexpr int highest = std::numeric_limits<int>::max(), lowest = std::numeric_limits<int>::min();

}  // namespace

TEST_CASE("a piece whose windows are not its own is refused") {
  const auto data = [](int x0, int y0, int x1, int y1) {
    return [=](ExrBytes& exr) { set_window(exr, "dataWindow", {x0, y0, x1, y1}); };
  };
  check_refused(data(100000, 0, 100011, 17), "data window");
  check_refused(data(512, 0, 523, 17), "data window");
  check_refused(data(13, 0, 24, 17), "data window is 13,0,25,18, its raytrace:region 12,0,24,18");
  check_refused(data(0, 0, 11, 17), "data window is 0,0,12,18, its raytrace:region 12,0,24,18");
  check_refused(data(-12, 0, -1, 17), "data window");
  check_refused(data(12, -18, 23, -1), "data window");
  check_refused(data(12, 0, 22, 17), "data window");
  check_refused(data(0, 0, 65535, 65535), "data window");
  check_refused(data(23, 0, 12, 17), "data window");
  check_refused(data(lowest, lowest, highest, highest), "data window");
  check_refused(data(highest, 0, highest, 17), "data window");
  const auto display = [](int x0, int y0, int x1, int y1) {
    return [=](ExrBytes& exr) { set_window(exr, "displayWindow", {x0, y0, x1, y1}); };
  };
  check_refused(display(1, 0, 23, 17), "its display window does not begin at 0,0");
  check_refused(display(0, -1, 23, 17), "its display window does not begin at 0,0");
  check_refused(display(0, 0, 65535, 65535), "its display window of 65536 x 65536 pixels");
  check_refused(display(0, 0, 65536, 0), "its display window of 65537 x 1 pixels");
  check_refused(display(0, 0, -1, 17), "its display window of 0 x 18 pixels");
  check_refused(display(0, 0, highest, highest), "its display window");
  check_refused(display(0, 0, 3, 3), "data window");
  check_refused([](ExrBytes& exr) { exr.remove("dataWindow"); }, "no data window");
  check_refused([](ExrBytes& exr) { exr["dataWindow"].type = "box2f"; }, "no data window");
}

TEST_CASE("a piece whose place in the picture is none is refused") {
  const auto text = [](const char* name, const std::string& value) {
    return [=](ExrBytes& exr) { exr.set_text(name, value); };
  };
  for (const char* const whole :
       {"1,1,2,2", "0,0,65536,65536", "0,0,24,17", "12,0,24,18", "-25,0,24,18", "0,0,49,18", "24,0,0,18", "0,0,24,18,",
        "0,0,24,18 ", "+0,0,24,18", "0,0,24", "0,0,24,018", "", "0,0,99999999999,18", "zero,0,24,18"})
    check_refused(text("raytrace:whole", whole), "is damaged: its raytrace:");
  for (const char* const region : {"0,0,24,18", "12,0,23,18", "12,0,24,18,", " 12,0,24,18", ""})
    check_refused(text("raytrace:region", region), "raytrace:region");
  for (const char* const tile : {"0/2", "2/2", "-1/2", "1/0", "1/-2", "1/3", "1", "1/", "/2", "1/2/", "01/2", "1/2 ",
                                 "", "1/2147483647", "1/2147483648"})
    check_refused(text("raytrace:tile", tile), "raytrace:");
  for (const char* const name : {"raytrace:whole", "raytrace:region", "raytrace:tile"})
    check_refused([=](ExrBytes& exr) { exr.remove(name); }, "raytrace:");
}

TEST_CASE("a piece whose numbers are none of this program's is refused") {
  const auto number = [](const char* name, int value) { return [=](ExrBytes& exr) { exr.set_int(name, value); }; };
  const auto text = [](const char* name, const std::string& value) {
    return [=](ExrBytes& exr) { exr.set_text(name, value); };
  };
  for (const int samples : {-1, 0, lowest}) check_refused(number("raytrace:samples", samples), "raytrace:samples");
  check_refused(
      [](ExrBytes& exr) {
        exr.set_int("raytrace:samples", highest);
        exr.set_text("raytrace:firstSample", "1");
      },
      "raytrace:samples");
  for (const char* const first : {"-1", "+1", "01", "1 ", " 1", "1x", "0x1", "1.0", "", "4294967296", "2147483647"})
    check_refused(text("raytrace:firstSample", first), "is damaged: its raytrace:");
  for (const char* const seed : {"-7", "+7", "07", "7 ", "seven", "", "18446744073709551616"})
    check_refused(text("raytrace:seed", seed), "raytrace:seed");
  for (const int centered : {2, -1, 1}) check_refused(number("raytrace:centered", centered), "raytrace:centered");
  for (const int partial : {2, -1}) check_refused(number("raytrace:partial", partial), "raytrace:partial");
  for (const int unit : {-193, 97, 1000, lowest, highest})
    check_refused(number("raytrace:unitExponent", unit), "raytrace:unitExponent");
  for (const char* const aovs : {"", "dept", "depth,", ",depth", "depth,depth", "position,depth"})
    check_refused(text("raytrace:aovs", aovs), "");
  SamplePiece with_aovs;
  with_aovs.aovs = true;
  for (const char* const units : {"0,0", "0,0,0,0", "0,0,97", "0,0,+1", "0,0,", ""})
    check_refused(with_aovs, text("raytrace:aovUnits", units), "raytrace:aovUnits");
  SamplePiece with_light_paths;
  with_light_paths.sums = with_light_paths.light_paths = true;
  for (const int flag : {2, -1})
    check_refused(with_light_paths, number("raytrace:lightPaths", flag), "raytrace:lightPaths");
  // Its file is as large as the picture, and no tile.
  check_refused(with_light_paths, number("raytrace:lightPaths", 0), "its data window is");
  // Of another type, or twice.
  for (const char* const name :
       {"raytrace:samples", "raytrace:centered", "raytrace:unitExponent", "raytrace:partial"}) {
    check_refused(text(name, "0"), name);
    check_refused([=](ExrBytes& exr) { exr.set(name, "double", std::string(8, '\0')); }, name);
  }
  for (const char* const name : {"raytrace:seed", "raytrace:whole", "Software"}) check_refused(number(name, 7), name);
  check_refused([](ExrBytes& exr) { exr.attributes.push_back(exr["raytrace:samples"]); }, "raytrace:samples twice");
}

TEST_CASE("a piece with other channels than its own is refused by the channel's name") {
  SamplePiece kind;
  kind.sums = kind.aovs = true;
  const auto check = [&](const std::function<void(std::vector<ExrChannel>&)>& edit, const std::string& text) {
    check_refused(kind, [&](ExrBytes& exr) { edit_channels(exr, edit); }, text);
  };
  const std::string as_half("\1", 1), as_float("\2", 1);
  for (const char* const name : {"R", "Z", "sums.red.low", "sums.samples", "sums.aov.nearest.sample",
                                 "sums.aov.mean0.high", "sums.aov.cover1.id000", "sums.aov.cover0.count001"})
    check([&](auto& channels) { channel(channels, name).name += "x"; }, "channel");
  check([](auto& channels) { channel(channels, "sums.green.low").name = "sums.green.lox"; },
        "lacks the channel sums.green.low");
  for (const char* const name : {"sums.red.low", "sums.hits", "sums.aov.cover0.id000", "sums.aov.mean1.low"})
    for (const std::string& type : {as_half, as_float})
      check([&](auto& channels) { channel(channels, name).layout.replace(0, 1, type); },
            std::string("its channel ") + name + " is of another type");
  check([](auto& channels) { channel(channels, "G").layout.replace(0, 1, 1, '\2'); },
        "its channel G is of another type");
  check([](auto& channels) { channel(channels, "A").layout.replace(0, 1, 1, '\7'); }, "");
  for (const char* const name : {"sums.depth", "sums.aov.mean9.low", "sums.aov.cover9.id000", "Y", "sums."})
    check([&](auto& channels) { channels.push_back({name, channel(channels, "sums.hits").layout}); }, "channel");
  check([](auto& channels) { channels.push_back({"sums.limb2.red.low", channel(channels, "sums.hits").layout}); },
        "lacks the channel sums.limb2.");
  check([](auto& channels) { channels.push_back(channel(channels, "sums.hits")); }, "the channel sums.hits twice");
  check([](auto& channels) { std::erase_if(channels, [](const auto& one) { return one.name == "sums.hits"; }); },
        "lacks the channel sums.hits");
  check([](auto& channels) { channels.clear(); }, "");
  check([](auto& channels) { channel(channels, "B").layout.replace(8, 4, little_endian(2U)); }, "channel B");
}

TEST_CASE("a piece with light paths needs the channels of what they bring") {
  SamplePiece kind;
  kind.sums = kind.light_paths = true;
  const auto check = [&](const std::function<void(std::vector<ExrChannel>&)>& edit, const std::string& text) {
    check_refused(kind, [&](ExrBytes& exr) { edit_channels(exr, edit); }, text);
  };
  for (const char* const name : {"sums.splat.red.low", "sums.splat.blue.high"}) {
    check([&](auto& channels) { std::erase_if(channels, [&](const auto& one) { return one.name == name; }); },
          std::string("lacks the channel ") + name);
    check([&](auto& channels) { channel(channels, name).name += "x"; }, "channel");
  }
  check([](auto& channels) { channels.push_back({"sums.splat.limb2.red.low", channel(channels, "sums.hits").layout}); },
        "lacks the channel sums.splat.limb2.");
}

TEST_CASE("an EXR file of another kind is refused") {
  for (const int compression : {1, 2, 4, 5, 6, 7, 8, 9, 255})
    check_refused([=](ExrBytes& exr) { exr["compression"].value[0] = static_cast<char>(compression); }, "");
  for (const int order : {1, 2, 7})
    check_refused([=](ExrBytes& exr) { exr["lineOrder"].value[0] = static_cast<char>(order); }, "");
  for (const std::uint32_t version : {1U, 3U, 0x202U, 0x802U, 0x1002U, 0x1802U, 0x80000002U})
    check_refused([=](ExrBytes& exr) { exr.version = version; }, "this program writes none");
  const std::string huge_tiles = little_endian(std::vector{highest, highest}) + std::string(1, '\0');
  check_refused([&](ExrBytes& exr) { exr.set("tiles", "tiledesc", huge_tiles); }, "");
  check_refused([](ExrBytes& exr) { exr.set_text("type", "deepscanline"); }, "");
  // What a few bytes claim to be.
  check_refused(
      [](ExrBytes& exr) {
        exr.rest.resize(10000);
        for (const char* const name : {"dataWindow", "displayWindow"}) set_window(exr, name, {0, 0, 16383, 16383});
        exr.remove("raytrace:tile");
        exr.set_text("raytrace:whole", "0,0,16384,16384");
        exr.set_text("raytrace:region", "0,0,16384,16384");
      },
      "too small for its 268435456 pixels");
}

TEST_CASE("a header that claims more bytes than the file has is refused") {
  const TemporaryFolder folder;
  write_piece(folder.file("piece.exr"), {});
  const std::string bytes = bytes_of(folder.file("piece.exr"));
  for (const std::uint32_t size : {0x7fffffffU, 0xffffffffU, 1000000U}) {
    std::string changed = bytes;
    changed.replace(bytes.find("raytrace:scene") + sizeof "raytrace:scene" + sizeof "string", 4, little_endian(size));
    write_text(folder.file("piece.exr"), changed);
    CHECK(contains(refusal(folder, {"piece.exr"}), "piece.exr: it is not whole"));
  }
}

TEST_CASE("a header whose values have other sizes than their types is refused") {
  for (const char* const name : {"raytrace:samples", "worldToNDC", "chromaticities", "dataWindow", "compression",
                                 "pixelAspectRatio", "screenWindowCenter", "channels"})
    for (const bool longer : {false, true})
      check_refused(
          [=](ExrBytes& exr) {
            std::string& value = exr[name].value;
            longer ? value.push_back('\0') : value.pop_back();
          },
          "");
  check_refused([](ExrBytes& exr) { exr.set("names", "stringvector", little_endian(0x7fffffffU)); },
                "its header has names of the type stringvector");
  check_refused([](ExrBytes& exr) { exr.set("small", "preview", little_endian({30000, 30000})); },
                "of the type preview");
}

TEST_CASE("sums that no samples can have are refused") {
  SamplePiece kind;
  kind.samples = {3, 5};
  kind.sums = kind.aovs = true;
  kind.compressed = false;
  SamplePiece before = kind;
  before.samples = {0, 3};
  before.tile = raytrace::Tile{1, 2};
  const auto refusal_of = [&](const Edit& edit, const Edit& edit_before) {
    const TemporaryFolder folder;
    kind.tile = raytrace::Tile{1, 2};
    for (const auto& [name, piece, change] : {std::tuple{"a.exr", before, edit_before}, {"b.exr", kind, edit}}) {
      write_piece(folder.file(name), piece);
      ExrBytes exr = exr_of(folder.file(name));
      change(exr);
      write_text(folder.file(name), exr.bytes());
    }
    return refusal(folder, {"a.exr", "b.exr"}, true);
  };
  const Edit none = [](ExrBytes&) {};
  REQUIRE(refusal_of(none, none) == "");
  const auto value = [](const char* channel, std::uint32_t word) {
    return [=](ExrBytes& exr) { exr.set_first_value(channel, word); };
  };
  const auto check = [&](const Edit& edit, const Edit& edit_before) {
    const std::string message = refusal_of(edit, edit_before);
    INFO(message);
    CHECK(contains(message, "b.exr is damaged: its sums"));
  };
  check(value("sums.samples", 6), none);
  check(value("sums.samples", 0xffffffff), none);
  check(value("sums.samples", 0), none);
  check(value("sums.hits", 6), none);
  for (const std::uint32_t index : {3U, 9U, 0xffffffffU}) check(value("sums.aov.nearest.sample", index), none);
  CHECK(refusal_of(value("sums.aov.nearest.sample", 8), none) == "");
  for (const std::uint32_t count : {6U, 0xffffffffU}) check(value("sums.aov.cover1.count000", count), none);
  check(value("sums.aov.mean2.high", 0x7fffffff), value("sums.aov.mean2.high", 0x7fffffff));
  check(value("sums.aov.mean2.high", 0x80000000), value("sums.aov.mean2.high", 0x80000000));
  CHECK(refusal_of(value("sums.red.high", 0x7fffffff), value("sums.red.high", 0x7fffffff)) == "");  // carried
  kind.large = true;
  REQUIRE(refusal_of(none, none) == "");
  for (const char* const sum : {"sums.limb2.red.high", "sums.limb2.green.high", "sums.limb2.blue.high"})
    for (const std::uint32_t word : {1U, 0x7fffffffU, 0x80000000U, 0xfffffffeU}) check(value(sum, word), none);
  check(
      [](ExrBytes& exr) {
        exr.set_first_value("sums.samples", 0);
        exr.set_first_value("sums.hits", 0);
      },
      none);
  // All that are damaged, in one run.
  const std::string both = refusal_of(value("sums.hits", 6), value("sums.hits", 4));
  CHECK(contains(both, "a.exr is damaged"));
  CHECK(contains(both, "b.exr is damaged"));
}

TEST_CASE("all pieces that are refused are named in one run") {
  const TemporaryFolder folder;
  for (const char* const name : {"good.exr", "other.exr", "samples.exr", "window.exr"})
    write_piece(folder.file(name), {});
  const auto edit = [&](const char* name, const Edit& change) {
    ExrBytes exr = exr_of(folder.file(name));
    change(exr);
    write_text(folder.file(name), exr.bytes());
  };
  edit("other.exr", [](ExrBytes& exr) { exr.set_text("raytrace:seed", "8"); });
  edit("samples.exr", [](ExrBytes& exr) { exr.set_int("raytrace:samples", -1); });
  edit("window.exr", [](ExrBytes& exr) { set_window(exr, "dataWindow", {1, 0, 24, 17}); });
  const std::string message = refusal(folder, {"good.exr", "other.exr", "samples.exr", "window.exr", "absent.exr"});
  for (const char* const name : {"other.exr", "samples.exr", "window.exr", "absent.exr"})
    CHECK(contains(message, folder.file(name)));
  CHECK(!contains(message, folder.file("good.exr") + " is"));
}

TEST_CASE("a piece that was stopped is reported with the options that make it") {
  const TemporaryFolder folder;
  SamplePiece piece;
  piece.sums = piece.partial = true;
  const auto check = [&](const std::string& options) {
    write_piece(folder.file("piece.exr"), piece);
    CHECK(contains(refusal(folder, {"piece.exr"}), "piece.exr was stopped before its end: render it to its end with " +
                                                       options + "--resume, or use --partial"));
    CHECK(refusal(folder, {"piece.exr"}, true) == "");
  };
  check("");
  piece.tile = raytrace::Tile{1, 4};
  check("--tile 1/4 ");
  piece.samples = {8, 4};
  check("--tile 1/4 --sample-offset 8 ");
}

TEST_CASE("what is no regular file is refused at once") {
  const TemporaryFolder folder;
  write_piece(folder.file("piece.exr"), {});
  REQUIRE(mkfifo(folder.file("pipe.exr").c_str(), 0600) == 0);
  std::filesystem::create_directory(folder.file("folder.exr"));
  std::filesystem::create_symlink("/dev/zero", folder.file("device.exr"));
  for (const char* const name : {"pipe.exr", "device.exr"}) {
    CHECK(contains(refusal(folder, {"piece.exr", name}),
                   "cannot read " + folder.file(name) + ": it is not a regular file"));
    CHECK(contains(resume_refusal(folder.file(name), {}), "it is not a regular file"));
  }
  CHECK(contains(refusal(folder, {"folder.exr"}), "it is a folder"));
  std::filesystem::create_symlink("piece.exr", folder.file("link.exr"));
  CHECK(refusal(folder, {"link.exr"}) == "");
}

}  // namespace raytrace::test

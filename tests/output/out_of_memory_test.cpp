// Memory that runs out while a picture is encoded: std::bad_alloc, whoever asked for it, and never another error.
#include "raytrace/memory/out_of_memory.h"

#include <atomic>
#include <cstdlib>
#include <new>

#include "pictures.h"
#include "raytrace/output/image_encoder.h"
#include "support/catch.h"

// Not with sanitizers: OpenEXR itself leaks where an allocation fails, and the thread sanitizer knows by their callers
// which allocations are OpenImageIO's, which it passes over.
namespace {

/// The allocation of that number, from 0, fails; below 0: none.
std::atomic<int> failing{-1};

}  // namespace

// All that operator delete below may get: the address sanitizer wants pairs.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t& /*unused*/) noexcept {
  if (failing.load() >= 0 && failing.fetch_sub(1) == 0) return nullptr;
  return std::malloc(size == 0 ? 1 : size);
}
[[gnu::noinline]] void* operator new(std::size_t size) {
  if (void* const memory = operator new(size, std::nothrow)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t /*size*/) noexcept { std::free(memory); }

namespace raytrace::test {

namespace {

enum class Outcome { written, out_of_memory, other_error };

/// number: of the encoder's allocation that fails; below 0: none.
Outcome encode(const FloatPicture& picture, const ImageFileSettings& settings, int number) {
  const std::vector<Channel> channels = color_channels(settings.full_float);
  ImageBand band;
  fill_color(band, picture, 0, picture.region().y1);
  const FileHandle memory = open_memory_file();
  const auto encoder = make_image_encoder("a.exr", settings);
  const PictureExtent extent{picture.region().x1, picture.region().y1, picture.region()};
  const ImageMetadata metadata;
  try {
    failing = number;
    encoder->begin(extent, channels, metadata, memory.get());
    encoder->write(band);
    encoder->finish();
    failing = -1;
    return Outcome::written;
  } catch (const std::bad_alloc&) {
    failing = -1;
    return Outcome::out_of_memory;
  } catch (const std::exception& error) {
    failing = -1;
    UNSCOPED_INFO("allocation " << number << ": " << error.what());
    return Outcome::other_error;
  }
}

}  // namespace

TEST_CASE("every allocation that fails while an EXR is encoded is out of memory") {
  const FloatPicture picture = noise_film(40, 50);
  for (const int threads : {1, 3}) {
    ImageFileSettings settings;
    settings.threads = threads;
    REQUIRE(encode(picture, settings, -1) == Outcome::written);  // starts the threads
    int number = 0;
    for (Outcome outcome = Outcome::out_of_memory; outcome != Outcome::written && number < 100000; ++number) {
      outcome = encode(picture, settings, number);
      REQUIRE(outcome != Outcome::other_error);
    }
    CHECK(number > 100);
  }
}

TEST_CASE("what libraries say of memory") {
  for (const char* const message :
       {"Error writing pixel data to image file \"picture\". std::bad_alloc", "Data compression (zlib) failed.",
        "Out of memory", "Cannot allocate memory", "pthread_create has failed: Resource temporarily unavailable"})
    CHECK(says_out_of_memory(message));
  for (const char* const message : {"", "No space left on device", "unexpected end of file", "memory_folder/a.exr"})
    CHECK_FALSE(says_out_of_memory(message));
}

}  // namespace raytrace::test

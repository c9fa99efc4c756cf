#include "raytrace/aovs/cryptomatte.h"

#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>

#include "support/catch.h"

namespace raytrace::test {

namespace {

std::string text_of(const std::vector<ImageAttribute>& attributes, const std::string& name) {
  for (const ImageAttribute& attribute : attributes)
    if (attribute.name == name) return std::get<std::string>(attribute.value);
  return "no attribute " + name;
}

}  // namespace

TEST_CASE("MurmurHash3 gives its published values") {
  CHECK(cryptomatte::murmur_hash3("") == 0);
  CHECK(cryptomatte::murmur_hash3("test") == 0xba6bd213U);
  CHECK(cryptomatte::murmur_hash3("Hello, world!") == 0xc0363e43U);
  CHECK(cryptomatte::murmur_hash3("The quick brown fox jumps over the lazy dog") == 0x2e4ff723U);
  CHECK(cryptomatte::murmur_hash3("aaaa") == 0x7eeed987U);  // lengths of all remainders
  CHECK(cryptomatte::murmur_hash3("aaa") == 0xb4d05fb7U);
  CHECK(cryptomatte::murmur_hash3("aa") == 0x371091a9U);
  CHECK(cryptomatte::murmur_hash3("a") == 0x3c2569b2U);
}

TEST_CASE("the ids of names are those of the specification's example") {
  CHECK(cryptomatte::id_of("bunny") == 0x13851a76U);
  CHECK(cryptomatte::id_of("default") == 0x42c9679fU);
}

TEST_CASE("the bits of an id are a normal number, whatever the name") {
  int repaired = 0, wrong = 0;
  for (int i = 0; i < 100000; ++i) {
    const std::string name = "object " + std::to_string(i);
    const std::uint32_t hash = cryptomatte::murmur_hash3(name), id = cryptomatte::id_of(name);
    wrong += !std::isnormal(std::bit_cast<float>(id));
    wrong += id != hash && (id ^ hash) != 1U << 23U;
    wrong += id != hash && std::isnormal(std::bit_cast<float>(hash));
    repaired += id != hash;
  }
  CHECK(wrong == 0);
  CHECK(repaired > 600);  // 2 exponents of 256 are none of a normal number's
  CHECK(repaired < 1000);
}

TEST_CASE("six pairs are three layers of four channels") {
  const std::vector<Channel> channels = cryptomatte::channels("crypto_object");
  REQUIRE(channels.size() == 12);
  CHECK(channels[0] == Channel{"crypto_object00.R", ChannelType::float32});
  CHECK(channels[7] == Channel{"crypto_object01.A", ChannelType::float32});
  CHECK(channels[10] == Channel{"crypto_object02.B", ChannelType::float32});
}

TEST_CASE("the attributes name the layer, the hash and each thing's id") {
  const std::vector<std::string> names = {"bunny", "a \"quoted\" \\ name", "\xc3\xa9t\xc3\xa9"};
  const auto attributes = cryptomatte::attributes("crypto_object", names);
  char digits[9];
  std::snprintf(digits, sizeof digits, "%08x", cryptomatte::id_of("crypto_object"));
  const std::string key = "cryptomatte/" + std::string(digits).substr(0, 7) + "/";
  CHECK(text_of(attributes, key + "name") == "crypto_object");
  CHECK(text_of(attributes, key + "hash") == "MurmurHash3_32");
  CHECK(text_of(attributes, key + "conversion") == "uint32_to_float32");
  const auto manifest = nlohmann::json::parse(text_of(attributes, key + "manifest"));
  REQUIRE(manifest.size() == 3);
  CHECK(manifest["bunny"] == "13851a76");
  for (const std::string& name : names) {
    const std::string id = manifest[name];
    CHECK(std::stoul(id, nullptr, 16) == cryptomatte::id_of(name));
  }
}

}  // namespace raytrace::test

#include "raytrace/import/mesh_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "raytrace/import/converted_model.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/parallel/for_each_index.h"
#include "raytrace/parallel/read_file_at.h"

namespace raytrace {
namespace {

struct Inflater {
  z_stream stream{};
  Inflater() {
    constexpr int gzip_of_any_window = 15 + 16;
    if (inflateInit2(&stream, gzip_of_any_window) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

}  // namespace

std::string mesh_type(const std::string& file) {
  std::filesystem::path path(file);
  if (path.extension() == ".gz") path = path.stem();
  std::string type = path.extension().string();
  std::transform(type.begin(), type.end(), type.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return type;
}

void MeshFile::Close::operator()(const int* file) const {
  close(*file);
  delete file;
}

void MeshFile::report_changed(Diagnostics& diagnostics) {
  diagnostics.error({}, "cannot read all of it; it may have become shorter meanwhile");
}

std::optional<MeshFile> MeshFile::open(const std::string& name, Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& reason) {
    diagnostics.error({}, "cannot read it: " + reason);
    return std::nullopt;
  };
  struct stat status{};
  // Before it is opened, since a device may do something then.
  if (stat(name.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    return refuse(S_ISDIR(status.st_mode) ? "it is a folder" : "it is not a regular file");
  const int number = ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (number < 0) return refuse(std::generic_category().message(errno));
  MeshFile file;
  file.file_ = std::unique_ptr<int, Close>(new int(number));
  if (fstat(number, &status) != 0 || !S_ISREG(status.st_mode)) return refuse("it is not a regular file");
  file.size_ = static_cast<std::size_t>(status.st_size);
  if (file.size_ == 0) {
    diagnostics.error({}, "is empty");
    return std::nullopt;
  }
  if (name.ends_with(".gz") && !file.decompress(diagnostics)) return std::nullopt;
  return file;
}

const char* MeshFile::bytes(std::size_t offset, std::size_t count, Scratch& scratch) const {
  if (memory_.data() != nullptr) return memory_.data() + offset;
  char* const room = scratch.room_for(count);
  return read_file_at(*file_, room, count, offset) == count ? room : nullptr;
}

bool MeshFile::load(int threads, Diagnostics& diagnostics) {
  if (memory_.data() != nullptr) return true;
  constexpr std::size_t block = std::size_t{1} << 21U;
  auto memory = LargeArray<char>::unset(size_ + 1);
  std::atomic<bool> complete{true};
  for_each_index(static_cast<int>((size_ + block - 1) / block), threads, [&](int index) {
    const std::size_t offset = static_cast<std::size_t>(index) * block, count = std::min(block, size_ - offset);
    if (read_file_at(*file_, memory.data() + offset, count, offset) != count) complete = false;
  });
  if (!complete) {
    report_changed(diagnostics);
    return false;
  }
  memory_ = std::move(memory);
  return true;
}

bool MeshFile::convert(const std::string& name, Diagnostics& diagnostics) {
  std::optional<ConvertedModel> model = convert_model(name, diagnostics);
  if (!model) return false;
  memory_ = std::move(model->glb);
  size_ = model->size;
  file_.reset();
  return true;
}

std::string_view MeshFile::text(bool as_lines) {
  const std::string_view all(memory_.data(), size_);
  constexpr std::size_t first_lines = 4096;
  if (as_lines && all.substr(0, first_lines).find('\n') == std::string_view::npos &&
      all.substr(0, first_lines).find('\r') != std::string_view::npos && all.find('\n') == std::string_view::npos)
    std::replace(memory_.data(), memory_.data() + size_, '\r', '\n');
  return all;
}

bool MeshFile::decompress(Diagnostics& diagnostics) {
  constexpr std::size_t block = std::size_t{1} << 18U;
  constexpr std::size_t most_ratio = 1032;  // of deflate
  const std::size_t most = std::min(available_memory() / 4, size_ * most_ratio) + 1;

  // The last four bytes say how much there is, modulo 2^32, if they do not lie.
  unsigned char claim[4] = {};
  if (size_ >= sizeof claim) read_file_at(*file_, reinterpret_cast<char*>(claim), sizeof claim, size_ - sizeof claim);
  const std::size_t claimed =
      std::size_t{claim[0]} | std::size_t{claim[1]} << 8U | std::size_t{claim[2]} << 16U | std::size_t{claim[3]} << 24U;
  std::size_t room = std::clamp(claimed + 1, std::min(block, most), most), length = 0;
  auto memory = LargeArray<char>::unset(room);

  const auto input = std::make_unique_for_overwrite<char[]>(block);
  Inflater inflater;
  z_stream& stream = inflater.stream;
  std::size_t offset = 0;
  const auto refuse = [&](const std::string& reason) {
    diagnostics.error({}, "byte " + std::to_string(offset - stream.avail_in) + ": " + reason);
    return false;
  };
  bool ended = false;
  while (true) {
    if (stream.avail_in == 0) {
      stream.avail_in = static_cast<uInt>(read_file_at(*file_, input.get(), std::min(block, size_ - offset), offset));
      stream.next_in = reinterpret_cast<Bytef*>(input.get());
      offset += stream.avail_in;
      if (stream.avail_in == 0) {
        if (ended) break;
        return refuse("the compressed data ends too early");
      }
    }
    if (ended) {
      if (*stream.next_in != 0x1f) break;  // no further part: what tapes are padded with
      inflateReset(&stream);
      ended = false;
    }
    if (length == room) {
      if (room == most) return refuse("becomes larger than a quarter of the memory that is available");
      const std::size_t more = std::min(2 * room, most);
      auto larger = LargeArray<char>::unset(more);
      std::memcpy(larger.data(), memory.data(), length);
      memory = std::move(larger);
      room = more;
    }
    constexpr std::size_t most_at_once = std::size_t{1} << 30U;
    const auto at_once = static_cast<uInt>(std::min(room - length, most_at_once));
    stream.next_out = reinterpret_cast<Bytef*>(memory.data() + length);
    stream.avail_out = at_once;
    const int result = inflate(&stream, Z_NO_FLUSH);
    length += at_once - stream.avail_out;
    if (result == Z_STREAM_END) {
      ended = true;
    } else if (result == Z_MEM_ERROR) {
      throw std::bad_alloc();
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      return refuse(std::string("the compressed data is damaged (") + (stream.msg != nullptr ? stream.msg : "zlib") +
                    ")");
    }
  }
  memory_ = std::move(memory);
  size_ = length;
  file_.reset();
  return true;
}

}  // namespace raytrace

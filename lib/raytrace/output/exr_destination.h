// Where OpenEXR writes to.
#pragma once

#include <ImfIO.h>

#include <cstdint>
#include <cstdio>

namespace raytrace {

/// A file that remembers why a write failed, since OpenEXR tells only that it did. Throws OutputError then.
class ExrDestination final : public Imf::OStream {
 public:
  /// file: open for writing; it stays open.
  explicit ExrDestination(std::FILE* file) : OStream("picture"), file_(file) {}

  void write(const char data[], int size) override;
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override;

  /// Empties the file's buffer. Throws if that or any write before failed.
  void finish();

  /// 0, or the error number of the first failure.
  int error() const { return error_; }

 private:
  [[noreturn]] void fail();

  std::FILE* file_;
  std::uint64_t position_ = 0;
  int error_ = 0;
};

}  // namespace raytrace

// What Linux says about this process and its memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace raytrace {

/// A number of /proc/self/status, in the unit that it has there: 4 of a line "Threads:   4", 1234 of "VmData:   1234
/// kB". 0 where there is none. https://docs.kernel.org/filesystems/proc.html
std::uint64_t process_status(const std::string& field);

/// The same for memory, which is in KiB there, in bytes.
inline std::uint64_t process_status_bytes(const std::string& field) { return process_status(field) << 10U; }

/// A limit on this process, and what is left of it, in bytes.
struct MemoryLimit {
  std::uint64_t bytes, left;
};

/// On its address space (RLIMIT_AS, `ulimit -v`) and on its data (RLIMIT_DATA, `ulimit -d`).
std::optional<MemoryLimit> address_space_limit();
std::optional<MemoryLimit> data_limit();

/// Bytes that the process may still take: without swapping, and within its limit on data.
std::size_t available_memory();

}  // namespace raytrace

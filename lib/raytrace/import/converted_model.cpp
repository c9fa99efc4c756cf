#include "raytrace/import/converted_model.h"

#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <system_error>

#include "raytrace/import/mesh_file.h"
#include "raytrace/memory/process_status.h"
#include "raytrace/parallel/read_file_at.h"
#include "raytrace/text/message.h"

namespace raytrace {
namespace {

/// A file without a name, in memory.
class Capture {
 public:
  explicit Capture(const char* name) : number_(memfd_create(name, MFD_CLOEXEC)) {
    if (number_ < 0) throw std::bad_alloc();
  }
  ~Capture() { close(number_); }
  Capture(const Capture&) = delete;
  Capture& operator=(const Capture&) = delete;

  int number() const { return number_; }
  std::size_t size() const {
    const off_t end = lseek(number_, 0, SEEK_END);
    return end < 0 ? 0 : static_cast<std::size_t>(end);
  }
  std::size_t read(char* to, std::size_t count) const { return read_file_at(number_, to, count, 0); }

 private:
  int number_;
};

std::string first_line(const Capture& capture) {
  constexpr std::size_t most = 500;
  std::string text(std::min(capture.size(), most), '\0');
  text.resize(capture.read(text.data(), text.size()));
  return printable(text.substr(0, text.find('\n')));
}

/// Runs it to its end. The result: what waitpid() says of it; or, below 0, why it could not be started.
int run(const std::string& program, const std::string& file, std::size_t memory, const Capture& output,
        const Capture& errors) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", 0, 0);
  posix_spawn_file_actions_adddup2(&actions, output.number(), STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, errors.number(), STDERR_FILENO);
  // Not an option, whatever it is called.
  std::string arguments[] = {program, file.starts_with('-') ? "./" + file : file, std::to_string(memory)};
  char* const argv[] = {arguments[0].data(), arguments[1].data(), arguments[2].data(), nullptr};
  pid_t process = 0;
  const int error = posix_spawn(&process, program.c_str(), &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return -error;
  int status = 0;
  while (waitpid(process, &status, 0) < 0) {
    if (errno == ECHILD) return 0;  // whoever started this program has it ignore SIGCHLD: what was written must do
    if (errno != EINTR) return -errno;
  }
  return status;
}

/// Where the module for OpenImageIO is, too.
std::string converter() {
  constexpr const char* name = "raytrace-convert";
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const std::filesystem::path own = program.parent_path().parent_path() / RAYTRACE_MODULE_FOLDER / name;
  return std::filesystem::exists(own, error) ? own : std::filesystem::path(RAYTRACE_INSTALLED_MODULE_FOLDER) / name;
}

}  // namespace

bool is_converted_model(const std::string& file) {
  return !file.ends_with(".gz") && std::find(std::begin(converted_types), std::end(converted_types), mesh_type(file)) !=
                                       std::end(converted_types);
}

std::string converted_types_text() {
  std::string text;
  for (const std::string_view type : converted_types) text += (text.empty() ? "" : ", ") + std::string(type);
  return text;
}

std::optional<ConvertedModel> convert_model(const std::string& file, Diagnostics& diagnostics) {
  return convert_model_by(converter(), file, diagnostics);
}

std::optional<ConvertedModel> convert_model_by(const std::string& program, const std::string& file,
                                               Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& reason) {
    diagnostics.error({}, "cannot be converted to glTF: " + reason);
    return std::nullopt;
  };
  const Capture output("raytrace-model"), errors("raytrace-errors");
  const int status = run(program, file, available_memory() / 2, output, errors);
  if (status == -ENOENT)
    return refuse("there is no raytrace-convert, which is built where Assimp (libassimp-dev) is installed");
  if (status < 0) return refuse(program + ": " + std::generic_category().message(-status));
  if (WIFSIGNALED(status))
    return refuse("Assimp ended by signal " + std::to_string(WTERMSIG(status)) + " (" + strsignal(WTERMSIG(status)) +
                  "); the file may be damaged, or too large");
  if (const std::string reason = first_line(errors); WEXITSTATUS(status) != 0 || output.size() == 0)
    return refuse((reason.empty() ? "Assimp does not say why" : reason) +
                  (mesh_type(file) == ".blend"
                       ? "; only files of Blender before 2.8 can be: in Blender, export as glTF 2.0 (.glb)"
                       : ""));
  ConvertedModel model{LargeArray<char>::unset(output.size() + 1), output.size()};
  if (output.read(model.glb.data(), model.size) != model.size) return refuse("the result cannot be read");
  return model;
}

}  // namespace raytrace

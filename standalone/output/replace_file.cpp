// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/replace_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "model/error.hpp"
#include "output/descriptor.hpp"
#include "output/disk.hpp"

namespace solidem {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw RunError("cannot write " + path + ": " + reason);
}

bool is_device(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void write_text(const std::string& file_name, int flags, const std::string& text,
                const std::string& path) {
  const Descriptor file(::open(file_name.c_str(), O_WRONLY | O_CLOEXEC | flags, usual_mode));
  if (!file.is_open() || !file.write_all(text)) fail(path, std::strerror(errno));
}

/// Waits until a file's bytes are on the disk: a name must not outlive a power cut that its content
/// does not.
void wait_for_disk(const std::string& file_name, const std::string& path) {
  const Descriptor file(::open(file_name.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file.is_open() || ::fsync(file.get()) != 0) fail(path, std::strerror(errno));
}

}  // namespace

void replace_file(const std::string& path,
                  const std::function<void(const std::string& temporary)>& write) {
  insist_on_regular_file(path);
  const fs::path parent = fs::path(path).parent_path();
  std::error_code error;
  if (!parent.empty() && !fs::is_directory(parent, error))
    fail(path, "there is no directory " + parent.string());

  // Links are followed, so that the file they lead to is replaced and not the link.
  const fs::path followed = fs::weakly_canonical(path, error);
  const std::string target = error ? path : followed.string();
  const std::string temporary = target + ".partial";
  try {
    write(temporary);
    wait_for_disk(temporary, path);
    if (std::rename(temporary.c_str(), target.c_str()) != 0) fail(path, std::strerror(errno));
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
}

void replace_text_file(const std::string& path, const std::string& text) {
  if (is_device(path)) return write_text(path, 0, text, path);
  replace_file(path, [&](const std::string& temporary) {
    write_text(temporary, O_CREAT | O_TRUNC, text, path);
  });
}

}  // namespace solidem

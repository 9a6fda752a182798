// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/replace_file.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "model/error.hpp"

namespace solidem {

namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw RunError("cannot write " + path + ": " + reason);
}

}  // namespace

void replace_file(const std::string& path,
                  const std::function<void(const std::string& temporary)>& write) {
  namespace fs = std::filesystem;
  std::error_code error;
  if (fs::is_directory(path, error)) fail(path, "it is a directory");
  const fs::path parent = fs::path(path).parent_path();
  if (!parent.empty() && !fs::is_directory(parent, error))
    fail(path, "there is no directory " + parent.string());

  const std::string temporary = path + ".partial";
  try {
    write(temporary);
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
  fs::rename(temporary, path, error);
  if (error) {
    const std::string reason = error.message();
    fs::remove(temporary, error);
    fail(path, reason);
  }
}

void replace_text_file(const std::string& path, const std::string& text) {
  replace_file(path, [&](const std::string& temporary) {
    std::FILE* file = std::fopen(temporary.c_str(), "wb");
    if (!file) fail(path, std::strerror(errno));
    errno = 0;
    const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
    const int write_error = errno;
    // Buffered text may reach a full disk only here.
    const bool closed = std::fclose(file) == 0;
    if (!written || !closed) fail(path, std::strerror(written ? errno : write_error));
  });
}

}  // namespace solidem

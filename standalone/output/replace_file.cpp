// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/replace_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
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

/// Waits until a new name is on the disk. Some file systems cannot wait for that.
void sync_directory(const fs::path& directory, const std::string& path) {
  const std::string name = directory.empty() ? "." : directory.string();
  const Descriptor opened(::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened.is_open() || (!opened.sync() && errno != EINVAL))
    fail(path, std::string("its folder: ") + std::strerror(errno));
}

/// The new file while it is written. Its name says whose place it will take; a lock says that
/// somebody writes it, so that what a killed program left is known as such.
class NewFile {
 public:
  NewFile(std::string target, const std::string& shown)
      : target_(std::move(target)), name_(target_ + ".partial"), shown_(shown) {
    if (!create()) {
      remove_what_was_left();
      if (!create()) fail(shown_, std::strerror(errno));
    }
    lock(file_);
    struct stat opened {
    }, named{};
    if (::fstat(file_.get(), &opened) != 0 || ::lstat(name_.c_str(), &named) != 0 ||
        opened.st_ino != named.st_ino || opened.st_dev != named.st_dev)
      fail(shown_, "another program is writing it");
    is_ours_ = true;
  }
  ~NewFile() {
    if (is_ours_) ::unlink(name_.c_str());
  }
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  void write(std::string_view bytes) const {
    if (!file_.write_all(bytes)) fail(shown_, std::strerror(errno));
  }

  /// Takes the place of the target. The lock holds until then.
  void put_in_place() {
    if (!file_.sync()) fail(shown_, std::strerror(errno));
    if (std::rename(name_.c_str(), target_.c_str()) != 0) fail(shown_, std::strerror(errno));
    is_ours_ = false;
    if (!file_.close()) fail(shown_, std::strerror(errno));
    sync_directory(fs::path(target_).parent_path(), shown_);
  }

 private:
  /// A link that somebody planted under the name is no new file.
  bool create() {
    file_ = Descriptor(
        ::open(name_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, usual_mode));
    if (file_.is_open()) return true;
    if (errno != EEXIST) fail(shown_, std::strerror(errno));
    return false;
  }

  void remove_what_was_left() const {
    const Descriptor left(::open(name_.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC));
    if (left.is_open()) lock(left);
    if (::unlink(name_.c_str()) != 0 && errno != ENOENT)
      fail(shown_, name_ + " is in the way: " + std::strerror(errno));
  }

  /// Where a file system has no locks, nobody can be told from what was left.
  void lock(const Descriptor& file) const {
    if (::flock(file.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
      fail(shown_, "another program is writing it");
  }

  std::string target_, name_, shown_;
  Descriptor file_;
  bool is_ours_ = false;
};

void write_to_device(const std::string& path, const std::string& text) {
  Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file.is_open() || !file.write_all(text) || !file.close()) fail(path, std::strerror(errno));
}

}  // namespace

void replace_file(const std::string& path, const std::vector<std::string_view>& parts) {
  insist_on_regular_file(path);
  const fs::path parent = fs::path(path).parent_path();
  std::error_code error;
  const fs::file_status folder = fs::status(parent.empty() ? "." : parent, error);
  if (!fs::status_known(folder)) fail(path, "its folder: " + error.message());
  if (!fs::is_directory(folder)) fail(path, "there is no directory " + parent.string());

  // Links are followed, so that the file they lead to is replaced and not the link.
  const fs::path followed = fs::weakly_canonical(path, error);
  if (error) fail(path, error.message());
  NewFile file(followed.string(), path);
  for (const std::string_view part : parts) file.write(part);
  file.put_in_place();
}

void replace_text_file(const std::string& path, const std::string& text) {
  if (is_device(path)) return write_to_device(path, text);
  replace_file(path, {text});
}

}  // namespace solidem

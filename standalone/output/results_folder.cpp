// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/results_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fnmatch.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <random>

#include "model/error.hpp"
#include "output/disk.hpp"

namespace solidem {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> names_in(const fs::path& folder, const std::string& pattern) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    if (::fnmatch(pattern.c_str(), name.c_str(), 0) == 0) names.push_back(name);
  }
  if (error)
    throw RunError(
        fmt::format("cannot look into the folder {}: {}", folder.string(), error.message()));
  std::sort(names.begin(), names.end());
  return names;
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) throw RunError(fmt::format("cannot remove {}: {}", path.string(), error.message()));
}

/// Frames, and the folder unless somebody else's files are in it.
void remove_frames(const fs::path& folder) {
  for (const char* pattern : {"[0-9]*.h5", "[0-9]*.h5.*", "rest.h5", "rest.h5.*"})
    for (const std::string& name : names_in(folder, pattern)) remove_file(folder / name);
  std::error_code not_empty;
  fs::remove(folder, not_empty);
}

Descriptor lock(const std::string& folder) {
  Descriptor opened(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!opened.is_open())
    throw RunError(fmt::format("cannot open the folder {}: {}", folder, std::strerror(errno)));
  // Where a file system has no locks, two runs are for the user to keep apart.
  if (::flock(opened.get(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
    throw RunError(fmt::format(
        "{}: another solidem is writing its results there; wait for it, or choose another folder "
        "with --output",
        folder));
  return opened;
}

}  // namespace

ResultsFolder::ResultsFolder(std::string path, std::vector<std::string> results, Earlier earlier)
    : path_(std::move(path)), results_(std::move(results)), earlier_(earlier) {
  std::error_code error;
  is_new_ = !fs::exists(path_, error);
  prepare_directory(path_);
  lock_ = lock(path_);
  if (earlier_ != Earlier::refuse) return;
  if (const std::vector<std::string> there = found(); !there.empty())
    throw InputError(fmt::format(
        "{}: holds earlier results ({}); expected --overwrite to replace them, or another folder "
        "with --output",
        path_, fmt::join(there, ", ")));
}

ResultsFolder::~ResultsFolder() {
  std::error_code not_empty;
  if (is_new_) fs::remove(path_, not_empty);
}

std::vector<std::string> ResultsFolder::found() const {
  std::vector<std::string> there;
  for (const std::string& pattern : results_)
    for (std::string& name : names_in(path_, pattern)) there.push_back(std::move(name));
  return there;
}

void ResultsFolder::begin() const {
  if (earlier_ != Earlier::replace) return;
  for (const std::string& name : found()) {
    const fs::path result = fs::path(path_) / name;
    std::error_code error;
    if (fs::is_directory(fs::symlink_status(result, error)))
      remove_frames(result);
    else
      remove_file(result);
  }
}

const std::vector<std::string>& run_results() {
  static const std::vector<std::string> names{"checkpoint.h5",   "summary.json",  "history.csv",
                                              "trajectory.xdmf", "trajectory.h5", "trajectory",
                                              "modes.xdmf",      "modes.h5",      "modes"};
  return names;
}

void insist_on_new_file(const std::string& path, bool overwrite) {
  if (!overwrite && is_regular_file(path))
    throw InputError(path +
                     ": is there already; expected --overwrite to replace it, or another name");
}

std::string new_identity() {
  std::random_device source;
  std::string identity;
  for (int word = 0; word < 4; ++word) identity += fmt::format("{:08x}", source());
  return identity;
}

}  // namespace solidem

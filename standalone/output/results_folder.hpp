// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_OUTPUT_RESULTS_FOLDER_HPP
#define SOLIDEM_OUTPUT_RESULTS_FOLDER_HPP

#include <string>
#include <vector>

#include "output/descriptor.hpp"

namespace solidem {

/// What to do with the results of an earlier run.
enum class Earlier {
  refuse,   ///< InputError names them
  replace,  ///< they go when the new results begin
  keep      ///< a run goes on from them
};

/// The folder that a command writes its results into. It has the folder for itself while this
/// lives: another process that wants it is told so.
class ResultsFolder {
 public:
  /// Makes the folder if it is not there. `results`: names of files and of folders with frames,
  /// "*" for any part of a name. Throws InputError, see Earlier, and RunError if the folder cannot
  /// be made or another process writes there.
  ResultsFolder(std::string path, std::vector<std::string> results, Earlier earlier);
  /// A folder that was made and in which nothing was written goes again.
  ~ResultsFolder();
  ResultsFolder(const ResultsFolder&) = delete;
  ResultsFolder& operator=(const ResultsFolder&) = delete;

  /// Takes earlier results away where they are to be replaced, in the order of their names' list:
  /// what others build on stands first. RunError if one cannot be removed.
  void begin() const;

 private:
  std::vector<std::string> found() const;

  std::string path_;
  std::vector<std::string> results_;
  Earlier earlier_;
  bool is_new_;
  Descriptor lock_;
};

/// What `run` and `solve` write: a checkpoint stands for all else, so it goes first.
const std::vector<std::string>& run_results();

/// InputError if a file is there and may not be replaced.
void insist_on_new_file(const std::string& path, bool overwrite);

/// A name that no other run has.
std::string new_identity();

}  // namespace solidem

#endif

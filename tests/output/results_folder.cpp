// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/results_folder.hpp"

#include "conditions.hpp"
#include "model/error.hpp"

namespace solidem::results_folder_test {

void leave_results(const TemporaryDirectory& directory) {
  std::filesystem::create_directory(directory / "trajectory");
  for (const char* name :
       {"checkpoint.h5", "history.csv", "trajectory/000000.h5", "trajectory/rest.h5", "notes.txt"})
    std::ofstream(directory / name) << "earlier";
}

TEST(ResultsFolder, refuses_earlier_results_by_name_and_leaves_them) {
  const TemporaryDirectory directory;
  leave_results(directory);
  const std::vector<std::string> before = directory.names();
  const std::string message = message_of<InputError>(
      [&] { ResultsFolder(directory.string(), run_results(), Earlier::refuse); });
  EXPECT_EQ(message, directory.string() +
                         ": holds earlier results (checkpoint.h5, history.csv, trajectory); "
                         "expected --overwrite to replace them, or another folder with --output");
  EXPECT_EQ(directory.names(), before);
}

TEST(ResultsFolder, takes_away_what_is_replaced_and_nothing_else) {
  const TemporaryDirectory directory;
  leave_results(directory);
  const ResultsFolder folder(directory.string(), run_results(), Earlier::replace);
  EXPECT_EQ(directory.names().size(), 4u) << "only when the new results begin";
  folder.begin();
  EXPECT_EQ(directory.names(), std::vector<std::string>{"notes.txt"});
}

TEST(ResultsFolder, keeps_a_folder_of_frames_in_which_others_have_files) {
  const TemporaryDirectory directory;
  leave_results(directory);
  std::ofstream(directory / "trajectory/mine.txt") << "mine";
  ResultsFolder(directory.string(), run_results(), Earlier::replace).begin();
  EXPECT_EQ(content_of(directory / "trajectory/mine.txt"), "mine");
  EXPECT_FALSE(std::filesystem::exists(directory / "trajectory/000000.h5"));
}

TEST(ResultsFolder, keeps_what_a_run_goes_on_from) {
  const TemporaryDirectory directory;
  leave_results(directory);
  ResultsFolder(directory.string(), run_results(), Earlier::keep).begin();
  EXPECT_EQ(directory.names().size(), 4u);
}

TEST(ResultsFolder, is_for_one_at_a_time) {
  const TemporaryDirectory directory;
  const auto take = [&] { ResultsFolder(directory.string(), run_results(), Earlier::keep); };
  {
    const ResultsFolder first(directory.string(), run_results(), Earlier::keep);
    EXPECT_TRUE(contains(message_of<RunError>(take), "another solidem is writing"));
  }
  EXPECT_EQ(message_of<RunError>(take), "");
}

TEST(ResultsFolder, that_was_made_for_nothing_goes_again) {
  const TemporaryDirectory directory;
  ResultsFolder(directory / "new", run_results(), Earlier::refuse);
  EXPECT_TRUE(directory.names().empty());
  {
    const ResultsFolder folder(directory / "new", run_results(), Earlier::refuse);
    std::ofstream(directory / "new/history.csv") << "row";
  }
  EXPECT_EQ(directory.names(), std::vector<std::string>{"new"});
}

TEST(Identity, is_of_one_run_only) {
  EXPECT_NE(new_identity(), new_identity());
  EXPECT_EQ(new_identity().size(), 32u);
}

}  // namespace solidem::results_folder_test

// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/replace_file.hpp"

#include <fcntl.h>
#include <sys/file.h>

#include "conditions.hpp"
#include "model/error.hpp"
#include "output/disk.hpp"
#include "output/results_folder.hpp"

namespace solidem::replace_file_test {

TEST(ReplaceFile, holds_the_new_text_and_nothing_else_is_left) {
  const TemporaryDirectory directory;
  replace_text_file(directory / "a.txt", "first");
  replace_text_file(directory / "a.txt", "second");
  EXPECT_EQ(content_of(directory / "a.txt"), "second");
  EXPECT_EQ(directory.names(), std::vector<std::string>{"a.txt"});
}

TEST(ReplaceFile, keeps_the_old_text_when_the_new_does_not_fit) {
  const TemporaryDirectory directory;
  const std::string path = directory / "a.txt";
  replace_text_file(path, "good");
  std::string message;
  {
    const FileSizeLimit limit(1000);
    message = message_of<RunError>([&] { replace_text_file(path, std::string(5000, 'x')); });
  }
  EXPECT_TRUE(contains(message, path)) << message;
  EXPECT_TRUE(contains(message, "File too large")) << message;
  EXPECT_EQ(content_of(path), "good");
  EXPECT_EQ(directory.names(), std::vector<std::string>{"a.txt"});
}

TEST(ReplaceFile, follows_a_link_and_keeps_it) {
  const TemporaryDirectory directory;
  replace_text_file(directory / "real.txt", "old");
  std::filesystem::create_symlink("real.txt", directory / "link.txt");
  replace_text_file(directory / "link.txt", "new");
  EXPECT_TRUE(std::filesystem::is_symlink(directory / "link.txt"));
  EXPECT_EQ(content_of(directory / "real.txt"), "new");
}

TEST(ReplaceFile, writes_to_a_device_directly_and_tells_that_it_is_full) {
  const std::string message = message_of<RunError>([] { replace_text_file("/dev/full", "x"); });
  EXPECT_EQ(message, "cannot write /dev/full: No space left on device");
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
}

TEST(ReplaceFile, names_a_directory_that_is_missing_or_in_the_way) {
  const TemporaryDirectory directory;
  const std::string missing = directory / "no/a.txt";
  EXPECT_EQ(message_of<RunError>([&] { replace_text_file(missing, "x"); }),
            "cannot write " + missing + ": there is no directory " + (directory / "no"));
  EXPECT_EQ(message_of<RunError>([&] { replace_text_file(directory.string(), "x"); }),
            "cannot write " + directory.string() + ": it is a directory");
}

TEST(ReplaceFile, tells_that_permission_is_missing) {
  const TemporaryDirectory directory;
  const std::string path = directory / "a.txt";
  replace_text_file(path, "good");
  std::filesystem::permissions(directory.string(), std::filesystem::perms(0555));
  std::string message;
  {
    const OrdinaryUser user;
    message = message_of<RunError>([&] { replace_text_file(path, "other"); });
  }
  std::filesystem::permissions(directory.string(), std::filesystem::perms(0755));
  EXPECT_EQ(message, "cannot write " + path + ": Permission denied");
  EXPECT_EQ(content_of(path), "good");
}

TEST(Disk, what_cannot_be_looked_at_is_not_what_is_not_there) {
  const TemporaryDirectory directory;
  replace_text_file(directory / "file", "x");
  EXPECT_TRUE(is_there(directory / "file") && is_regular_file(directory / "file"));
  EXPECT_TRUE(is_there(directory.string()) && is_folder(directory.string()));
  EXPECT_FALSE(is_there(directory / "none"));
  const std::string circle = directory / "circle";
  std::filesystem::create_symlink("circle", circle);
  const std::string why = " cannot be looked at (Too many levels of symbolic links)";
  EXPECT_EQ(message_of<InputError>([&] { is_there(circle); }), circle + ":" + why);
  EXPECT_EQ(message_of<InputError>([&] { insist_on_new_file(circle, false); }), circle + ":" + why);
  EXPECT_EQ(message_of<RunError>([&] { replace_text_file(circle, "y"); }),
            "cannot write " + circle + ": Too many levels of symbolic links");
}

TEST(PrepareDirectory, makes_it_with_those_above_and_leaves_it_empty) {
  const TemporaryDirectory directory;
  prepare_directory(directory / "a/b");
  EXPECT_TRUE(std::filesystem::is_empty(directory / "a/b"));
}

TEST(PrepareDirectory, refuses_before_a_run_what_would_fail_after_it) {
  const TemporaryDirectory directory;
  replace_text_file(directory / "file", "x");
  EXPECT_TRUE(contains(message_of<RunError>([&] { prepare_directory(directory / "file"); }),
                       "cannot make the directory " + (directory / "file")));
  std::filesystem::create_directory(directory / "closed");
  std::filesystem::permissions(directory / "closed", std::filesystem::perms(0555));
  std::filesystem::permissions(directory.string(), std::filesystem::perms(0755));
  const OrdinaryUser user;
  EXPECT_EQ(message_of<RunError>([&] { prepare_directory(directory / "closed"); }),
            "cannot write into the directory " + (directory / "closed") + ": Permission denied");
}

TEST(ReplaceFile, does_not_follow_a_link_that_was_planted_where_it_writes) {
  const TemporaryDirectory directory;
  replace_text_file(directory / "victim", "precious");
  std::filesystem::create_symlink("victim", directory / "a.txt.partial");
  replace_text_file(directory / "a.txt", "new");
  EXPECT_EQ(content_of(directory / "victim"), "precious");
  EXPECT_EQ(content_of(directory / "a.txt"), "new");
  EXPECT_EQ(directory.names(), (std::vector<std::string>{"a.txt", "victim"}));
}

TEST(ReplaceFile, tells_a_file_that_was_left_from_one_that_another_program_writes) {
  const TemporaryDirectory directory;
  const std::string path = directory / "a.txt";
  {
    std::ofstream(path + ".partial") << "half";
    const int other = ::open((path + ".partial").c_str(), O_WRONLY);
    ASSERT_EQ(::flock(other, LOCK_EX | LOCK_NB), 0);
    EXPECT_EQ(message_of<RunError>([&] { replace_text_file(path, "new"); }),
              "cannot write " + path + ": another program is writing it");
    EXPECT_EQ(content_of(path + ".partial"), "half");
    ::close(other);
  }
  replace_text_file(path, "new");  // nobody writes it now
  EXPECT_EQ(content_of(path), "new");
  EXPECT_EQ(directory.names(), std::vector<std::string>{"a.txt"});
}

}  // namespace solidem::replace_file_test

// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/replace_file.hpp"

#include "conditions.hpp"
#include "model/error.hpp"
#include "output/disk.hpp"

namespace solidem {
namespace {

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

TEST(ReserveSpace, leaves_size_and_content_and_refuses_what_does_not_fit) {
  const TemporaryDirectory directory;
  const std::string path = directory / "a";
  replace_text_file(path, "abc");
  reserve_space(path, 100000, path, "");
  EXPECT_EQ(content_of(path), "abc");
  const int outcome = in_own_process([&] {
    const std::string disk = directory / "disk";
    std::filesystem::create_directory(disk);
    if (!mount_small_disk(disk, 128)) return 77;
    reserve_space(disk + "/a", 64 * 1024, "a", "");
    const std::string message =
        message_of<RunError>([&] { reserve_space(disk + "/b", 96 * 1024, "b", "a is safe"); });
    return message == "cannot write b: No space left on device; a is safe" ? 0 : 1;
  });
  if (outcome == 77) GTEST_SKIP() << "this system does not let us mount a small disk";
  EXPECT_EQ(outcome, 0);
}

}  // namespace
}  // namespace solidem

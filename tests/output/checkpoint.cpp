// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/checkpoint.hpp"

#include <cmath>
#include <csignal>
#include <limits>

#include "conditions.hpp"
#include "model/error.hpp"

namespace solidem::checkpoint_test {

const CheckpointHeader header{123456789012, 1.0 / 3, "beams 5f3a", "run 7", {99, "abc"}, 3};
const std::vector<double> position{0.1, -0.0, std::numeric_limits<double>::denorm_min(), 1e300};
const std::vector<std::int32_t> broken{0, -7, 2147483647};
const std::vector<std::int64_t> counts{-1, std::int64_t{1} << 62};
const std::vector<std::uint8_t> bytes{0, 255, 7};

void write_good(const std::string& path, const CheckpointHeader& head = header) {
  write_checkpoint(path, head, [](const CheckpointContents& contents) {
    contents.write("position", position);
    contents.write("broken", broken);
    contents.write("counts", counts);
    contents.write("bytes", bytes);
    contents.write("empty", std::vector<double>{});
    contents.write("energy", 0.1);
    contents.write("frames", (std::int64_t{1} << 60) + 1);
  });
}

TEST(Checkpoint, gives_back_every_bit) {
  const TemporaryDirectory directory;
  write_good(directory / "c.h5");
  const CheckpointReader reader(directory / "c.h5", header.fingerprint);
  EXPECT_EQ(reader.header().step, header.step);
  EXPECT_EQ(reader.header().time, header.time);
  EXPECT_EQ(reader.header().run, header.run);
  EXPECT_EQ(reader.header().history.bytes, header.history.bytes);
  EXPECT_EQ(reader.header().history.digest, header.history.digest);
  EXPECT_EQ(reader.header().frames, header.frames);
  EXPECT_EQ(reader.read<double>("position", 4), position);
  EXPECT_TRUE(std::signbit(reader.read<double>("position")[1]));
  EXPECT_EQ(reader.read<std::int32_t>("broken"), broken);
  EXPECT_EQ(reader.read<std::int64_t>("counts"), counts);
  EXPECT_EQ(reader.read<std::uint8_t>("bytes"), bytes);
  EXPECT_TRUE(reader.read<double>("empty", 0).empty());
  EXPECT_EQ(reader.read_number("energy"), 0.1);
  EXPECT_EQ(reader.read_integer("frames"), (std::int64_t{1} << 60) + 1);
  EXPECT_TRUE(reader.has("position"));
  EXPECT_TRUE(reader.has("energy"));
  EXPECT_FALSE(reader.has("velocity"));
}

TEST(Checkpoint, names_an_array_that_is_missing_or_of_another_size) {
  const TemporaryDirectory directory;
  write_good(directory / "c.h5");
  const CheckpointReader reader(directory / "c.h5", header.fingerprint);
  EXPECT_TRUE(contains(message_of<InputError>([&] { reader.read<double>("velocity"); }),
                       "velocity: missing"));
  const std::string message = message_of<InputError>([&] { reader.read<double>("position", 5); });
  EXPECT_TRUE(contains(message, "(4)") && contains(message, "(5)")) << message;
}

TEST(Checkpoint, of_another_scene_or_version_is_refused) {
  const TemporaryDirectory directory;
  const std::string path = directory / "c.h5";
  write_good(path);
  const std::string message = message_of<InputError>([&] { CheckpointReader(path, "beams 0000"); });
  EXPECT_TRUE(contains(message, path) && contains(message, "another scene") &&
              contains(message, "5f3a") && contains(message, "0000"))
      << message;
  replace_hdf5_file(
      path,
      [](const Hdf5File& file) {
        file.set_attribute("format", "solidem checkpoint");
        file.set_attribute("version", 1);
      },
      Seal::present);
  EXPECT_EQ(message_of<InputError>([&] { CheckpointReader(path, header.fingerprint); }),
            path + ": is a checkpoint of version 1, expected version 2");
}

bool is_refused(const std::string& path) {
  return !message_of<InputError>([&] { CheckpointReader(path, header.fingerprint); }).empty();
}

TEST(Checkpoint, that_is_damaged_is_refused_wherever_it_was_cut) {
  const TemporaryDirectory directory;
  const std::string path = directory / "c.h5";
  write_good(path);
  const std::string whole = content_of(path);
  for (std::size_t size = 0; size < whole.size(); size += 97) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, size);
    EXPECT_TRUE(is_refused(path)) << size << " of " << whole.size() << " bytes";
  }
}

TEST(Checkpoint, that_is_damaged_is_refused_whichever_bit_is_wrong) {
  const TemporaryDirectory directory;
  const std::string path = directory / "c.h5";
  write_good(path);
  const std::string whole = content_of(path);
  for (std::size_t place = 0; place < whole.size(); place += 7) {
    std::string flipped = whole;
    flipped[place] = static_cast<char>(flipped[place] ^ (1 << (place % 8)));
    std::ofstream(path, std::ios::binary) << flipped;
    EXPECT_TRUE(is_refused(path)) << "byte " << place << " of " << whole.size();
  }
}

TEST(Checkpoint, that_is_none_is_refused) {
  const TemporaryDirectory directory;
  const std::string path = directory / "c.h5";
  EXPECT_EQ(message_of<InputError>([&] { CheckpointReader(path, ""); }),
            path + ": there is no checkpoint to resume from");
  replace_hdf5_file(
      path, [](const Hdf5File& file) { file.set_attribute("format", "solidem specimen"); },
      Seal::present);
  EXPECT_EQ(message_of<InputError>([&] { CheckpointReader(path, ""); }),
            path + ": is no checkpoint of solidem");
}

void write_large(const std::string& path) {
  write_checkpoint(path, {7, 0, "large", ""}, [](const CheckpointContents& contents) {
    for (int k = 0; k < 20; ++k)
      contents.write("array" + std::to_string(k), std::vector<double>(10000, k));
  });
}

TEST(Checkpoint, that_does_not_fit_leaves_the_earlier_one) {
  const TemporaryDirectory directory;
  const std::string path = directory / "c.h5";
  write_good(path);
  const std::string before = content_of(path);
  std::string message;
  {
    const FileSizeLimit limit(500000);
    message = message_of<RunError>([&] { write_large(path); });
  }
  EXPECT_EQ(message, "no checkpoint of step 7: cannot write " + path +
                         ": File too large; the checkpoint from before is unchanged");
  EXPECT_EQ(content_of(path), before);
  EXPECT_EQ(directory.names(), std::vector<std::string>{"c.h5"});
}

TEST(Checkpoint, on_a_full_disk_leaves_the_earlier_one) {
  const TemporaryDirectory directory;
  const int outcome = in_own_process([&] {
    if (!mount_small_disk(directory.string(), 600)) return 77;
    const std::string path = directory / "c.h5";
    write_good(path);
    const std::string message = message_of<RunError>([&] { write_large(path); });
    if (!contains(message, "No space left on device")) return 1;
    if (directory.names() != std::vector<std::string>{"c.h5"}) return 2;
    return CheckpointReader(path, header.fingerprint).read<double>("position") == position ? 0 : 3;
  });
  if (outcome == 77) GTEST_SKIP() << "this system does not let us mount a small disk";
  EXPECT_EQ(outcome, 0);
}

TEST(Checkpoint, is_the_earlier_one_if_the_run_is_killed_while_writing) {
  const TemporaryDirectory directory;
  const std::string path = directory / "c.h5";
  write_good(path);
  const int outcome = in_own_process([&] {
    write_checkpoint(path, {7, 0, "other", ""}, [](const CheckpointContents& contents) {
      contents.write("position", std::vector<double>(100000, 1.0));
      ::raise(SIGKILL);
    });
    return 0;
  });
  ASSERT_EQ(outcome, -SIGKILL);
  EXPECT_EQ(CheckpointReader(path, header.fingerprint).read<double>("position"), position);
  write_good(path, {8, 0, "later", ""});  // what the killed run left does not stand in the way
  EXPECT_EQ(CheckpointReader(path, "later").header().step, 8);
  EXPECT_EQ(directory.names(), std::vector<std::string>{"c.h5"});
}

}  // namespace solidem::checkpoint_test

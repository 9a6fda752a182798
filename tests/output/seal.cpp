// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/seal.hpp"

#include "conditions.hpp"
#include "model/error.hpp"
#include "output/digest.hpp"
#include "output/hdf5.hpp"

namespace solidem::seal_test {

TEST(Digest, is_that_of_the_standard) {
  // FIPS 180-4, examples of SHA-256.
  EXPECT_EQ(digest_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(digest_of(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST(Digest, of_parts_is_that_of_the_whole_and_may_be_asked_for_at_any_time) {
  Digest digest;
  digest.add("a");
  EXPECT_EQ(digest.hexadecimal(), digest_of("a"));
  digest.add("bc");
  EXPECT_EQ(digest.hexadecimal(), digest_of("abc"));
}

TEST(Seal, holds_until_a_bit_changes_or_a_byte_is_lost) {
  const TemporaryDirectory directory;
  const std::string path = directory / "file";
  const std::string content = "what was written";
  const std::string sealed = content + seal_of(content);
  const auto state = [&](const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
    return check_seal(path);
  };
  EXPECT_EQ(state(sealed), SealState::holds);
  EXPECT_EQ(state(content), SealState::absent);
  EXPECT_EQ(state(""), SealState::absent);
  for (std::size_t place = 0; place < sealed.size(); ++place) {
    std::string changed = sealed;
    changed[place] = static_cast<char>(changed[place] ^ 4);
    EXPECT_NE(state(changed), SealState::holds) << place;
    EXPECT_NE(state(sealed.substr(0, place)), SealState::holds) << place;
    EXPECT_NE(state(sealed.substr(0, place) + 'x' + sealed.substr(place)), SealState::holds);
  }
  EXPECT_NE(message_of<RunError>([&] { check_seal(directory / "none"); }), "");
}

TEST(Seal, stands_behind_an_hdf5_file_that_reads_as_any_other) {
  const TemporaryDirectory directory;
  const std::string path = directory / "a.h5";
  const std::vector<double> values(1000, 0.1);
  const auto fill = [&](const Hdf5File& file) { file.write("group/values", values); };
  replace_hdf5_file(path, fill, Seal::present);
  EXPECT_EQ(Hdf5File::open(path, Seal::present).read<double>("group/values"), values);
  replace_hdf5_file(path, fill);
  EXPECT_EQ(Hdf5File::open(path).read<double>("group/values"), values);
  EXPECT_TRUE(contains(message_of<InputError>([&] { Hdf5File::open(path, Seal::present); }),
                       "has no seal"));
}

TEST(Hdf5, links_lead_from_one_file_to_another_wherever_both_are) {
  const TemporaryDirectory directory;
  std::filesystem::create_directory(directory / "parts");
  replace_hdf5_file(directory / "parts/one.h5", [](const Hdf5File& file) {
    file.write("x", std::vector<double>{1, 2});
  });
  replace_hdf5_file(directory / "all.h5",
                    [](const Hdf5File& file) { file.link("frames/0", "parts/one.h5", "/"); });
  const Hdf5File all = Hdf5File::open(directory / "all.h5");
  EXPECT_TRUE(all.has("frames/0/x"));
  EXPECT_EQ(all.group("frames/0").read<double>("x"), (std::vector<double>{1, 2}));
}

}  // namespace solidem::seal_test

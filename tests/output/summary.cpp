// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "conditions.hpp"
#include "model/error.hpp"

namespace solidem::summary_test {

TEST(Summary, is_json_in_the_order_given) {
  const TemporaryDirectory directory;
  const nlohmann::ordered_json summary{{"steps", 10}, {"energy", 1.0 / 3}, {"drift", std::nan("")}};
  write_summary(directory / "summary.json", summary);
  const std::string text = content_of(directory / "summary.json");
  EXPECT_EQ(nlohmann::json::parse(text).at("energy").get<double>(), 1.0 / 3);
  EXPECT_TRUE(nlohmann::json::parse(text).at("drift").is_null());
  EXPECT_LT(text.find("steps"), text.find("energy"));
  EXPECT_EQ(text.back(), '\n');
}

TEST(Summary, that_cannot_be_written_leaves_the_earlier_one) {
  const TemporaryDirectory directory;
  const std::string path = directory / "summary.json";
  write_summary(path, {{"steps", 1}});
  const std::string before = content_of(path);
  {
    const FileSizeLimit limit(10);
    EXPECT_EQ(message_of<RunError>([&] {
                write_summary(path, {{"steps", 2}});
              }),
              "cannot write " + path + ": File too large");
  }
  EXPECT_EQ(content_of(path), before);
}

TEST(Summary, survives_a_name_that_is_not_utf_8) {
  const TemporaryDirectory directory;
  write_summary(directory / "s.json", {{"scene", "caf\xe9.toml"}});
  EXPECT_TRUE(nlohmann::json::accept(content_of(directory / "s.json")));
}

TEST(Hardware, knows_this_machine) {
  const Hardware machine = hardware();
  EXPECT_NE(machine.processor, "");
  EXPECT_GE(machine.processors, 1);
  EXPECT_GT(machine.memory_bytes, std::uint64_t{1} << 26);
  EXPECT_EQ(to_json(machine).at("processors"), machine.processors);
}

TEST(PeakMemory, grows_with_what_is_used) {
  const std::uint64_t before = peak_memory_bytes();
  constexpr std::size_t size = std::size_t{64} << 20;
  // Written through a volatile pointer, or a compiler may leave the memory out altogether.
  std::vector<char> used(size);
  volatile char* memory = used.data();
  for (std::size_t k = 0; k < size; k += 4096) memory[k] = 'x';
  EXPECT_GE(peak_memory_bytes(), before + size / 2);
}

TEST(Version, has_three_numbers) {
  const std::string text = version();
  EXPECT_EQ(std::count(text.begin(), text.end(), '.'), 2) << text;
}

}  // namespace solidem::summary_test

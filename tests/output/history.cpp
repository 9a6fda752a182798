// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/history.hpp"

#include <cmath>
#include <limits>

#include "conditions.hpp"
#include "model/error.hpp"

namespace solidem::history_test {

const std::vector<std::string> columns{"kinetic_energy", "grip.left.force_x"};

TEST(History, names_its_columns_and_keeps_every_bit) {
  const TemporaryDirectory directory;
  const std::string path = directory / "history.csv";
  const std::vector<double> values{0.1, -1.0 / 3.0};
  HistoryWriter history(path, columns);
  history.write_row(12345678901, 1e-9 / 3, values);
  history.write_row(12345678902, 5e-324, {std::numeric_limits<double>::max(), std::nan("")});

  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "step,time,kinetic_energy,grip.left.force_x");
  std::int64_t step = 0;
  char comma = 0;
  double time = 0, first = 0, second = 0;
  file >> step >> comma >> time >> comma >> first >> comma >> second;
  EXPECT_EQ(step, 12345678901);
  EXPECT_EQ(time, 1e-9 / 3);
  EXPECT_EQ(first, values[0]);
  EXPECT_EQ(second, values[1]);
}

TEST(History, has_each_row_on_file_when_it_was_written) {
  const TemporaryDirectory directory;
  HistoryWriter history(directory / "history.csv", {});
  history.write_row(0, 0, {});
  EXPECT_EQ(content_of(directory / "history.csv"), "step,time\n0,0\n");
  history.write_row(10, 0.5, {});
  EXPECT_EQ(content_of(directory / "history.csv"), "step,time\n0,0\n10,0.5\n");
  EXPECT_EQ(history.last_step(), 10);
}

TEST(History, resumed_is_the_same_as_one_that_never_stopped) {
  const TemporaryDirectory directory;
  const auto run = [](HistoryWriter& history, int from, int to) {
    for (int step = from; step <= to; step += 5)
      history.write_row(step, step * 1e-3, {std::sin(step), std::cos(step)});
  };
  HistoryWriter whole(directory / "whole.csv", columns);
  run(whole, 0, 100);
  HistoryMark checkpoint;
  {
    HistoryWriter stopped(directory / "history.csv", columns);
    run(stopped, 0, 50);
    checkpoint = stopped.mark();
    run(stopped, 55, 70);
  }
  std::ofstream(directory / "history.csv", std::ios::app) << "75,0.07";  // killed within a row
  HistoryWriter resumed = HistoryWriter::resume(directory / "history.csv", columns, checkpoint);
  EXPECT_EQ(resumed.last_step(), 50);
  EXPECT_EQ(resumed.mark().digest, checkpoint.digest);
  run(resumed, 55, 100);
  EXPECT_EQ(resumed.mark().digest, whole.mark().digest);
  EXPECT_EQ(content_of(directory / "history.csv"), content_of(directory / "whole.csv"));
}

TEST(History, does_not_go_on_with_another_file) {
  const TemporaryDirectory directory;
  const std::string path = directory / "history.csv";
  EXPECT_EQ(message_of<InputError>([&] { HistoryWriter::resume(path, columns, {}); }),
            "cannot resume the history " + path + ": no such file");
  HistoryWriter(path, {"kinetic_energy"}).write_row(0, 0, {1});
  const std::string before = content_of(path);
  const std::string message =
      message_of<InputError>([&] { HistoryWriter::resume(path, columns, {}); });
  EXPECT_TRUE(contains(message, "\"step,time,kinetic_energy\"")) << message;
  EXPECT_TRUE(contains(message, "\"step,time,kinetic_energy,grip.left.force_x\"")) << message;
  EXPECT_EQ(content_of(path), before);
}

TEST(History, notices_rows_that_are_missing_or_changed) {
  const TemporaryDirectory directory;
  const std::string path = directory / "history.csv";
  HistoryMark checkpoint;
  {
    HistoryWriter history(path, columns);
    for (int step = 0; step < 10; ++step) history.write_row(step, 0.25 * step, {1, 2});
    checkpoint = history.mark();
  }
  const std::string whole = content_of(path);
  EXPECT_EQ(HistoryWriter::resume(path, columns, checkpoint).last_step(), 9);
  const auto refuses = [&](const std::string& content) {
    std::ofstream(path, std::ios::binary) << content;
    const std::string message =
        message_of<InputError>([&] { HistoryWriter::resume(path, columns, checkpoint); });
    return contains(message, "rows before the checkpoint") && content_of(path) == content;
  };
  const std::size_t row = whole.find("\n3,") + 1;
  EXPECT_TRUE(refuses(whole.substr(0, row)));  // the last ones
  EXPECT_TRUE(refuses(whole.substr(0, row) + whole.substr(whole.find('\n', row) + 1)));  // one
  std::string changed = whole;
  changed[row] = '4';
  EXPECT_TRUE(refuses(changed));
}

TEST(History, refuses_names_that_would_break_the_table) {
  const TemporaryDirectory directory;
  for (const std::string name : {"", "a,b", "a\"b", "a\nb", "time"})
    EXPECT_NE(message_of<InputError>([&] {
                HistoryWriter(directory / "h.csv", {"x", name});
              }),
              "")
        << name;
  EXPECT_EQ(directory.names().size(), 0u);
}

TEST(History, on_a_full_disk_ends_with_its_last_whole_row) {
  const TemporaryDirectory directory;
  const std::string path = directory / "history.csv";
  HistoryWriter history(path, columns);
  std::string message;
  std::int64_t step = 0;
  {
    const FileSizeLimit limit(1000);
    message = message_of<RunError>([&] {
      for (; step < 1000; ++step) history.write_row(step, 1.0 / 3, {1.0 / 7, 1.0 / 11});
    });
  }
  ASSERT_LT(step, 1000);
  EXPECT_TRUE(contains(message, path)) << message;
  EXPECT_TRUE(contains(message, "File too large")) << message;
  EXPECT_TRUE(contains(message, "the rows up to step " + std::to_string(step - 1) + " are safe"));
  const std::string content = content_of(path);
  EXPECT_EQ(content.back(), '\n');
  EXPECT_EQ(std::count(content.begin(), content.end(), '\n'), step + 1);
  history.write_row(step, 0, {0, 0});  // there is room again: the table goes on
  EXPECT_EQ(content_of(path), content + std::to_string(step) + ",0,0,0\n");
}

TEST(History, tells_that_the_device_is_full) {
  EXPECT_EQ(message_of<RunError>([] { HistoryWriter("/dev/full", columns); }),
            "cannot write /dev/full: No space left on device");
}

}  // namespace solidem::history_test

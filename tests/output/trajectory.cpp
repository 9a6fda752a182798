// SPDX-License-Identifier: GPL-2.0-or-later
#include "output/trajectory.hpp"

#include <csignal>
#include <cstdlib>

#include "conditions.hpp"
#include "model/error.hpp"

namespace solidem::trajectory_test {

/// A chain of elements along x, one bond between each two.
Specimen chain(int elements) {
  Specimen specimen;
  for (int i = 0; i < elements; ++i) {
    specimen.position.push_back({2.0 * i, 0.1 * i, 0});
    specimen.radius.push_back(1 + 0.01 * i);
    if (i > 0) specimen.bonds.push_back({i - 1, i});
  }
  return specimen;
}

/// What a run could write at a step: positions and temperatures that depend on it.
struct State {
  std::vector<Vector> position;
  std::vector<double> temperature;
  State(const Specimen& specimen, std::int64_t step) : position(specimen.position) {
    for (Vector& place : position) place.x += 0.001 * static_cast<double>(step);
    for (std::size_t i = 0; i < position.size(); ++i)
      temperature.push_back(300 + static_cast<double>(step) / (1.0 + static_cast<double>(i)));
  }
  std::vector<Field> fields() const {
    return {{"position", 3, &position.front().x}, {"temperature", 1, temperature.data()}};
  }
};

void write(TrajectoryWriter& trajectory, const Specimen& specimen, std::int64_t step) {
  trajectory.write_frame(step, 1e-6 * static_cast<double>(step), State(specimen, step).fields());
}

void expect_frame(const Hdf5Group& frame, const Specimen& specimen, std::int64_t step) {
  const State state(specimen, step);
  EXPECT_EQ(frame.integer_attribute("step"), step);
  EXPECT_EQ(frame.number_attribute("time"), 1e-6 * static_cast<double>(step));
  EXPECT_EQ(frame.read<double>("temperature", specimen.size()), state.temperature);
  const auto position = frame.read<double>("position", specimen.size(), 3);
  for (std::size_t i = 0; i < specimen.size(); ++i) {
    EXPECT_EQ(position[3 * i], state.position[i].x);
    EXPECT_EQ(position[3 * i + 1], state.position[i].y);
    EXPECT_EQ(position[3 * i + 2], state.position[i].z);
  }
}

/// Reads the index with other programs' libraries; true if it is right and has so many frames.
bool index_is_right(const std::string& xdmf, int frames,
                    const std::string& errors = "/dev/stderr") {
  const std::string command = "/usr/bin/python3 " SOLIDEM_SOURCE_DIR
                              "/tests/output/check_xdmf.py " +
                              xdmf + ' ' + std::to_string(frames) + " > /dev/null 2>> " + errors;
  return std::system(command.c_str()) == 0;
}

TEST(Trajectory, gives_back_what_was_written) {
  const TemporaryDirectory directory;
  const Specimen specimen = chain(50);
  {
    TrajectoryWriter trajectory(directory / "t.h5", specimen);
    for (const int step : {0, 100, 250}) write(trajectory, specimen, step);
  }
  const Hdf5File file = Hdf5File::open(directory / "t.h5");
  EXPECT_EQ(file.group("frames").names(), (std::vector<std::string>{"000000", "000001", "000002"}));
  expect_frame(file.group("frames/000000"), specimen, 0);
  expect_frame(file.group("frames/000001"), specimen, 100);
  expect_frame(file.group("frames/000002"), specimen, 250);
  EXPECT_EQ(file.read<double>("elements/radius"), specimen.radius);
  const auto pairs = file.read<std::int32_t>("bonds/pairs", 49, 2);
  EXPECT_EQ(pairs[2], 1);
  EXPECT_EQ(pairs[3], 2);
}

TEST(Trajectory, has_an_index_that_other_programs_read_after_each_frame) {
  const TemporaryDirectory directory;
  const Specimen specimen = chain(20);
  TrajectoryWriter trajectory(directory / "t.h5", specimen);
  EXPECT_TRUE(index_is_right(directory / "t.xdmf", 0));
  for (int frame = 0; frame < 3; ++frame) {
    write(trajectory, specimen, 10 * frame);
    // The writer still has the file open: another process reads it all the same.
    EXPECT_TRUE(index_is_right(directory / "t.xdmf", frame + 1)) << frame;
  }
  EXPECT_FALSE(index_is_right(directory / "t.xdmf", 7, "/dev/null"))
      << "the check must be able to fail";
}

TEST(Trajectory, index_of_a_body_without_bonds_or_with_odd_names_is_right_too) {
  const TemporaryDirectory directory;
  Specimen specimen = chain(5);
  specimen.bonds.clear();
  const std::vector<double> values(45, 1.5);
  TrajectoryWriter trajectory(directory / "a&b.h5", specimen);
  trajectory.write_frame(0, 0, {{"a < \"b\"", 1, values.data()}, {"stress", 9, values.data()}});
  EXPECT_TRUE(index_is_right("'" + (directory / "a&b.xdmf") + "'", 1));
  EXPECT_TRUE(contains(content_of(directory / "a&b.xdmf"), "Polyvertex"));
}

TEST(Trajectory, draws_no_lines_across_a_periodic_body) {
  const TemporaryDirectory directory;
  Specimen specimen = chain(5);
  specimen.domain.periodic[0] = true;
  TrajectoryWriter trajectory(directory / "t.h5", specimen);
  write(trajectory, specimen, 0);
  EXPECT_FALSE(contains(content_of(directory / "t.xdmf"), "Polyline"));
  EXPECT_TRUE(Hdf5File::open(directory / "t.h5").has("bonds/pairs"));
}

TEST(Trajectory, is_readable_after_the_run_was_killed) {
  const TemporaryDirectory directory;
  const Specimen specimen = chain(1000);
  const int outcome = in_own_process([&] {
    TrajectoryWriter trajectory(directory / "t.h5", specimen);
    for (int frame = 0; frame < 4; ++frame) write(trajectory, specimen, 10 * frame);
    ::raise(SIGKILL);
    return 0;
  });
  ASSERT_EQ(outcome, -SIGKILL);
  EXPECT_TRUE(index_is_right(directory / "t.xdmf", 4));
  const Hdf5File file = Hdf5File::open(directory / "t.h5");
  for (int frame = 0; frame < 4; ++frame)
    expect_frame(file.group("frames/00000" + std::to_string(frame)), specimen, 10 * frame);
}

TEST(Trajectory, resumed_goes_on_after_the_step_it_was_resumed_at) {
  const TemporaryDirectory directory;
  const Specimen specimen = chain(30);
  {
    TrajectoryWriter trajectory(directory / "t.h5", specimen);
    for (int step = 0; step <= 50; step += 10) write(trajectory, specimen, step);
  }
  TrajectoryWriter trajectory = TrajectoryWriter::resume(directory / "t.h5", specimen, 30);
  EXPECT_EQ(trajectory.frames(), 4u);
  EXPECT_TRUE(index_is_right(directory / "t.xdmf", 4));
  for (const int step : {45, 60}) write(trajectory, specimen, step);
  const Hdf5File file = Hdf5File::open(directory / "t.h5");
  const std::vector<int> steps{0, 10, 20, 30, 45, 60};
  const std::vector<std::string> names = file.group("frames").names();
  ASSERT_EQ(names.size(), steps.size());
  for (std::size_t k = 0; k < steps.size(); ++k)
    expect_frame(file.group("frames/" + names[k]), specimen, steps[k]);
  EXPECT_TRUE(index_is_right(directory / "t.xdmf", 6));
}

TEST(Trajectory, does_not_go_on_with_the_file_of_another_specimen) {
  const TemporaryDirectory directory;
  const std::string path = directory / "t.h5";
  const Specimen specimen = chain(30);
  TrajectoryWriter(path, specimen).write_frame(0, 0, State(specimen, 0).fields());
  EXPECT_TRUE(
      contains(message_of<InputError>([&] { TrajectoryWriter::resume(path, chain(31), 0); }),
               "another specimen (30 elements, this run has 31)"));
  Specimen moved = specimen;
  moved.position[7].x += 1e-12;
  EXPECT_TRUE(contains(message_of<InputError>([&] { TrajectoryWriter::resume(path, moved, 0); }),
                       "at other places"));
}

TEST(Trajectory, resumed_sets_aside_what_is_damaged_or_of_another_run) {
  const TemporaryDirectory directory;
  const std::string path = directory / "t.h5";
  const Specimen specimen = chain(30);
  const auto frame = [&](int number) {
    return directory / ("t/00000" + std::to_string(number) + ".h5");
  };
  {
    TrajectoryWriter trajectory(path, specimen, "this run");
    for (int step = 0; step <= 40; step += 10) write(trajectory, specimen, step);
    TrajectoryWriter other(directory / "other.h5", specimen, "another run");
    write(other, specimen, 0);
  }
  std::string damaged = content_of(frame(1));
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 1);
  std::ofstream(frame(1), std::ios::binary) << damaged;
  std::ofstream(frame(2), std::ios::binary) << content_of(frame(2)).substr(0, 1000);
  std::filesystem::rename(directory / "other/000000.h5", frame(3));
  std::ofstream(path, std::ios::binary) << "no index";

  TrajectoryWriter trajectory = TrajectoryWriter::resume(path, specimen, 40, "this run");
  EXPECT_EQ(trajectory.frames(), 2u);
  ASSERT_EQ(trajectory.notes().size(), 3u);
  EXPECT_TRUE(contains(trajectory.notes()[0], "is damaged")) << trajectory.notes()[0];
  EXPECT_TRUE(contains(trajectory.notes()[1], "is cut short")) << trajectory.notes()[1];
  EXPECT_TRUE(contains(trajectory.notes()[2], "of another run")) << trajectory.notes()[2];
  EXPECT_EQ(content_of(frame(1) + ".aside"), damaged);
  write(trajectory, specimen, 50);
  const Hdf5File file = Hdf5File::open(path);
  EXPECT_EQ(file.group("frames").names(), (std::vector<std::string>{"000000", "000004", "000005"}));
  expect_frame(file.group("frames/000004"), specimen, 40);
  EXPECT_TRUE(index_is_right(directory / "t.xdmf", 3));
}

TEST(Trajectory, on_a_full_disk_keeps_the_frames_it_has) {
  const TemporaryDirectory directory;
  const std::string path = directory / "t.h5";
  const Specimen specimen = chain(1000);
  TrajectoryWriter trajectory(path, specimen);
  write(trajectory, specimen, 0);
  write(trajectory, specimen, 10);
  std::string message;
  {
    const FileSizeLimit limit(20000);
    message = message_of<RunError>([&] { write(trajectory, specimen, 20); });
  }
  EXPECT_EQ(message, "cannot write " + (directory / "t/000002.h5") +
                         ": File too large; the 2 frames up to step 10 are safe");
  EXPECT_TRUE(index_is_right(directory / "t.xdmf", 2));
  write(trajectory, specimen, 20);  // there is room again: the run can go on
  expect_frame(Hdf5File::open(path).group("frames/000002"), specimen, 20);
  EXPECT_TRUE(index_is_right(directory / "t.xdmf", 3));
}

TEST(Trajectory, on_a_disk_that_fills_up_keeps_the_frames_it_has) {
  const TemporaryDirectory directory;
  const int outcome = in_own_process([&] {
    if (!mount_small_disk(directory.string(), 512)) return 77;
    const Specimen specimen = chain(1000);
    int frames = 0;
    const std::string message = message_of<RunError>([&] {
      TrajectoryWriter trajectory(directory / "t.h5", specimen);
      for (; frames < 100; ++frames) write(trajectory, specimen, frames);
    });
    if (!contains(message, "No space left on device") || frames < 2) return 1;
    const Hdf5File file = Hdf5File::open(directory / "t.h5");
    int step = 0;
    for (const std::string& name : file.group("frames").names())
      expect_frame(file.group("frames/" + name), specimen, step++);
    // The index of the last frame may be what did not fit.
    if (!index_is_right(directory / "t.xdmf", step)) return 2;
    return std::abs(step - frames) > 1 || ::testing::Test::HasFailure() ? 3 : 0;
  });
  if (outcome == 77) GTEST_SKIP() << "this system does not let us mount a small disk";
  EXPECT_EQ(outcome, 0);
}

TEST(Trajectory, that_cannot_start_leaves_the_earlier_one) {
  const TemporaryDirectory directory;
  const std::string path = directory / "t.h5";
  const Specimen specimen = chain(1000);
  TrajectoryWriter(path, specimen).write_frame(0, 0, State(specimen, 0).fields());
  const std::string before = content_of(directory / "t/000000.h5");
  {
    const FileSizeLimit limit(500);
    EXPECT_NE(message_of<RunError>([&] { TrajectoryWriter(path, specimen); }), "");
  }
  EXPECT_EQ(content_of(directory / "t/000000.h5"), before);
  EXPECT_EQ(directory.names(), (std::vector<std::string>{"t", "t.h5", "t.xdmf"}));
  EXPECT_EQ(message_of<RunError>([&] { TrajectoryWriter("/dev/full", specimen); }),
            "cannot write /dev/full: it is not a regular file");
}

}  // namespace solidem::trajectory_test

// SPDX-License-Identifier: GPL-2.0-or-later
#include <array>
#include <cmath>
#include <stdexcept>

#include "bytes.hpp"
#include "model/error.hpp"
#include "output/hdf5.hpp"
#include "specimen/specimen_file.hpp"
#include "targets.hpp"

namespace solidem::fuzz {

namespace {

/// Mostly a number that is right, now and then any.
double number(Bytes& bytes, double right) {
  return bytes.below(8) == 0 ? bytes.take<double>() : right;
}

std::size_t size(Bytes& bytes, std::size_t right) {
  return bytes.below(8) == 0 ? bytes.below(40) : right;
}

void fill(const Hdf5File& file, Bytes& bytes) {
  file.set_attribute("format", "solidem specimen");
  file.set_attribute("version", bytes.below(16) == 0 ? bytes.take<std::int64_t>() : 1);
  const std::size_t elements = 1 + bytes.below(8);
  std::vector<double> position, radius;
  for (std::size_t i = 0; i < elements; ++i) {
    for (const double right : {2.0 * static_cast<double>(i), 0.0, 0.0})
      position.push_back(number(bytes, right));
    radius.push_back(number(bytes, 1));
  }
  radius.resize(size(bytes, elements), 1);
  file.write("elements/position", position.data(), {elements, 3});
  file.write("elements/radius", radius);
  std::vector<std::int32_t> pairs;
  for (std::int32_t i = 1; i < static_cast<std::int32_t>(elements); ++i)
    for (const std::int32_t end : {i - 1, i})
      pairs.push_back(bytes.below(8) == 0 ? bytes.take<std::int32_t>() : end);
  if (!pairs.empty()) file.write("bonds/pairs", pairs.data(), {pairs.size() / 2, 2});
  const Hdf5Group domain = file.make_group("domain");
  domain.set_attribute("shape", "box");
  for (const auto& [name, right] : {std::pair{"lower", -1.0}, std::pair{"upper", 20.0}}) {
    std::vector<double> corner(1 + size(bytes, 2));
    for (double& coordinate : corner) coordinate = number(bytes, right);
    domain.set_attribute(name, corner);
  }
  domain.set_attribute("periodic", std::vector<std::uint8_t>{bytes.take<std::uint8_t>(), 0, 0});
  for (const char* name : {"volume", "radius", "inner_radius", "angle"})
    domain.set_attribute(name, number(bytes, 1));
  domain.set_attribute("axis", static_cast<std::int64_t>(bytes.below(5)) - 1);
  std::vector<std::int32_t> members(bytes.below(5));
  for (std::int32_t& member : members) member = bytes.take<std::int32_t>();
  file.write("sets/some", members);
}

}  // namespace

void specimen(std::string_view input) {
  Bytes bytes(input);
  const std::string path = file_in_memory(".h5");
  replace_hdf5_file(path, [&](const Hdf5File& file) { fill(file, bytes); });
  try {
    const Specimen read = read_specimen(path);
    // What was accepted is good: it can be written, and is then the same.
    write_specimen(path, read);
    if (read_specimen(path).radius != read.radius) throw std::logic_error("another specimen");
  } catch (const InputError&) {
  }
  std::filesystem::remove(path);
}

}  // namespace solidem::fuzz

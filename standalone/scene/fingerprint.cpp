// SPDX-License-Identifier: GPL-2.0-or-later
#include "scene/fingerprint.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <type_traits>

namespace solidem {

namespace {

/// Collects the lines; overloads of `add` say how each kind of data is written.
class Lines {
 public:
  template <class Number, std::enable_if_t<std::is_arithmetic_v<Number>, int> = 0>
  void add(const std::string& name, Number number) {
    // The shortest text that reads back as the same number: different ones never look the same.
    text_ += fmt::format("{} = {}\n", name, number);
  }
  template <class Enum, std::enable_if_t<std::is_enum_v<Enum>, int> = 0>
  void add(const std::string& name, Enum value) {
    add(name, static_cast<int>(value));
  }
  void add(const std::string& name, const std::string& value) {
    text_ += fmt::format("{} = \"{}\"\n", name, value);
  }
  void add(const std::string& name, const Vector& v) {
    text_ += fmt::format("{} = [{}, {}, {}]\n", name, v.x, v.y, v.z);
  }
  template <class T>
  void add(const std::string& name, const std::array<T, 3>& values) {
    for (std::size_t k = 0; k < 3; ++k) add(name + "[" + std::to_string(k) + "]", values[k]);
  }
  template <class T>
  void add(const std::string& name, const std::vector<T>& values) {
    for (std::size_t k = 0; k < values.size(); ++k)
      add(name + "[" + std::to_string(k) + "]", values[k]);
  }
  template <class T>
  void add(const std::string& name, const std::optional<T>& value) {
    if (value) add(name, *value);
  }

  void add(const std::string& name, const TimeFunction& function) {
    add(name + ".time", function.time);
    add(name + ".value", function.value);
    add(name + ".amplitude", function.amplitude);
    add(name + ".frequency", function.frequency);
    add(name + ".phase", function.phase);
  }
  void add(const std::string& name, const Region& region) {
    add(name + ".kind", region.kind);
    add(name + ".axis", region.axis);
    add(name + ".high_side", region.high_side);
    add(name + ".depth", region.depth);
    add(name + ".layers", region.layers);
    add(name + ".lower", region.lower);
    add(name + ".upper", region.upper);
    add(name + ".set", region.set);
  }
  void add(const std::string& name, const AxisControl& control) {
    add(name + ".kind", control.kind);
    if (control.kind != AxisControl::Kind::free) add(name, control.function);
  }
  void add(const std::string& name, const SpecimenRecipe& recipe) {
    if (!recipe.file.empty()) {
      add(name + ".file", std::filesystem::path(recipe.file).filename().string());
      return;
    }
    add(name + ".shape", recipe.shape);
    add(name + ".size", recipe.size);
    add(name + ".length", recipe.length);
    add(name + ".radius", recipe.radius);
    add(name + ".axis", recipe.axis);
    add(name + ".lattice", recipe.lattice);
    add(name + ".cells", recipe.cells);
    add(name + ".element_radius", recipe.element_radius);
    add(name + ".elements", recipe.elements);
    add(name + ".mean_radius", recipe.mean_radius);
    add(name + ".seed", recipe.seed);
    add(name + ".radius_spread", recipe.radius_spread);
    add(name + ".periodic", recipe.periodic);
    add(name + ".origin", recipe.origin);
  }
  void add(const std::string& name, const Material& material) {
    add(name + ".region", material.region);
    add(name + ".density", material.density);
    add(name + ".specific_heat_capacity", material.specific_heat);
    add(name + ".conductivity", material.conductivity);
  }
  void add(const std::string& name, const ConductionParameters& conduction) {
    add(name + ".law", conduction.law);
    add(name + ".initial_temperature", conduction.initial_temperature);
  }
  void add(const std::string& name, const BeamParameters& beams) {
    add(name + ".young_modulus", beams.young_modulus);
    add(name + ".shear_modulus", beams.shear_modulus);
    add(name + ".radius_ratio", beams.radius_ratio);
    add(name + ".radius_from", beams.radius_from);
  }
  void add(const std::string& name, const GripParameters& grip) {
    add(name + ".name", grip.name);
    add(name + ".region", grip.region);
    add(name + ".axis", grip.axis);
    add(name + ".rotation_fixed", grip.rotation_fixed);
  }
  void add(const std::string& name, const ImposedTemperatureParameters& imposed) {
    add(name + ".name", imposed.name);
    add(name + ".region", imposed.region);
    add(name + ".value", imposed.temperature);
  }
  void add(const std::string& name, const InitialVelocity& initial) {
    add(name + ".region", initial.region);
    add(name + ".velocity", initial.velocity);
  }
  void add(const std::string& name, const Sensor& sensor) {
    add(name + ".name", sensor.name);
    add(name + ".point", sensor.point);
    add(name + ".quantity", sensor.quantity);
  }
  void add(const std::string& name, const Gauge& gauge) {
    add(name + ".axis", gauge.axis);
    add(name + ".lower", gauge.lower);
    add(name + ".upper", gauge.upper);
  }

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace

std::string fingerprint(const Scene& scene) {
  const Setup& setup = scene.setup;
  Lines lines;
  lines.add("specimen", scene.specimen);
  lines.add("bonds.tolerance", scene.bond_tolerance);
  lines.add("material", setup.materials);
  lines.add("conduction", setup.conduction);
  lines.add("beams", setup.beams);
  lines.add("grips", setup.grips);
  lines.add("temperatures", setup.temperatures);
  lines.add("initial_velocities", setup.initial_velocities);
  lines.add("sensors", setup.sensors);
  lines.add("gauge", setup.gauge);
  lines.add("run.time_step", setup.run.time_step);
  lines.add("run.time_step_ratio", setup.run.time_step_ratio);
  return lines.text();
}

std::string first_difference(const std::string& first, const std::string& second) {
  std::istringstream a(first), b(second);
  std::string line_a, line_b;
  while (true) {
    const bool more_a = static_cast<bool>(std::getline(a, line_a));
    const bool more_b = static_cast<bool>(std::getline(b, line_b));
    if (!more_a && !more_b) return "";
    if (!more_b) return line_a + ", not given";
    if (!more_a) return "not given, not " + line_b;
    if (line_a == line_b) continue;
    const std::size_t name_end = line_a.find(" = ");
    const bool same_name = name_end != std::string::npos &&
                           line_b.compare(0, name_end + 3, line_a, 0, name_end + 3) == 0;
    return line_a + ", not " + (same_name ? line_b.substr(name_end + 3) : line_b);
  }
}

}  // namespace solidem

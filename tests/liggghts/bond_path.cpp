// SPDX-License-Identifier: GPL-2.0-or-later
//
// One bond led through poses by the laws themselves: what the bond style must do too.
//
//   bond_path law radius kappa young shear plasticity hardening [parameter value ...] < poses
//
// A line of the input: positions and orientations (w x y z) of atom 1 and atom 2; the first is the
// pose in which the bond is made. A line of the output, for each pose but the first: force on atom
// 1, moments on atom 1 and atom 2, equivalent strain, plastic strain, elastic energy, plastic work
// (the mean of what both atoms see, as a step turns one against the other).
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>
#include <variant>

#include "laws/beam_flow.hpp"
#include "laws/yield_laws.hpp"

namespace {

struct Pose {
  solidem::Vector3<double> chord;
  solidem::Quaternion<double> first, second;
};

bool read(Pose& pose) {
  solidem::Vector3<double> a, b;
  auto& p = pose.first;
  auto& q = pose.second;
  std::cin >> a.x >> a.y >> a.z >> p.w >> p.v.x >> p.v.y >> p.v.z;
  std::cin >> b.x >> b.y >> b.z >> q.w >> q.v.x >> q.v.y >> q.v.z;
  pose.chord = b - a;
  return static_cast<bool>(std::cin);
}

/// The bond as the second atom sees it.
Pose turned_about(const Pose& pose) {
  return {-pose.chord, pose.second, pose.first};
}

/// What one side of the bond remembers.
struct Side {
  solidem::Vector3<double> rest_direction;
  solidem::BeamHistory<double> history;
  explicit Side(const solidem::Vector3<double>& direction)
      : rest_direction(direction), history(solidem::unyielded(direction)) {}
};

void print(const solidem::Vector3<double>& a) {
  std::printf("%.17g %.17g %.17g ", a.x, a.y, a.z);
}

/// The yield law of this name, with parameters from pairs of words.
solidem::YieldLaw yield_law(const std::string& name, char** words) {
  solidem::YieldLaw result;
  solidem::YieldLaws::for_each([&](auto law) {
    if (name != law.name) return;
    for (char** word = words; *word != nullptr; word += 2)
      for (const auto& parameter : law.parameters())
        if (parameter.name == std::string(*word)) law.*parameter.member = std::atof(word[1]);
    result = law;
  });
  return result;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 8 || argc % 2 != 0) return 1;
  const std::string law = argv[1], plasticity = argv[6];
  const double radius = std::atof(argv[2]), kappa = std::atof(argv[3]);
  const solidem::BeamSection<double> section = {std::atof(argv[4]), std::atof(argv[5]), radius};
  Pose pose;
  if (!read(pose)) return 1;
  const double length = solidem::norm(pose.chord);
  const solidem::Vector3<double> rest_direction = (1 / length) * pose.chord;
  solidem::YieldingBeam<double> beam{};
  beam.rigidity = law == "timoshenko" ? solidem::timoshenko_rigidity(section, length, kappa)
                  : law == "spring"   ? solidem::spring_rigidity(section)
                                      : solidem::euler_bernoulli_rigidity(section);
  beam.rest_length = length;
  if (law != "spring")
    beam.radius = radius, beam.shear_ratio = std::atof(argv[5]) / std::atof(argv[4]);
  const solidem::YieldLaw hardening = yield_law(argv[7], argv + 8);
  Side first(rest_direction), second(-rest_direction);
  solidem::FlowRule rule = solidem::FlowRule::radial_return;
  for (const auto& named : solidem::flow_rules)
    if (plasticity == named.name) rule = named.choice;
  double work = 0;
  while (read(pose)) {
    const auto respond = [&](Side& side, const Pose& seen) {
      const auto by = [&](const auto& known) {
        const solidem::YieldCurve<std::decay_t<decltype(known)>, double> yield{known};
        return solidem::flow_response(rule, yield, beam, side.history, side.rest_direction,
                                      {seen.chord, seen.first, seen.second});
      };
      const solidem::BeamResponse<double> response = std::visit(by, hardening);
      side.history = response.history;
      return response;
    };
    const solidem::BeamResponse<double> response = respond(first, pose);
    work += 0.5 * (response.plastic_work + respond(second, turned_about(pose)).plastic_work);
    const solidem::BeamHistory<double>& history = first.history;
    const auto kept =
        solidem::beam_pose(pose.chord, history.normal_i, history.normal_j, pose.first, pose.second);
    const double strain = solidem::equivalent_strain(
        beam.radius, beam.shear_ratio, kept, solidem::elastic_deformation(length, kept, history));
    print(response.load.force);
    print(response.load.moment_i);
    print(response.load.moment_j);
    std::printf("%.17g %.17g %.17g %.17g\n", strain, history.strain, response.energy, work);
  }
}

// SPDX-License-Identifier: GPL-2.0-or-later
//
// Loads of one beam under prescribed motions: beam_loads MOTIONS LOADS. The first line of MOTIONS
// gives both positions (m), beam radius (m), E and G (Pa), the law (euler-bernoulli, timoshenko or
// spring) and its shear coefficient, and how the beam flows (elastic, radial-return or
// scaled-offset) with yield strain and hardening ratio; each further line the displacements (m) of
// i and j and their rotation vectors (rad). An elastic beam takes each motion from rest; one that
// flows takes them one after the other. A line of LOADS: forces on i and j (N), moments on i and j
// (N·m).
#include <cstdio>
#include <fstream>
#include <iostream>
#include <string>

#include "laws/beam_flow.hpp"
#include "laws/linear_hardening.hpp"
#include "laws/rigid_sphere.hpp"

namespace {

using Vector = solidem::Vector3<double>;
using Orientation = solidem::Quaternion<double>;

std::istream& operator>>(std::istream& in, Vector& v) {
  return in >> v.x >> v.y >> v.z;
}

// A rotation vector in steps small enough for the law's own integrator to be exact.
Orientation turned(const Vector& rotation) {
  constexpr int steps = 16;
  Orientation q;
  for (int n = 0; n < steps; ++n) q = solidem::turn(q, rotation, 1.0 / steps);
  return q;
}

struct Task {
  Vector position_i, position_j;
  solidem::BeamSection<double> section{};
  std::string law, flow;
  double shear_coefficient = 0;
  solidem::LinearHardening yield;
};

bool read(std::istream& in, Task& t) {
  return bool(in >> t.position_i >> t.position_j >> t.section.radius >> t.section.young_modulus >>
              t.section.shear_modulus >> t.law >> t.shear_coefficient >> t.flow >>
              t.yield.yield_strain >> t.yield.hardening_ratio);
}

solidem::BeamRigidity<double> rigidity(const Task& t, double length) {
  if (t.law == "spring") return solidem::spring_rigidity(t.section);
  if (t.law == "timoshenko")
    return solidem::timoshenko_rigidity(t.section, length, t.shear_coefficient);
  return solidem::euler_bernoulli_rigidity(t.section);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "error: expected beam_loads MOTIONS LOADS\n";
    return 2;
  }
  std::ifstream in(argv[1]);
  Task task;
  if (!read(in, task)) {
    std::cerr << "error: " << argv[1] << ": the first line does not say what beam\n";
    return 2;
  }
  const Vector rest = task.position_j - task.position_i;
  const double length = norm(rest);
  const Vector direction = (1 / length) * rest;
  const solidem::YieldingBeam<double> beam{rigidity(task, length), length, task.section.radius,
                                           task.section.shear_modulus / task.section.young_modulus};
  const solidem::YieldCurve<solidem::LinearHardening, double> yield{task.yield};
  solidem::BeamHistory<double> history = solidem::unyielded(direction);
  std::FILE* out = std::fopen(argv[2], "w");
  if (!out) {
    std::cerr << "error: " << argv[2] << " cannot be written\n";
    return 1;
  }
  Vector move_i, move_j, turn_i, turn_j;
  while (in >> move_i >> move_j >> turn_i >> turn_j) {
    const Vector chord = (task.position_j + move_j) - (task.position_i + move_i);
    const Orientation at_i = turned(turn_i), at_j = turned(turn_j);
    solidem::BeamLoad<double> load{};
    if (task.flow == "elastic") {
      load = solidem::beam_load(beam.rigidity, length,
                                solidem::beam_pose(chord, direction, at_i, at_j));
    } else {
      const solidem::FlowRule rule = task.flow == "scaled-offset"
                                         ? solidem::FlowRule::scaled_offset
                                         : solidem::FlowRule::radial_return;
      const solidem::BeamResponse<double> response =
          solidem::flow_response(rule, yield, beam, history, direction, {chord, at_i, at_j});
      load = response.load;
      history = response.history;
    }
    const Vector loads[] = {load.force, -load.force, load.moment_i, load.moment_j};
    for (const Vector& v : loads) std::fprintf(out, "%.17g %.17g %.17g ", v.x, v.y, v.z);
    std::fprintf(out, "\n");
  }
  return std::fclose(out) == 0 ? 0 : 1;
}

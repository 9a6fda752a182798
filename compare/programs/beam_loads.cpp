// SPDX-License-Identifier: GPL-2.0-or-later
//
// Loads of one beam under prescribed motions: beam_loads MOTIONS LOADS. The first line of MOTIONS
// gives both positions (m), beam radius (m), E and G (Pa); each further line the displacements (m)
// of i and j and their rotation vectors (rad). A line of LOADS: forces on i and j (N), moments on i
// and j (N·m).
#include <cstdio>
#include <fstream>
#include <iostream>

#include "laws/beam.hpp"
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

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "error: expected beam_loads MOTIONS LOADS\n";
    return 2;
  }
  std::ifstream in(argv[1]);
  Vector position_i, position_j;
  solidem::BeamSection<double> section{};
  if (!(in >> position_i >> position_j >> section.radius >> section.young_modulus >>
        section.shear_modulus)) {
    std::cerr << "error: " << argv[1] << ": the first line has no nine numbers\n";
    return 2;
  }
  const solidem::BeamRigidity<double> rigidity = solidem::euler_bernoulli_rigidity(section);
  const Vector rest = position_j - position_i;
  const double length = norm(rest);
  std::FILE* out = std::fopen(argv[2], "w");
  if (!out) {
    std::cerr << "error: " << argv[2] << " cannot be written\n";
    return 1;
  }
  Vector move_i, move_j, turn_i, turn_j;
  while (in >> move_i >> move_j >> turn_i >> turn_j) {
    const solidem::BeamLoad<double> load =
        solidem::beam_load(rigidity, length,
                           solidem::beam_pose((position_j + move_j) - (position_i + move_i),
                                              (1 / length) * rest, turned(turn_i), turned(turn_j)));
    const Vector loads[] = {load.force, -load.force, load.moment_i, load.moment_j};
    for (const Vector& v : loads) std::fprintf(out, "%.17g %.17g %.17g ", v.x, v.y, v.z);
    std::fprintf(out, "\n");
  }
  return std::fclose(out) == 0 ? 0 : 1;
}

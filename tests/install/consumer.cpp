// SPDX-License-Identifier: GPL-2.0-or-later
//
// Uses a law (header only), the model and the output (compiled) of the installed library.
#include <iostream>

#include "laws/platonic_conduction.hpp"
#include "model/specimen.hpp"
#include "output/summary.hpp"
#include "output/trajectory.hpp"

int main(int, char** arguments) {
  solidem::Specimen specimen;
  for (int i = 0; i < 4; ++i) {
    specimen.position.push_back({2.0 * i, 0, 0});
    specimen.radius.push_back(1);
    if (i > 0) specimen.bonds.push_back({i - 1, i});
  }
  solidem::TrajectoryWriter(arguments[1], specimen)
      .write_frame(0, 0, {{"radius", 1, specimen.radius.data()}});
  std::cout << solidem::version() << ' ' << solidem::mean_radius(specimen) << ' '
            << solidem::platonic_face_area(6) << '\n';
}

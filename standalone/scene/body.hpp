// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SCENE_BODY_HPP
#define SOLIDEM_SCENE_BODY_HPP

#include "engine/simulation.hpp"
#include "scene/scene.hpp"

namespace solidem {

/// The specimen that a scene asks for, with its bonds: those of [bonds] tolerance, else those of
/// the specimen file, else of tolerance 0. InputErrors name the place in the scene.
Specimen make_body(const Scene& scene, const ReportProgress& progress = {});

/// Writes everything that another code needs to run a scene: the specimen with bonds, the elements
/// of every grip, imposed temperature, gauge and sensor as /sets, and what each element represents:
/// /mechanics/mass, inertia; /conduction/transmission_area (S_i of the law, m²), heat_capacity.
/// `simulation` is that of the scene.
void write_prepared(const std::string& path, const Simulation& simulation);

}  // namespace solidem

#endif

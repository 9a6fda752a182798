// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_SCENE_FINGERPRINT_HPP
#define SOLIDEM_SCENE_FINGERPRINT_HPP

#include <string>

#include "output/first_difference.hpp"
#include "scene/scene.hpp"

namespace solidem {

/// All of a scene that shapes its states and its history columns, as text: a line `name = value`
/// for each, numbers with all their digits. Two scenes with the same fingerprint may continue each
/// other's checkpoints. Left out are the title, the paths of folders, how long to run, how often to
/// observe, what to write, and the time step, which the checkpoint compares as it came out. A
/// specimen file counts by its name: its content is for the checkpoint to compare.
std::string fingerprint(const Scene& scene);

}  // namespace solidem

#endif

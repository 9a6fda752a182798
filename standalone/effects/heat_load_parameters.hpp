// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a scene may ask of loads of heat: plain data in SI units, filled by the scene reader and
// read by the effects.
#ifndef SOLIDEM_EFFECTS_HEAT_LOAD_PARAMETERS_HPP
#define SOLIDEM_EFFECTS_HEAT_LOAD_PARAMETERS_HPP

#include <array>
#include <optional>
#include <string>

#include "model/region.hpp"
#include "model/shape.hpp"
#include "model/time_function.hpp"

namespace solidem {

/// A temperature imposed on elements, or on a wall of the body.
struct ImposedTemperatureParameters {
  std::string name;
  Region region;
  TimeFunction temperature;  ///< K
  std::string wall{};        ///< if given, of this wall, and not of elements themselves
};

/// Heat that flows into the body through a wall, or through a part of it that may move.
struct HeatFluxParameters {
  std::string name;
  std::string wall;
  TimeFunction flux;                       ///< W/m², or W in all
  bool is_power = false;                   ///< `flux` is in W
  std::optional<Shape> shape{};            ///< around its origin: the part of the wall inside
  std::optional<double> spot_radius{};     ///< of a Gaussian spot: where it has fallen to 1/e², m
  std::array<TimeFunction, 3> position{};  ///< of the shape's origin or the spot's centre, m
  Region region{};                         ///< of the exposed surface: through these elements
};

/// Heat exchanged with a fluid along a wall.
struct ConvectionParameters {
  std::string name;
  std::string wall;
  TimeFunction coefficient;  ///< h, W/(m² K)
  TimeFunction temperature;  ///< of the fluid, K
  Region region{};           ///< of the exposed surface: of these elements
};

/// Heat that arises inside the body, in a region at rest or in a shape that may move.
struct HeatSourceParameters {
  std::string name;
  std::optional<Region> region;
  std::optional<Shape> shape;            ///< around the origin
  std::array<TimeFunction, 3> position;  ///< of the shape's origin, m
  bool is_density = true;                ///< `power` is in W/m³, else W in all
  TimeFunction power;
};

}  // namespace solidem

#endif

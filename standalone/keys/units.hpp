// SPDX-License-Identifier: GPL-2.0-or-later
//
// Quantities as a user writes them ("73 GPa", "3.3 mm/s", "25 °C"), understood by UDUNITS-2 and
// turned into SI. Each place of a scene expects one dimension; anything else is an error that says
// what was found and what would be right.
#ifndef SOLIDEM_KEYS_UNITS_HPP
#define SOLIDEM_KEYS_UNITS_HPP

#include <string>

namespace solidem {

/// What a quantity must be.
struct Dimension {
  const char* name;                ///< with its article, for messages: "a length"
  const char* unit;                ///< the SI unit of the result
  const char* example;             ///< a quantity as a user may write it
  bool offset_is_allowed = false;  ///< absolute temperatures: 0 °C is 273.15 K
};

namespace dimension {

inline constexpr Dimension length{"a length", "m", "0.5 mm"};
inline constexpr Dimension time{"a time", "s", "1 ms"};
inline constexpr Dimension velocity{"a velocity", "m/s", "3.3 mm/s"};
inline constexpr Dimension rate{"a rate", "1/s", "100 1/s"};
inline constexpr Dimension acceleration{"an acceleration", "m/s^2", "9.81 m/s^2"};
inline constexpr Dimension force{"a force", "N", "25 N"};
inline constexpr Dimension energy{"an energy", "J", "0.24 mJ"};
inline constexpr Dimension stiffness{"a stiffness", "N/m", "1500 kN/m"};
inline constexpr Dimension drag{"a drag coefficient", "N s/m", "0.08 N s/m"};
inline constexpr Dimension modulus{"a modulus", "Pa", "73 GPa"};
inline constexpr Dimension density{"a density", "kg/m^3", "2790 kg/m^3"};
inline constexpr Dimension conductivity{"a conductivity", "W/(m K)", "134 W/(m K)"};
inline constexpr Dimension specific_heat_capacity{"a specific heat capacity", "J/(kg K)",
                                                  "880 J/(kg K)"};
inline constexpr Dimension temperature{"a temperature", "K", "298 K", true};
inline constexpr Dimension temperature_difference{"a temperature difference", "K", "10 K"};
inline constexpr Dimension expansion{"an expansion coefficient", "1/K", "23e-6 1/K"};
inline constexpr Dimension frequency{"a frequency", "Hz", "50 Hz"};
inline constexpr Dimension angle{"an angle", "rad", "90 degree"};
inline constexpr Dimension angular_velocity{"an angular velocity", "rad/s", "1000 rpm"};
inline constexpr Dimension torque{"a torque", "N m", "5 N m"};
inline constexpr Dimension mass{"a mass", "kg", "20 g"};
inline constexpr Dimension heat_flux{"a heat flux", "W/m^2", "1 MW/m^2"};
inline constexpr Dimension heat_transfer{"a heat transfer coefficient", "W/(m^2 K)",
                                         "1000 W/(m^2 K)"};
inline constexpr Dimension power{"a power", "W", "1 kW"};
inline constexpr Dimension power_density{"a power density", "W/m^3", "1e11 W/m^3"};
inline constexpr Dimension number{"a number", "1", "5 %"};

}  // namespace dimension

/// The value of a quantity in the SI unit of `expected`. Throws InputError with what is wrong with
/// the text (`"GPA" is no unit (did you mean "73 GPa"?)`); the caller knows the place and adds
/// what is expected. Refused are also: a number that is not finite, a unit with an offset (°C)
/// where a difference or a rate is meant, logarithmic units, an angle per time where cycles per
/// time are meant (rpm: 2π apart), and the other way round (Hz).
double to_si(const std::string& quantity, const Dimension& expected);

}  // namespace solidem

#endif

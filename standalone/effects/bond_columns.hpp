// SPDX-License-Identifier: GPL-2.0-or-later
//
// What a bond keeps in its slot: one table that says of each column who needs it, what an empty
// slot holds and what a bond holds when it is made.
#ifndef SOLIDEM_EFFECTS_BOND_COLUMNS_HPP
#define SOLIDEM_EFFECTS_BOND_COLUMNS_HPP

#include <algorithm>

#include "laws/beam.hpp"
#include "laws/limit_scale.hpp"
#include "laws/rupture_law.hpp"
#include "model/columns.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// What decides which columns bonds have.
struct BondNeeds {
  bool has_rotation;         ///< elements turn
  bool remembers;            ///< bonds keep a history
  bool measured_since_made;  ///< flow depends on the deformation since a bond was made
  bool differ;               ///< in section or stiffness
  bool limits_differ;        ///< of yield or rupture
  bool feels_rate;           ///< yields otherwise when it flows fast
  bool may_flow_or_break;
  bool is_periodic;
  bool expands, softens;  ///< with temperature
};

/// A bond when it is made, free of load.
struct NewBond {
  double rest_length;
  Vector direction;           ///< from the element to its neighbour
  Vector normal_i, normal_j;  ///< the same in either element's body axes
  double twist;               ///< of the two elements against each other
  double radius;
  BeamRigidity<double> rigidity;
  Vector image_shift;
  LimitScale<double> limits;
  double limit_strain;
};

/// A column of bonds.
struct BondColumn {
  const Column* column;
  bool (*is_needed)(const BondNeeds&);
  double empty;                                            ///< of every component of an empty slot
  void (*write)(const NewBond& bond, double* components);  ///< of a bond when it is made
};

namespace detail {

inline void write(const Vector& v, double* components) {
  components[0] = v.x;
  components[1] = v.y;
  components[2] = v.z;
}

inline bool keeps_normals(const BondNeeds& needs) {
  return needs.has_rotation && needs.remembers;
}

inline bool remembers(const BondNeeds& needs) {
  return needs.remembers;
}

}  // namespace detail

inline const BondColumn bond_columns[] = {
    {&columns::rest_length, [](const BondNeeds&) { return true; }, 1,
     [](const NewBond& bond, double* to) { *to = bond.rest_length; }},
    {&columns::rest_direction,
     [](const BondNeeds& needs) {
       return needs.has_rotation && (!needs.remembers || needs.measured_since_made);
     },
     0, [](const NewBond& bond, double* to) { detail::write(bond.direction, to); }},
    {&columns::section_normal, detail::keeps_normals, 0,
     [](const NewBond& bond, double* to) { detail::write(bond.normal_i, to); }},
    {&columns::far_section_normal, detail::keeps_normals, 0,
     [](const NewBond& bond, double* to) { detail::write(bond.normal_j, to); }},
    {&columns::plastic_twist, detail::keeps_normals, 0,
     [](const NewBond& bond, double* to) { *to = bond.twist; }},
    // An empty slot has shrunk to nothing: it bears no load.
    {&columns::plastic_extension, detail::remembers, -1,
     [](const NewBond&, double* to) { *to = 0; }},
    {&columns::plastic_strain, detail::remembers, 0, [](const NewBond&, double* to) { *to = 0; }},
    {&columns::flow_rate, [](const BondNeeds& needs) { return needs.feels_rate; }, 0,
     [](const NewBond&, double* to) { *to = 0; }},
    {&columns::flow_time, [](const BondNeeds& needs) { return needs.feels_rate; }, 0,
     [](const NewBond&, double* to) { *to = 0; }},
    {&columns::limit_strain, detail::remembers, unlimited,
     [](const NewBond& bond, double* to) { *to = bond.limit_strain; }},
    {&columns::bond_rigidity, [](const BondNeeds& needs) { return needs.differ; }, 1,
     [](const NewBond& bond, double* to) {
       to[0] = bond.rigidity.axial;
       to[1] = bond.rigidity.bending;
       to[2] = bond.rigidity.shear;
       to[3] = bond.rigidity.torsion;
     }},
    {&columns::reference_length, [](const BondNeeds& needs) { return needs.expands; }, 1,
     [](const NewBond&, double* to) { *to = 0; }},
    {&columns::reference_rigidity, [](const BondNeeds& needs) { return needs.softens; }, 1,
     [](const NewBond&, double* to) { std::fill_n(to, 4, 0.0); }},
    {&columns::bond_radius,
     [](const BondNeeds& needs) { return needs.differ && needs.may_flow_or_break; }, 1,
     [](const NewBond& bond, double* to) { *to = bond.radius; }},
    {&columns::bond_limits, [](const BondNeeds& needs) { return needs.limits_differ; }, 1,
     [](const NewBond& bond, double* to) {
       to[0] = bond.limits.yield;
       to[1] = bond.limits.plastic;
       to[2] = bond.limits.rupture;
     }},
    {&columns::image_shift, [](const BondNeeds& needs) { return needs.is_periodic; }, 0,
     [](const NewBond& bond, double* to) { detail::write(bond.image_shift, to); }}};

}  // namespace solidem

#endif

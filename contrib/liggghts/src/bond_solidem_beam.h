// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifdef BOND_CLASS

// clang-format off
BondStyle(solidem/beam,BondSolidemBeam)
// clang-format on

#else

#ifndef LMP_BOND_SOLIDEM_BEAM_H
#define LMP_BOND_SOLIDEM_BEAM_H

#include <vector>

#include "bond.h"
#include "solidem_beam.h"
#include "solidem_bond_packs.h"

namespace LAMMPS_NS {

/// What happened to the bonds of this rank so far.
struct SolidemLedger {
  double broken = 0.0, formed = 0.0;
  double fracture_energy = 0.0;
  double first_rupture = 0.0;  ///< step plus one; 0: none
  double damping = 0.0;        ///< energy that dashpots took
};

/// Beam between the centres of two spheres, elastic, plastic or brittle. What one bond does is in
/// solidem_beam.h; this style finds the bonds and hands their loads on. History of a bond:
/// SolidemBondMemory.
class BondSolidemBeam : public Bond {
 public:
  BondSolidemBeam(class LAMMPS*);
  ~BondSolidemBeam();
  void init_style();
  void compute(int, int);
  void coeff(int, char**);
  double equilibrium_distance(int);
  void write_restart(FILE*);
  void read_restart(FILE*);
  void write_data(FILE*);
  double single(int, double, int, int, double&);

  const SolidemBeam& beam(int type) const { return beams[type]; }
  bool may_break() const;
  bool may_damp() const;
  /// Does any type bear bending or torsion?
  bool bears_moments() const;
  /// Does temperature count for any type? Does flow give heat to the atoms?
  bool follows_temperature() const;
  bool gives_heat() const;
  /// Has any type bonds that are longer when they are warm?
  bool may_expand() const;
  /// The ends of a bond between two atoms of this rank, ghosts included; i is made the lower tag.
  SolidemBondEnds ends(int& i, int& j) const;
  /// The list of bonds is about to be made anew.
  void forget_list() { list_is_new_ = true; }
  /// How many bonds of this rank broke at the last step.
  int broke() const { return broke_; }
  /// Energy of the contacts of broken bonds at the last step, this rank's share.
  double contact_energy() const { return contact_energy_; }
  /// This rank's share of a bond: 1, or 1/2 when another rank has the bond too.
  double owned_fraction(int i, int j) const;

  SolidemLedger ledger;

 private:
  std::vector<SolidemBeam> beams;  // by bond type
  class FixPropertyAtom* orientation;
  class FixPropertyAtom *motion_at_pose, *motion_before;  // NULL: no bond is damped
  class FixPropertyAtom* temperature;                     // NULL: it does not count
  class FixPropertyAtom* waiting_heat;  // that flow has made, half of it of either atom; NULL: none
  bool after_setup_;  // are velocities known at the last pose, and not half a step before it?
  double damping_power_, damping_power_now_;  // at the last step and at this, this rank's share
  double contact_energy_;
  int broke_;
  bool list_is_new_;
  std::vector<SolidemBondPacks> packs_;    // by bond type
  std::vector<SolidemRow> poses_, loads_;  // of atoms, ghosts included
  std::vector<SolidemRow> motion_;         // the same, if bonds are damped

  void allocate();
  void widen_history();
  void enter(const SolidemBondAction& action, double fraction);
  void find_heat();
  void prepare_heat();
  void give_heat(int i, int j, const SolidemBondAction& action);
  void lead_motion();
  void damp(const SolidemBondPacks& packs, int bond, const SolidemBondEnds& place,
            solidem::BeamLoad<double>& load);
  void enter_damping();
  void tally(int i, int j, double energy_of_bond, const solidem::Vector3<double>& force_on_i);

  void arrange();
  void gather_poses();
  void gather_motion();
  void act(SolidemBondPacks& packs, bool asked);
  void act_alone(SolidemBondPacks& packs, int bond, bool asked);
  void hand_loads_on();
};

}  // namespace LAMMPS_NS

#endif
#endif

// SPDX-License-Identifier: GPL-2.0-or-later
//
// Copyright (C) solidem developers
//
// This program is free software: you can redistribute it and/or modify it under the terms of the
// GNU General Public License as published by the Free Software Foundation, either version 2 of the
// License, or (at your option) any later version. It comes with NO WARRANTY.
//
// Contributing author: solidem developers
#ifdef FIX_CLASS

// clang-format off
FixStyle(solidem/conduction,FixSolidemConduction)
// clang-format on

#else

#ifndef LMP_FIX_SOLIDEM_CONDUCTION_H
#define LMP_FIX_SOLIDEM_CONDUCTION_H

#include <string>
#include <vector>

#include "fix.h"
#include "solidem_bond_values.h"
#include "solidem_kernels.h"

namespace LAMMPS_NS {

/// Heat conduction along bonds, explicit in time. Laws `platonic` and `platonic-calibrated` are
/// laws/platonic_conduction.hpp; law `voronoi` takes areas, distances and volumes from a file.
/// Temperatures are LIGGGHTS' property Temp. What a conductance needs stays with the bonds, the
/// number of bonds (property coordination) or the volume (cellVolume) with the atoms, so
/// conductances never change once a bond has been seen. A step adds up the properties heatFlux,
/// which it empties first and any fix may add to in post_force, and heatSource, which is the
/// user's. Where bonds give heat or look at temperatures, and where heat waits for several steps of
/// the motion, heat steps before the bonds act in a new pose: they see the temperatures of their
/// time.
class FixSolidemConduction : public Fix {
 public:
  FixSolidemConduction(class LAMMPS*, int, char**);
  ~FixSolidemConduction();
  void post_create();
  int setmask();
  void init();
  void setup_pre_force(int);
  void setup(int);
  void post_integrate();
  void pre_force(int);
  void post_force(int);
  void final_integrate();
  void post_run();
  double compute_scalar();
  double extend_cut_ghost();

  /// Heat capacity of local atom i, J/K.
  double heat_capacity(int i) const;
  /// e = √(λ ρ c) of the atoms' material, W s^½/(m² K).
  double effusivity() const;
  /// Whether heat steps before forces act, and calls those that heat by walls or impose a
  /// temperature itself.
  bool leads() const { return leads_; }
  /// Whether steps of the motion have passed since heat last stepped.
  bool waits() const { return waited_ > 0; }

  void grow_arrays(int);
  void copy_arrays(int, int, int);
  void set_arrays(int);
  int pack_exchange(int, double*);
  int unpack_exchange(int, double*);
  int pack_restart(int, double*);
  void unpack_restart(int, int);
  int size_restart(int);
  int maxsize_restart();
  double memory_usage();
  void write_restart(FILE*);
  void restart(char*);

 private:
  struct Conductor {
    int i, j;            // i is local, j may be a ghost
    double conductance;  // W/K
  };

  std::string law, file;
  double conductivity, specific_heat, density, initial_temperature;
  double area_factor;      // of law platonic-calibrated, else 1
  double volume;           // of the body, m³; law platonic-calibrated
  double capacity_factor;  // of law platonic-calibrated, else 1; 0 until it is known
  double*** bond_value;    // [local atom][bond]: distance (0 until seen), area (law voronoi)
  SolidemBondValues* values;
  std::vector<Conductor> conductors;
  std::vector<int> first_row, neighbour;  // of blocks of eight local atoms: SolidemConductors
  std::vector<SolidemRow> row_conductance;
  std::vector<Conductor> outward;          // whose other side is told to the rank that owns it
  std::vector<double> step_over_capacity;  // of local atoms, K/W
  double step_of_capacities;               // s; negative: not known
  double checked_step;                     // of the motion, that is known to be stable, s
  bool leads_;
  bool leaves_forces_;  // as they are, for nobody acts on them
  bool contacts_heat_;  // by friction, or through what touches
  int every_;           // steps of the motion from one step of heat to the next
  int waited_;          // steps of the motion since heat last stepped
  double waited_time_;  // how long they took, s
  class FixPropertyAtom *temperature, *heat_flux, *heat_source, *coordination, *cell_volume;
  class FixPropertyAtom* waiting_heat;  // of plastic flow and friction; NULL: none

  void read_arguments(int, char**);
  class FixPropertyAtom* property(const char*, const char*, const char*, const char*);
  void find_properties();
  bool any_rank(bool) const;
  int partner(int, int) const;
  bool see_new_bonds();
  void see_cells();
  void count_bonds();
  void scale_capacities();
  void build_conductors();
  void lay_out_conductors();
  double area(int, int, int) const;
  void find_steps(double);
  void find_what_bonds_ask();
  void take_waiting_heat();
  void take_heat_of_contacts();
  double pass();
  void conduct();
  bool somebody_acts() const;
  void leave_forces(bool);
  void clear_forces();
  void step(double);
  void require_temperatures() const;
  void require_stable_step();
  std::vector<double> conductances_of_atoms();
  std::vector<bool> free_atoms() const;
  double fastest_decay(const std::vector<double>& conductance, const std::vector<bool>& free) const;
};

}  // namespace LAMMPS_NS

#endif
#endif

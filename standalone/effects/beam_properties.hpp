// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_BEAM_PROPERTIES_HPP
#define SOLIDEM_EFFECTS_BEAM_PROPERTIES_HPP

#include "effects/beam_parameters.hpp"
#include "laws/beam.hpp"
#include "model/specimen.hpp"

namespace solidem {

/// Whether all beams have one section and one rigidity.
bool beams_are_alike(const BeamParameters& parameters);

/// What beams of each two materials are, as BeamMaterialTable has them; `yield`: the law that all
/// share.
std::vector<BeamPairing> pairings(const BeamParameters& parameters, const YieldLaw* yield);

/// What the beam of each bond is made of, how thick and how stiff it is.
class BeamProperties {
 public:
  /// Keeps a reference to neither.
  BeamProperties(const BeamParameters& parameters, const Specimen& specimen,
                 const YieldLaw* yield = nullptr);

  /// The section of the beam between two elements of the specimen that this was made of. `chord`:
  /// from i to j at rest.
  BeamSection<double> section(const Specimen& specimen, Pair pair, const Vector& chord) const;
  BeamSection<double> section(const Specimen& specimen, Pair pair) const {
    return section(specimen, pair, rest_chord(specimen, pair));
  }

  /// The same of beams outside of all regions, wherever the elements stand.
  BeamSection<double> section(double radius_i, double radius_j, const Vector& chord) const;

  /// That of a beam along x between elements of mean radius, outside of all regions.
  BeamSection<double> common_section() const;

  /// Where the beam between two elements flows and breaks, over what the laws say.
  LimitScale<double> limits(Pair pair) const {
    if (parameters_.materials.empty()) return {};
    return materials_.between(pair.i, pair.j).limits;
  }

  /// Its stiffness times its rest length.
  BeamRigidity<double> rigidity(const BeamSection<double>& section, double rest_length) const;

 private:
  BeamParameters parameters_;
  BeamSection<double> section(const BeamElasticity& made_of, double radius_i, double radius_j,
                              const Vector& chord) const;

  BeamMaterialTable materials_;  ///< empty: one for all
  double mean_radius_, bond_tolerance_, contact_margin_;
};

}  // namespace solidem

#endif

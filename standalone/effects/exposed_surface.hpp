// SPDX-License-Identifier: GPL-2.0-or-later
#ifndef SOLIDEM_EFFECTS_EXPOSED_SURFACE_HPP
#define SOLIDEM_EFFECTS_EXPOSED_SURFACE_HPP

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "effects/assembly.hpp"
#include "effects/heated_faces.hpp"
#include "effects/plan.hpp"
#include "effects/surroundings.hpp"

namespace solidem {

/// The whole surface of a body, wherever heat may leave it: its walls where they are known, else
/// what its elements show (effects/surroundings.hpp); and what cracks lay open since.
///
/// Elements that were near each other at the start, and joined by at most three bonds in a row,
/// hide each other until they are so no longer. One broken bond opens nothing while others hold on
/// beside it. Where elements are does not count: the surface is that of the body at rest, and so
/// follows from the bonds of now alone.
class ExposedSurface : public Effect {
 public:
  /// The word that names it where walls are named.
  static const std::string word;

  explicit ExposedSurface(const Assembly& assembly);

  /// The faces of some elements.
  HeatedFaces part(const std::vector<std::int32_t>& elements);

  /// Brings the faces up to date with the bonds; whether any changed.
  bool follow_bonds();

  void advance(Model& /*model*/, const Step& /*step*/) override {}
  void observe(const Model& model, Observation& observation) const override;
  /// To be read after the bonds.
  void state(Archive& archive) override;

 private:
  struct Part {
    std::vector<char> holds;  ///< each element
    std::shared_ptr<std::vector<WallFace>> faces;
  };
  /// Elements joined with one by so many bonds in a row, the element itself too.
  std::vector<std::int32_t> joined(const std::vector<std::int32_t>& from, int bonds) const;
  /// Looks at what hides these elements, and what that means for them and those near; whether
  /// anything is new.
  bool look_at(const std::vector<std::int32_t>& elements);
  void measure(std::size_t element);
  void fill(const Part& part) const;

  const Model& model_;
  bool may_grow_;
  std::vector<WallFace> at_start_;
  std::optional<Surroundings> surroundings_;  ///< where walls do not tell all
  // The rest is empty where bonds never break.
  std::vector<Vector> closed_;            ///< vector area of each element at the start, m²
  std::vector<Vector> laid_open_;         ///< since, m²
  std::vector<double> grown_;             ///< area since, m²
  std::vector<char> was_joined_, apart_;  ///< entries of what is near
  std::size_t seen_ = 0;                  ///< changes of bonds followed so far
  double area_ = 0;                       ///< m²
  std::vector<Part> parts_;
};

/// Plans it for an entry that names this wall, once.
void plan_exposed_surface(const std::string& wall, const std::string& section, Plan& plan);

}  // namespace solidem

#endif

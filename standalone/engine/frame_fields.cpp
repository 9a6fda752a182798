// SPDX-License-Identifier: GPL-2.0-or-later
#include "engine/frame_fields.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <optional>
#include <stdexcept>
#include <utility>

#include "effects/mechanics.hpp"
#include "engine/element_tensors.hpp"
#include "engine/simulation.hpp"
#include "model/columns.hpp"
#include "model/error.hpp"

namespace solidem {

namespace {

/// What fields are worked out from; what several of them need, once.
class Scenery {
 public:
  Scenery(const Simulation& simulation, const Frame& frame)
      : model_(simulation.model()), frame_(frame), effects_(simulation.effects()) {}

  const Model& model() const { return model_; }
  const Frame& frame() const { return frame_; }
  /// Bonds, or central forces.
  std::vector<const ActsBetweenElements*> mechanics() const {
    const auto found = those_that_are<Mechanics>(effects_);
    return {found.begin(), found.end()};
  }

  const ElementTensors& stress() {
    if (!stress_)
      stress_ = element_stress(model_, those_that_are<ActsBetweenElements>(effects_),
                               those_that_are<TouchesElements>(effects_));
    return *stress_;
  }
  const ElementTensors& deformation() {
    if (!deformation_) deformation_ = deformation_gradient(model_, mechanics());
    return *deformation_;
  }

 private:
  const Model& model_;
  const Frame& frame_;
  const std::vector<std::unique_ptr<Effect>>& effects_;
  std::optional<ElementTensors> stress_, deformation_;
};

/// What a field cannot be shown of.
using Need = std::string (*)(const Model&);

std::string motion(const Model& model) {
  return model.moves() ? "" : "nothing moves";
}
std::string rotation(const Model& model) {
  return model.has(columns::pose) ? "" : "elements have no orientation";
}
std::string bonds(const Model& model) {
  return model.has(columns::pose) && !model.slots().pairs().empty() ? "" : "no bonds are drawn";
}
std::string flow(const Model& model) {
  return model.has(columns::plastic_work) ? "" : "bonds do not flow";
}
std::string heat(const Model& model) {
  return model.has(columns::temperature) ? "" : "nothing conducts heat";
}

using Numbers = std::vector<double>;

void append(Numbers& values, const Vector& v) {
  values.insert(values.end(), {v.x, v.y, v.z});
}

/// xx yy zz xy yz xz, as VTK orders a symmetric tensor, and hence ParaView calls its components.
void append_symmetric(Numbers& values, const Eigen::Matrix3d& t) {
  values.insert(values.end(), {t(0, 0), t(1, 1), t(2, 2), t(0, 1), t(1, 2), t(0, 2)});
}

Numbers displacement(Scenery& scenery) {
  const auto positions = scenery.model().positions();
  Numbers values;
  for (std::size_t i = 0; i < scenery.model().elements(); ++i) {
    const Vector& rest = scenery.model().specimen().position[i];
    append(values, Vector{positions[i][0], positions[i][1], positions[i][2]} - rest);
  }
  return values;
}

Numbers orientation(Scenery& scenery) {
  const double* pose = scenery.model().data(columns::pose);
  Numbers values;
  for (std::size_t i = 0; i < scenery.model().elements(); ++i)
    values.insert(values.end(), pose + 8 * i + 4, pose + 8 * i + 8);
  return values;
}

Numbers stress(Scenery& scenery) {
  Numbers values;
  for (const Eigen::Matrix3d& tensor : scenery.stress()) append_symmetric(values, tensor);
  return values;
}

Numbers mean_stress(Scenery& scenery) {
  Numbers values;
  for (const Eigen::Matrix3d& tensor : scenery.stress()) values.push_back(tensor.trace() / 3);
  return values;
}

Numbers von_mises_stress(Scenery& scenery) {
  Numbers values;
  for (const Eigen::Matrix3d& tensor : scenery.stress()) {
    const Eigen::Matrix3d deviator = tensor - tensor.trace() / 3 * Eigen::Matrix3d::Identity();
    values.push_back(std::sqrt(1.5) * deviator.norm());
  }
  return values;
}

Numbers principal_stresses(Scenery& scenery) {
  Numbers values;
  for (const Eigen::Matrix3d& tensor : scenery.stress()) {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> principal(tensor, Eigen::EigenvaluesOnly);
    const Eigen::Vector3d& ascending = principal.eigenvalues();
    values.insert(values.end(), {ascending(2), ascending(1), ascending(0)});
  }
  return values;
}

Numbers deformation_gradient(Scenery& scenery) {
  Numbers values;
  for (const Eigen::Matrix3d& tensor : scenery.deformation())
    for (int row = 0; row < 3; ++row)
      values.insert(values.end(), {tensor(row, 0), tensor(row, 1), tensor(row, 2)});
  return values;
}

Numbers strain(Scenery& scenery) {
  Numbers values;
  for (const Eigen::Matrix3d& f : scenery.deformation())
    append_symmetric(values, 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity()));
  return values;
}

Numbers gradient_of_temperature(Scenery& scenery) {
  Numbers values;
  for (const Vector& gradient : temperature_gradient(scenery.model())) append(values, gradient);
  return values;
}

/// What an effect shows of the bonds.
const Numbers& shown_of_bonds(const Frame& frame, const std::string& name) {
  for (const Frame::Field& field : frame.fields())
    if (field.of_bonds && field.name == name) return field.values;
  throw std::logic_error("no effect shows " + name);
}

/// The mean over the bonds that an element still has; 0 where it has none.
Numbers plastic_strain(Scenery& scenery) {
  const Numbers& of_bond = shown_of_bonds(scenery.frame(), "plastic_strain");
  const Numbers& intact = shown_of_bonds(scenery.frame(), "intact");
  Numbers sum(scenery.model().elements(), 0.0), count(sum);
  const std::vector<Pair>& pairs = scenery.frame().bonds();
  for (std::size_t bond = 0; bond < pairs.size(); ++bond) {
    if (intact[bond] == 0) continue;
    for (const std::int32_t element : {pairs[bond].i, pairs[bond].j}) {
      sum[static_cast<std::size_t>(element)] += of_bond[bond];
      count[static_cast<std::size_t>(element)] += 1;
    }
  }
  for (std::size_t i = 0; i < sum.size(); ++i)
    if (count[i] > 0) sum[i] /= count[i];
  return sum;
}

/// A load of each bond that is drawn; 0 where it has broken.
Numbers of_bonds(Scenery& scenery, Vector PairLoad::*load) {
  const std::vector<Pair>& drawn = scenery.frame().bonds();
  const auto ends = [](const Pair& pair) { return std::pair(pair.i, pair.j); };
  const auto before = [&](const Pair& a, const Pair& b) { return ends(a) < ends(b); };
  Numbers values(3 * drawn.size(), 0.0);
  for (const ActsBetweenElements* actor : scenery.mechanics())
    actor->for_each_pair(scenery.model(), [&](const PairLoad& pair) {
      const Pair sought{pair.i, pair.j};
      const auto found = std::lower_bound(drawn.begin(), drawn.end(), sought, before);
      if (found == drawn.end() || ends(*found) != ends(sought)) return;
      const Vector& on_i = pair.*load;
      const auto at = static_cast<std::size_t>(3 * (found - drawn.begin()));
      values[at] = on_i.x, values[at + 1] = on_i.y, values[at + 2] = on_i.z;
    });
  return values;
}

Numbers force(Scenery& scenery) {
  return of_bonds(scenery, &PairLoad::force);
}
Numbers moment(Scenery& scenery) {
  return of_bonds(scenery, &PairLoad::moment);
}

struct FieldKind {
  FieldName name;
  const char* written_as;
  int components;
  bool of_bonds;
  Need missing;
  Numbers (*values)(Scenery&);
};

const std::vector<FieldKind>& kinds() {
  static const std::vector<FieldKind> all{
      {{"displacement", "from where an element is at rest: x y z, m"},
       "displacement",
       3,
       false,
       motion,
       displacement},
      {{"orientation", "quaternion of the turn since the start: w x y z"},
       "orientation",
       4,
       false,
       rotation,
       orientation},
      {{"stress", "virial stress, tension positive: xx yy zz xy yz xz, Pa"},
       "stress",
       6,
       false,
       motion,
       stress},
      {{"mean_stress", "a third of its trace, Pa"}, "mean_stress", 1, false, motion, mean_stress},
      {{"von_mises_stress", "of the same tensor, Pa"},
       "von_mises_stress",
       1,
       false,
       motion,
       von_mises_stress},
      {{"principal_stresses", "the largest first, Pa"},
       "principal_stresses",
       3,
       false,
       motion,
       principal_stresses},
      {{"deformation_gradient", "F by least squares over neighbours: nine, row by row"},
       "deformation_gradient",
       9,
       false,
       motion,
       deformation_gradient},
      {{"strain", "Green–Lagrange strain ½ (FᵀF − 1): xx yy zz xy yz xz"},
       "strain",
       6,
       false,
       motion,
       strain},
      {{"plastic_strain", "mean over the bonds of an element"},
       "plastic_strain",
       1,
       false,
       flow,
       plastic_strain},
      {{"temperature_gradient", "by least squares over neighbours: x y z, K/m"},
       "temperature_gradient",
       3,
       false,
       heat,
       gradient_of_temperature},
      {{"bond_force", "on the first of a bond's two elements: x y z, N; stands in `bonds/force`"},
       "force",
       3,
       true,
       bonds,
       force},
      {{"bond_moment",
        "on the first of a bond's two elements: x y z, N m; stands in `bonds/moment`"},
       "moment",
       3,
       true,
       bonds,
       moment},
  };
  return all;
}

const FieldKind& kind_of(const std::string& name) {
  return *std::find_if(kinds().begin(), kinds().end(),
                       [&](const FieldKind& kind) { return kind.name.name == name; });
}

}  // namespace

const std::vector<FieldName>& frame_field_names() {
  static const std::vector<FieldName> names = [] {
    std::vector<FieldName> found;
    for (const FieldKind& kind : kinds()) found.push_back(kind.name);
    return found;
  }();
  return names;
}

FrameFields::FrameFields(const Simulation& simulation, std::vector<std::string> names)
    : simulation_(simulation), names_(std::move(names)) {
  for (const std::string& name : names_) {
    const std::string missing = kind_of(name).missing(simulation.model());
    if (!missing.empty())
      throw InputError(fmt::format("[output] fields: \"{}\" cannot be shown: {}", name, missing));
  }
}

std::vector<FrameFields::Values> FrameFields::of_now(const Frame& frame) const {
  Scenery scenery(simulation_, frame);
  std::vector<Values> found;
  for (const std::string& name : names_) {
    const FieldKind& kind = kind_of(name);
    found.push_back({kind.written_as, kind.components, kind.values(scenery), kind.of_bonds});
  }
  return found;
}

}  // namespace solidem
